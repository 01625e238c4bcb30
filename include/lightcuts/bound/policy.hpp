#pragma once

#include <concepts>
#include <cstddef>
#include <limits>

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

/// A policy with a dearer second opinion, `tight(...)`, with the arguments and result of `quick`: asked for before a
/// cluster is split whose bound is above the threshold by a factor below `doubt`.
template <class P>
concept TwoStagePolicy = P::two_stages && requires(const P& policy) {
    { policy.doubt } -> std::convertible_to<double>;
};

namespace detail {

/// `policy.quick` of several clusters of one kind: units[i] for *clusters[i]; all at once by `quick_many` if the policy
/// has it.
template <class Policy, class M, Light L>
void quick_bounds(const Policy& policy, const M& material, const glm::vec3& point,
                  const LightCluster<L>* const* clusters, std::size_t count, material_spectrum<M>* units) {
    if constexpr (requires { policy.quick_many(material, point, clusters, count, units); }) {
        policy.quick_many(material, point, clusters, count, units);
    } else {
        for (std::size_t i = 0; i < count; ++i) units[i] = policy.quick(material, *clusters[i], point);
    }
}

/// `multiply_bounds` where a product may be no number.
template <Spectrum S>
[[gnu::noinline]] constexpr S multiply_infinite_bounds(const S& a, const S& b) {
    return make_spectrum<S>([&](int c) {
        const float x = channel(a, c), y = channel(b, c);
        return x > 0.0f && y > 0.0f ? x * y : 0.0f;
    });
}

/// Channel-wise product of two bounds, where 0 x infinity = 0.
template <Spectrum S>
constexpr S multiply_bounds(const S& a, const S& b) {
    const S product = a * b;
    const float sum = rough_sum(product);
    if (sum == sum) [[likely]]
        return product;
    return multiply_infinite_bounds(a, b);
}

/// `scale_bound` by a factor that float cannot hold.
template <Spectrum S>
[[gnu::noinline]] constexpr S scale_infinite_bound(const S& s, float factor) {
    return make_spectrum<S>([&](int c) { return channel(s, c) > 0.0f ? channel(s, c) * factor : 0.0f; });
}

/// spectrum x bound, where 0 x infinity = 0.
template <Spectrum S>
constexpr S scale_bound(const S& s, float bound) {
    // Covers rounding to float here and in products with it, and axes of nearly unit length.
    constexpr float slack = 1.0f + 1.2e-5f;
    const float factor = bound * slack;
    if (factor <= (std::numeric_limits<float>::max)()) [[likely]]
        return s * factor;
    return scale_infinite_bound(s, factor);
}
template <Spectrum S>
constexpr S scale_bound(const S& s, double bound) {
    return scale_bound(s, round_up(bound));
}

/// A joint bound for what is evaluated: the material sees the direction rounded to float, the emitter as it is. Where
/// the material's cosine is mere rounding, its product with the emitter's can exceed that at any one point.
inline double with_direction_noise(double joint, const glm::dvec3& n, const glm::dvec3& u, const ClusterView& view) {
    if (joint == 0.0 && (is_behind(n, view.box) || is_behind(u, view.box))) return 0.0;
    return joint + 8e-7 * (view.inverse_distance * view.inverse_distance);
}

/// The joint bound of a receiver's cosine and those of emitters whose axes fill `cone`.
inline double joint_cone_bound(const glm::dvec3& n, const Cone& cone, const ClusterView& view) {
    const double joint = joint_bound(n, negated(cone), view.box);
    if (!is_single(cone) && joint == 0.0) return 0.0;
    return with_direction_noise(joint, n, -glm::dvec3(cone.axis), view);
}

/// Bounds cosine x geometric term, for the lobe of a diffuse surface with normal `n`.
template <Light L>
double cosine_lobe_bound(const glm::dvec3& n, const LightCluster<L>& cluster, const ClusterView& view) {
    if constexpr (DirectionalLight<L>) {
        return clamped_max_cosine_of_directions(n, view.box);
    } else if constexpr (inverse_square<L> && !OrientedLight<L>) {
        return max_power<3>(n, view.box).value;
    } else if constexpr (inverse_square<L>) {
        if constexpr (cosine_emission<L>) {
            if (is_single(cluster.cone)) {
                const glm::dvec3 u = -glm::dvec3(cluster.cone.axis);
                return with_direction_noise(joint_bound(n, u, view.box), n, u, view);
            }
        }
        const double emission = emission_bound(cluster, view);
        return emission > 0.0 ? emission * max_power<3>(n, view.box).value : 0.0;
    } else {
        const double cosine = clamped_max_cosine(n, view.box);
        if (!(cosine > 0.0)) return 0.0;
        const double geometric = geometric_bound(cluster, view);
        return geometric > 0.0 ? cosine * geometric : 0.0;
    }
}

/// Says what a material lacks to be bounded.
template <class M>
constexpr void require_bound() {
    static_assert(
        BoundedMaterial<M> || CompositeMaterial<M> || CosineLobeMaterial<M>,
        "a material needs upper_bound(offsets) const, which returns the spectrum that evaluate(to_light) does; "
        "or a stated cap: Capped{material, cap}");
}

/// The product of the factors' bounds.
template <class M, Light L>
material_spectrum<M> material_bound(const M& material, const LightCluster<L>& cluster, const ClusterView& view) {
    require_bound<M>();
    using S = material_spectrum<M>;
    if constexpr (CompositeMaterial<M>) {
        S sum = black<S>();
        material.for_each_component([&](const auto& part) { sum = sum + material_bound(part, cluster, view); });
        return sum;
    } else if constexpr (CosineLobeMaterial<M>) {
        const auto lobe = material.cosine_lobe();
        return scale_bound(S(lobe.scale), cosine_lobe_bound(glm::dvec3(lobe.normal), cluster, view));
    } else if constexpr (BoundedMaterial<M>) {
        const double geometric = geometric_bound(cluster, view);
        if (!(geometric > 0.0)) return black<S>();
        return scale_bound(S(material.upper_bound(view.box)), geometric);
    }
}

/// Adds the bounds of up to `lane_count` clusters of one kind to `units`.
template <class M, Light L>
void add_block_bound(const M& material, const LightCluster<L>* const* clusters, int count, const glm::vec3& point,
                     ClusterBlock& block, material_spectrum<M>* units) {
    require_bound<M>();
    using S = material_spectrum<M>;
    if constexpr (CompositeMaterial<M>) {
        material.for_each_component(
            [&](const auto& part) { add_block_bound(part, clusters, count, point, block, units); });
    } else if constexpr (CosineLobeMaterial<M>) {
        alignas(32) Lanes bound;
        const auto lobe = material.cosine_lobe();
        lane_cosine_lobe(lobe.normal, clusters, count, point, block, bound);
        for (int i = 0; i < count; ++i) units[i] = units[i] + scale_bound(S(lobe.scale), bound[i]);
    } else if constexpr (BoundedMaterial<M>) {
        alignas(32) Lanes geometric;
        lane_geometric(clusters, count, point, block, geometric);
        if constexpr (QuicklyBoundedMaterial<M>) {
            LaneSpectra<S> reflected;
            material.quick_upper_bounds(block, reflected);
            for (int i = 0; i < count; ++i) {
                if (!(geometric[i] > 0.0f)) continue;
                units[i] = units[i] + scale_bound(reflected[static_cast<std::size_t>(i)], geometric[i]);
            }
        } else {
            for (int i = 0; i < count; ++i) {
                if (!(geometric[i] > 0.0f)) continue;
                const OffsetBox box = view_of(*clusters[i], point).box;
                units[i] = units[i] + scale_bound(S(material.upper_bound(box)), geometric[i]);
            }
        }
    }
}

/// Bounds of up to `lane_count` clusters of one kind, without iteration, in vector code.
template <class M, Light L>
void block_bound(const M& material, const LightCluster<L>* const* clusters, int count, const glm::vec3& point,
                 material_spectrum<M>* units) {
    ClusterBlock block(clusters, count, point);
    for (int i = 0; i < count; ++i) units[i] = black<material_spectrum<M>>();
    add_block_bound(material, clusters, count, point, block, units);
}

/// As `material_bound`, but both cosines of a diffuse surface and of diffuse emitters are bounded together also where
/// the emitters' axes differ.
template <class M, Light L>
material_spectrum<M> joint_material_bound(const M& material, const LightCluster<L>& cluster, const ClusterView& view) {
    using S = material_spectrum<M>;
    if constexpr (CompositeMaterial<M>) {
        S sum = black<S>();
        material.for_each_component([&](const auto& part) { sum = sum + joint_material_bound(part, cluster, view); });
        return sum;
    } else if constexpr (CosineLobeMaterial<M> && cosine_emission<L> && inverse_square<L>) {
        const auto lobe = material.cosine_lobe();
        return scale_bound(S(lobe.scale), joint_cone_bound(glm::dvec3(lobe.normal), cluster.cone, view));
    } else {
        return material_bound(material, cluster, view);
    }
}

}  // namespace detail

/// Every factor bounded by itself, in one stage.
struct SeparateBounds {
    static constexpr bool two_stages = false;

    template <class M, Light L>
    material_spectrum<M> quick(const M& material, const LightCluster<L>& cluster, const glm::vec3& point) const {
        return detail::material_bound(material, cluster, view_of(cluster, point));
    }
};

/// The default: a bound without iteration, for several clusters at once, and, if asked for, the nearly exact, joint one
/// for a cluster that is about to be split.
struct TwoStageBounds {
    static constexpr bool two_stages = true;
    /// Clusters whose quick bound is above the threshold by less than this factor get the tight one before they are
    /// split. 1: none, the fastest where a shadow ray costs less than a microsecond; 1.5 pays for dear oracles.
    double doubt = 1.0;

    template <class M, Light L>
    material_spectrum<M> quick(const M& material, const LightCluster<L>& cluster, const glm::vec3& point) const {
        const LightCluster<L>* const one = &cluster;
        material_spectrum<M> unit;
        detail::block_bound(material, &one, 1, point, &unit);
        return unit;
    }

    /// `quick` of several clusters of one kind: units[i] for *clusters[i].
    template <class M, Light L>
    void quick_many(const M& material, const glm::vec3& point, const LightCluster<L>* const* clusters,
                    std::size_t count, material_spectrum<M>* units) const {
        for (std::size_t begin = 0; begin < count; begin += std::size_t{lane_count}) {
            const std::size_t lanes = count - begin < std::size_t{lane_count} ? count - begin : std::size_t{lane_count};
            detail::block_bound(material, clusters + begin, static_cast<int>(lanes), point, units + begin);
        }
    }

    template <class M, Light L>
    material_spectrum<M> tight(const M& material, const LightCluster<L>& cluster, const glm::vec3& point) const {
        return detail::joint_material_bound(material, cluster, view_of(cluster, point));
    }
};

}  // namespace lightcuts
