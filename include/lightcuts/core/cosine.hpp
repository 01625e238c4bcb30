#pragma once

#include <cmath>

#include <glm/vec3.hpp>

#include "box.hpp"
#include "dot_over_distance.hpp"
#include "offset_block.hpp"
#include "rounding.hpp"
#include "vectorized.hpp"

namespace lightcuts {

/// Upper bound of max(0, cos) between `v` and the points of `b` seen from the origin; exactly zero if all lie behind.
/// pre: `v` is a unit vector
inline double clamped_max_cosine(const glm::dvec3& v, const OffsetBox& b, double tolerance = 1e-3,
                                 int iterations = 60) {
    const double c = max_dot_over_distance<1>(v, b, tolerance, iterations).value;
    return c < 1.0 ? c : 1.0;
}

/// Upper bound of the signed cosine between `v` and the points of `b` seen from the origin. Points at the origin do not
/// count; 0 if there is no other.
/// pre: `v` is a unit vector
inline double max_cosine(const glm::dvec3& v, const OffsetBox& b, double tolerance = 1e-3, int iterations = 60) {
    const double positive = clamped_max_cosine(v, b, tolerance, iterations);
    if (positive > 0.0) return positive;
    // No point lies in front. There the cosine is quasi-convex, so its maximum is at a vertex: the least
    // (v.p)^2 / |p|^2, since every v.p <= 0.
    double least = 2.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? b.hi.x : b.lo.x, (corner & 2) != 0 ? b.hi.y : b.lo.y,
                           (corner & 4) != 0 ? b.hi.z : b.lo.z);
        const double p2 = detail::dot(p, p);
        const double along = detail::dot(v, p);
        const double squared = along * along / p2;
        if (squared < least) least = squared;  // false for p = 0
    }
    if (least == 2.0) return 0.0;
    const double c = 8.0 * unit_roundoff - std::sqrt(least);
    return c < 0.0 ? c : 0.0;
}

/// Lower bound of the signed cosine between `v` and the points of `b` seen from the origin.
/// pre: `v` is a unit vector
inline double min_cosine(const glm::dvec3& v, const OffsetBox& b, double tolerance = 1e-3, int iterations = 60) {
    return -max_cosine(-v, b, tolerance, iterations);
}

/// Upper bound of max(0, cos) between `v` and the unit vectors in `b`, such as directions towards distant lights. They
/// have length 1 within float rounding, so v.p itself bounds the cosine too.
/// pre: `v` is a unit vector
inline double clamped_max_cosine_of_directions(const glm::dvec3& v, const OffsetBox& b, double tolerance = 1e-3,
                                               int iterations = 60) {
    constexpr double longest = 1.0 + 4e-7;
    const double c = max_dot_over_distance<1>(v, b, tolerance, iterations).value;
    if (c == 0.0) return 0.0;
    const double support = detail::larger(detail::support_of(v, b).value, 0.0) + 8.0 * unit_roundoff;
    const double least = c < support ? c : support;
    return least * longest < 1.0 ? least * longest : 1.0;
}

namespace detail {

/// Upper bounds of max(0, cos) between unit `v` and the points of each box as a float evaluation may see them; exactly
/// zero where all lie behind.
LIGHTCUTS_VECTORIZED inline void clamped_max_cosines(const glm::vec3& v, const OffsetBlock& b, Lanes& cosines) {
    LaneVectors directions;
    LaneSupport s;
    broadcast(v, directions);
    support(v, b, s);
    max_dots_over_distance<1>(directions, s, b, cosines);
    for (int i = 0; i < lane_count; ++i) cosines[i] = smaller(cosines[i], 1.0f);
}

}  // namespace detail

}  // namespace lightcuts
