#pragma once

#include <limits>

#include <glm/vec3.hpp>

#include "lanes.hpp"
#include "vectorized.hpp"

namespace lightcuts {

/// By how much of each coordinate, to either side, the boxes of an OffsetBlock are widened: 16 unit roundoffs of float
/// for the directions that materials are given, and one for the float differences that the boxes are made of. Zeros
/// stay zeros.
inline constexpr float offset_margin = 0x1.1p-20f;

/// Several boxes of offsets, coordinate by coordinate in float: the quick bounds of all of them are computed in loops
/// that compilers turn into vector code. Whatever float cannot do (overflow, denormals) makes a bound infinite.
/// Fill with `set`, then call `finish`.
struct OffsetBlock {
    LaneVectors lo;
    LaneVectors hi;
    alignas(32) Lanes farthest2;  ///< upper bound of the squared distance
    alignas(32) Lanes inverse;    ///< 1 / least distance; infinite if that is zero or out of float's range
    /// Negative for a box that is so far for its size that the largest product over the least distance is nearly a
    /// maximum. By lane, so that a bound does not depend on what stands beside it.
    alignas(32) Lanes nearness;
    bool all_far;  ///< every lane counts as far

    /// A box counts as far if half of its diagonal is less than this share of the least distance.
    static constexpr float far_half_diagonal = 0.125f;

    /// The middle of a box along axis `k`.
    float center(int k, int lane) const { return 0.5f * lo.x[k][lane] + 0.5f * hi.x[k][lane]; }

    /// pre: 0 <= lane < lane_count
    void set(int lane, const glm::vec3& low, const glm::vec3& high) {
        lo.set(lane, low);
        hi.set(lane, high);
    }

    /// Repeats the last of `count` boxes in the lanes behind it, and completes all: widened by all rounding up to here,
    /// but corners at zero stay there. pre: count > 0
    LIGHTCUTS_VECTORIZED void finish(int count) {
        detail::repeat_last(lo, count);
        detail::repeat_last(hi, count);
        for (int k = 0; k < 3; ++k) {
            for (int i = 0; i < lane_count; ++i) {
                lo.x[k][i] -= offset_margin * detail::magnitude(lo.x[k][i]);
                hi.x[k][i] += offset_margin * detail::magnitude(hi.x[k][i]);
            }
        }
        for (int i = 0; i < lane_count; ++i) {
            float d2 = 0.0f, far2 = 0.0f, half2 = 0.0f;
            for (int k = 0; k < 3; ++k) {
                const float low = lo.x[k][i], high = hi.x[k][i];
                const float near_k = detail::larger(detail::larger(low, -high), 0.0f);
                const float far_k = detail::larger(-low, high);
                const float half_k = 0.5f * high - 0.5f * low;
                d2 += near_k * near_k;
                far2 += far_k * far_k;
                half2 += half_k * half_k;
            }
            farthest2[i] = far2 * 1.000001f;
            const bool in_range = detail::smaller(d2 - 1e-30f, 1e34f - far2) > 0.0f;
            inverse[i] = detail::select(in_range, detail::inverse_sqrt(d2) * 1.000001f,
                                        std::numeric_limits<float>::infinity());
            nearness[i] = half2 - far_half_diagonal * far_half_diagonal * d2;
        }
        float nearest = nearness[0];
        for (int i = 1; i < lane_count; ++i) nearest = detail::larger(nearest, nearness[i]);
        all_far = nearest < 0.0f;
    }
};

namespace detail {

/// The largest v.p of each lane and its rounding error.
struct LaneSupport {
    alignas(32) Lanes value;
    alignas(32) Lanes noise;
};

/// The support of one lane. From the corner farthest along v, so that boxes which touch the plane behind v give zero.
[[gnu::always_inline]] inline void support_lane(float vx, float vy, float vz, const OffsetBlock& b, int i,
                                                LaneSupport& s) {
    const float x = select(vx > 0.0f, b.hi.x[0][i], b.lo.x[0][i]), y = select(vy > 0.0f, b.hi.x[1][i], b.lo.x[1][i]),
                z = select(vz > 0.0f, b.hi.x[2][i], b.lo.x[2][i]);
    const float px = vx * x, py = vy * y, pz = vz * z;
    s.value[i] = px + py + pz;
    // A product of factors that are not zero is not zero, though it may underflow.
    const bool any = ((vx != 0.0f) & (x != 0.0f)) | ((vy != 0.0f) & (y != 0.0f)) | ((vz != 0.0f) & (z != 0.0f));
    s.noise[i] = 1e-6f * (magnitude(px) + magnitude(py) + magnitude(pz)) + select(any, 1e-37f, 0.0f);
}

[[gnu::always_inline]] inline void support(const LaneVectors& v, const OffsetBlock& b, LaneSupport& s) {
    for (int i = 0; i < lane_count; ++i) support_lane(v.x[0][i], v.x[1][i], v.x[2][i], b, i, s);
}

/// Of one vector in all lanes.
[[gnu::always_inline]] inline void support(const glm::vec3& v, const OffsetBlock& b, LaneSupport& s) {
    const float x = v.x, y = v.y, z = v.z;
    for (int i = 0; i < lane_count; ++i) support_lane(x, y, z, b, i, s);
}

inline void broadcast(const glm::vec3& n, LaneVectors& v) {
    for (int i = 0; i < lane_count; ++i) {
        v.x[0][i] = n.x;
        v.x[1][i] = n.y;
        v.x[2][i] = n.z;
    }
}

}  // namespace detail

}  // namespace lightcuts
