#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "box.hpp"
#include "rounding.hpp"

namespace lightcuts {

/// All directions within an angle beta of an axis. Stored as sin^2(beta/2), which, unlike a cosine, keeps small
/// angles. The default is empty: the identity of `merge`.
struct Cone {
    glm::vec3 axis{0.0f, 0.0f, 1.0f};  ///< unit
    float sin2_half = -1.0f;           ///< sin^2(beta/2): 0 one direction, 1/2 hemisphere, 1 sphere; negative: empty

    friend bool operator==(const Cone&, const Cone&) = default;
};

/// The cone of one direction; pre: `axis` is a unit vector.
inline Cone cone_of(const glm::vec3& axis) { return {axis, 0.0f}; }

/// The cone of every direction.
inline Cone whole_sphere() { return {{0.0f, 0.0f, 1.0f}, 1.0f}; }

/// True iff the cone holds no direction.
inline bool is_empty(const Cone& c) { return c.sin2_half < 0.0f; }
/// True iff the cone holds exactly one direction.
inline bool is_single(const Cone& c) { return c.sin2_half == 0.0f; }
/// True iff the cone holds every direction.
inline bool is_whole_sphere(const Cone& c) { return c.sin2_half >= 1.0f; }

namespace detail {

/// `v` with length 1. pre: its squared length is a normal number
inline glm::dvec3 unit(const glm::dvec3& v) { return v * (1.0 / std::sqrt(dot(v, v))); }

}  // namespace detail

/// The axis in double, with length 1 to double precision: as stored it is off by up to 1e-7, too much for
/// `widen_cosine` where the cosine is near -1. pre: not empty
inline glm::dvec3 unit_axis(const Cone& c) { return detail::unit(glm::dvec3(c.axis)); }

/// The cone of the opposites of the directions in `c`; that of no direction is itself.
inline Cone negated(const Cone& c) { return {-c.axis, c.sin2_half}; }

/// 1 - cos(beta), without cancellation; pre: not empty.
inline double one_minus_cos(const Cone& c) { return 2.0 * static_cast<double>(c.sin2_half); }

/// cos(beta); pre: not empty.
inline double cos_half_angle(const Cone& c) { return 1.0 - 2.0 * static_cast<double>(c.sin2_half); }

/// sin(beta); pre: not empty.
inline double sin_half_angle(const Cone& c) {
    const double s2 = static_cast<double>(c.sin2_half);
    return 2.0 * std::sqrt(s2 * (1.0 - s2));
}

/// True iff `direction` lies in `c`, within 1e-15 radians: the rounding of unit vectors. pre: `direction` is not zero.
inline bool contains(const Cone& c, const glm::dvec3& direction) {
    if (is_empty(c)) return false;
    const double reach = std::sqrt(static_cast<double>(c.sin2_half)) + 4.0 * unit_roundoff;
    const glm::dvec3 apart = glm::normalize(direction) - unit_axis(c);
    return 0.25 * detail::dot(apart, apart) <= reach * reach || is_whole_sphere(c);
}

namespace detail {

/// sin^2 of half the angle that a cone about `axis` needs to hold the cone about `other` whose own is `sin2_half`; from
/// above, with the rounding of the unit vectors, so that it is at least 1e-21: 6e-11 radians, a thousandth of the
/// distance between two axes of floats. Relative to that it keeps its digits, however narrow the cones are.
inline double needed_sin2_half(const glm::dvec3& axis, const glm::dvec3& other, double sin2_half) {
    const glm::dvec3 apart = axis - other;
    const double between = 0.25 * dot(apart, apart);  // sin^2 of half the angle between the axes
    if (between + sin2_half >= 1.0 - 64.0 * unit_roundoff) return 1.0;
    const double cos2_between = 1.0 - between, cos2_half = 1.0 - sin2_half;
    // sin^2 of a sum of angles.
    const double sum = between * cos2_half + sin2_half * cos2_between +
                       2.0 * std::sqrt((between * cos2_half) * (sin2_half * cos2_between));
    // (s + 16 u)^2 <= s^2 (1 + 1e-8) + (16 u)^2 (1 + 1e8): u is the rounding of the axes.
    return sum * (1.0 + 1e-8) + 1e-21;
}

/// A unit vector perpendicular to the unit vector `a`.
inline glm::dvec3 perpendicular(const glm::dvec3& a) {
    const double x = std::fabs(a.x);
    const double y = std::fabs(a.y);
    const double z = std::fabs(a.z);
    const glm::dvec3 least = x <= y && x <= z ? glm::dvec3(1, 0, 0)
                             : y <= z         ? glm::dvec3(0, 1, 0)
                                              : glm::dvec3(0, 0, 1);
    return glm::normalize(glm::cross(a, least));
}

}  // namespace detail

/// A cone that holds both: minimal, up to the rounding of its float storage, which is outward, and to 1e-10 radians.
/// Equal single directions stay one direction.
inline Cone merge(const Cone& a, const Cone& b) {
    using namespace detail;
    if (is_empty(b) || is_whole_sphere(a)) return a;
    if (is_empty(a) || is_whole_sphere(b)) return b;
    if (a.axis == b.axis) return a.sin2_half >= b.sin2_half ? a : b;
    if (a.sin2_half < b.sin2_half) return merge(b, a);

    const glm::dvec3 u = unit_axis(a);
    const glm::dvec3 v = unit_axis(b);
    const double sin2_a = static_cast<double>(a.sin2_half), sin2_b = static_cast<double>(b.sin2_half);
    if (sin2_a > 0.0 && needed_sin2_half(u, v, sin2_b) <= sin2_a) return a;

    // The middle of the merged cone lies between the axes, nearer to that of the wider cone: at u + v if both are as
    // wide, and by tan((beta_a - beta_b) / 2) / tan(angle / 2) of the way from there to u.
    const glm::dvec3 across = u - v;
    const double across2 = dot(across, across);
    glm::dvec3 middle = u + v;
    double middle2 = dot(middle, middle);
    if (middle2 < 1e-6) {
        // Nearly opposite: what is left of the sum along the axes is rounding.
        middle -= across * (dot(middle, across) / across2);
        middle2 = dot(middle, middle);
        if (middle2 < 1e-28) {
            middle = perpendicular(u);
            middle2 = 1.0;
        }
    }
    if (sin2_a != sin2_b && across2 > 0.0) {
        const double tan_a = std::sqrt(sin2_a / (1.0 - sin2_a)), tan_b = std::sqrt(sin2_b / (1.0 - sin2_b));
        const double tan_surplus = (tan_a - tan_b) / (1.0 + tan_a * tan_b);
        middle += across * (tan_surplus * std::sqrt(middle2 / across2));
    }
    // The sum with zero keeps g++ 12 from leaving out the rounding to float when it vectorizes what follows: the cone
    // would be measured about an axis that is not the stored one.
    const glm::vec3 axis = glm::vec3(unit(middle)) + 0.0f;

    // Measured about the axis as stored.
    const glm::dvec3 w = unit(glm::dvec3(axis));
    const double needed_a = needed_sin2_half(w, u, sin2_a);
    const double needed_b = needed_sin2_half(w, v, sin2_b);
    const float needed = round_up(needed_a > needed_b ? needed_a : needed_b);
    return needed >= 1.0f ? whole_sphere() : Cone{axis, needed};
}

/// The cone of `c` and one more direction.
inline Cone merge(const Cone& c, const glm::vec3& direction) { return merge(c, cone_of(direction)); }

/// Upper bound of the cosine between a direction and the cone's nearest one, given the cosine `cos_axis` between the
/// direction and the (unit) axis: cos(max(0, theta - beta)). A single direction returns `cos_axis` unchanged, so that
/// zeros stay zeros. pre: `c` is not empty
inline double widen_cosine(double cos_axis, const Cone& c) {
    if (is_single(c)) return cos_axis;
    const double cos_cone = cos_half_angle(c);
    if (cos_axis >= cos_cone) return 1.0;
    const double clamped = cos_axis < -1.0 ? -1.0 : cos_axis;
    const double wide = clamped * cos_cone + std::sqrt((1.0 - clamped) * (1.0 + clamped)) * sin_half_angle(c) +
                        4.0 * unit_roundoff;
    return wide < 1.0 ? wide : 1.0;
}

}  // namespace lightcuts
