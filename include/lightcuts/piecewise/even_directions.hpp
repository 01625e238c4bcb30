#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/random.hpp"

namespace lightcuts {

/// Directions spread evenly over the sphere: random ones, one in each of `count` bands of equal area, that repel their
/// neighbors step by step [Cut merging 2008, section 4.1]. Each stands for about 4 pi / count. `steps`: 0 leaves them
/// as they are drawn; after 20 none has another much nearer than evenness asks for. The same on every run for a seed.
/// cost: O(count x steps).
inline std::vector<glm::vec3> even_directions(std::size_t count, std::uint64_t seed = 0, int steps = 20) {
    // Between neighbors of a hexagonal lattice.
    const double spacing = std::sqrt(4.0 * std::numbers::pi / static_cast<double>((std::max)(count, std::size_t{12})) *
                                     2.0 / std::sqrt(3.0));
    std::vector<glm::dvec3> points(count);
    for (std::size_t i = 0; i < count; ++i) {
        // One in each of as many bands, a golden angle from the one before: what is uneven then is so nearby, where
        // repulsion mends it.
        const auto at = static_cast<double>(i);
        const double z = 1.0 - 2.0 * (at + uniform01(hash_keys(seed, i, 0))) / static_cast<double>(count);
        const double turn = uniform01(hash_keys(seed, count)) + (uniform01(hash_keys(seed, i, 1)) - 0.5) * spacing;
        const double phi = std::numbers::pi * ((3.0 - std::sqrt(5.0)) * at + 2.0 * turn);
        const double r = std::sqrt((std::max)(0.0, 1.0 - z * z));
        points[i] = {r * std::cos(phi), r * std::sin(phi), z};
    }
    // Points repel each other up to twice the spacing. A grid of cells of that size finds them.
    const double reach = 2.0 * spacing;
    const auto side = static_cast<std::size_t>((std::max)(1.0, std::min(2.0 / reach, 256.0)));
    const auto cell_of = [side](double x) {
        const auto at = static_cast<std::size_t>((x + 1.0) * 0.5 * static_cast<double>(side));
        return (std::min)(at, side - 1);
    };
    std::vector<std::uint32_t> begin, order(count);
    std::vector<glm::dvec3> moved(count);
    for (int step = 0; step < steps; ++step) {
        const auto index = [&](const glm::dvec3& p) {
            return (cell_of(p.z) * side + cell_of(p.y)) * side + cell_of(p.x);
        };
        begin.assign(side * side * side + 1, 0);
        for (const glm::dvec3& p : points) ++begin[index(p) + 1];
        for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
        std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
        for (std::size_t i = 0; i < count; ++i) order[next[index(points[i])]++] = static_cast<std::uint32_t>(i);

        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec3 p = points[i];
            glm::dvec3 push(0.0);
            const auto first = [&](double x) { return cell_of((std::max)(x - reach, -1.0)); };
            const auto last = [&](double x) { return cell_of((std::min)(x + reach, 1.0)); };
            for (std::size_t z = first(p.z); z <= last(p.z); ++z) {
                for (std::size_t y = first(p.y); y <= last(p.y); ++y) {
                    for (std::size_t x = first(p.x); x <= last(p.x); ++x) {
                        const std::size_t cell = (z * side + y) * side + x;
                        for (std::uint32_t k = begin[cell]; k < begin[cell + 1]; ++k) {
                            const glm::dvec3 away = p - points[order[k]];
                            const double distance2 = glm::dot(away, away);
                            if (order[k] == i || !(distance2 < reach * reach) || !(distance2 > 0.0)) continue;
                            const double distance = std::sqrt(distance2), closeness = 1.0 - distance / reach;
                            push += away * (closeness * closeness / distance);
                        }
                    }
                }
            }
            // All move at once, and ever less, or they would swing to and fro.
            push *= spacing * 0.5 * (1.0 - static_cast<double>(step) / static_cast<double>(steps));
            const double length = glm::length(push), most = 0.5 * spacing;
            if (length > most) push *= most / length;
            moved[i] = glm::normalize(p + push);
        }
        points.swap(moved);
    }
    return {points.begin(), points.end()};
}

}  // namespace lightcuts
