#pragma once

#include <concepts>

#include <glm/vec3.hpp>

#include "above_horizon.hpp"
#include "material.hpp"

namespace lightcuts {

/// A thin sheet that passes light on from behind: leaf, paper, lampshade. `reflection` answers for lights on the side
/// of the viewer and `transmission` for those behind the surface, each as `AboveHorizon` has it, so that neither leaks
/// into the other. A Lambert about the opposite normal transmits diffusely:
/// `ThinSheet{Lambert{n, reflectance}, Lambert{-n, transmittance}, n}`. Models TwoSidedMaterial.
/// `upper_bound` of a box across the surface is that of the brighter side; a cut, which bounds each component by
/// itself, bounds clusters across it by the sum of both sides.
template <Material Front, Material Back>
    requires std::same_as<material_spectrum<Front>, material_spectrum<Back>>
struct ThinSheet {
    [[no_unique_address]] Front reflection;
    [[no_unique_address]] Back transmission;
    glm::vec3 geometric_normal;  ///< unit, on the side of the viewer

    using S = material_spectrum<Front>;

    S evaluate(const glm::vec3& to_light) const { return front().evaluate(to_light) + back().evaluate(to_light); }
    void evaluate_many(const LaneVectors& to_lights, int count, LaneSpectra<S>& values) const
        requires(LaneMaterial<Front> || LaneMaterial<Back>) {
        evaluate_lanes(front(), to_lights, count, values);
        add_lanes(back(), to_lights, count, values);
    }
    S upper_bound(const OffsetBox& offsets) const requires(BoundedMaterial<Front>&& BoundedMaterial<Back>) {
        // A light is on one side only, so that the larger bound holds for both.
        return larger_channels(front().upper_bound(offsets), back().upper_bound(offsets));
    }
    void quick_upper_bounds(const OffsetBlock& offsets, LaneSpectra<S>& bounds) const
        requires(BoundedMaterial<Front>&& BoundedMaterial<Back>) {
        LaneSpectra<S> others;
        front().quick_upper_bounds(offsets, bounds);
        back().quick_upper_bounds(offsets, others);
        for (std::size_t i = 0; i < bounds.size(); ++i) bounds[i] = larger_channels(bounds[i], others[i]);
    }
    /// Calls f for each component of either side, as seen above that side's horizon.
    template <class F>
    void for_each_component(F&& f) const {
        visit(front(), f);
        visit(back(), f);
    }

    bool is_behind(const glm::vec3& to_light) const { return back().is_above(to_light); }

private:
    auto front() const { return AboveHorizon<const Front&>{reflection, geometric_normal}; }
    auto back() const { return AboveHorizon<const Back&>{transmission, -geometric_normal}; }

    template <class M, class F>
    static void visit(const M& side, F&& f) {
        if constexpr (CompositeMaterial<M>) {
            side.for_each_component(f);
        } else {
            f(side);
        }
    }
};

template <class Front, class Back>
ThinSheet(Front, Back, glm::vec3) -> ThinSheet<Front, Back>;

}  // namespace lightcuts
