#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/vec3.hpp>

#include "box.hpp"
#include "offset_block.hpp"
#include "rounding.hpp"
#include "vectorized.hpp"

namespace lightcuts {

/// An upper bound and the point of the box where it is (nearly) attained: `value` exceeds the maximum by a relative
/// `tolerance`, or 1e-14, at most, if the iteration was not cut short.
struct AttainedBound {
    double value;
    glm::dvec3 at;
};

namespace detail {

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

/// The powers of |p| that go with the exponent k = K of a bound, without `pow`.
template <int K>
struct DistancePower {
    static_assert(1 <= K && K <= 3);

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

/// 1 if the numbers differ, else 0; without a branch. Bits, since a difference of products may be contracted.
inline double differ(double x, double y) {
    const std::uint64_t other = std::bit_cast<std::uint64_t>(x) ^ std::bit_cast<std::uint64_t>(y);
    return static_cast<double>(other != 0);
}

/// The vertex of the box farthest along v, within rounding; without branches.
inline glm::dvec3 vertex_along(const glm::dvec3& v, const OffsetBox& b) {
    const glm::dvec3 half = 0.5 * (b.hi - b.lo);
    return center(b) + glm::dvec3(std::copysign(half.x, v.x), std::copysign(half.y, v.y), std::copysign(half.z, v.z));
}

/// Least |p|^2 / v.p of three points of the box, where v.p > 0: its center, its vertex farthest along v, its point
/// `nearest` to the origin. Divided by k, a start for the iteration; never too small.
inline double start_of(const glm::dvec3& v, const OffsetBox& b, const glm::dvec3& nearest, double d2, double support) {
    const glm::dvec3 middle = center(b);
    const glm::dvec3 farthest = vertex_along(v, b);
    const auto value = [](double p2, double along) { return p2 / larger(along, (std::numeric_limits<double>::min)()); };
    const double from_farthest = dot(farthest, farthest) / support;
    const double from_middle = value(dot(middle, middle), dot(v, middle));
    const double from_nearest = value(d2, dot(v, nearest));
    const double least = smaller(from_middle, from_farthest);
    return smaller(from_nearest, least);
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
AttainedBound max_dot_over_distance(const glm::dvec3& v, const OffsetBox& b, double tolerance = 1e-3,
                                    int iterations = 60) {
    // Certificate: for s > 0 let q = clamp(s v), the projection of s v on the box, and h = |q|^2 - k s v.q. The
    // function F(p) = c |p|^k - v.p with c = |q|^(2-k) / (k s) is convex with gradient (q - s v) / s at q, and
    // projection makes (q - s v).(p - q) >= 0 in the box. So F >= F(q) = h / (k s), that is, v.p / |p|^k <= c + max(0,
    // -h) / (k s dmin^k): every s gives a bound, and the iteration towards h = 0, where it is exact, may stop at any
    // time.
    //
    // Rounding: where |q| is far above dmin, an error of h that is small against |q|^2 is large in the bound. So h is
    // computed as C - k s M - (k-1) s^2 A, with C = |q|^2 and M = v.q summed over the clamped coordinates alone and
    // A = |v|^2 over the others, less what its rounding may be; then it is certain that it is not negative. In
    // coordinates that are not clamped q is s v rounded: the certificate is for a vector whose coordinates are within a
    // unit roundoff of those of v, which changes v.p / |p|^k by at most |v| dmin^(1-k) unit roundoffs. `slack` adds
    // them.
    using Power = detail::DistancePower<K>;
    using detail::Support, detail::dot, detail::larger, detail::smaller;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double rounding = 8.0 * unit_roundoff;  // relative, of the terms of h
    constexpr double k = K;

    const Support support = detail::support_of(v, b);
    const glm::dvec3 nearest = clamp(glm::dvec3(0.0), b);
    if (detail::is_behind(support)) return {0.0, nearest};
    const double d2 = dot(nearest, nearest);
    if (d2 == 0.0) return {k == 1.0 ? std::sqrt(dot(v, v)) * (1.0 + 4.0 * unit_roundoff) : infinity, nearest};
    const double length = std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);  // >= |v|
    const double slack = 8.0 * unit_roundoff * length * Power::inverse_less_one(d2);
    const double m = support.value;
    if (m <= 0.0) return {slack, nearest};

    double below = d2 / (k * m);  // h >= 0, here and at every later value
    double above = infinity;      // h < 0
    double s = larger(below, detail::start_of(v, b, nearest, d2, m) / k);
    const double tight = larger(tolerance, 8.0 * k * rounding);
    const double most_deficit = Power::scaled(tight, d2);
    for (int i = 0;; ++i) {
        const glm::dvec3 wanted = v * s;
        const glm::dvec3 q = clamp(wanted, b);
        // 0 or 1 without a branch: which coordinates are clamped is unpredictable.
        const glm::dvec3 clamped(detail::differ(q.x, wanted.x), detail::differ(q.y, wanted.y),
                                 detail::differ(q.z, wanted.z));
        const glm::dvec3 clamped_q = clamped * q;
        const double x = clamped_q.x * v.x, y = clamped_q.y * v.y, z = clamped_q.z * v.z;
        const double C = dot(clamped_q, clamped_q);
        const double A = dot(v - clamped * v, v);
        const double q2 = C + A * s * s;
        const double M = x + y + z + rounding * (std::fabs(x) + std::fabs(y) + std::fabs(z));
        // h = constant - linear s - square s^2
        const double constant = (1.0 - rounding) * C;
        const double linear = k * M;
        const double square = (k - 1.0) * (1.0 + rounding) * A;
        const double h = constant - s * (linear + square * s);
        // One comparison, because the sign of h is unpredictable.
        const bool is_close = larger(h - tight * q2, -h * Power::per(q2) - most_deficit) <= 0.0;
        if (is_close || i >= iterations || above - below <= 4.0 * unit_roundoff * below) {
            const double deficit = larger(0.0, -h);
            double value = Power::ratio(q2, k * s) + deficit * Power::inverse(d2) / (k * s);
            if (!is_close) {
                const glm::dvec3 p = clamp(v * below, b);
                value = smaller(value, Power::ratio(dot(p, p), k * below));
            }
            return {value * (1.0 + 16.0 * unit_roundoff) + slack, q};
        }
        below = h < 0.0 ? below : s;
        above = h < 0.0 ? s : above;
        // Take the root, or a little less: there h is certain.
        s = Power::root(constant, linear, square) * (1.0 - 2.0 * rounding);
        if (!(s > below && s < above)) s = above < infinity ? std::sqrt(below * above) : 16.0 * below;
    }
}

namespace detail {

/// The certificate of `max_dot_over_distance` at `step`: lowers `best`, a bound of (v.p)+ / |p|^K, and moves `step` to
/// where the bound would be exact if the same coordinates stayed clamped.
template <int K>
[[gnu::always_inline]] inline void certify(const LaneVectors& v, const OffsetBlock& b, Lanes& step, Lanes& best) {
    constexpr float k = K;
    alignas(32) Lanes next, bound;
    for (int i = 0; i < lane_count; ++i) {
        const float vx = v.x[0][i], vy = v.x[1][i], vz = v.x[2][i];
        const float inverse = b.inverse[i], s = step[i];
        const float wx = s * vx, wy = s * vy, wz = s * vz;
        const float qx = smaller(larger(wx, b.lo.x[0][i]), b.hi.x[0][i]);
        const float qy = smaller(larger(wy, b.lo.x[1][i]), b.hi.x[1][i]);
        const float qz = smaller(larger(wz, b.lo.x[2][i]), b.hi.x[2][i]);
        const float q2 = qx * qx + qy * qy + qz * qz;
        const float tx = wx * qx, ty = wy * qy, tz = wz * qz;
        const float error = 2e-6f * (q2 + k * (magnitude(tx) + magnitude(ty) + magnitude(tz)));
        const float deficit = larger(k * (tx + ty + tz) - q2 + error, 0.0f);
        float value = 0.0f;
        if constexpr (K == 1) value = q2 * inverse_sqrt(q2) + deficit * inverse;
        if constexpr (K == 2) value = 1.0f + deficit * inverse * inverse;
        if constexpr (K == 3) value = inverse_sqrt(q2) + deficit * inverse * inverse * inverse;
        bound[i] = smaller(value / (k * s), best[i]);

        const float fx = select(qx == wx, 0.0f, qx), fy = select(qy == wy, 0.0f, qy), fz = select(qz == wz, 0.0f, qz);
        const float c = fx * fx + fy * fy + fz * fz;
        const float m = k * (fx * vx + fy * vy + fz * vz);
        float root = c / m;
        if constexpr (K > 1) {
            const float ox = select(qx == wx, vx, 0.0f), oy = select(qy == wy, vy, 0.0f),
                        oz = select(qz == wz, vz, 0.0f);
            const float under = m * m + 4.0f * (k - 1.0f) * (ox * ox + oy * oy + oz * oz) * c;
            root = 2.0f * c / (m + under * inverse_sqrt(under));
        }
        next[i] = select(root > 1e-18f, smaller(root, 1e18f), s);
    }
    for (int i = 0; i < lane_count; ++i) {
        step[i] = next[i];
        best[i] = bound[i];
    }
}

/// Two certificates, the first at the center of the box, for each lane: bounds (v.p)+ / |p|^K. Zero where the support
/// says that nothing lies in front.
template <int K>
LIGHTCUTS_VECTORIZED void max_dots_over_distance(const LaneVectors& v, const LaneSupport& s, const OffsetBlock& b,
                                                 Lanes& bound) {
    constexpr float k = K;
    alignas(32) Lanes step, best, result;
    for (int i = 0; i < lane_count; ++i) {
        const float cx = b.center(0, i), cy = b.center(1, i), cz = b.center(2, i);
        const float most = s.value[i] + s.noise[i];
        const float at_center = v.x[0][i] * cx + v.x[1][i] * cy + v.x[2][i] * cz;
        const bool in_front = at_center > 0.0f;
        step[i] = select(in_front, cx * cx + cy * cy + cz * cz, b.farthest2[i]) /
                  (k * select(in_front, at_center, most));
        step[i] = smaller(larger(step[i], 1e-18f), 1e18f);  // any will do that overflows nothing
        const float inverse = b.inverse[i];
        // From the left, since the powers alone would be denormal far away.
        best[i] = K == 1 ? most * inverse : K == 2 ? most * inverse * inverse : most * inverse * inverse * inverse;
    }
    if (!b.all_far) {
        alignas(32) Lanes certified;
        for (int i = 0; i < lane_count; ++i) certified[i] = best[i];
        certify<K>(v, b, step, certified);
        certify<K>(v, b, step, certified);
        for (int i = 0; i < lane_count; ++i) best[i] = select(b.nearness[i] < 0.0f, best[i], certified[i]);
    }
    for (int i = 0; i < lane_count; ++i) {
        constexpr float largest = (std::numeric_limits<float>::max)(),
                        infinity = std::numeric_limits<float>::infinity();
        const float inverse = b.inverse[i];
        const float slack = 1e-6f * (magnitude(v.x[0][i]) + magnitude(v.x[1][i]) + magnitude(v.x[2][i])) *
                            (K == 1   ? 1.0f
                             : K == 2 ? inverse
                                      : inverse * inverse);
        const float padded = best[i] * 1.00001f + slack;
        // The comparison that fails for NaN leaves infinity.
        const float in_front = select(padded < largest, larger(padded, 1e-37f), infinity);
        result[i] = select(s.value[i] <= -s.noise[i], 0.0f, in_front);
    }
    for (int i = 0; i < lane_count; ++i) bound[i] = result[i];
}

}  // namespace detail

}  // namespace lightcuts
