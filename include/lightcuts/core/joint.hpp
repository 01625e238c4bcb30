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

/// u.p / n.p at the best of three points of the box: its centre, its point nearest to the origin and its vertex
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
        const double better = value > best ? 1.0 : 0.0;  // blends instead of branches that nobody can predict
        best_n = better * along_n + (1.0 - better) * best_n;
        best_u = better * along_u + (1.0 - better) * best_u;
        best = larger(best, value);
    };
    consider(centre(b));
    consider(clamp(glm::dvec3(0.0), b));
    consider(vertex_along(n + u, b));
    return clamp(best_u / best_n, 0x1p-12, 0x1p12);
}

}  // namespace detail

/// How far a joint bound is driven. The search stops early once it is nearly exact.
struct JointEffort {
    int iterations = 3;       ///< at most; each costs one `max_power`; 1 is often within a few %, 3 within about 1 %
    double tolerance = 2e-3;  ///< relative, of each `max_power`
    double enough = 0.0;      ///< stop as soon as the bound is at most this: tightening further changes no decision
};

/// Upper bound of (n.p)+ (u.p)+ / |p|^4 over the points p of `b`: both cosines over the squared distance, for a
/// receiver's normal n and the reversed axis u of all emitters.
///
/// For any lambda > 0, sqrt((n.p)(u.p)) <= v.p with v = (lambda n + u / lambda) / 2, so the maximum is at most
/// max_power<2>(v)^2, and the best lambda makes it exact (Sion). Exactly zero if all points lie behind n, or behind u;
/// otherwise infinite if the box holds the origin.
/// cost: about 70 to 160 ns
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
        const PowerBound bound = max_power<2>(v, b, effort.tolerance);
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

/// d is the cone's direction nearest to the direction w of the box's centre; epsilon = 1 - cos(delta) with delta the
/// largest angle from w to a corner. Exists if delta < 90 degrees and either w lies in the cone or the angle from the
/// axis to w plus beta is at most 180 degrees.
inline NearestDirection nearest_direction(const Cone& cone, const OffsetBox& b) {
    const NearestDirection none{{}, 0.0, false};
    const glm::dvec3 middle = centre(b);
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

}  // namespace detail

/// The same for emitters whose reversed axes fill a cone: bounds (n.p)+ cos(max(0, theta - beta)) / |p|^3, where theta
/// is the angle from the axis of `reversed_axes` (the lights' cone, `negated`) to p. At most the product of
/// `clamped_max_cosine(n)`, the widened cosine and 1 / `min_distance2`.
/// pre: `n` is a unit vector; `reversed_axes` is not empty
/// cost: about 400 ns for a cone of several directions
inline double joint_bound(const glm::dvec3& n, const Cone& reversed_axes, const OffsetBox& b,
                          const JointEffort& effort = {}) {
    if (is_single(reversed_axes)) return joint_bound(n, glm::dvec3(reversed_axes.axis), b, effort);
    const glm::dvec3 axis = unit_axis(reversed_axes);
    const double cos_n = clamped_max_cosine(n, b, effort.tolerance);
    if (cos_n == 0.0) return 0.0;
    const double cos_u = widen_cosine(max_cosine(axis, b, effort.tolerance), reversed_axes);
    if (!(cos_u > 0.0)) return 0.0;
    const double d2 = min_distance2(b);
    if (d2 == 0.0) return std::numeric_limits<double>::infinity();
    double best = cos_n * cos_u / d2 * (1.0 + 8.0 * unit_roundoff);
    const auto is_enough = [&](double bound) {
        const double raised = bound * (1.0 + 8.0 * unit_roundoff);
        best = raised < best ? raised : best;
        return best <= effort.enough;
    };
    if (best <= effort.enough) return best;
    const double n3 = max_power<3>(n, b, effort.tolerance).value;
    if (is_enough(cos_u * n3)) return best;
    const detail::NearestDirection u = detail::nearest_direction(reversed_axes, b);
    if (!u.exists) return best;
    if (is_enough(cos_n * (max_power<3>(u.direction, b, effort.tolerance).value + u.epsilon / d2))) return best;
    const double rest = u.epsilon * n3;
    const double enough = detail::larger(effort.enough * (1.0 - 16.0 * unit_roundoff) - rest, 0.0);
    is_enough(joint_bound(n, u.direction, b, {effort.iterations, effort.tolerance, enough}) + rest);
    return best;
}

/// Upper bound of the product of (a_j.p)+^w_j over |p|^K, for N directions with weights: for instance both cosines, a
/// Phong lobe of exponent n and 1/d^2 have weights 1, 1, n and K = n + 4.
///
/// With W the sum of the weights it is at most P_{K/W}(v)^W, v = sum of (w_j / W) mu_j a_j, for any mu_j > 0 whose
/// weighted product is 1; the best ones, mu_j proportional to 1 / (a_j.q), make it exact.
/// pre: every w_j > 0; 1 <= W <= K
/// cost: about 350 ns
template <std::size_t N>
inline double joint_power_bound(const glm::dvec3 (&directions)[N], const double (&weights)[N], double K,
                                const OffsetBox& b, int iterations = 4, double tolerance = 1e-2) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double W = 0.0;
    for (std::size_t j = 0; j < N; ++j) {
        if (is_behind(directions[j], b)) return 0.0;
        W += weights[j];
    }
    const double k = K / W > 1.0 ? K / W : 1.0;
    glm::dvec3 q = centre(b);
    double log_mu[N] = {};
    double best = infinity;
    double log_best = infinity;
    for (int i = 0; i < iterations && log_best > -infinity; ++i) {
        // log mu_j = mean - log(a_j.q); a direction that faces away from q weighs more than before.
        const double length = std::sqrt(detail::dot(q, q));
        double log_at_q = -(K - W) * std::log(length);
        double mean = 0.0;
        for (std::size_t j = 0; j < N; ++j) {
            const double cosine = detail::dot(directions[j], q) / length;
            const double log_cosine = cosine > 0x1p-20 ? std::log(cosine) : -infinity;
            log_at_q += weights[j] * log_cosine;
            log_mu[j] = log_cosine > -infinity ? -log_cosine : i == 0 ? 0.0 : log_mu[j] + 2.0;
            mean += weights[j] * log_mu[j] / W;
        }
        if (log_best <= log_at_q + 2.0 * tolerance) break;  // attained
        glm::dvec3 v(0.0);
        for (std::size_t j = 0; j < N; ++j) {
            log_mu[j] -= mean;
            v += directions[j] * (weights[j] / W * std::exp(log_mu[j]));
        }
        const PowerBound bound = max_power(v, b, k, tolerance / W);
        if (!(bound.value < infinity)) return infinity;
        const double log_bound = W * std::log(bound.value);
        if (log_bound < log_best) {
            log_best = log_bound;
            // The weighted product of the mu_j is 1 within rounding that grows with W.
            best = std::pow(bound.value, W) * (1.0 + 64.0 * unit_roundoff * (1.0 + W));
        }
        q = bound.at;
    }
    if (log_best == -infinity) return 0.0;
    return best < 0x1p-1022 ? 0x1p-1022 : best;
}

}  // namespace lightcuts
