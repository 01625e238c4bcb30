#pragma once

#include <cmath>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "outward.hpp"

namespace lightcuts::detail {

/// A cone about the direction of a box's centre that holds the directions of all its points, as rounded to float. With
/// d the distance of the centre and a the cone's half-angle, `along` = d cos a and `across` = d sin a.
struct DirectionCap {
    glm::dvec3 centre;
    double d2;
    double along;
    double across;
    bool is_narrow;  ///< a < 90 degrees; otherwise `along` and `across` mean nothing
};

/// cost: about 10 ns
inline DirectionCap cap_of(const OffsetBox& b) {
    const glm::dvec3 c = 0.5 * (b.lo + b.hi);
    const glm::dvec3 e = 0.5 * (b.hi - b.lo);
    const double d2 = dot(c, c);
    // Opposite vertices c + s and c - s have c.s = +-t: the one farther from the axis has t < 0, and there
    // tan^2 = (|e|^2 d^2 - t^2) / (d^2 - |t|)^2. The factor makes up for cancellation in needles that point at us.
    const double e2d2 = dot(e, e) * d2 * (1.0 + 1e-15);
    const double tx = std::fabs(c.x) * e.x;
    const double ty = std::fabs(c.y) * e.y;
    const double tz = std::fabs(c.z) * e.z;
    const double t[4] = {tx + ty + tz, tx + ty - tz, tx - ty + tz, tx - ty - tz};
    double sin2s[4];
    for (int i = 0; i < 4; ++i) {
        const double front = d2 - std::fabs(t[i]);
        const double side2 = e2d2 - t[i] * t[i];
        sin2s[i] = side2 / (side2 + front * front);
    }
    const double a = sin2s[0] > sin2s[1] ? sin2s[0] : sin2s[1];
    const double z = sin2s[2] > sin2s[3] ? sin2s[2] : sin2s[3];
    const double sin2 = a > z ? a : z;
    const double across2 = d2 * sin2;
    const bool is_narrow = d2 > t[0] && sin2 < 1.0 - 1e-9;  // false for NaN: a box at the origin
    const double along = std::sqrt(is_narrow ? d2 - across2 : 0.0);
    const double across = std::sqrt(across2);
    constexpr double turn = 1.01 * direction_error;
    return {c, d2, along - turn * across, across + turn * along, is_narrow};
}

/// Upper bound of the cosine between unit `v` and the cap's directions, if one lies in front of it; at most 0 if none
/// does. pre: the cap is narrow
inline double clamped_max_cosine(const glm::dvec3& v, const DirectionCap& cap) {
    const double n = dot(v, cap.centre);
    const double beside2 = cap.d2 - n * n;
    const double beside = std::sqrt(beside2 > 0.0 ? beside2 : 0.0);
    const double c = (n * cap.along + beside * cap.across) / cap.d2 + 1e-15;
    return n >= cap.along || c > 1.0 ? 1.0 : c;
}

/// Lower bound of max(0, cos) between unit `v` and the cap's directions. pre: the cap is narrow
inline double clamped_min_cosine(const glm::dvec3& v, const DirectionCap& cap) {
    const double n = dot(v, cap.centre);
    const double beside2 = cap.d2 - n * n;
    const double beside = std::sqrt(beside2 > 0.0 ? beside2 : 0.0);
    const double c = (n * cap.along - beside * cap.across) / cap.d2 - 1e-15;
    return c > 0.0 ? c : 0.0;
}

}  // namespace lightcuts::detail
