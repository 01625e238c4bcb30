#pragma once

#include <concepts>

#include "../core/joint.hpp"
#include "../material/material.hpp"
#include "block.hpp"
#include "geometric.hpp"

namespace lightcuts {

/// Bounds what any light of a cluster can do at a receiver, shadows apart: `quick(material, cluster, point)` is a
/// spectrum no smaller than material term x geometric term of every light, per unit intensity.
template <class P, class M, class C>
concept BoundPolicy = requires(const P& policy, const M& material, const C& cluster, const glm::vec3& point) {
    { policy.quick(material, cluster, point) } -> std::convertible_to<material_spectrum<M>>;
};

/// A policy with a dearer second opinion, `tight(...)`, asked for before a cluster is split.
template <class P>
concept TwoStagePolicy = P::two_stages;

namespace detail {

/// Channel-wise product of two bounds, where 0 x infinity = 0.
template <Spectrum S>
constexpr S multiply_bounds(const S& a, const S& b) {
    const S product = a * b;
    const double sum = channel_sum(product);
    if (sum == sum) return product;
    return make_spectrum<S>([&](int c) {
        const float x = channel(a, c), y = channel(b, c);
        return x > 0.0f && y > 0.0f ? x * y : 0.0f;
    });
}

/// spectrum x bound, where 0 x infinity = 0.
template <Spectrum S>
constexpr S scale_bound(const S& s, float bound) {
    // Covers rounding to float here and in products with it, and axes of nearly unit length.
    constexpr float slack = 1.0f + 1.2e-5f;
    const float factor = bound * slack;
    if (factor <= std::numeric_limits<float>::max()) return s * factor;
    return make_spectrum<S>([&](int c) { return channel(s, c) > 0.0f ? channel(s, c) * factor : 0.0f; });
}
template <Spectrum S>
constexpr S scale_bound(const S& s, double bound) {
    return scale_bound(s, round_up(bound));
}

/// A joint bound for what is evaluated: the material sees the direction rounded to float, the emitter as it is. Where
/// the material's cosine is mere rounding, its product with the emitter's can exceed that at any one point.
inline double with_direction_noise(double joint, const glm::dvec3& n, const glm::dvec3& u, const ClusterView& view) {
    if (joint == 0.0 && (is_behind(n, view.box) || is_behind(u, view.box))) return 0.0;
    return joint + 4e-7 * (view.inverse_distance * view.inverse_distance);
}

/// The joint bound of a receiver's cosine and those of emitters whose axes fill `cone`.
inline double joint_cone_bound(const glm::dvec3& n, const Cone& cone, const ClusterView& view) {
    const double joint = joint_bound(n, negated(cone), view.box);
    if (!is_single(cone) && joint == 0.0) return 0.0;
    return with_direction_noise(joint, n, -glm::dvec3(cone.axis), view);
}

/// Bounds cosine x geometric term, for the lobe of a diffuse surface with normal `n`.
template <class Kernel, Light L>
double cosine_lobe_bound(const glm::dvec3& n, const LightCluster<L>& cluster, const ClusterView& view) {
    if constexpr (DirectionalLight<L>) {
        return directional_cosine<Kernel>(n, view);
    } else if constexpr (inverse_square<L> && !OrientedLight<L>) {
        return Kernel::template power<3>(n, view);
    } else if constexpr (inverse_square<L>) {
        if constexpr (cosine_emission<L>) {
            if (is_single(cluster.cone)) {
                const glm::dvec3 u = -glm::dvec3(cluster.cone.axis);
                return with_direction_noise(Kernel::joint(n, u, view), n, u, view);
            }
        }
        const double emission = emission_bound<Kernel>(cluster, view);
        return emission > 0.0 ? emission * Kernel::template power<3>(n, view) : 0.0;
    } else {
        const double cosine = front_cosine<Kernel>(n, view);
        if (!(cosine > 0.0)) return 0.0;
        const double geometric = geometric_bound<Kernel>(cluster, view);
        return geometric > 0.0 ? cosine * geometric : 0.0;
    }
}

/// The product of the factors' bounds.
template <class Kernel, class M, Light L>
material_spectrum<M> material_bound(const M& material, const LightCluster<L>& cluster, const ClusterView& view) {
    static_assert(
        BoundedMaterial<M> || CompositeMaterial<M> || CosineLobeMaterial<M>,
        "a material needs upper_bound(offsets) const, which returns the spectrum that evaluate(to_light) does; "
        "or a stated cap: Capped{material, cap}");
    using S = material_spectrum<M>;
    if constexpr (CompositeMaterial<M>) {
        S sum{};
        material.for_each_component([&](const auto& part) { sum = sum + material_bound<Kernel>(part, cluster, view); });
        return sum;
    } else if constexpr (CosineLobeMaterial<M>) {
        const auto lobe = material.cosine_lobe();
        return scale_bound(S(lobe.scale), cosine_lobe_bound<Kernel>(glm::dvec3(lobe.normal), cluster, view));
    } else if constexpr (BoundedMaterial<M>) {
        const double geometric = geometric_bound<Kernel>(cluster, view);
        if (!(geometric > 0.0)) return S{};
        if constexpr (std::same_as<Kernel, QuickKernel>) {
            return scale_bound(S(cheapest_upper_bound(material, view.box)), geometric);
        } else {
            return scale_bound(S(material.upper_bound(view.box)), geometric);
        }
    }
}

/// True if ClusterBlock has vector code for lights of kind `L`.
template <Light L>
inline constexpr bool has_lanes = DirectionalLight<L> ||
                                  (inverse_square<L> && (!OrientedLight<L> || cosine_emission<L>));

/// The box that a material is asked about.
template <Light L>
OffsetBox material_box(const LightCluster<L>& cluster, const glm::vec3& point) {
    const glm::dvec3 origin = DirectionalLight<L> ? glm::dvec3(0.0) : glm::dvec3(point);
    return {glm::dvec3(cluster.box.lo) - origin, glm::dvec3(cluster.box.hi) - origin};
}

/// Adds `material_bound<QuickKernel>` of up to ClusterBlock::width clusters to `units`, in vector code where the kinds
/// of material and light allow it.
template <class M, Light L>
void add_block_bound(const M& material, const LightCluster<L>* const* clusters, int count, const glm::vec3& point,
                     ClusterBlock& block, material_spectrum<M>* units) {
    using S = material_spectrum<M>;
    if constexpr (CompositeMaterial<M>) {
        material.for_each_component(
            [&](const auto& part) { add_block_bound(part, clusters, count, point, block, units); });
    } else if constexpr (!has_lanes<L>) {
        for (int i = 0; i < count; ++i) {
            units[i] = units[i] + material_bound<QuickKernel>(material, *clusters[i], view_of(*clusters[i], point));
        }
    } else if constexpr (CosineLobeMaterial<M>) {
        const auto lobe = material.cosine_lobe();
        if constexpr (DirectionalLight<L>) {
            lane_directional(lobe.normal, block);
        } else if constexpr (!OrientedLight<L>) {
            lane_inverse_square(lobe.normal, block);
        } else {
            lane_oriented(lobe.normal, block);
        }
        for (int i = 0; i < count; ++i) units[i] = units[i] + scale_bound(S(lobe.scale), block.bound[i]);
    } else {
        if constexpr (PointLight<L>) lane_geometric<OrientedLight<L>>(block);
        for (int i = 0; i < count; ++i) {
            const float geometric = DirectionalLight<L> ? 1.0f : block.geometric[i];
            if (!(geometric > 0.0f)) continue;
            const S reflected = cheapest_upper_bound(material, material_box(*clusters[i], point));
            units[i] = units[i] + scale_bound(reflected, geometric);
        }
    }
}

template <class M, Light L>
void block_bound(const M& material, const LightCluster<L>* const* clusters, int count, const glm::vec3& point,
                 material_spectrum<M>* units) {
    ClusterBlock block;
    if constexpr (has_lanes<L>) {
        for (int i = 0; i < count; ++i) block.set(i, *clusters[i], point);
        block.finish(count);
    }
    for (int i = 0; i < count; ++i) units[i] = {};
    add_block_bound(material, clusters, count, point, block, units);
}

/// As `material_bound`, but both cosines of a diffuse surface and of diffuse emitters are bounded together also where
/// the emitters' axes differ.
template <class M, Light L>
material_spectrum<M> joint_material_bound(const M& material, const LightCluster<L>& cluster, const ClusterView& view) {
    using S = material_spectrum<M>;
    if constexpr (CompositeMaterial<M>) {
        S sum{};
        material.for_each_component([&](const auto& part) { sum = sum + joint_material_bound(part, cluster, view); });
        return sum;
    } else if constexpr (CosineLobeMaterial<M> && cosine_emission<L> && inverse_square<L>) {
        const auto lobe = material.cosine_lobe();
        return scale_bound(S(lobe.scale), joint_cone_bound(glm::dvec3(lobe.normal), cluster.cone, view));
    } else {
        return material_bound<ExactKernel>(material, cluster, view);
    }
}

}  // namespace detail

/// Every factor bounded by itself, in one stage.
struct SeparateBounds {
    static constexpr bool two_stages = false;

    template <class M, Light L>
    material_spectrum<M> quick(const M& material, const LightCluster<L>& cluster, const glm::vec3& point) const {
        return detail::material_bound<ExactKernel>(material, cluster, view_of(cluster, point));
    }
};

/// The default: a bound without iteration for every cluster, and the nearly exact, joint one for a cluster that is
/// about to be split.
struct TwoStageBounds {
    static constexpr bool two_stages = true;
    /// Clusters whose quick bound is above the threshold by less than this factor get the tight one before they are
    /// split. 1: none, the fastest where a shadow ray costs less than a microsecond; 1.5 pays for dear oracles.
    double doubt = 1.0;

    template <class M, Light L>
    material_spectrum<M> quick(const M& material, const LightCluster<L>& cluster, const glm::vec3& point) const {
        return detail::material_bound<QuickKernel>(material, cluster, view_of(cluster, point));
    }

    /// `quick` of several clusters of one kind: units[i] for *clusters[i].
    template <class M, Light L>
    void quick_many(const M& material, const glm::vec3& point, const LightCluster<L>* const* clusters,
                    std::size_t count, material_spectrum<M>* units) const {
        for (std::size_t begin = 0; begin < count; begin += ClusterBlock::width) {
            const std::size_t lanes = count - begin < ClusterBlock::width ? count - begin : ClusterBlock::width;
            detail::block_bound(material, clusters + begin, static_cast<int>(lanes), point, units + begin);
        }
    }

    template <class M, Light L>
    material_spectrum<M> tight(const M& material, const LightCluster<L>& cluster, const glm::vec3& point) const {
        return detail::joint_material_bound(material, cluster, view_of(cluster, point));
    }
};

}  // namespace lightcuts
