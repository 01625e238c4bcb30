/// Seconds, sorts and memory of the tree builders against the number of lights, and the size of the cuts that their
/// trees lead to. Prints a table and writes tree_build.json. A sort is the time of std::sort of as many random 64-bit
/// keys, measured in the same run.

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
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
#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/light/directional.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/tree/build/agglomerate.hpp>
#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/light_tree.hpp>
#include <lightcuts/tree/statistics.hpp>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "support/threads.hpp"
#include "timing.hpp"

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
lightcuts::test::Threads all_threads() { return {std::thread::hardware_concurrency()}; }

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

using Receiver = lightcuts::Receiver<lightcuts::Lambert<float>>;
using Receivers = std::vector<Receiver>;

/// Diffuse receivers in the space that the lights are in: `place(uniform)` says where, `normal(uniform)` how they face.
template <class Place, class Normal>
Receivers receivers(Place&& place, Normal&& normal) {
    Uniform uniform;
    Receivers made;
    for (std::uint32_t id = 0; id < 200; ++id) {
        const glm::vec3 p = place(uniform);
        made.emplace_back(p, lightcuts::Lambert<float>{normal(uniform), 0.5f}, p, id);
    }
    return made;
}

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

/// In the hall, facing up.
Receivers below_ceiling() {
    return receivers([](Uniform& uniform) { return uniform.cube() * glm::vec3(18.2f, 5.0f, 10.6f); },
                     [](Uniform& uniform) {
                         const glm::vec3 normal = uniform.direction();
                         return glm::vec3(normal.x, std::abs(normal.y), normal.z);
                     });
}

/// A room that is turned against the axes.
constexpr glm::vec3 room_size(20, 6, 12);

glm::vec3 turn(const glm::vec3& v) {
    const float c = std::cos(0.7f), s = std::sin(0.7f);
    const glm::vec3 w(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
    return glm::vec3(w.x, c * w.y - s * w.z, s * w.y + c * w.z);
}

/// Lights all over the walls of the room; `bumpiness` jitters their normals.
std::vector<OrientedItem> surfaces(std::size_t count, float bumpiness) {
    Uniform uniform;
    std::vector<OrientedItem> items;
    for (std::size_t i = 0; i < count; ++i) {
        const int wall = static_cast<int>(6 * uniform()), side = wall / 2;
        glm::vec3 p = uniform.cube() * room_size, normal(0);
        p[side] = wall % 2 == 0 ? 0.0f : room_size[side];
        normal[side] = wall % 2 == 0 ? 1.0f : -1.0f;
        normal += bumpiness * uniform.direction();
        items.push_back({turn(p), turn(glm::normalize(normal)), 0.1f + uniform()});
    }
    return items;
}

/// In the room.
Receivers between_surfaces() {
    return receivers([](Uniform& uniform) { return turn(uniform.cube() * room_size); },
                     [](Uniform& uniform) { return uniform.direction(); });
}

/// Lights without direction in a cube.
std::vector<PointItem> volume(std::size_t count) {
    Uniform uniform;
    std::vector<PointItem> items;
    for (std::size_t i = 0; i < count; ++i) items.push_back({uniform.cube(), 0.1f + uniform()});
    return items;
}

/// In the cube.
Receivers in_volume() {
    return receivers([](Uniform& uniform) { return uniform.cube(); },
                     [](Uniform& uniform) { return uniform.direction(); });
}

/// Equally spaced lights on a line, each weaker than the one before: of each light the nearest neighbor, as greedy
/// builders measure it, is the next one. 2^k + 1 of them, at least `count`: in this number chains of nearest neighbors
/// are longest.
std::vector<PointItem> strip(std::size_t count) {
    std::vector<PointItem> items;
    count = std::bit_ceil(count) + 1;
    for (std::size_t i = 0; i < count; ++i) {
        const float x = static_cast<float>(i) / static_cast<float>(count - 1);
        items.push_back({{x, 0, 0}, 1.0f + static_cast<float>(count - i) / static_cast<float>(count)});
    }
    return items;
}

/// The same lights with random weights.
std::vector<PointItem> uneven_strip(std::size_t count) {
    Uniform uniform;
    std::vector<PointItem> items = strip(count);
    for (PointItem& item : items) item.weight = 1.0f + uniform();
    return items;
}

/// On either side of the line.
Receivers along_strip() {
    return receivers(
        [](Uniform& uniform) { return (uniform.cube() - glm::vec3(0, 0.5f, 0.5f)) * glm::vec3(1, 0.2f, 0.2f); },
        [](Uniform& uniform) { return uniform.direction(); });
}

/// Lights at infinity, all around.
std::vector<PointItem> directions(std::size_t count) {
    Uniform uniform;
    std::vector<PointItem> items;
    for (std::size_t i = 0; i < count; ++i) items.push_back({uniform.direction(), 0.1f + uniform()});
    return items;
}

lightcuts::OrientedPointLight<float> oriented_light(const OrientedItem& item) {
    return {item.position, item.axis, item.weight, {}};
}
lightcuts::OmniLight<float> omni_light(const PointItem& item) { return {item.position, item.weight, {}}; }
lightcuts::DistantLight<float> distant_light(const PointItem& item) { return {item.position, item.weight}; }

/// Mean size of the cuts of `receivers` through `topology`, without shadows and without a limit.
template <class Light>
double mean_cut_size(const ClusterTree& topology, const std::vector<Light>& lights, const Receivers& receivers) {
    const auto adopt = [&](const auto&, const auto&) { return topology; };
    const lightcuts::LightTree tree(lights, {}, adopt);
    lightcuts::LightcutOptions options;
    options.max_cut = 0;
    double sum = 0;
    for (const Receiver& receiver : receivers) {
        sum += lightcuts::shade(tree, receiver, lightcuts::AlwaysVisible{}, options).cut_size;
    }
    return sum / static_cast<double>(receivers.size());
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

/// What the rows of one set of lights have in common.
template <class Item>
struct LightSet {
    std::string name;
    std::span<const Item> items;
    double sort;                                         ///< seconds
    std::function<double(const ClusterTree&)> cut_size;  ///< that a tree of the items leads to
};

class Table {
public:
    explicit Table(Options options) : options_(std::move(options)) {
        std::printf("%-13s %-22s %9s | %9s %7s | %8s %8s | %6s %10s | %7s\n", "lights", "builder", "number", "seconds",
                    "sorts", "bytes a", "and while", "depth", "cost", "cut");
        std::printf("%-13s %-22s %9s | %9s %7s | %8s %8s | %6s %10s | %7s\n", "", "", "", "", "", "light", "building",
                    "mean", "a light", "size");
    }

    /// `make(count)`: the items. `light(item)`: a light of it. `receivers`: of which the cuts are.
    template <class Item, class MakeLight>
    void measure(const std::string& name, std::vector<Item> (*make)(std::size_t), MakeLight&& light,
                 const Receivers& receivers) {
        for (std::size_t count = 1000; count <= std::max(options_.max_divide, options_.max_agglomerate); count *= 10) {
            const std::vector<Item> items = make(count);
            const std::span<const Item> span(items);
            const auto cut_size = [&](const ClusterTree& tree) {
                std::vector<decltype(light(items[0]))> lights;
                lights.reserve(items.size());
                for (const Item& item : items) lights.push_back(light(item));
                return mean_cut_size(tree, lights, receivers);
            };
            const LightSet<Item> set{name, span, sort_seconds(count, options_.runs), cut_size};
            if (count <= options_.max_divide) {
                row(set, "binned", [&] { return lightcuts::divide(span); });
                row(set, "binned, all items", [&] { return lightcuts::divide(span, lightcuts::Binned{0}); });
                row(set, "longest axis", [&] { return lightcuts::divide(span, lightcuts::LongestAxis{}); });
                threaded_row(set, "binned, threads",
                             [&] { return lightcuts::divide(span, lightcuts::Binned{}, all_threads()); });
            }
            if (count <= options_.max_agglomerate) {
                row(set, "agglomerate", [&] { return lightcuts::agglomerate(span); });
                threaded_row(set, "agglomerate, threads",
                             [&] { return lightcuts::agglomerate(span, lightcuts::ClusterSize{}, all_threads()); });
            }
        }
    }

    const nlohmann::json& rows() const { return rows_; }

private:
    template <class Item, class Build>
    void row(const LightSet<Item>& set, const std::string& builder, Build&& build) {
        add(set, builder, build, [](auto&& f) { return benchmark::seconds(f); });
    }

    /// By the clock on the wall: means something on an idle machine only.
    template <class Item, class Build>
    void threaded_row(const LightSet<Item>& set, const std::string& builder, Build&& build) {
        add(set, builder, build, [](auto&& f) {
            const auto start = std::chrono::steady_clock::now();
            f();
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        });
    }

    template <class Item, class Build, class Clock>
    void add(const LightSet<Item>& set, const std::string& builder, Build&& build, Clock&& clock) {
        if ((set.name + " " + builder).find(options_.only) == std::string::npos) return;
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
        const auto count = static_cast<double>(set.items.size());
        const double final_bytes = static_cast<double>(sizeof(std::uint32_t) * tree.size()) / count;
        const double peak_bytes = static_cast<double>(most) / count;
        const lightcuts::TreeStatistics statistics = lightcuts::statistics(tree, set.items);
        const double cut_size = set.cut_size(tree);
        std::printf("%-13s %-22s %9zu | %9.4f %7.2f | %8.1f %8.1f | %6.1f %10.4g | %7.1f\n", set.name.c_str(),
                    builder.c_str(), set.items.size(), seconds, seconds / set.sort, final_bytes, peak_bytes,
                    statistics.depth_mean, statistics.cost / count, cut_size);
        std::fflush(stdout);
        rows_.push_back({{"lights", set.name},
                         {"builder", builder},
                         {"count", set.items.size()},
                         {"seconds", seconds},
                         {"sorts", seconds / set.sort},
                         {"bytes_per_light", final_bytes},
                         {"bytes_per_light_while_building", peak_bytes},
                         {"depth_max", statistics.depth_max},
                         {"depth_mean", statistics.depth_mean},
                         {"cost_per_light", statistics.cost / count},
                         {"cut_size", cut_size}});
    }

    Options options_;
    nlohmann::json rows_ = nlohmann::json::array();
};

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{"Time and memory of the tree builders"};
    app.add_option("--only", options.only, "measure only rows whose name (lights builder) contains this");
    app.add_option("--runs", options.runs, "odd, of which the median is taken")->check(benchmark::odd_number());
    app.add_option("--max-divide", options.max_divide, "most lights for divide, say 10000000");
    app.add_option("--max-agglomerate", options.max_agglomerate, "most lights for agglomerate");
    CLI11_PARSE(app, argc, argv);

    return benchmark::write_figures("bench-tree_build", "tree_build.json", [&] {
        Table table(options);
        table.measure<OrientedItem>("ceiling", ceiling, oriented_light, below_ceiling());
        table.measure<OrientedItem>(
            "surfaces", [](std::size_t n) { return surfaces(n, 0.0f); }, oriented_light, between_surfaces());
        table.measure<OrientedItem>(
            "bumpy", [](std::size_t n) { return surfaces(n, 0.2f); }, oriented_light, between_surfaces());
        table.measure<PointItem>("volume", volume, omni_light, in_volume());
        table.measure<PointItem>("directional", directions, distant_light, in_volume());
        table.measure<PointItem>("strip", strip, omni_light, along_strip());
        table.measure<PointItem>("uneven strip", uneven_strip, omni_light, along_strip());
        return table.rows();
    });
}
