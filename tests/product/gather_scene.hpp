#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <lightcuts/material/phong.hpp>
#include <lightcuts/product/gather.hpp>
#include "support/occluders.hpp"
#include "support/scene.hpp"

namespace lightcuts::test {

using V = glm::vec3;
using DiffusePoint = GatherPoint<Lambert<V>, V>;
using GlossyPoint = GatherPoint<ModifiedPhong<V>, V>;

/// Diffuse gather points near one another, whose strengths sum to less than 1 in each channel.
inline std::vector<DiffusePoint> diffuse_points(Random& random, std::size_t n, double spread, double turn) {
    std::vector<DiffusePoint> points;
    const glm::dvec3 middle = random.in_box({-1.5, -1.0, -2.0}, {1.5, 1.0, 2.0});
    const glm::dvec3 facing = random.on_sphere();
    for (std::uint32_t i = 0; i < n; ++i) {
        const V p(middle + spread * random.in_box({-1, -1, -1}, {1, 1, 1}));
        const V normal(random.near(facing, turn));
        const double share = random.chance(0.1) ? 0.0 : random.decades(-1.0, 0.0) / static_cast<double>(n);
        const V strength(random.real(0, 1) * static_cast<float>(share), random.real(0.2, 1) * static_cast<float>(share),
                         random.real(0.5, 1) * static_cast<float>(share));
        points.push_back({{p, Lambert<V>{normal, V(1.0f)}, p + 1e-4f * normal, i}, strength});
    }
    return points;
}

/// Glossy gather points near one another.
inline std::vector<GlossyPoint> glossy_points(Random& random, std::size_t n, double spread, double turn) {
    std::vector<GlossyPoint> points;
    for (const DiffusePoint& d : diffuse_points(random, n, spread, turn)) {
        const V normal = d.receiver.material.normal;
        const V view(random.near(glm::dvec3(normal), 1.2));
        const auto exponent = static_cast<float>(random.decades(0.0, 3.0));
        points.push_back(
            {{d.receiver.position, ModifiedPhong<V>(glm::normalize(normal), glm::normalize(view), V(1.0f), exponent),
              d.receiver.shadow_origin, d.receiver.id},
             d.strength});
    }
    return points;
}

/// The same points, each at some instant.
template <class M>
std::vector<InstantGatherPoint<M, V>> at_instants(const std::vector<GatherPoint<M, V>>& points,
                                                  std::uint32_t instants) {
    std::vector<InstantGatherPoint<M, V>> timed;
    for (std::uint32_t i = 0; i < points.size(); ++i) timed.push_back({points[i], i % instants});
    return timed;
}
/// The same lights, each at some instant, with as many times the power.
template <class L>
std::vector<InstantLight<L>> at_instants(const std::vector<L>& lights, std::uint32_t instants) {
    std::vector<InstantLight<L>> timed;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        timed.push_back({lights[i], (i * 7) % instants});
        timed.back().intensity = timed.back().intensity * static_cast<float>(instants);
    }
    return timed;
}

/// Sum over all pairs, one by one, in double.
template <class Points, class Lights, class Oracle>
glm::dvec3 sum_of_pairs(const Points& points, const Lights& lights, const Oracle& oracle) {
    glm::dvec3 sum(0.0);
    for (const auto& p : points) {
        for (const auto& l : lights) {
            if constexpr (TimedLight<std::remove_cvref_t<decltype(l)>>) {
                if (p.instant != instant_of(l)) continue;
            }
            sum += glm::dvec3(unshadowed_transfer(p.receiver, l)) * static_cast<double>(oracle(p.receiver, l)) *
                   glm::dvec3(p.strength) * glm::dvec3(l.intensity);
        }
    }
    return sum;
}

}  // namespace lightcuts::test
