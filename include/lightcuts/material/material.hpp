#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

#include <glm/vec3.hpp>

#include "../core/lanes.hpp"
#include "../core/spectrum.hpp"
#include "reflection_bound.hpp"

namespace lightcuts {

/// What `M::evaluate` returns.
template <class M>
using material_spectrum = std::remove_cvref_t<decltype(std::declval<const M&>().evaluate(glm::vec3()))>;

/// The surface at one receiver, seen from one direction: made once per receiver, asked about many lights.
///
/// `evaluate(to_light)`: BRDF x cosine at the receiver (the cosine is included), 1/sr; `to_light` is a unit vector.
/// Zero, not negative, where the surface does not reflect; never NaN.
template <class M>
concept Material = requires(const M& m, glm::vec3 to_light) {
    { m.evaluate(to_light) } -> Spectrum;
};

/// A material that evaluates several directions at once: `evaluate_many(to_lights, count, values)` sets values[i] to
/// what `evaluate` returns for lane i, within float rounding, for each i < count; what it leaves in other lanes does
/// not matter. Lanes to spare of `to_lights` are unit vectors too. 0 < count <= lane_count.
template <class M>
concept LaneMaterial = Material<M> &&
    requires(const M& m, const LaneVectors& to_lights, LaneSpectra<material_spectrum<M>>& values) {
    m.evaluate_many(to_lights, 1, values);
};

/// A material that bounds itself, by `upper_bound`: see `BoundsDirections`. One without a bound can be wrapped in
/// `Capped` or `BoundedBy`.
template <class M>
concept BoundedMaterial = Material<M> && BoundsDirections<M, material_spectrum<M>>;

/// A bounded material with a second, cheaper bound: see `QuicklyBoundsDirections`.
template <class M>
concept QuicklyBoundedMaterial = Material<M> && QuicklyBoundsDirections<M, material_spectrum<M>>;

/// A material that never exceeds one cosine lobe and, for Lambert's, equals it: evaluate(o) <= scale max(0, normal .
/// o). See `BoundsByCosineLobe`.
template <class M>
concept CosineLobeMaterial = Material<M> && BoundsByCosineLobe<M, material_spectrum<M>>;

/// A material that is bounded part by part: `for_each_component(f)` calls f(component) for each of some materials whose
/// sum `evaluate` never exceeds. The components are asked for bounds only: it is `evaluate`, or `evaluate_many`, that
/// says what the material reflects.
template <class M>
concept CompositeMaterial = Material<M> && BoundsByComponents<M>;

/// A material of a thin surface that is lit from both sides: light from behind goes through to the viewer.
/// `is_behind(to_light)` is true if light from there, a vector of any length, arrives behind the surface itself. Shadow
/// rays to such lights then start behind it too. Oracles that are asked about a receiver are shown a copy that says so:
/// a material that cannot be copied is referred to, by `Receiver<const M&>`.
template <class M>
concept TwoSidedMaterial = Material<M> && requires(const M& m, const glm::vec3& to_light) {
    { m.is_behind(to_light) } -> std::same_as<bool>;
};

/// A material whose `horizon()` is a normal such that it reflects nothing from directions `d` with dot(horizon(), d) <=
/// 0, or nothing if it has none, as what light passes through. Of a TwoSidedMaterial: nothing also if `is_behind(d)` is
/// true of a direction `d` above that horizon.
template <class M>
concept MaterialWithHorizon = requires(const M& material) {
    { material.horizon() } -> std::convertible_to<std::optional<glm::vec3>>;
};

/// Sets values[i] to `m.evaluate` of the direction in lane i, for i < count: by `evaluate_many` if the material has it.
/// pre: 0 < count <= lane_count
template <Material M>
void evaluate_lanes(const M& m, const LaneVectors& to_lights, int count, LaneSpectra<material_spectrum<M>>& values) {
    if constexpr (LaneMaterial<M>) {
        m.evaluate_many(to_lights, count, values);
    } else {
        for (int i = 0; i < count; ++i) values[static_cast<std::size_t>(i)] = m.evaluate(to_lights.at(i));
    }
}

/// Adds `m.evaluate` of the direction in lane i to values[i], for i < count. pre: 0 < count <= lane_count
template <Material M>
void add_lanes(const M& m, const LaneVectors& to_lights, int count, LaneSpectra<material_spectrum<M>>& values) {
    LaneSpectra<material_spectrum<M>> transfer;
    evaluate_lanes(m, to_lights, count, transfer);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) values[i] = values[i] + transfer[i];
}

}  // namespace lightcuts
