#pragma once

#include <concepts>

#include <glm/vec3.hpp>

#include "../core/cone.hpp"
#include "../core/cone_block.hpp"
#include "../core/cosine.hpp"
#include "../core/joint.hpp"
#include "../core/vectorized.hpp"
#include "geometric.hpp"
#include "view.hpp"

namespace lightcuts::detail {

/// A material sees the direction to a light rounded to float, the emitter as it is: where the material's cosine is mere
/// rounding, its product with the emitter's can exceed the maximum over points by this over the squared distance.
inline constexpr double direction_noise = 8e-7;

/// Adds what rounded directions may, where the joint bound is not certainly zero.
inline double with_direction_noise(double joint, const ClusterView& view) {
    return joint + direction_noise * (view.inverse_distance * view.inverse_distance);
}

/// Bounds both cosines over the squared distance, for one normal and one reversed axis.
inline double joint_cosines_bound(const glm::dvec3& normal, const glm::dvec3& reversed_axis, const ClusterView& view) {
    const double joint = joint_bound(normal, reversed_axis, view.box);
    if (joint == 0.0 && (is_behind(normal, view.box) || is_behind(reversed_axis, view.box))) return 0.0;
    return with_direction_noise(joint, view);
}

/// Bounds both cosines over the squared distance, for normals that fill a cone and emitters whose axes fill another.
inline double joint_cosines_bound(const Cone& normals, const Cone& axes, const ClusterView& view) {
    if (is_single(normals) && is_single(axes)) {
        return joint_cosines_bound(glm::dvec3(normals.axis), -glm::dvec3(axes.axis), view);
    }
    const double joint = joint_bound(normals, negated(axes), view.box);
    return joint > 0.0 ? with_direction_noise(joint, view) : 0.0;
}

/// `joint_cosines_bound` of every lane, of the axes of its two cones alone.
LIGHTCUTS_VECTORIZED inline void joint_cosines_bounds(const ConeBlock& normals, const ConeBlock& reversed_axes,
                                                      const OffsetBlock& b, Lanes& bounds) {
    const LaneVectors& n = normals.axis;
    const LaneVectors& u = reversed_axes.axis;
    const LaneSupport& sn = normals.support;
    const LaneSupport& su = reversed_axes.support;
    LaneVectors v;
    LaneSupport sv;
    for (int i = 0; i < lane_count; ++i) {
        const float cx = b.center(0, i), cy = b.center(1, i), cz = b.center(2, i);
        const float at_n = n.x[0][i] * cx + n.x[1][i] * cy + n.x[2][i] * cz;
        const float at_u = u.x[0][i] * cx + u.x[1][i] * cy + u.x[2][i] * cz;
        const bool is_in_front = smaller(at_n, at_u) > 0.0f;
        const float top = select(is_in_front, at_u, su.value[i] + su.noise[i]);
        const float bottom = select(is_in_front, at_n, sn.value[i] + sn.noise[i]);
        const float square = smaller(larger(top / bottom, 0x1p-12f), 0x1p12f);
        const float lambda = square * inverse_sqrt(square);
        const float mu = 1.000001f / lambda;
        v.x[0][i] = 0.5f * (lambda * n.x[0][i] + mu * u.x[0][i]);
        v.x[1][i] = 0.5f * (lambda * n.x[1][i] + mu * u.x[1][i]);
        v.x[2][i] = 0.5f * (lambda * n.x[2][i] + mu * u.x[2][i]);
    }
    support(v, b, sv);
    // v may be seen to be behind only where n or u is.
    for (int i = 0; i < lane_count; ++i) {
        sv.noise[i] = larger(sv.noise[i], 1e-37f);
        sv.value[i] = larger(sv.value[i], 0.0f);
    }
    alignas(32) Lanes root;
    max_dots_over_distance<2>(v, sv, b, root);
    for (int i = 0; i < lane_count; ++i) {
        const bool behind = smaller(sn.value[i] + sn.noise[i], su.value[i] + su.noise[i]) <= 0.0f;
        const float noise = static_cast<float>(direction_noise) * b.inverse[i] * b.inverse[i];
        bounds[i] = select(behind, 0.0f, larger(root[i] * root[i] * 1.00001f + noise, 1e-37f));
    }
}

/// Upper bound of cosine x emission x attenuation of any light in the cluster, for a diffuse surface with this normal;
/// jointly where that costs no more.
template <Light L>
double cosine_lobe_bound(const glm::vec3& surface_normal, const LightCluster<L>& cluster, const ClusterView& view) {
    const glm::dvec3 normal(surface_normal);
    if constexpr (DirectionalLight<L>) {
        return clamped_max_cosine_of_directions(normal, view.box);
    } else if constexpr (inverse_square<L> && !OrientedLight<L>) {
        return max_dot_over_distance<3>(normal, view.box).value;
    } else if constexpr (inverse_square<L>) {
        if constexpr (cosine_emission<L>) {
            if (is_single(cluster.cone)) { return joint_cosines_bound(normal, -glm::dvec3(cluster.cone.axis), view); }
        }
        const double emission = emission_bound(cluster, view);
        return emission > 0.0 ? emission * max_dot_over_distance<3>(normal, view.box).value : 0.0;
    } else {
        const double cosine = clamped_max_cosine(normal, view.box);
        if (!(cosine > 0.0)) return 0.0;
        const double geometric = geometric_bound(cluster, view);
        return geometric > 0.0 ? cosine * geometric : 0.0;
    }
}

/// Upper bound of cosine x emission x attenuation of any light in the cluster, for diffuse surfaces whose normals fill
/// a cone.
template <Light L>
double cosine_lobe_bound(const Cone& normals, const LightCluster<L>& cluster, const ClusterView& view) {
    if (is_single(normals)) return cosine_lobe_bound(normals.axis, cluster, view);
    const double cosine = widen_cosine(max_cosine(unit_axis(normals), view.box), normals);
    if (!(cosine > 0.0)) return 0.0;
    const double geometric = geometric_bound(cluster, view);
    return geometric > 0.0 ? cosine * geometric : 0.0;
}

/// As `cosine_lobe_bound`, but both cosines of diffuse surfaces and of diffuse emitters are bounded together also where
/// normals or axes differ.
template <class Normal, Light L>
double joint_cosine_lobe_bound(const Normal& normal, const LightCluster<L>& cluster, const ClusterView& view) {
    if constexpr (cosine_emission<L> && inverse_square<L>) {
        if constexpr (std::same_as<Normal, Cone>) {
            return joint_cosines_bound(normal, cluster.cone, view);
        } else {
            return joint_cosines_bound(cone_of(normal), cluster.cone, view);
        }
    } else {
        return cosine_lobe_bound(normal, cluster, view);
    }
}

/// `cosine_lobe_bound` of every lane, of the axis of its cone of normals alone.
template <Light L, class Receivers>
void axis_lobe_bounds(const ConeBlock& normals, const LightCluster<L>* const* clusters, int count,
                      const Receivers& receivers, ClusterBlock<L>& block, Lanes& bounds) {
    if constexpr (DirectionalLight<L>) {
        max_dots_over_distance<1>(normals.axis, normals.support, block, bounds);
        // Directions are unit vectors, so n.p itself bounds the cosine too.
        for (int i = 0; i < lane_count; ++i) {
            const float most = larger(normals.support.value[i], 0.0f) + normals.support.noise[i];
            bounds[i] = smaller(smaller(bounds[i], most) * 1.000003f, 1.0f);
        }
    } else if constexpr (!inverse_square<L>) {
        alignas(32) Lanes geometric;
        geometric_bounds(clusters, count, receivers, block, geometric);
        max_dots_over_distance<1>(normals.axis, normals.support, block, bounds);
        for (int i = 0; i < lane_count; ++i) bounds[i] = smaller(bounds[i], 1.0f);
        multiply(geometric, bounds, bounds);
    } else if constexpr (has_profile<L>) {
        alignas(32) Lanes emission;
        const auto bound = [](const auto& cluster, const auto& view) { return emission_bound(cluster, view); };
        fill_lanes(clusters, count, receivers, bound, emission);
        max_dots_over_distance<3>(normals.axis, normals.support, block, bounds);
        multiply(emission, bounds, bounds);
    } else if constexpr (!OrientedLight<L>) {
        max_dots_over_distance<3>(normals.axis, normals.support, block, bounds);
    } else {
        const ConeBlock& axes = block.reversed_axes;
        alignas(32) Lanes single;
        if (axes.any_single) joint_cosines_bounds(normals, axes, block, single);
        if (!axes.any_wide) {
            for (int i = 0; i < lane_count; ++i) bounds[i] = single[i];
        } else {
            max_dots_over_distance<3>(normals.axis, normals.support, block, bounds);
            multiply(block.cosines_at_lights(), bounds, bounds);
            if (axes.any_single) {
                for (int i = 0; i < lane_count; ++i) bounds[i] = select(axes.is_single(i), single[i], bounds[i]);
            }
        }
    }
}

/// `cosine_lobe_bound` of every lane.
template <Light L, class Receivers>
void cosine_lobe_bounds(const ConeBlock& normals, const LightCluster<L>* const* clusters, int count,
                        const Receivers& receivers, ClusterBlock<L>& block, Lanes& bounds) {
    if (normals.any_single) axis_lobe_bounds(normals, clusters, count, receivers, block, bounds);
    if (!normals.any_wide) return;
    alignas(32) Lanes wide, geometric;
    clamped_max_cosines(normals, block, wide);
    geometric_bounds(clusters, count, receivers, block, geometric);
    multiply(wide, geometric, wide);
    for (int i = 0; i < lane_count; ++i) {
        if (!normals.is_single(i)) bounds[i] = wide[i];
    }
}

}  // namespace lightcuts::detail
