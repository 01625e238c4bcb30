#pragma once

#include <limits>

#include <glm/vec3.hpp>

#include "lanes.hpp"

namespace lightcuts {

/// Several boxes of offsets, coordinate by coordinate in float: the quick bounds of all of them are computed in loops
/// that compilers turn into vector code. Whatever float cannot do (overflow, denormals) makes a bound infinite.
/// Fill with `set`, then call `finish`.
struct OffsetBlock {
    LaneVectors lo;
    LaneVectors hi;
    alignas(32) Lanes centre[3];
    alignas(32) Lanes half[3];    ///< of the edges
    alignas(32) Lanes farthest2;  ///< upper bound of the squared distance
    alignas(32) Lanes inverse;    ///< 1 / least distance; infinite if that is zero or out of float's range
    /// Negative for a box that is so far for its size that the largest product over the least distance is nearly a
    /// maximum. By lane, so that a bound does not depend on what stands beside it.
    alignas(32) Lanes nearness;
    bool all_far;

    /// Of a box that counts as far, half of the diagonal over the least distance.
    static constexpr float far_half_diagonal = 0.125f;

    /// pre: 0 <= lane < lane_count
    void set(int lane, const glm::vec3& low, const glm::vec3& high) {
        lo.set(lane, low);
        hi.set(lane, high);
    }

    /// Repeats the last of `count` boxes in the lanes behind it, and completes all: widened by all rounding up to here,
    /// but corners at zero stay there. pre: count > 0
    void finish(int count) {
        detail::repeat_last(lo, count);
        detail::repeat_last(hi, count);
        for (int k = 0; k < 3; ++k) {
            for (int i = 0; i < lane_count; ++i) {
                const float low = lo.x[k][i], high = hi.x[k][i];
                const float c = 0.5f * low + 0.5f * high, h = 0.5f * high - 0.5f * low;
                centre[k][i] = c;
                half[k][i] = h + 1e-6f * (detail::magnitude(c) + h);
                lo.x[k][i] = low - 1e-6f * detail::magnitude(low);
                hi.x[k][i] = high + 1e-6f * detail::magnitude(high);
            }
        }
        for (int i = 0; i < lane_count; ++i) {
            const float x = detail::larger(detail::magnitude(centre[0][i]) - half[0][i], 0.0f);
            const float y = detail::larger(detail::magnitude(centre[1][i]) - half[1][i], 0.0f);
            const float z = detail::larger(detail::magnitude(centre[2][i]) - half[2][i], 0.0f);
            const float d2 = x * x + y * y + z * z;
            const float far_x = detail::magnitude(centre[0][i]) + half[0][i],
                        far_y = detail::magnitude(centre[1][i]) + half[1][i],
                        far_z = detail::magnitude(centre[2][i]) + half[2][i];
            farthest2[i] = far_x * far_x + far_y * far_y + far_z * far_z;
            const bool in_range = detail::smaller(d2 - 1e-30f, 1e34f - farthest2[i]) > 0.0f;
            inverse[i] = detail::select(in_range, detail::inverse_sqrt(d2) * 1.000001f,
                                        std::numeric_limits<float>::infinity());
            const float half2 = half[0][i] * half[0][i] + half[1][i] * half[1][i] + half[2][i] * half[2][i];
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
inline void support_lane(float vx, float vy, float vz, const OffsetBlock& b, int i, LaneSupport& s) {
    const float x = select(vx > 0.0f, b.hi.x[0][i], b.lo.x[0][i]), y = select(vy > 0.0f, b.hi.x[1][i], b.lo.x[1][i]),
                z = select(vz > 0.0f, b.hi.x[2][i], b.lo.x[2][i]);
    const float px = vx * x, py = vy * y, pz = vz * z;
    s.value[i] = px + py + pz;
    // A product of factors that are not zero is not zero, though it may underflow.
    const bool any = ((vx != 0.0f) & (x != 0.0f)) | ((vy != 0.0f) & (y != 0.0f)) | ((vz != 0.0f) & (z != 0.0f));
    s.noise[i] = 1e-6f * (magnitude(px) + magnitude(py) + magnitude(pz)) + select(any, 1e-37f, 0.0f);
}

inline void support(const LaneVectors& v, const OffsetBlock& b, LaneSupport& s) {
    for (int i = 0; i < lane_count; ++i) support_lane(v.x[0][i], v.x[1][i], v.x[2][i], b, i, s);
}

/// Of one vector in all lanes.
inline void support(const glm::vec3& v, const OffsetBlock& b, LaneSupport& s) {
    const float x = v.x, y = v.y, z = v.z;
    for (int i = 0; i < lane_count; ++i) support_lane(x, y, z, b, i, s);
}

/// The certificate of `max_power` at `step`: lowers `best`, a bound of (v.p)+ / |p|^K, and moves `step` to where the
/// bound would be exact if the same coordinates stayed clamped.
template <int K>
void certify(const LaneVectors& v, const OffsetBlock& b, Lanes& step, Lanes& best) {
    constexpr float k = K;
    alignas(32) Lanes next, bound;
    for (int i = 0; i < lane_count; ++i) {
        const float vx = v.x[0][i], vy = v.x[1][i], vz = v.x[2][i];
        const float cx = b.centre[0][i], cy = b.centre[1][i], cz = b.centre[2][i];
        const float hx = b.half[0][i], hy = b.half[1][i], hz = b.half[2][i];
        const float inverse = b.inverse[i], s = step[i];
        const float wx = s * vx, wy = s * vy, wz = s * vz;
        const float qx = smaller(larger(wx, cx - hx), cx + hx);
        const float qy = smaller(larger(wy, cy - hy), cy + hy);
        const float qz = smaller(larger(wz, cz - hz), cz + hz);
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

/// Two certificates, the first at the centre of the box, for each lane: bounds (v.p)+ / |p|^K. Zero where the support
/// says that nothing lies in front.
template <int K>
void lane_power(const LaneVectors& v, const LaneSupport& s, const OffsetBlock& b, Lanes& bound) {
    constexpr float k = K;
    alignas(32) Lanes step, best, result;
    for (int i = 0; i < lane_count; ++i) {
        const float cx = b.centre[0][i], cy = b.centre[1][i], cz = b.centre[2][i];
        const float most = s.value[i] + s.noise[i];
        const float at_centre = v.x[0][i] * cx + v.x[1][i] * cy + v.x[2][i] * cz;
        const bool in_front = at_centre > 0.0f;
        step[i] = select(in_front, cx * cx + cy * cy + cz * cz, b.farthest2[i]) /
                  (k * select(in_front, at_centre, most));
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

inline void broadcast(const glm::vec3& n, LaneVectors& v) {
    for (int i = 0; i < lane_count; ++i) {
        v.x[0][i] = n.x;
        v.x[1][i] = n.y;
        v.x[2][i] = n.z;
    }
}

/// Upper bounds of max(0, cos) between unit `v` and the points of each box as a float evaluation may see them; exactly
/// zero where all lie behind.
inline void clamped_max_cosines(const glm::vec3& v, const OffsetBlock& b, Lanes& cosines) {
    LaneVectors directions;
    LaneSupport s;
    broadcast(v, directions);
    support(v, b, s);
    lane_power<1>(directions, s, b, cosines);
    for (int i = 0; i < lane_count; ++i) cosines[i] = smaller(cosines[i], 1.0f);
}

}  // namespace detail

}  // namespace lightcuts
