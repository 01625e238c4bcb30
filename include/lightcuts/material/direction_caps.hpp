#pragma once

#include <limits>

#include <glm/vec3.hpp>

#include "../core/offset_block.hpp"
#include "../core/vectorized.hpp"

namespace lightcuts::detail {

/// For each box of a block a cone about the direction of its center that holds the directions of all its points, as
/// rounded to float. Wider than the smallest by 1e-5 radians at most, and by 5e-3 of the box's diagonal over its
/// distance: so much a needle that points at the receiver loses in float, and more where it is nearer than its length.
struct DirectionCaps {
    alignas(32) Lanes center[3];  ///< unit vectors
    alignas(32) Lanes cos;        ///< of the half-angle
    alignas(32) Lanes sin;
    alignas(32) Lanes narrow;  ///< 1: a cone of under about 88 degrees; 0: the rest means nothing
};

LIGHTCUTS_VECTORIZED inline void caps_of(const OffsetBlock& b, DirectionCaps& caps) {
    for (int i = 0; i < lane_count; ++i) {
        const float cx = b.center(0, i), cy = b.center(1, i), cz = b.center(2, i);
        const float d2 = cx * cx + cy * cy + cz * cz;
        const float inverse = inverse_sqrt(d2);
        const auto half_edge = [&](int k, float c) {
            const float half = 0.5f * b.hi.x[k][i] - 0.5f * b.lo.x[k][i];
            return (half + 3e-7f * (half + magnitude(c))) * inverse;
        };
        // Seen from a unit distance.
        const float x = cx * inverse, y = cy * inverse, z = cz * inverse;
        const float hx = half_edge(0, cx), hy = half_edge(1, cy), hz = half_edge(2, cz);
        // Opposite vertices c + s and c - s have c.s = +-t: the one farther from the axis has t < 0, and there
        // tan^2 = (s^2 - t^2) / (1 - |t|)^2.
        const float tx = magnitude(x) * hx, ty = magnitude(y) * hy, tz = magnitude(z) * hz;
        const float s2 = (hx * hx + hy * hy + hz * hz) * 1.000002f;
        const auto tangent2 = [s2](float t) {
            const float front = 0.999999f - magnitude(t);
            return (s2 - t * t * 0.999998f) / (front * front);
        };
        const float most = larger(larger(tangent2(tx + ty + tz), tangent2(tx + ty - tz)),
                                  larger(tangent2(tx - ty + tz), tangent2(tx - ty - tz)));
        const bool in_range = smaller(d2 - 1e-30f, 1e37f - d2) > 0.0f;
        const bool is_narrow = smaller(0.999f - (tx + ty + tz), 1e3f - most) > 0.0f;
        const float tan2 = select(is_narrow, larger(most, 0.0f), 0.0f);
        const float cosine = inverse_sqrt(1.0f + tan2), sine = square_root(tan2) * cosine * 1.000002f;
        constexpr float turn = 2e-6f;
        caps.center[0][i] = x;
        caps.center[1][i] = y;
        caps.center[2][i] = z;
        caps.cos[i] = cosine - turn * sine;
        caps.sin[i] = sine + turn * cosine;
        caps.narrow[i] = select(in_range, select(is_narrow, 1.0f, 0.0f), 0.0f);
    }
}

/// Where unit `v` lies as seen from a cap's axis: cosine and sine.
struct CapAngle {
    float along;
    float beside;
};

[[gnu::always_inline]] inline CapAngle angle_from(const DirectionCaps& caps, int i, const glm::vec3& v) {
    const float cx = caps.center[0][i], cy = caps.center[1][i], cz = caps.center[2][i];
    const float x = v.y * cz - v.z * cy, y = v.z * cx - v.x * cz, z = v.x * cy - v.y * cx;
    return {v.x * cx + v.y * cy + v.z * cz, square_root(x * x + y * y + z * z)};
}

/// Upper bounds of max(0, cos) between unit `v` and the directions of each cap. 1 for one that is not narrow.
LIGHTCUTS_VECTORIZED inline void clamped_max_cosines(const glm::vec3& v, const DirectionCaps& caps, Lanes& cosines) {
    for (int i = 0; i < lane_count; ++i) {
        const auto [along, beside] = angle_from(caps, i, v);
        const float c = larger(along * caps.cos[i] + beside * caps.sin[i] + 2e-6f, 0.0f);
        const bool inside = smaller(caps.cos[i] - 2e-6f - along, caps.narrow[i] - 0.5f) <= 0.0f;
        cosines[i] = select(inside, 1.0f, smaller(c, 1.0f));
    }
}

/// Lower bounds of max(0, cos) between unit `v` and the directions of each cap. 0 for one that is not narrow.
LIGHTCUTS_VECTORIZED inline void clamped_min_cosines(const glm::vec3& v, const DirectionCaps& caps, Lanes& cosines) {
    for (int i = 0; i < lane_count; ++i) {
        const auto [along, beside] = angle_from(caps, i, v);
        const float c = along * caps.cos[i] - beside * caps.sin[i] - 2e-6f;
        cosines[i] = select(c * caps.narrow[i] > 0.0f, c, 0.0f);
    }
}

}  // namespace lightcuts::detail
