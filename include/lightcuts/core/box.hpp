#pragma once

#include <cmath>
#include <limits>

#include <glm/vec3.hpp>

#include "rounding.hpp"

namespace lightcuts {

/// Axis-aligned box of points (or of directions). The default is empty: the identity of `merge`.
struct Box {
    glm::vec3 lo{std::numeric_limits<float>::infinity()};
    glm::vec3 hi{-std::numeric_limits<float>::infinity()};

    friend bool operator==(const Box&, const Box&) = default;
};

/// The box of one point.
inline Box box_of(const glm::vec3& point) { return {point, point}; }

/// The smallest box that holds both.
inline Box merge(const Box& a, const Box& b) {
    const auto lower = [](float s, float t) { return t < s ? t : s; };
    const auto upper = [](float s, float t) { return s < t ? t : s; };
    return {{lower(a.lo.x, b.lo.x), lower(a.lo.y, b.lo.y), lower(a.lo.z, b.lo.z)},
            {upper(a.hi.x, b.hi.x), upper(a.hi.y, b.hi.y), upper(a.hi.z, b.hi.z)}};
}

/// True iff the box holds no point.
inline bool is_empty(const Box& b) { return !(b.lo.x <= b.hi.x && b.lo.y <= b.hi.y && b.lo.z <= b.hi.z); }

/// True iff `point` lies in `b` or on its surface.
inline bool contains(const Box& b, const glm::vec3& point) {
    return b.lo.x <= point.x && point.x <= b.hi.x && b.lo.y <= point.y && point.y <= b.hi.y && b.lo.z <= point.z &&
           point.z <= b.hi.z;
}

/// True iff every point of `inner` lies in `outer`; an empty `inner` always does.
inline bool contains(const Box& outer, const Box& inner) {
    return is_empty(inner) || (contains(outer, inner.lo) && contains(outer, inner.hi));
}

/// The middle of `b`; pre: not empty.
inline glm::dvec3 center(const Box& b) { return 0.5 * (glm::dvec3(b.lo) + glm::dvec3(b.hi)); }

/// The edges of `b`; zero if empty.
inline glm::dvec3 extent(const Box& b) { return is_empty(b) ? glm::dvec3(0.0) : glm::dvec3(b.hi) - glm::dvec3(b.lo); }

/// Squared length of the diagonal; zero if empty.
inline double diagonal2(const Box& b) {
    const glm::dvec3 e = extent(b);
    return e.x * e.x + e.y * e.y + e.z * e.z;
}

/// Box of offsets p = light - receiver, in double: seen from the receiver, which is the origin. Every bound starts
/// from it. Products of such coordinates, to the fourth power even, neither overflow nor underflow.
struct OffsetBox {
    glm::dvec3 lo{0.0};
    glm::dvec3 hi{0.0};

    friend bool operator==(const OffsetBox&, const OffsetBox&) = default;
};

namespace detail {

/// a - b, moved one ulp towards -infinity iff rounding has raised it. `way` = -1 mirrors: towards +infinity.
constexpr double outward_difference(double a, double b, double way) {
    const double d = a - b;
    const double t = d - a;
    const double lost = (a - (d - t)) - (b + t);  // a - b = d + lost exactly (Knuth's two-sum)
    const double magnitude = d < 0.0 ? -d : d;
    return d - (way * lost < 0.0 ? way * magnitude * (2.0 * unit_roundoff) : 0.0);
}

constexpr double clamp(double x, double lo, double hi) {
    const double raised = x < lo ? lo : x;
    return raised > hi ? hi : raised;
}

inline double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace detail

/// The offsets of the points of `lights` from `receiver`. Exact unless the difference of two floats has more than
/// 53 bits; then rounded outward.
/// pre: `lights` is not empty
inline OffsetBox offsets(const Box& lights, const glm::vec3& receiver) {
    using detail::outward_difference;
    const glm::dvec3 lo(lights.lo);
    const glm::dvec3 hi(lights.hi);
    const glm::dvec3 x(receiver);
    return {
        {outward_difference(lo.x, x.x, 1.0), outward_difference(lo.y, x.y, 1.0), outward_difference(lo.z, x.z, 1.0)},
        {outward_difference(hi.x, x.x, -1.0), outward_difference(hi.y, x.y, -1.0),
         outward_difference(hi.z, x.z, -1.0)}};
}

/// The offsets from every point of `receivers` to every point of `lights` (a gather cluster's view).
/// pre: neither box is empty
inline OffsetBox offsets(const Box& lights, const Box& receivers) {
    return {offsets(lights, receivers.hi).lo, offsets(lights, receivers.lo).hi};
}

/// The box of -p.
inline OffsetBox negated(const OffsetBox& b) { return {-b.hi, -b.lo}; }

/// The middle of `b`.
inline glm::dvec3 center(const OffsetBox& b) { return 0.5 * (b.lo + b.hi); }

/// The point of `b` nearest to `v`.
inline glm::dvec3 clamp(const glm::dvec3& v, const OffsetBox& b) {
    return {detail::clamp(v.x, b.lo.x, b.hi.x), detail::clamp(v.y, b.lo.y, b.hi.y), detail::clamp(v.z, b.lo.z, b.hi.z)};
}

/// True iff `p` lies in `b` or on its surface.
inline bool contains(const OffsetBox& b, const glm::dvec3& p) {
    return b.lo.x <= p.x && p.x <= b.hi.x && b.lo.y <= p.y && p.y <= b.hi.y && b.lo.z <= p.z && p.z <= b.hi.z;
}

/// Lower bound of |p|^2 over the box, within a few ulps; exactly zero iff the receiver lies in it.
inline double min_distance2(const OffsetBox& b) {
    const glm::dvec3 nearest = clamp(glm::dvec3(0.0), b);
    return detail::dot(nearest, nearest) * (1.0 - 4.0 * unit_roundoff);
}

/// Upper bound of |p|^2 over the box, within a few ulps.
inline double max_distance2(const OffsetBox& b) {
    const auto farthest = [](double lo, double hi) { return -lo > hi ? -lo : hi; };
    const glm::dvec3 corner(farthest(b.lo.x, b.hi.x), farthest(b.lo.y, b.hi.y), farthest(b.lo.z, b.hi.z));
    return detail::dot(corner, corner) * (1.0 + 4.0 * unit_roundoff);
}

}  // namespace lightcuts
