/// Seconds, sorts and memory of the tree builders against the number of lights. Prints a table and writes
/// tree_build.json. A sort is the time of std::sort of as many random 64-bit keys, measured in the same run.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <new>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <lightcuts/tree/agglomerate.hpp>
#include <lightcuts/tree/divide.hpp>
#include <lightcuts/tree/statistics.hpp>
#include <nlohmann/json.hpp>

#include "workload.hpp"

namespace {

/// Bytes on the heap, now and at most since last asked; see operator new below.
std::atomic<std::size_t> allocated = 0, most_allocated = 0;

void* allocate(std::size_t size, std::size_t alignment) {
    // The size is kept in front of the block, which stays aligned.
    const std::size_t header = std::max(alignment, sizeof(std::size_t));
    void* block = std::aligned_alloc(header, (size + 2 * header - 1) / header * header);
    if (block == nullptr) throw std::bad_alloc();
    *static_cast<std::size_t*>(block) = size;
    const std::size_t now = allocated += size;
    for (std::size_t most = most_allocated; most < now && !most_allocated.compare_exchange_weak(most, now);) {}
    return static_cast<char*>(block) + header;
}

void release(void* pointer, std::size_t alignment) noexcept {
    if (pointer == nullptr) return;
    void* block = static_cast<char*>(pointer) - std::max(alignment, sizeof(std::size_t));
    allocated -= *static_cast<std::size_t*>(block);
    std::free(block);
}

constexpr std::size_t usual = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

}  // namespace

void* operator new(std::size_t size) { return allocate(size, usual); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept { release(p, usual); }
void operator delete(void* p, std::size_t) noexcept { release(p, usual); }
void operator delete(void* p, std::align_val_t alignment) noexcept { release(p, static_cast<std::size_t>(alignment)); }
void operator delete(void* p, std::size_t, std::align_val_t alignment) noexcept {
    release(p, static_cast<std::size_t>(alignment));
}

namespace {

using lightcuts::ClusterTree;
using lightcuts::OrientedItem;
using lightcuts::PointItem;

/// An executor of as many threads as the machine has.
struct Threads {
    template <class Task>
    void operator()(std::size_t count, Task&& task) const {
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t i = next++; i < count; i = next++) task(i);
        };
        std::vector<std::jthread> others;
        for (std::size_t t = 1; t < std::min<std::size_t>(count, std::thread::hardware_concurrency()); ++t) {
            others.emplace_back(work);
        }
        work();
    }
};

/// Uniform numbers in [0, 1).
class Uniform {
public:
    float operator()() { return distribution_(engine_); }
    glm::vec3 cube() {
        const float x = (*this)(), y = (*this)(), z = (*this)();
        return {x, y, z};
    }
    glm::vec3 direction() {
        const float z = 2 * (*this)() - 1, phi = 2 * std::numbers::pi_v<float> * (*this)();
        const float r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::mt19937 engine_;
    std::uniform_real_distribution<float> distribution_;
};

/// 72 panels of 0.6 m in the ceiling of a hall, facing down.
std::vector<OrientedItem> ceiling(std::size_t count) {
    Uniform uniform;
    std::vector<OrientedItem> items;
    for (std::size_t i = 0; i < count; ++i) {
        const auto column = static_cast<float>(i % 12), row = static_cast<float>(i / 12 % 6);
        const float x = 1.6f * column + 0.6f * uniform(), z = 2.0f * row + 0.6f * uniform();
        items.push_back({{x, 5.9f, z}, {0, -1, 0}, 1});
    }
    return items;
}

/// Lights all over the walls of a room that is turned against the axes; `bumpiness` jitters their normals.
std::vector<OrientedItem> surfaces(std::size_t count, float bumpiness) {
    Uniform uniform;
    const auto turn = [](const glm::vec3& v) {
        const float c = std::cos(0.7f), s = std::sin(0.7f);
        const glm::vec3 w(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
        return glm::vec3(w.x, c * w.y - s * w.z, s * w.y + c * w.z);
    };
    const glm::vec3 size(20, 6, 12);
    std::vector<OrientedItem> items;
    for (std::size_t i = 0; i < count; ++i) {
        const int wall = static_cast<int>(6 * uniform()), side = wall / 2;
        glm::vec3 p = uniform.cube() * size, normal(0);
        p[side] = wall % 2 == 0 ? 0.0f : size[side];
        normal[side] = wall % 2 == 0 ? 1.0f : -1.0f;
        normal += bumpiness * uniform.direction();
        items.push_back({turn(p), turn(glm::normalize(normal)), 0.1f + uniform()});
    }
    return items;
}

/// Lights without direction in a cube.
std::vector<PointItem> volume(std::size_t count) {
    Uniform uniform;
    std::vector<PointItem> items;
    for (std::size_t i = 0; i < count; ++i) items.push_back({uniform.cube(), 0.1f + uniform()});
    return items;
}

/// Lights at infinity, all around.
std::vector<PointItem> directions(std::size_t count) {
    Uniform uniform;
    std::vector<PointItem> items;
    for (std::size_t i = 0; i < count; ++i) items.push_back({uniform.direction(), 0.1f + uniform()});
    return items;
}

struct Options {
    std::string only;
    std::size_t runs = 3;
    std::size_t max_divide = 1'000'000, max_agglomerate = 1'000'000;
};

/// Processor seconds of sorting as many keys; the median of several runs.
double sort_seconds(std::size_t count, std::size_t runs) {
    std::mt19937_64 engine;
    std::vector<std::uint64_t> keys(count);
    std::vector<double> times;
    for (std::size_t run = 0; run < std::max<std::size_t>(5, runs); ++run) {
        std::generate(keys.begin(), keys.end(), engine);
        times.push_back(benchmark::seconds([&] { std::sort(keys.begin(), keys.end()); }));
    }
    return benchmark::median(times);
}

class Table {
public:
    explicit Table(Options options) : options_(std::move(options)) {
        std::printf("%-13s %-22s %9s | %9s %7s | %8s %8s | %6s %10s\n", "lights", "builder", "number", "seconds",
                    "sorts", "bytes a", "and while", "depth", "cost");
        std::printf("%-13s %-22s %9s | %9s %7s | %8s %8s | %6s %10s\n", "", "", "", "", "", "light", "building", "mean",
                    "a light");
    }

    template <class Item>
    void measure(const std::string& name, std::vector<Item> (*make)(std::size_t)) {
        for (std::size_t count = 1000; count <= std::max(options_.max_divide, options_.max_agglomerate); count *= 10) {
            const std::vector<Item> items = make(count);
            const std::span<const Item> span(items);
            const double sort = sort_seconds(count, options_.runs);
            if (count <= options_.max_divide) {
                row(name, "binned", span, sort, [&] { return lightcuts::divide(span); });
                row(name, "binned, all items", span, sort,
                    [&] { return lightcuts::divide(span, lightcuts::Binned{0}); });
                row(name, "longest axis", span, sort,
                    [&] { return lightcuts::divide(span, lightcuts::LongestAxis{}); });
                threaded_row(name, "binned, threads", span, sort,
                             [&] { return lightcuts::divide(span, lightcuts::Binned{}, Threads{}); });
            }
            if (count <= options_.max_agglomerate) {
                row(name, "agglomerate", span, sort, [&] { return lightcuts::agglomerate(span); });
                threaded_row(name, "agglomerate, threads", span, sort,
                             [&] { return lightcuts::agglomerate(span, lightcuts::ClusterSize{}, Threads{}); });
            }
        }
    }

    const nlohmann::json& rows() const { return rows_; }

private:
    template <class Item, class Build>
    void row(const std::string& lights, const std::string& builder, std::span<const Item> items, double sort,
             Build&& build) {
        add(lights, builder, items, sort, build, [](auto&& f) { return benchmark::seconds(f); });
    }

    /// By the clock on the wall: means something on an idle machine only.
    template <class Item, class Build>
    void threaded_row(const std::string& lights, const std::string& builder, std::span<const Item> items, double sort,
                      Build&& build) {
        add(lights, builder, items, sort, build, [](auto&& f) {
            const auto start = std::chrono::steady_clock::now();
            f();
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        });
    }

    template <class Item, class Build, class Clock>
    void add(const std::string& lights, const std::string& builder, std::span<const Item> items, double sort,
             Build&& build, Clock&& clock) {
        if ((lights + " " + builder).find(options_.only) == std::string::npos) return;
        ClusterTree tree;
        std::vector<double> times;
        std::size_t most = 0;
        for (std::size_t run = 0; run < options_.runs; ++run) {
            tree = ClusterTree{};
            const std::size_t before = allocated;
            most_allocated = before;
            times.push_back(clock([&] { tree = build(); }));
            most = most_allocated - before;
        }
        const double seconds = benchmark::median(times);
        const auto count = static_cast<double>(items.size());
        const double final_bytes = static_cast<double>(sizeof(std::uint32_t) * tree.size()) / count;
        const double peak_bytes = static_cast<double>(most) / count;
        const lightcuts::TreeStatistics statistics = lightcuts::statistics(tree, items);
        std::printf("%-13s %-22s %9zu | %9.4f %7.2f | %8.1f %8.1f | %6.1f %10.4g\n", lights.c_str(), builder.c_str(),
                    items.size(), seconds, seconds / sort, final_bytes, peak_bytes, statistics.depth_mean,
                    statistics.cost / count);
        std::fflush(stdout);
        rows_.push_back({{"lights", lights},
                         {"builder", builder},
                         {"count", items.size()},
                         {"seconds", seconds},
                         {"sorts", seconds / sort},
                         {"bytes_per_light", final_bytes},
                         {"bytes_per_light_while_building", peak_bytes},
                         {"depth_max", statistics.depth_max},
                         {"depth_mean", statistics.depth_mean},
                         {"cost_per_light", statistics.cost / count}});
    }

    Options options_;
    nlohmann::json rows_ = nlohmann::json::array();
};

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{"Time and memory of the tree builders"};
    app.add_option("--only", options.only, "measure only rows whose name (lights builder) contains this");
    app.add_option("--runs", options.runs, "of which the median is taken")->check(CLI::PositiveNumber);
    app.add_option("--max-divide", options.max_divide, "most lights for divide, say 10000000");
    app.add_option("--max-agglomerate", options.max_agglomerate, "most lights for agglomerate");
    CLI11_PARSE(app, argc, argv);

    Table table(options);
    table.measure<OrientedItem>("ceiling", ceiling);
    table.measure<OrientedItem>("surfaces", [](std::size_t n) { return surfaces(n, 0.0f); });
    table.measure<OrientedItem>("bumpy", [](std::size_t n) { return surfaces(n, 0.2f); });
    table.measure<PointItem>("volume", volume);
    table.measure<PointItem>("directional", directions);
    std::ofstream("tree_build.json") << table.rows().dump(2) << "\n";
}
