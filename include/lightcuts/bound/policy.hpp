#pragma once

#include <concepts>
#include <cstddef>

#include "../core/box.hpp"
#include "../core/lanes.hpp"
#include "reflection.hpp"

namespace lightcuts {

/// Bounds what any light of a cluster can do at receivers, shadows apart: `quick(bound, cluster, receivers)` is a
/// spectrum no smaller than reflection x geometric term of every light at every receiver in the box `receivers`, per
/// unit intensity. `bound` is a ReflectionBound of their surfaces: for one receiver its material, and the box is that
/// of its position.
template <class P, class B, class C>
concept BoundPolicy = requires(const P& policy, const B& bound, const C& cluster, const Box& receivers) {
    { policy.quick(bound, cluster, receivers) } -> std::convertible_to<typename C::spectrum>;
};

/// A BoundPolicy with a second, tighter and more expensive bound: `tight(bound, cluster, receivers)` has the meaning of
/// `quick`. It is formed only for a cluster that would be split next and whose quick bound is above the threshold by a
/// factor below `tight_band`.
template <class P, class B, class C>
concept TwoStagePolicy = BoundPolicy<P, B, C> && P::two_stages &&
    requires(const P& policy, const B& bound, const C& cluster, const Box& receivers) {
    { policy.tight_band } -> std::convertible_to<double>;
    { policy.tight(bound, cluster, receivers) } -> std::convertible_to<typename C::spectrum>;
};

namespace detail {

/// `policy.quick` of several clusters of one kind: units[i] for *clusters[i]; all at once by `quick_many` if the policy
/// has it.
template <class Policy, class B, Light L>
void quick_bounds(const Policy& policy, const B& bound, const LightCluster<L>* const* clusters, std::size_t count,
                  const Box& receivers, spectrum_of<L>* units) {
    if constexpr (requires { policy.quick_many(bound, clusters, count, receivers, units); }) {
        policy.quick_many(bound, clusters, count, receivers, units);
    } else {
        for (std::size_t i = 0; i < count; ++i) units[i] = policy.quick(bound, *clusters[i], receivers);
    }
}

/// True unless a representative's transfer exceeds a bound of it by more than rounding.
template <Spectrum S>
bool dominates(const S& unit, const S& transfer) {
    for (int c = 0; c < channels_of<S>; ++c) {
        if (channel(transfer, c) > 1.0001f * channel(unit, c)) return false;
    }
    return true;
}

/// `policy.quick` of several pairs of a cluster of one kind and a box of receivers: units[i] for *clusters[i] at the
/// receivers in *receivers[i], whose surfaces *bounds[i] bounds; all at once by `quick_pairs` if the policy has it.
template <class Policy, class B, Light L>
void quick_pair_bounds(const Policy& policy, const B* const* bounds, const LightCluster<L>* const* clusters,
                       std::size_t count, const Box* const* receivers, spectrum_of<L>* units) {
    if constexpr (requires { policy.quick_pairs(bounds, clusters, count, receivers, units); }) {
        policy.quick_pairs(bounds, clusters, count, receivers, units);
    } else {
        for (std::size_t i = 0; i < count; ++i) units[i] = policy.quick(*bounds[i], *clusters[i], *receivers[i]);
    }
}

}  // namespace detail

/// Every factor bounded by itself, in one stage.
struct SeparateBounds {
    static constexpr bool two_stages = false;

    template <class B, Light L>
    spectrum_of<L> quick(const B& bound, const LightCluster<L>& cluster, const Box& receivers) const {
        return reflection_bound(bound, cluster, receivers);
    }
};

/// The default: a bound without iteration, for several clusters at once, and, if asked for, the nearly exact, joint one
/// for a cluster that is about to be split.
struct TwoStageBounds {
    static constexpr bool two_stages = true;
    /// Clusters whose quick bound is above the threshold by less than this factor get the tight one before they are
    /// split. 1: none, the fastest where a shadow ray costs less than a microsecond; 1.5 pays for expensive oracles.
    double tight_band = 1.0;

    template <class B, Light L>
    spectrum_of<L> quick(const B& bound, const LightCluster<L>& cluster, const Box& receivers) const {
        const LightCluster<L>* const one = &cluster;
        spectrum_of<L> unit;
        reflection_bounds(bound, &one, 1, receivers, &unit);
        return unit;
    }

    /// `quick` of several clusters of one kind at the same receivers: units[i] for *clusters[i].
    template <class B, Light L>
    void quick_many(const B& bound, const LightCluster<L>* const* clusters, std::size_t count, const Box& receivers,
                    spectrum_of<L>* units) const {
        for (std::size_t begin = 0; begin < count; begin += std::size_t{lane_count}) {
            const std::size_t lanes = count - begin < std::size_t{lane_count} ? count - begin : std::size_t{lane_count};
            reflection_bounds(bound, clusters + begin, static_cast<int>(lanes), receivers, units + begin);
        }
    }

    /// `quick` of several pairs of a cluster of one kind and a box of receivers: units[i] for *clusters[i] at the
    /// receivers in *receivers[i], whose surfaces *bounds[i] bounds.
    template <class B, Light L>
    void quick_pairs(const B* const* bounds, const LightCluster<L>* const* clusters, std::size_t count,
                     const Box* const* receivers, spectrum_of<L>* units) const {
        for (std::size_t begin = 0; begin < count; begin += std::size_t{lane_count}) {
            const std::size_t lanes = count - begin < std::size_t{lane_count} ? count - begin : std::size_t{lane_count};
            reflection_bounds(bounds + begin, clusters + begin, static_cast<int>(lanes), receivers + begin,
                              units + begin);
        }
    }

    template <class B, Light L>
    spectrum_of<L> tight(const B& bound, const LightCluster<L>& cluster, const Box& receivers) const {
        return joint_reflection_bound(bound, cluster, receivers);
    }
};

}  // namespace lightcuts
