#pragma once

#include <glm/vec3.hpp>

#include "../core/cone.hpp"
#include "../core/offset_block.hpp"
#include "../light/light.hpp"
#include "../tree/light_cluster.hpp"
#include "geometric.hpp"

namespace lightcuts {

/// Several clusters of one kind of light as a receiver sees them, side by side.
struct ClusterBlock : OffsetBlock {
    static constexpr float one_direction = 2.0f;  ///< no cosine

    LaneVectors axis;            ///< reversed axis of the emission cone
    alignas(32) Lanes cos_cone;  ///< `one_direction` for a cone of one
    alignas(32) Lanes sin_cone;
    detail::LaneSupport axis_support;
    alignas(32) Lanes emission;  ///< bound relative to the peak, once `lane_emission` was called
    bool has_emission = false;
    bool any_cone = false;    ///< some emission cone is wider than one direction
    bool any_single = false;  ///< some is one direction

    /// pre: 0 < count <= lane_count
    template <Light L>
    ClusterBlock(const LightCluster<L>* const* clusters, int count, const glm::vec3& point) {
        const glm::vec3 origin = DirectionalLight<L> ? glm::vec3(0.0f) : point;
        for (int i = 0; i < count; ++i) {
            set(i, clusters[i]->box.lo - origin, clusters[i]->box.hi - origin);
            if constexpr (LightCluster<L>::oriented) set_cone(i, clusters[i]->cone);
        }
        finish(count);
        if constexpr (LightCluster<L>::oriented) {
            detail::repeat_last(axis, count);
            detail::repeat_last(cos_cone, count);
            detail::repeat_last(sin_cone, count);
            detail::support(axis, *this, axis_support);
        }
    }

private:
    void set_cone(int lane, const Cone& cone) {
        axis.set(lane, -cone.axis);
        const bool single = is_single(cone);
        any_single = any_single || single;
        any_cone = any_cone || !single;
        cos_cone[lane] = single ? one_direction : static_cast<float>(cos_half_angle(cone));
        sin_cone[lane] = single ? 0.0f : static_cast<float>(sin_half_angle(cone));
    }
};

namespace detail {

/// a x b, where 0 x infinity is a certain zero.
inline void multiply(const Lanes& a, const Lanes& b, Lanes& product) {
    for (int i = 0; i < lane_count; ++i) {
        product[i] = select(smaller(a[i], b[i]) > 0.0f, larger(a[i] * b[i] * 1.000001f, 1e-37f), 0.0f);
    }
}

/// Bounds both cosines over the squared distance, (n.p)+ (u.p)+ / |p|^4, for lights of one axis a lane.
inline void lane_joint(const glm::vec3& n, const ClusterBlock& b, Lanes& bound) {
    LaneVectors normals, v;
    LaneSupport sn, sv;
    broadcast(n, normals);
    support(n, b, sn);
    const LaneSupport& su = b.axis_support;
    alignas(32) Lanes lambda;
    for (int i = 0; i < lane_count; ++i) {
        const float cx = b.centre[0][i], cy = b.centre[1][i], cz = b.centre[2][i];
        const float at_n = n.x * cx + n.y * cy + n.z * cz;
        const float at_u = b.axis.x[0][i] * cx + b.axis.x[1][i] * cy + b.axis.x[2][i] * cz;
        const bool centred = smaller(at_n, at_u) > 0.0f;
        const float top = select(centred, at_u, su.value[i] + su.noise[i]);
        const float bottom = select(centred, at_n, sn.value[i] + sn.noise[i]);
        const float square = smaller(larger(top / bottom, 0x1p-12f), 0x1p12f);
        lambda[i] = square * inverse_sqrt(square);
        const float mu = 1.000001f / lambda[i];
        v.x[0][i] = 0.5f * (lambda[i] * normals.x[0][i] + mu * b.axis.x[0][i]);
        v.x[1][i] = 0.5f * (lambda[i] * normals.x[1][i] + mu * b.axis.x[1][i]);
        v.x[2][i] = 0.5f * (lambda[i] * normals.x[2][i] + mu * b.axis.x[2][i]);
    }
    support(v, b, sv);
    // v may be seen to be behind only where n or u is.
    for (int i = 0; i < lane_count; ++i) {
        sv.noise[i] = larger(sv.noise[i], 1e-37f);
        sv.value[i] = larger(sv.value[i], 0.0f);
    }
    alignas(32) Lanes root;
    lane_power<2>(v, sv, b, root);
    for (int i = 0; i < lane_count; ++i) {
        const bool behind = smaller(sn.value[i] + sn.noise[i], su.value[i] + su.noise[i]) <= 0.0f;
        // The material sees the direction rounded to float, the emitter as it is: where the material's cosine is mere
        // rounding, its product with the emitter's can exceed that at any one point.
        const float noise = 8e-7f * b.inverse[i] * b.inverse[i];
        bound[i] = select(behind, 0.0f, larger(root[i] * root[i] * 1.00001f + noise, 1e-37f));
    }
}

/// Bounds emission relative to the peak, cos(max(0, theta - beta)), for lights within a cone a lane.
inline void lane_emission(ClusterBlock& b) {
    if (b.has_emission) return;
    b.has_emission = true;
    const LaneSupport& s = b.axis_support;
    // For one direction the largest numerator over the least distance, whatever stands in other lanes. Materials with a
    // cosine lobe use the tighter joint bound instead.
    for (int i = 0; i < lane_count; ++i) {
        const float most = larger(s.value[i] + s.noise[i], 0.0f) * b.inverse[i];
        b.emission[i] = select(s.value[i] <= -s.noise[i], 0.0f, smaller(larger(most * 1.00001f, 1e-37f), 1.0f));
    }
    if (!b.any_cone) return;
    alignas(32) Lanes front;
    lane_power<1>(b.axis, s, b, front);
    for (int i = 0; i < lane_count; ++i) {
        // Where all lies behind the axis the cosine is negative, and the largest is that of a far point.
        const float farthest2 = b.farthest2[i];
        const float most = s.value[i] + s.noise[i];
        const bool is_behind = larger(most, larger(farthest2 - 1e37f, 1e-30f - farthest2)) < 0.0f;
        // A box that holds the receiver has an infinite bound here.
        const float cosine = select(is_behind, larger(smaller(most, 0.0f) * inverse_sqrt(farthest2), -1.0f),
                                    smaller(front[i], 1.0f));
        const float sine2 = larger(1.0f - cosine * cosine, 0.0f) + 1e-6f;
        const float wide = cosine * b.cos_cone[i] + sine2 * inverse_sqrt(sine2) * (b.sin_cone[i] + 1e-6f);
        const bool one = b.cos_cone[i] == ClusterBlock::one_direction;
        const float inside = select(cosine >= b.cos_cone[i], 1.0f, smaller(wide * 1.000002f, 1.0f));
        b.emission[i] = select(one, b.emission[i], larger(inside, 0.0f));
    }
}

/// Bounds (v.p)+ / |p|^K about one `n`.
template <int K>
void lane_power(const glm::vec3& n, const ClusterBlock& b, Lanes& bound) {
    LaneVectors normals;
    LaneSupport s;
    broadcast(n, normals);
    support(n, b, s);
    lane_power<K>(normals, s, b, bound);
    if constexpr (K == 1) {
        for (int i = 0; i < lane_count; ++i) bound[i] = smaller(bound[i], 1.0f);
    }
}

/// Sets values[i] to `f(i)`, for functions that can only be called one by one.
template <class F>
void fill_lanes(int count, F&& f, Lanes& values) {
    for (int i = 0; i < count; ++i) values[i] = round_up(f(i));
    repeat_last(values, count);
}

/// Bounds emission x attenuation: the geometric term [Lightcuts 2005, Eq. 3].
template <Light L>
void lane_geometric(const LightCluster<L>* const* clusters, int count, const glm::vec3& point, ClusterBlock& b,
                    Lanes& geometric) {
    if constexpr (DirectionalLight<L>) {
        for (int i = 0; i < lane_count; ++i) geometric[i] = 1.0f;
    } else if constexpr (has_profile<L>) {
        fill_lanes(
            count, [&](int i) { return geometric_bound(*clusters[i], view_of(*clusters[i], point)); }, geometric);
    } else {
        for (int i = 0; i < lane_count; ++i) geometric[i] = b.inverse[i] * b.inverse[i] * 1.000002f;
        if constexpr (OrientedLight<L>) {
            lane_emission(b);
            multiply(b.emission, geometric, geometric);
        }
    }
}

/// Bounds the cosine about `n` x emission x attenuation, jointly where the kind of light allows it.
template <Light L>
void lane_cosine_lobe(const glm::vec3& n, const LightCluster<L>* const* clusters, int count, const glm::vec3& point,
                      ClusterBlock& b, Lanes& bound) {
    if constexpr (DirectionalLight<L>) {
        LaneVectors normals;
        LaneSupport s;
        broadcast(n, normals);
        support(n, b, s);
        lane_power<1>(normals, s, b, bound);
        // Directions are unit vectors, so n.p itself bounds the cosine too.
        for (int i = 0; i < lane_count; ++i) {
            const float most = larger(s.value[i], 0.0f) + s.noise[i];
            bound[i] = smaller(smaller(bound[i], most) * 1.000003f, 1.0f);
        }
    } else if constexpr (!inverse_square<L>) {
        alignas(32) Lanes geometric;
        lane_geometric(clusters, count, point, b, geometric);
        lane_power<1>(n, b, bound);
        multiply(geometric, bound, bound);
    } else if constexpr (has_profile<L>) {
        alignas(32) Lanes emission;
        fill_lanes(
            count, [&](int i) { return emission_bound(*clusters[i], view_of(*clusters[i], point)); }, emission);
        lane_power<3>(n, b, bound);
        multiply(emission, bound, bound);
    } else if constexpr (!OrientedLight<L>) {
        lane_power<3>(n, b, bound);
    } else {
        alignas(32) Lanes cone, single;
        if (b.any_single) lane_joint(n, b, single);
        if (b.any_cone) {
            lane_emission(b);
            lane_power<3>(n, b, cone);
            multiply(b.emission, cone, cone);
        }
        for (int i = 0; i < lane_count; ++i) {
            bound[i] = b.cos_cone[i] == ClusterBlock::one_direction ? single[i] : cone[i];
        }
    }
}

}  // namespace detail

}  // namespace lightcuts
