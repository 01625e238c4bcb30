/// Bounds of clusters of glossy gather points by the library's envelopes and by cube maps of 6 x 6 cells a face: how
/// far above the largest value, nanoseconds, and what they make of sums over pairs. Prints a table and writes
/// gloss_bounds.json.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <lightcuts/core/random.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/phong.hpp>
#include <lightcuts/product/gather.hpp>
#include <nlohmann/json.hpp>

#include "cube_map_envelope.hpp"
#include "figures.hpp"
#include "timing.hpp"

namespace {

using namespace benchmark;
using lightcuts::GatherPoint;
using Phong = lightcuts::ModifiedPhong<float>;
using Ggx = lightcuts::Ggx<float>;

/// Numbers in [0, 1) that do not depend on one another.
class Numbers {
public:
    explicit Numbers(std::uint64_t seed) : seed_(seed) {}
    double unit() { return lightcuts::uniform01(lightcuts::hash_keys(seed_, count_++)); }
    double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
    glm::dvec3 in_cube() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
    glm::dvec3 on_sphere() {
        for (;;) {
            const glm::dvec3 p = in_cube();
            const double length = glm::length(p);
            if (length > 0.01 && length < 1.0) return p / length;
        }
    }

private:
    std::uint64_t seed_;
    std::uint64_t count_ = 0;
};

/// What a pixel sees of a surface: normals within `turn` of one another, seen from one place.
template <class M, class MakeLobe>
std::vector<GatherPoint<M, float>> pixel_of(Numbers& numbers, std::size_t count, double turn,
                                            const MakeLobe& make_lobe) {
    const glm::dvec3 middle = 0.5 * numbers.in_cube(), facing = numbers.on_sphere();
    const glm::dvec3 eye = glm::normalize(facing + numbers.on_sphere() * 0.8);
    std::vector<GatherPoint<M, float>> points;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 normal(glm::normalize(facing + std::tan(turn) * numbers.in_cube()));
        const glm::vec3 position(middle + 0.01 * numbers.in_cube());
        const lightcuts::Receiver<M> receiver{position, M(make_lobe(normal, glm::vec3(eye))), position,
                                              static_cast<std::uint32_t>(i)};
        points.push_back({receiver, 1.0f / static_cast<float>(count)});
    }
    return points;
}

struct Figures {
    double over = 0;         ///< geometric mean of bound / largest value, where that is above a thousandth of the peak
    double bound_ns = 0;     ///< of a bound
    double envelope_us = 0;  ///< to make one point's envelope and merge it
    double cut = 0;          ///< mean pairs on the cut
    double trees_us = 0, gather_us = 0;  ///< a pixel
};

struct Case {
    std::string lobe;
    double turn;  ///< radians between normals
};

/// `M`: a lobe, ByCubeMap or itself. `make_lobe(normal, view)`: the lobe itself.
template <class M, class MakeLobe>
Figures measure(const Case& c, const MakeLobe& make_lobe, int pixels) {
    Figures figures;
    constexpr std::size_t points_a_pixel = 64;
    // Bounds of whole pixels over boxes of lights, against points of the boxes, corners too.
    Numbers numbers(1);
    double logarithms = 0.0, bound_seconds = 0.0, envelope_seconds = 0.0;
    int counted = 0, bounds = 0;
    for (int pixel = 0; pixel < pixels; ++pixel) {
        const auto points = pixel_of<M>(numbers, points_a_pixel, c.turn, make_lobe);
        auto envelope = lightcuts::detail::envelope_of_lobe(points[0].receiver.material);
        envelope_seconds += seconds([&] {
            for (const auto& p : points) {
                envelope = merge(envelope, lightcuts::detail::envelope_of_lobe(p.receiver.material));
            }
        });
        const glm::dvec3 main = glm::normalize(glm::dvec3(points[0].receiver.material.main_direction()));
        double peak = 0.0;
        std::vector<std::pair<double, double>> found;  // bound, largest value
        for (int i = 0; i < 30; ++i) {
            const glm::dvec3 middle = glm::normalize(main + numbers.between(0.0, 1.2) * numbers.on_sphere());
            const double size = std::pow(10.0, numbers.between(-2.0, -0.5));
            const lightcuts::OffsetBox box{middle - size, middle + size};
            double bound = 0.0;
            constexpr int again = 4;
            bound_seconds += seconds([&] {
                for (int k = 0; k < again; ++k) {
                    bound += static_cast<double>(lightcuts::detail::upper_bound_over<float>(envelope, box));
                }
            });
            bounds += again;
            double largest = 0.0;
            for (int k = 0; k < 40; ++k) {
                glm::dvec3 way = numbers.in_cube();
                if (k < 8) way = {k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1};
                const glm::vec3 direction(glm::normalize(middle + size * way));
                for (const auto& p : points) {
                    largest = std::fmax(largest, static_cast<double>(p.receiver.material.evaluate(direction)));
                }
            }
            peak = std::fmax(peak, largest);
            found.emplace_back(bound / again, largest);
        }
        for (const auto& [bound, largest] : found) {
            if (bound < largest) throw std::runtime_error("a bound is below a value");
            if (!(largest > 1e-3 * peak)) continue;
            logarithms += std::log(bound / largest);
            ++counted;
        }
    }
    figures.over = std::exp(logarithms / counted);
    figures.bound_ns = 1e9 * bound_seconds / bounds;
    figures.envelope_us = 1e6 * envelope_seconds / (pixels * static_cast<double>(points_a_pixel));

    // Sums over all pairs with lights all around.
    std::vector<lightcuts::OmniLight<float>> lights;
    for (int i = 0; i < 5000; ++i)
        lights.push_back({glm::vec3(numbers.on_sphere() * numbers.between(1.5, 2.5)), 1.0f, {}});
    const lightcuts::LightTree tree(lights);
    lightcuts::GatherForest<GatherPoint<M, float>> trees;
    lightcuts::gather_scratch_of<decltype(tree)> scratch;
    for (int pixel = 0; pixel < pixels; ++pixel) {
        const auto points = pixel_of<M>(numbers, points_a_pixel, c.turn, make_lobe);
        figures.trees_us += 1e6 / pixels * seconds([&] { trees.build(points, {}); });
        figures.gather_us += 1e6 / pixels * seconds([&] {
                                 const auto result = lightcuts::gather(tree, trees, lightcuts::AlwaysVisible{}, scratch,
                                                                       {.cut = {.max_cut = 0}});
                                 figures.cut += static_cast<double>(result.cut_size) / pixels;
                             });
    }
    return figures;
}

nlohmann::json to_json(const Figures& f) {
    return {{"bound_over_largest", f.over}, {"bound_ns", f.bound_ns},
            {"envelope_us", f.envelope_us}, {"cut_size", f.cut},
            {"trees_us", f.trees_us},       {"gather_us", f.gather_us}};
}

template <class M, class MakeLobe>
nlohmann::json compare(const Case& c, const MakeLobe& make_lobe, int pixels) {
    nlohmann::json row{{"lobe", c.lobe}, {"turn", c.turn}};
    const auto add = [&](const char* name, const Figures& f) {
        std::printf("%-12s %5.2f  %-9s | %9.2f %9.0f %9.2f | %9.0f %9.0f %9.0f\n", c.lobe.c_str(), c.turn, name, f.over,
                    f.bound_ns, f.envelope_us, f.cut, f.trees_us, f.gather_us);
        std::fflush(stdout);
        row[name] = to_json(f);
    };
    add("envelope", measure<M>(c, make_lobe, pixels));
    add("cube map", measure<ByCubeMap<M>>(c, make_lobe, pixels));
    return row;
}

}  // namespace

int main(int argc, char** argv) {
    int pixels = 60;
    CLI::App app{"Bounds of clusters of glossy gather points by envelopes and by cube maps"};
    app.add_option("--pixels", pixels, "sums of 64 gather points")->check(CLI::PositiveNumber);
    CLI11_PARSE(app, argc, argv);
    return write_figures("bench-gloss_bounds", "gloss_bounds.json", [&] {
        nlohmann::json rows = nlohmann::json::array();
        std::printf("%-12s %5s  %-9s | %9s %9s %9s | %9s %9s %9s\n", "lobe", "turn", "bound by", "/ largest", "ns",
                    "us a point", "cut", "trees us", "sum us");
        for (const double turn : {0.0, 0.1, 0.5}) {
            for (const float exponent : {10.0f, 100.0f, 1000.0f}) {
                rows.push_back(compare<Phong>(
                    {"Phong " + std::to_string(static_cast<int>(exponent)), turn},
                    [&](const glm::vec3& n, const glm::vec3& v) { return Phong(n, v, 1.0f, exponent); }, pixels));
            }
            for (const float alpha : {0.4f, 0.1f}) {
                rows.push_back(compare<Ggx>(
                    {alpha > 0.2f ? "GGX 0.4" : "GGX 0.1", turn},
                    [&](const glm::vec3& n, const glm::vec3& v) { return Ggx(n, v, 0.9f, alpha); }, pixels));
            }
        }
        return rows;
    });
}
