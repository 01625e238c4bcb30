#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/vec3.hpp>

#include "box.hpp"
#include "cone.hpp"
#include "rounding.hpp"

namespace lightcuts {

/// An upper bound and the point of the box where it is (nearly) attained: `value` exceeds the maximum by a relative
/// `tolerance`, or 1e-14, at most, if the iteration was not cut short.
struct PowerBound {
    double value;
    glm::dvec3 at;
};

namespace detail {

constexpr double larger(double x, double y) { return x < y ? y : x; }
constexpr double smaller(double x, double y) { return x < y ? x : y; }

/// The largest v.p over a box, and how large its rounding error may be.
struct Support {
    double value;
    double noise;
};

inline Support support_of(const glm::dvec3& v, const OffsetBox& b) {
    const auto magnitude = [](double x) { return x < 0.0 ? -x : x; };
    const glm::dvec3 terms(larger(v.x * b.lo.x, v.x * b.hi.x), larger(v.y * b.lo.y, v.y * b.hi.y),
                           larger(v.z * b.lo.z, v.z * b.hi.z));
    return {terms.x + terms.y + terms.z,
            4.0 * unit_roundoff * (magnitude(terms.x) + magnitude(terms.y) + magnitude(terms.z))};
}

/// True iff certainly no point has v.p > 0. Sums of exact zeros count: lights in the plane of their receiver.
inline bool is_behind(const Support& s) { return s.value <= -s.noise; }

/// The positive s where c - b s - a s^2 = 0, for a, c >= 0; without cancellation. NaN or infinite if there is none.
inline double quadratic_root(double c, double b, double a) {
    const double d = std::sqrt(b * b + 4.0 * a * c);
    const double numerator = b < 0.0 ? d - b : 2.0 * c;
    const double denominator = b < 0.0 ? 2.0 * a : b + d;
    return numerator / denominator;
}

/// The exponent k of a bound as a constant, and the powers of |p| that go with it, without `pow`.
template <int K>
struct FixedExponent {
    static_assert(1 <= K && K <= 3);
    static constexpr double k = K;
    static constexpr double roundings = 16.0;

    /// |q|^(2-k) / x, from |q|^2
    static double ratio(double q2, double x) {
        if constexpr (K == 1) return std::sqrt(q2) / x;
        if constexpr (K == 2) return 1.0 / x;
        if constexpr (K == 3) return 1.0 / (std::sqrt(q2) * x);
    }
    /// d^-k, from d^2
    static double inverse(double d2) {
        if constexpr (K == 1) return 1.0 / std::sqrt(d2);
        if constexpr (K == 2) return 1.0 / d2;
        if constexpr (K == 3) return 1.0 / (d2 * std::sqrt(d2));
    }
    /// d^(1-k), from d^2, or more
    static double inverse_less_one(double d2) {
        if constexpr (K == 1) return 1.0;
        if constexpr (K == 2) return 1.0 / std::sqrt(d2);
        if constexpr (K == 3) return 1.0 / d2;
    }
    /// x d^k |q|^(2-k) over `per(q2)`, from d^2
    static double scaled(double x, double d2) { return K == 3 ? x * d2 * d2 : x * d2; }
    static double per(double q2) { return K == 3 ? q2 : 1.0; }
    /// The positive s where c - b s - a s^2 = 0
    static double root(double c, double b, double a) {
        if constexpr (K == 1) return c / b;
        return quadratic_root(c, b, a);
    }
};

/// The same for a real k >= 1.
struct RealExponent {
    double k;
    double roundings = 16.0 + 4.0 * k;

    double ratio(double q2, double x) const { return std::pow(q2, 1.0 - 0.5 * k) / x; }
    double inverse(double d2) const { return std::pow(d2, -0.5 * k); }
    double inverse_less_one(double d2) const { return std::pow(d2, 0.5 - 0.5 * k); }
    double scaled(double x, double d2) const { return x * (k <= 2.0 ? d2 : std::pow(d2, 0.5 * k)); }
    double per(double q2) const { return k <= 2.0 ? 1.0 : std::pow(q2, 0.5 * k - 1.0); }
    double root(double c, double b, double a) const { return quadratic_root(c, b, a); }
};

/// 1 if the numbers differ, else 0; without a branch. Bits, since a difference of products may be contracted.
inline double differ(double x, double y) {
    const std::uint64_t other = std::bit_cast<std::uint64_t>(x) ^ std::bit_cast<std::uint64_t>(y);
    return static_cast<double>(other != 0);
}

/// The vertex of the box farthest along v, within rounding; without branches.
inline glm::dvec3 vertex_along(const glm::dvec3& v, const OffsetBox& b) {
    const glm::dvec3 half = 0.5 * (b.hi - b.lo);
    return centre(b) + glm::dvec3(std::copysign(half.x, v.x), std::copysign(half.y, v.y), std::copysign(half.z, v.z));
}

/// Least |p|^2 / v.p of three points of the box, where v.p > 0: its centre, its vertex farthest along v, its point
/// `nearest` to the origin. Divided by k, a start for the iteration; never too small.
inline double start_of(const glm::dvec3& v, const OffsetBox& b, const glm::dvec3& nearest, double d2, double support) {
    const glm::dvec3 middle = centre(b);
    const glm::dvec3 farthest = vertex_along(v, b);
    const auto value = [](double p2, double along) { return p2 / larger(along, (std::numeric_limits<double>::min)()); };
    const double from_farthest = dot(farthest, farthest) / support;
    const double from_middle = value(dot(middle, middle), dot(v, middle));
    const double from_nearest = value(d2, dot(v, nearest));
    const double least = smaller(from_middle, from_farthest);
    return smaller(from_nearest, least);
}

/// The maximum of (v.p)+ / |p|^k over the box, from above.
///
/// Certificate: for s > 0 let q = clamp(s v), the projection of s v on the box, and h = |q|^2 - k s v.q. The function
/// F(p) = c |p|^k - v.p with c = |q|^(2-k) / (k s) is convex with gradient (q - s v) / s at q, and projection makes
/// (q - s v).(p - q) >= 0 in the box. So F >= F(q) = h / (k s), that is, v.p / |p|^k <= c + max(0, -h) / (k s dmin^k):
/// every s gives a bound, and the iteration towards h = 0, where it is exact, may stop at any time.
///
/// Rounding: where |q| is far above dmin, an error of h that is small against |q|^2 is large in the bound. So h is
/// computed as C - k s M - (k-1) s^2 A, with C = |q|^2 and M = v.q summed over the clamped coordinates alone and
/// A = |v|^2 over the others, less what its rounding may be; then it is certain that it is not negative. In coordinates
/// that are not clamped q is s v rounded: the certificate is for a vector whose coordinates are within a unit roundoff
/// of those of v, which changes v.p / |p|^k by at most |v| dmin^(1-k) unit roundoffs. `slack` adds them.
template <class Exponent>
inline PowerBound max_power(const Exponent exponent, const glm::dvec3& v, const OffsetBox& b, double tolerance,
                            int iterations) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double doubt = 8.0 * unit_roundoff;  // relative, of the terms of h
    const double k = exponent.k;

    const Support support = support_of(v, b);
    const glm::dvec3 nearest = clamp(glm::dvec3(0.0), b);
    if (is_behind(support)) return {0.0, nearest};
    const double d2 = dot(nearest, nearest);
    if (d2 == 0.0) return {k == 1.0 ? std::sqrt(dot(v, v)) * (1.0 + 4.0 * unit_roundoff) : infinity, nearest};
    const double length = std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);  // >= |v|
    const double slack = 8.0 * unit_roundoff * length * exponent.inverse_less_one(d2);
    const double m = support.value;
    if (m <= 0.0) return {slack, nearest};

    double below = d2 / (k * m);  // h >= 0, here and at every later value
    double above = infinity;      // h < 0
    double s = larger(below, start_of(v, b, nearest, d2, m) / k);
    const double tight = larger(tolerance, 8.0 * k * doubt);
    const double most_deficit = exponent.scaled(tight, d2);
    for (int i = 0;; ++i) {
        const glm::dvec3 wanted = v * s;
        const glm::dvec3 q = clamp(wanted, b);
        // Which coordinates are clamped, nobody can predict: 0 or 1 without a branch.
        const glm::dvec3 clamped(differ(q.x, wanted.x), differ(q.y, wanted.y), differ(q.z, wanted.z));
        const glm::dvec3 clamped_q = clamped * q;
        const double x = clamped_q.x * v.x, y = clamped_q.y * v.y, z = clamped_q.z * v.z;
        const double C = dot(clamped_q, clamped_q);
        const double A = dot(v - clamped * v, v);
        const double q2 = C + A * s * s;
        const double M = x + y + z + doubt * (std::fabs(x) + std::fabs(y) + std::fabs(z));
        // h = constant - linear s - square s^2
        const double constant = (1.0 - doubt) * C;
        const double linear = k * M;
        const double square = (k - 1.0) * (1.0 + doubt) * A;
        const double h = constant - s * (linear + square * s);
        // One comparison, because nobody can predict the sign of h.
        const bool is_close = larger(h - tight * q2, -h * exponent.per(q2) - most_deficit) <= 0.0;
        if (is_close || i >= iterations || above - below <= 4.0 * unit_roundoff * below) {
            const double deficit = larger(0.0, -h);
            double value = exponent.ratio(q2, k * s) + deficit * exponent.inverse(d2) / (k * s);
            if (!is_close) {
                const glm::dvec3 p = clamp(v * below, b);
                value = smaller(value, exponent.ratio(dot(p, p), k * below));
            }
            return {value * (1.0 + exponent.roundings * unit_roundoff) + slack, q};
        }
        below = h < 0.0 ? below : s;
        above = h < 0.0 ? s : above;
        // Take the root, or a little less: there h is certain.
        s = exponent.root(constant, linear, square) * (1.0 - 2.0 * doubt);
        if (!(s > below && s < above)) s = above < infinity ? std::sqrt(below * above) : 16.0 * below;
    }
}

}  // namespace detail

/// True iff certainly no point p of `b` has v.p > 0: then every bound on the cosine with `v` is exactly zero.
inline bool is_behind(const glm::dvec3& v, const OffsetBox& b) { return detail::is_behind(detail::support_of(v, b)); }

/// Upper bound of (v.p)+ / |p|^K over the points p of `b`, for K = 1, 2, 3: cosine (v unit), the joint bound's kernel,
/// cosine over squared distance. v need not be a unit vector.
///
/// Exactly zero if no p has v.p > 0. Infinite (K = 1: |v|) if the box holds the origin and some p has v.p > 0.
/// A light at p = 0 counts as zero. `iterations` limits the refinement: the bound then is valid but looser.
/// cost: about 20 to 40 ns
template <int K>
inline PowerBound max_power(const glm::dvec3& v, const OffsetBox& b, double tolerance = 1e-3, int iterations = 60) {
    return detail::max_power(detail::FixedExponent<K>{}, v, b, tolerance, iterations);
}

/// The same for any real k >= 1.
inline PowerBound max_power(const glm::dvec3& v, const OffsetBox& b, double k, double tolerance, int iterations = 60) {
    return detail::max_power(detail::RealExponent{k}, v, b, tolerance, iterations);
}

/// Upper bound of max(0, cos) between `v` and the points of `b` seen from the origin; exactly zero if all lie behind.
/// pre: `v` is a unit vector
inline double clamped_max_cosine(const glm::dvec3& v, const OffsetBox& b, double tolerance = 1e-3,
                                 int iterations = 60) {
    const double c = max_power<1>(v, b, tolerance, iterations).value;
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

/// Upper bound of max(0, cos) between `v` and directions towards distant lights, which `b` holds (`towards_lights`).
/// They have length 1 within float rounding, so v.p itself bounds the cosine too.
/// pre: `v` is a unit vector
inline double clamped_max_cosine_of_directions(const glm::dvec3& v, const OffsetBox& b, double tolerance = 1e-3,
                                               int iterations = 60) {
    constexpr double longest = 1.0 + 4e-7;
    const double c = max_power<1>(v, b, tolerance, iterations).value;
    if (c == 0.0) return 0.0;
    const double support = detail::larger(detail::support_of(v, b).value, 0.0) + 8.0 * unit_roundoff;
    const double least = c < support ? c : support;
    return least * longest < 1.0 ? least * longest : 1.0;
}

}  // namespace lightcuts
