#pragma once

#include <cstddef>
#include <limits>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "../visibility/medium.hpp"
#include "policy.hpp"

namespace lightcuts {

/// Bounds in a medium: those of `Policy` times the least attenuation between receivers and lights [Multidimensional
/// Lightcuts 2006, section 4]. For oracles that attenuate as `ThroughMedium` does. Directional lights count as not
/// attenuated.
template <BoundedMedium M, class Policy = TwoStageBounds>
class AttenuatedBounds {
public:
    static constexpr bool two_stages = Policy::two_stages;

    /// `shadow_offset`: the largest distance of a receiver's `shadow_origin` from its position, on either side.
    /// Refers to the medium.
    AttenuatedBounds(const M& medium, float shadow_offset, const Policy& policy = {})
        : medium_(&medium), shadow_offset_(shadow_offset), policy_(policy) {
        if constexpr (two_stages) tight_band = policy.tight_band;
    }
    /// They would refer to a medium that is gone.
    AttenuatedBounds(const M&&, float, const Policy& = {}) = delete;

    /// See TwoStagePolicy.
    double tight_band = 1.0;

    template <class B, Light L>
    spectrum_of<L> quick(const B& bound, const LightCluster<L>& cluster, const Box& receivers) const {
        return attenuated(policy_.quick(bound, cluster, receivers), cluster, receivers);
    }
    template <class B, Light L>
    void quick_many(const B& bound, const LightCluster<L>* const* clusters, std::size_t count, const Box& receivers,
                    spectrum_of<L>* units) const {
        detail::quick_bounds(policy_, bound, clusters, count, receivers, units);
        for (std::size_t i = 0; i < count; ++i) units[i] = attenuated(units[i], *clusters[i], receivers);
    }
    template <class B, Light L>
    void quick_pairs(const B* const* bounds, const LightCluster<L>* const* clusters, std::size_t count,
                     const Box* const* receivers, spectrum_of<L>* units) const {
        detail::quick_pair_bounds(policy_, bounds, clusters, count, receivers, units);
        for (std::size_t i = 0; i < count; ++i) units[i] = attenuated(units[i], *clusters[i], *receivers[i]);
    }
    template <class B, Light L>
    spectrum_of<L> tight(const B& bound, const LightCluster<L>& cluster, const Box& receivers) const
        requires(Policy::two_stages) {
        return attenuated(policy_.tight(bound, cluster, receivers), cluster, receivers);
    }

private:
    template <Light L>
    spectrum_of<L> attenuated(const spectrum_of<L>& unit, const LightCluster<L>& cluster, const Box& receivers) const {
        if constexpr (DirectionalLight<L>) {
            return unit;
        } else {
            const auto reach = [this](const glm::vec3& corner) { return shadow_offset_ + 1e-6f * glm::abs(corner); };
            const Box origins{receivers.lo - reach(receivers.lo), receivers.hi + reach(receivers.hi)};
            const auto left = static_cast<float>(medium_->upper_bound(origins, cluster.box));
            if (left >= 1.0f) return unit;
            // Zero only where no float is smaller: what is bounded is rounded to float too.
            constexpr float smallest = (std::numeric_limits<float>::min)();
            return detail::scale_bound(unit, static_cast<double>(left > smallest ? left : smallest));
        }
    }

    const M* medium_;
    float shadow_offset_;
    [[no_unique_address]] Policy policy_;
};

}  // namespace lightcuts
