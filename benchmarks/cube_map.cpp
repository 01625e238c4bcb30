#include "cube_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <lightcuts/tree/validate.hpp>

namespace benchmark {

using lightcuts::ClusterTree;

CubeMap::CubeMap(std::size_t side) : side_(side) {
    const auto middle = [&](std::size_t i) {
        return (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(side) - 1.0;
    };
    for (std::size_t face = 0; face < 6; ++face) {
        for (std::size_t y = 0; y < side; ++y) {
            for (std::size_t x = 0; x < side; ++x) directions_.push_back(direction(face, middle(x), middle(y)));
        }
    }
}

glm::dvec3 CubeMap::direction(std::size_t face, double u, double v) {
    // The square to a part of the plane with curved edges, and that to the sphere by Lambert's projection turned about.
    const bool swapped = std::abs(v) > std::abs(u);
    if (swapped) std::swap(u, v);
    const double angle = u == 0.0 ? 0.0 : v / u * std::numbers::pi / 12.0;
    const double scale = std::sqrt(std::numbers::sqrt2) * u / std::sqrt(std::numbers::sqrt2 - std::cos(angle));
    double a = scale * (std::numbers::sqrt2 * std::cos(angle) - 1.0), b = scale * std::numbers::sqrt2 * std::sin(angle);
    if (swapped) std::swap(a, b);
    const double square = a * a + b * b, along = std::sqrt(1.0 - 0.25 * square), up = 1.0 - 0.5 * square;
    a *= along;
    b *= along;
    const glm::dvec3 of_axis[]{{up, a, b}, {-up, a, b}, {a, up, b}, {a, -up, b}, {a, b, up}, {a, b, -up}};
    return of_axis[face];
}

ClusterTree CubeMap::tree() const {
    std::vector<std::uint32_t> words;
    struct Part {
        std::size_t face, x, y, width, height;
    };
    const auto build = [&](const auto& self, const Part& p) -> void {
        if (p.width == 1 && p.height == 1) {
            words.push_back(ClusterTree::leaf_word(static_cast<std::uint32_t>((p.face * side_ + p.y) * side_ + p.x)));
            return;
        }
        const auto first = static_cast<std::uint32_t>(words.size());
        if (p.width >= p.height) {
            self(self, {p.face, p.x, p.y, p.width / 2, p.height});
            self(self, {p.face, p.x + p.width / 2, p.y, p.width / 2, p.height});
        } else {
            self(self, {p.face, p.x, p.y, p.width, p.height / 2});
            self(self, {p.face, p.x, p.y + p.height / 2, p.width, p.height / 2});
        }
        words.push_back(first);
    };
    for (std::size_t face = 0; face < 6; ++face) {
        build(build, {face, 0, 0, side_, side_});
        if (face > 0) words.push_back(0);  // above all so far
    }
    ClusterTree tree(std::move(words));
    lightcuts::validate(tree);
    return tree;
}

}  // namespace benchmark
