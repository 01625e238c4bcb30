#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include <glm/vec3.hpp>

#include "../core/cone.hpp"
#include "../light/light.hpp"
#include "../tree/light_cluster.hpp"

namespace lightcuts {

/// Several clusters of one kind as a receiver sees them, coordinate by coordinate in float: the quick bounds of all of
/// them are computed in loops that compilers turn into vector code. Whatever float cannot do (overflow, denormals)
/// makes a bound infinite, and the tight bound in double decides.
struct ClusterBlock {
    static constexpr int width = 8;
    static constexpr float one_direction = 2.0f;  ///< no cosine
    using Lanes = float[width];

    alignas(32) Lanes centre[3];  ///< of the box of offsets
    alignas(32) Lanes half[3];    ///< of its edges; widened by all rounding up to here, but zero stays zero
    alignas(32) Lanes axis[3];    ///< reversed axis of the emission cone
    alignas(32) Lanes cos_cone;   ///< `one_direction` for a cone of one
    alignas(32) Lanes sin_cone;
    alignas(32) Lanes inverse;    ///< 1 / distance of the box
    alignas(32) Lanes bound;      ///< what a kernel returns
    alignas(32) Lanes geometric;  ///< bound of emission x attenuation, once `lane_geometric` was called
    bool any_cone = false;        ///< some emission cone is wider than one direction
    bool any_single = false;      ///< some is one direction
    bool has_geometric = false;

    template <Light L>
    void set(int lane, const LightCluster<L>& cluster, const glm::vec3& point) {
        const glm::vec3 origin = DirectionalLight<L> ? glm::vec3(0.0f) : point;
        const glm::vec3 lo = cluster.box.lo - origin, hi = cluster.box.hi - origin;
        for (int i = 0; i < 3; ++i) {
            const float l = i == 0 ? lo.x : i == 1 ? lo.y : lo.z, h = i == 0 ? hi.x : i == 1 ? hi.y : hi.z;
            centre[i][lane] = 0.5f * (l + h);
            half[i][lane] = 0.5f * (h - l);
        }
        if constexpr (LightCluster<L>::oriented) {
            axis[0][lane] = -cluster.cone.axis.x;
            axis[1][lane] = -cluster.cone.axis.y;
            axis[2][lane] = -cluster.cone.axis.z;
            if (!is_single(cluster.cone)) {
                any_cone = true;
                cos_cone[lane] = static_cast<float>(cos_half_angle(cluster.cone));
                sin_cone[lane] = static_cast<float>(sin_half_angle(cluster.cone));
            } else {
                any_single = true;
                cos_cone[lane] = one_direction;
                sin_cone[lane] = 0.0f;
            }
        }
    }

    /// Repeats the last of `count` clusters in the lanes behind it, and completes all.
    void finish(int count);
};

namespace detail {

/// `condition ? a : b` by masks: a conditional would let compilers compute an arm only where it is needed, and then
/// refuse to vectorise the loop.
inline float select(bool condition, float a, float b) {
    const std::uint32_t mask = 0u - static_cast<std::uint32_t>(condition);
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) | (std::bit_cast<std::uint32_t>(b) & ~mask));
}

inline float magnitude(float x) { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & 0x7fffffffu); }
inline float larger(float x, float y) { return select(x > y, x, y); }
inline float smaller(float x, float y) { return select(x < y, x, y); }

/// 1 / sqrt(x) within 2e-7, in arithmetic that vectorises everywhere (sqrt itself sets errno); finite at 0.
inline float inverse_sqrt(float x) {
    float y = std::bit_cast<float>(0x5f375a86u - (std::bit_cast<std::uint32_t>(x) >> 1));
    const float half = 0.5f * x;
    y = y * (1.5f - half * y * y);
    y = y * (1.5f - half * y * y);
    y = y * (1.5f - half * y * y);
    return y;
}

}  // namespace detail

inline void ClusterBlock::finish(int count) {
    if (count < width) {
        const auto repeat = [&](Lanes& lanes) {
            for (int i = count; i < width; ++i) lanes[i] = lanes[count - 1];
        };
        for (int k = 0; k < 3; ++k) {
            repeat(centre[k]);
            repeat(half[k]);
            repeat(axis[k]);
        }
        repeat(cos_cone);
        repeat(sin_cone);
    }
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < width; ++i) half[k][i] += 1e-6f * (detail::magnitude(centre[k][i]) + half[k][i]);
    }
    for (int i = 0; i < width; ++i) {
        const float x = detail::larger(detail::magnitude(centre[0][i]) - half[0][i], 0.0f);
        const float y = detail::larger(detail::magnitude(centre[1][i]) - half[1][i], 0.0f);
        const float z = detail::larger(detail::magnitude(centre[2][i]) - half[2][i], 0.0f);
        const float d2 = x * x + y * y + z * z;
        const bool in_range = detail::smaller(d2 - 1e-30f, 1e37f - d2) > 0.0f;
        inverse[i] = detail::select(in_range, detail::inverse_sqrt(d2) * 1.000001f,
                                    std::numeric_limits<float>::infinity());
    }
}

namespace detail {

/// One direction per lane, or the same for all.
struct LaneVectors {
    alignas(32) ClusterBlock::Lanes x[3];
};

/// The largest v.p of each lane, its rounding error, and v.centre.
struct LaneSupport {
    alignas(32) ClusterBlock::Lanes at_centre;
    alignas(32) ClusterBlock::Lanes value;
    alignas(32) ClusterBlock::Lanes noise;
};

inline void support(const LaneVectors& v, const ClusterBlock& b, LaneSupport& s) {
    for (int i = 0; i < ClusterBlock::width; ++i) {
        const float vx = v.x[0][i], vy = v.x[1][i], vz = v.x[2][i];
        const float ax = magnitude(vx), ay = magnitude(vy), az = magnitude(vz);
        const float cx = b.centre[0][i], cy = b.centre[1][i], cz = b.centre[2][i];
        const float hx = b.half[0][i], hy = b.half[1][i], hz = b.half[2][i];
        s.at_centre[i] = vx * cx + vy * cy + vz * cz;
        const float spread = ax * hx + ay * hy + az * hz;
        s.value[i] = s.at_centre[i] + spread;
        // A product of factors that are not zero is not zero, though it may underflow.
        const float most = larger(larger(smaller(ax, magnitude(cx) + hx), smaller(ay, magnitude(cy) + hy)),
                                  smaller(az, magnitude(cz) + hz));
        const bool any = most > 0.0f;
        s.noise[i] = 1e-6f * (ax * magnitude(cx) + ay * magnitude(cy) + az * magnitude(cz) + spread) +
                     select(any, 1e-37f, 0.0f);
    }
}

/// The certificate of `max_power` at `step`: lowers `best`, a bound of (v.p)+ / |p|^K, and moves `step` to where the
/// bound would be exact if the same coordinates stayed clamped.
template <int K>
void certify(const LaneVectors& v, const ClusterBlock& b, ClusterBlock::Lanes& step, ClusterBlock::Lanes& best) {
    constexpr float k = K;
    alignas(32) ClusterBlock::Lanes next, bound;
    for (int i = 0; i < ClusterBlock::width; ++i) {
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
    for (int i = 0; i < ClusterBlock::width; ++i) {
        step[i] = next[i];
        best[i] = bound[i];
    }
}

/// Two certificates from the centre, as `QuickKernel`, for each lane: bounds (v.p)+ / |p|^K. Zero where the support
/// says that nothing lies in front.
template <int K>
void lane_power(const LaneVectors& v, const LaneSupport& s, const ClusterBlock& b, ClusterBlock::Lanes& bound) {
    constexpr float k = K;
    alignas(32) ClusterBlock::Lanes step, best, result;
    for (int i = 0; i < ClusterBlock::width; ++i) {
        const float cx = b.centre[0][i], cy = b.centre[1][i], cz = b.centre[2][i];
        const float rx = magnitude(cx) + b.half[0][i], ry = magnitude(cy) + b.half[1][i],
                    rz = magnitude(cz) + b.half[2][i];
        const float most = s.value[i] + s.noise[i];
        const bool in_front = s.at_centre[i] > 0.0f;
        step[i] = select(in_front, cx * cx + cy * cy + cz * cz, rx * rx + ry * ry + rz * rz) /
                  (k * select(in_front, s.at_centre[i], most));
        const float inverse = b.inverse[i];
        // From the left, since the powers alone would be denormal far away.
        best[i] = K == 1 ? most * inverse : K == 2 ? most * inverse * inverse : most * inverse * inverse * inverse;
    }
    certify<K>(v, b, step, best);
    certify<K>(v, b, step, best);
    for (int i = 0; i < ClusterBlock::width; ++i) {
        constexpr float largest = std::numeric_limits<float>::max(), infinity = std::numeric_limits<float>::infinity();
        const float inverse = b.inverse[i];
        const float slack = 1e-6f * (magnitude(v.x[0][i]) + magnitude(v.x[1][i]) + magnitude(v.x[2][i])) *
                            (K == 1   ? 1.0f
                             : K == 2 ? inverse
                                      : inverse * inverse);
        const float padded = larger(best[i] * 1.00001f + slack, 1e-37f);
        // Comparisons that fail for NaN leave infinity.
        result[i] = select(s.value[i] <= -s.noise[i], 0.0f, select(padded < largest, padded, infinity));
    }
    for (int i = 0; i < ClusterBlock::width; ++i) bound[i] = result[i];
}

inline void broadcast(const glm::vec3& n, LaneVectors& v) {
    for (int i = 0; i < ClusterBlock::width; ++i) {
        v.x[0][i] = n.x;
        v.x[1][i] = n.y;
        v.x[2][i] = n.z;
    }
}

/// Bounds both cosines over the squared distance, (n.p)+ (u.p)+ / |p|^4, for lights of one axis a lane.
inline void lane_joint(const glm::vec3& n, ClusterBlock& b) {
    LaneVectors normals, v, reversed;
    LaneSupport sn, su, sv;
    broadcast(n, normals);
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < ClusterBlock::width; ++i) reversed.x[k][i] = b.axis[k][i];
    }
    support(normals, b, sn);
    support(reversed, b, su);
    alignas(32) ClusterBlock::Lanes lambda;
    for (int i = 0; i < ClusterBlock::width; ++i) {
        const bool centred = smaller(sn.at_centre[i], su.at_centre[i]) > 0.0f;
        const float top = select(centred, su.at_centre[i], su.value[i] + su.noise[i]);
        const float bottom = select(centred, sn.at_centre[i], sn.value[i] + sn.noise[i]);
        const float square = smaller(larger(top / bottom, 0x1p-12f), 0x1p12f);
        lambda[i] = square * inverse_sqrt(square);
        const float mu = 1.000001f / lambda[i];
        v.x[0][i] = 0.5f * (lambda[i] * normals.x[0][i] + mu * reversed.x[0][i]);
        v.x[1][i] = 0.5f * (lambda[i] * normals.x[1][i] + mu * reversed.x[1][i]);
        v.x[2][i] = 0.5f * (lambda[i] * normals.x[2][i] + mu * reversed.x[2][i]);
    }
    support(v, b, sv);
    // v may be seen to be behind only where n or u is.
    for (int i = 0; i < ClusterBlock::width; ++i) {
        sv.noise[i] = larger(sv.noise[i], 1e-37f);
        sv.value[i] = larger(sv.value[i], 0.0f);
    }
    alignas(32) ClusterBlock::Lanes root;
    lane_power<2>(v, sv, b, root);
    for (int i = 0; i < ClusterBlock::width; ++i) {
        const bool behind = smaller(sn.value[i] + sn.noise[i], su.value[i] + su.noise[i]) <= 0.0f;
        // The material sees the direction rounded to float, the emitter as it is: where the material's cosine is mere
        // rounding, its product with the emitter's can exceed that at any one point.
        const float noise = 4e-7f * b.inverse[i] * b.inverse[i];
        b.bound[i] = select(behind, 0.0f, larger(root[i] * root[i] * 1.00001f + noise, 1e-37f));
    }
}

/// Bounds emission relative to the peak, cos(max(0, theta - beta)), for lights within a cone a lane.
inline void lane_emission(const ClusterBlock& b, ClusterBlock::Lanes& emission) {
    LaneVectors reversed;
    LaneSupport s;
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < ClusterBlock::width; ++i) reversed.x[k][i] = b.axis[k][i];
    }
    support(reversed, b, s);
    lane_power<1>(reversed, s, b, emission);
    for (int i = 0; i < ClusterBlock::width; ++i) {
        // A box that holds the receiver has an infinite bound here.
        const float cosine = smaller(emission[i], 1.0f);
        const float sine2 = larger(1.0f - cosine * cosine, 0.0f) + 1e-6f;
        const float wide = cosine * b.cos_cone[i] + sine2 * inverse_sqrt(sine2) * (b.sin_cone[i] + 1e-6f);
        const bool one = b.cos_cone[i] == ClusterBlock::one_direction;
        const float inside = select(cosine >= b.cos_cone[i], 1.0f, smaller(wide * 1.000002f, 1.0f));
        emission[i] = select(one, cosine, larger(inside, 0.0f));
    }
}

/// Bounds cos / |p|^2 about `n`.
inline void lane_inverse_square(const glm::vec3& n, ClusterBlock& b) {
    LaneVectors normals;
    LaneSupport s;
    broadcast(n, normals);
    support(normals, b, s);
    lane_power<3>(normals, s, b, b.bound);
}

/// Bounds the cosine about `n` of unit directions.
inline void lane_directional(const glm::vec3& n, ClusterBlock& b) {
    LaneVectors normals;
    LaneSupport s;
    broadcast(n, normals);
    support(normals, b, s);
    lane_power<1>(normals, s, b, b.bound);
    for (int i = 0; i < ClusterBlock::width; ++i) {
        const float most = larger(s.value[i], 0.0f) + s.noise[i];
        b.bound[i] = smaller(smaller(b.bound[i], most) * 1.000003f, 1.0f);
    }
}

/// Bounds the cosine about `n` times the emission of diffuse emitters over |p|^2: both jointly where a lane's emitters
/// have one axis.
inline void lane_oriented(const glm::vec3& n, ClusterBlock& b) {
    if (b.any_single) lane_joint(n, b);
    if (!b.any_cone) return;
    alignas(32) ClusterBlock::Lanes emission, joint;
    for (int i = 0; i < ClusterBlock::width; ++i) joint[i] = b.bound[i];
    lane_emission(b, emission);
    lane_inverse_square(n, b);
    for (int i = 0; i < ClusterBlock::width; ++i) {
        // 0 x infinity is a certain zero.
        const float product = select(smaller(emission[i], b.bound[i]) > 0.0f, emission[i] * b.bound[i] * 1.000001f,
                                     0.0f);
        b.bound[i] = select(b.cos_cone[i] == ClusterBlock::one_direction, joint[i], product);
    }
}

/// Bounds emission over |p|^2 of diffuse emitters, or 1 / |p|^2 of others, into `geometric`.
template <bool oriented>
void lane_geometric(ClusterBlock& b) {
    if (b.has_geometric) return;
    b.has_geometric = true;
    for (int i = 0; i < ClusterBlock::width; ++i) b.geometric[i] = b.inverse[i] * b.inverse[i] * 1.000002f;
    if constexpr (oriented) {
        alignas(32) ClusterBlock::Lanes joint, emission;
        if (b.any_single) {
            LaneVectors reversed;
            LaneSupport s;
            for (int k = 0; k < 3; ++k) {
                for (int i = 0; i < ClusterBlock::width; ++i) reversed.x[k][i] = b.axis[k][i];
            }
            support(reversed, b, s);
            lane_power<3>(reversed, s, b, joint);
        }
        if (b.any_cone) lane_emission(b, emission);
        for (int i = 0; i < ClusterBlock::width; ++i) {
            if (b.cos_cone[i] == ClusterBlock::one_direction) {
                b.geometric[i] = joint[i];
            } else {
                b.geometric[i] = emission[i] > 0.0f ? emission[i] * b.geometric[i] : 0.0f;
            }
        }
    }
}

}  // namespace detail

}  // namespace lightcuts
