#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/vec3.hpp>

#include "box.hpp"
#include "cone.hpp"
#include "cosine.hpp"
#include "rounding.hpp"

namespace lightcuts {

namespace detail {

/// u.p / n.p at the best of three points of the box: its center, its point nearest to the origin and its vertex
/// farthest along n + u. Best means the largest (n.p)+ (u.p)+ / |p|^4; if none is positive, 1.
inline double joint_start(const glm::dvec3& n, const glm::dvec3& u, const OffsetBox& b) {
    double best = 0.0;
    double best_n = 1.0;
    double best_u = 1.0;
    const auto consider = [&](const glm::dvec3& p) {
        const double along_n = larger(dot(n, p), 0.0);
        const double along_u = larger(dot(u, p), 0.0);
        const double p2 = dot(p, p);
        const double value = along_n * along_u / (p2 * p2);
        const double better = value > best ? 1.0 : 0.0;  // branchless: which is best is unpredictable
        best_n = better * along_n + (1.0 - better) * best_n;
        best_u = better * along_u + (1.0 - better) * best_u;
        best = larger(best, value);
    };
    consider(center(b));
    consider(clamp(glm::dvec3(0.0), b));
    consider(vertex_along(n + u, b));
    return clamp(best_u / best_n, 0x1p-12, 0x1p12);
}

}  // namespace detail

/// How far a joint bound is driven. The search stops early once it is nearly exact.
struct JointEffort {
    int iterations =
        3;  ///< at most; each costs one `max_dot_over_distance`; 1 is often within a few %, 3 within about 1 %
    double tolerance = 2e-3;  ///< relative, of each `max_dot_over_distance`
    double enough = 0.0;      ///< stop as soon as the bound is at most this: tightening further changes no decision
};

/// Upper bound of (n.p)+ (u.p)+ / |p|^4 over the points p of `b`: both cosines over the squared distance, for a
/// receiver's normal n and the reversed axis u of all emitters.
///
/// For any lambda > 0, sqrt((n.p)(u.p)) <= v.p with v = (lambda n + u / lambda) / 2, so the maximum is at most
/// max_dot_over_distance<2>(v)^2, and the best lambda makes it exact (Sion). Exactly zero if all points lie behind n,
/// or behind u; otherwise infinite if the box holds the origin. cost: about 70 to 160 ns
inline double joint_bound(const glm::dvec3& n, const glm::dvec3& u, const OffsetBox& b,
                          const JointEffort& effort = {}) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (is_behind(n, b) || is_behind(u, b)) return 0.0;
    if (min_distance2(b) == 0.0) return infinity;
    double lambda2 = detail::joint_start(n, u, b);
    double below2 = 0.0;
    double above2 = infinity;
    double best = infinity;
    for (int i = 1;; ++i) {
        const double lambda = std::sqrt(lambda2);
        const glm::dvec3 v = n * (0.5 * lambda) + u * (0.5 / lambda);
        const AttainedBound bound = max_dot_over_distance<2>(v, b, effort.tolerance);
        const double squared = bound.value * bound.value * (1.0 + 8.0 * unit_roundoff);
        best = squared < best ? squared : best;
        if (i >= effort.iterations || best <= effort.enough) return best;
        const double x = detail::dot(n, bound.at);
        const double y = detail::dot(u, bound.at);
        const double q2 = detail::dot(bound.at, bound.at);
        if (best * q2 * q2 <= (1.0 + 10.0 * effort.tolerance) * x * y) return best;
        // The value at q is stationary in lambda where lambda^2 = u.q / n.q; keep the bracket of it.
        (x * lambda2 > y ? above2 : below2) = lambda2;
        lambda2 = x <= 0.0 ? 64.0 * lambda2 : y <= 0.0 ? lambda2 / 64.0 : y / x;
        if (!(lambda2 > below2 && lambda2 < above2)) {
            lambda2 = below2 == 0.0 ? above2 / 64.0 : above2 == infinity ? below2 * 64.0 : std::sqrt(below2 * above2);
        }
    }
}

namespace detail {

/// A direction d and epsilon such that cos(max(0, theta - beta)) <= d.o + epsilon for every direction o of a box,
/// where theta is the angle from a cone's axis to o and beta the cone's half-angle.
struct NearestDirection {
    glm::dvec3 direction;
    double epsilon;
    bool exists;
};

/// d is the cone's direction nearest to the direction w of the box's center; epsilon = 1 - cos(delta) with delta the
/// largest angle from w to a corner. Exists if delta < 90 degrees and either w lies in the cone or the angle from the
/// axis to w plus beta is at most 180 degrees.
inline NearestDirection nearest_direction(const Cone& cone, const OffsetBox& b) {
    const NearestDirection none{{}, 0.0, false};
    const glm::dvec3 middle = center(b);
    const double length = glm::length(middle);
    if (!(length > 0.0)) return none;
    const glm::dvec3 w = middle / length;

    double least = 1.0;  // cos^2(delta)
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? b.hi.x : b.lo.x, (corner & 2) != 0 ? b.hi.y : b.lo.y,
                           (corner & 4) != 0 ? b.hi.z : b.lo.z);
        const double along = dot(w, p);
        if (!(along > 0.0)) return none;
        const double squared = along * along / dot(p, p);
        least = squared < least ? squared : least;
    }
    const double epsilon = 1.0 - std::sqrt(least) + 16.0 * unit_roundoff;

    const glm::dvec3 u = unit_axis(cone);
    const double cos_w = dot(u, w);
    const double cos_cone = cos_half_angle(cone);
    if (cos_w >= cos_cone) return {w, epsilon, true};
    if (cos_w < 8.0 * unit_roundoff - cos_cone) return none;
    const glm::dvec3 side = glm::normalize(w - u * cos_w);
    return {u * cos_cone + side * sin_half_angle(cone), epsilon, true};
}

/// What the joint bound needs of one cone of directions over a box.
struct ConeOverBox {
    double cosine;  ///< bounds cos(max(0, theta - beta))
    NearestDirection nearest;

    ConeOverBox(const Cone& cone, const OffsetBox& b, double tolerance) {
        if (is_single(cone)) {
            nearest = {glm::dvec3(cone.axis), 0.0, true};
            cosine = clamped_max_cosine(nearest.direction, b, tolerance);
        } else {
            nearest = nearest_direction(cone, b);
            cosine = widen_cosine(max_cosine(unit_axis(cone), b, tolerance), cone);
        }
    }
};

}  // namespace detail

/// Upper bound of cos(max(0, theta_n - beta_n)) cos(max(0, theta_u - beta_u)) / |p|^2 over the points p of `b`: both
/// cosines over the squared distance, for receivers whose normals fill one cone and emitters whose reversed axes (their
/// cone, `negated`) fill another; theta is the angle from a cone's axis to p and beta its half-angle. At most the
/// product of the widened cosines and 1 / `min_distance2`. A cone of one direction may have an axis that is no unit
/// vector, which scales its cosine.
/// pre: no cone is empty
/// cost: that of single directions for two of them, else about 400 ns
inline double joint_bound(const Cone& normals, const Cone& reversed_axes, const OffsetBox& b,
                          const JointEffort& effort = {}) {
    if (is_single(normals) && is_single(reversed_axes)) {
        return joint_bound(glm::dvec3(normals.axis), glm::dvec3(reversed_axes.axis), b, effort);
    }
    const detail::ConeOverBox n(normals, b, effort.tolerance);
    if (!(n.cosine > 0.0)) return 0.0;
    const detail::ConeOverBox u(reversed_axes, b, effort.tolerance);
    if (!(u.cosine > 0.0)) return 0.0;
    const double d2 = min_distance2(b);
    if (d2 == 0.0) return std::numeric_limits<double>::infinity();
    double best = n.cosine * u.cosine / d2 * (1.0 + 8.0 * unit_roundoff);
    const auto is_enough = [&](double bound) {
        const double raised = bound * (1.0 + 8.0 * unit_roundoff);
        best = raised < best ? raised : best;
        return best <= effort.enough;
    };
    if (best <= effort.enough) return best;
    // cos / |p|^2 is at most that about the nearest direction d, plus epsilon / |p|^2.
    const auto over_distance2 = [&](const detail::NearestDirection& d) {
        return max_dot_over_distance<3>(d.direction, b, effort.tolerance).value;
    };
    double n3 = 0.0, u3 = 0.0;
    if (n.nearest.exists) {
        n3 = over_distance2(n.nearest);
        if (is_enough(u.cosine * (n3 + n.nearest.epsilon / d2))) return best;
    }
    if (u.nearest.exists) {
        u3 = over_distance2(u.nearest);
        if (is_enough(n.cosine * (u3 + u.nearest.epsilon / d2))) return best;
    }
    if (!n.nearest.exists || !u.nearest.exists) return best;
    const double rest = u.nearest.epsilon * n3 + n.nearest.epsilon * u3 + u.nearest.epsilon * n.nearest.epsilon / d2;
    const double enough = detail::larger(effort.enough * (1.0 - 16.0 * unit_roundoff) - rest, 0.0);
    const double joint = joint_bound(n.nearest.direction, u.nearest.direction, b,
                                     {effort.iterations, effort.tolerance, enough});
    is_enough(joint + rest);
    return best;
}

}  // namespace lightcuts
