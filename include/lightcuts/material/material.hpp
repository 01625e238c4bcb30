#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "../core/offset_block.hpp"
#include "../core/spectrum.hpp"

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

/// A material that bounds itself. `upper_bound(box)`, of the spectrum that `evaluate` returns: no channel of
/// evaluate(p / |p|) exceeds it for any offset p in `box`, where p / |p| is rounded to float and evaluate() is taken as
/// compiled. Exactly zero only if the material returns zero for all of them. p = 0 does not count.
/// A material without one can be wrapped in `Capped`.
template <class M>
concept BoundedMaterial = Material<M> && requires(const M& m, const OffsetBox& box) {
    { m.upper_bound(box) } -> std::same_as<material_spectrum<M>>;
};

/// One spectrum for each box of an OffsetBlock.
template <Spectrum S>
using LaneSpectra = std::array<S, lane_count>;

/// A material that evaluates several directions at once: `evaluate_many(to_lights, count, values)` sets values[i] to
/// what `evaluate` returns for lane i, within float rounding, for each i < count; what it leaves in other lanes does
/// not matter. Lanes to spare of `to_lights` are unit vectors too. 0 < count <= lane_count.
template <class M>
concept LaneMaterial = Material<M> &&
    requires(const M& m, const LaneVectors& to_lights, LaneSpectra<material_spectrum<M>>& values) {
    m.evaluate_many(to_lights, 1, values);
};

/// A bounded material with a second, cheaper bound: as valid, less tight, without iteration, and for several boxes at
/// once. `quick_upper_bounds(offsets, bounds)` sets bounds[i] for the box in lane i of `offsets`.
template <class M>
concept QuicklyBoundedMaterial = BoundedMaterial<M> &&
    requires(const M& m, const OffsetBlock& offsets, LaneSpectra<material_spectrum<M>>& bounds) {
    m.quick_upper_bounds(offsets, bounds);
};

/// scale * max(0, cos) about a normal. `normal`: unit; `scale`: 1/sr.
template <Spectrum S>
struct CosineLobe {
    glm::vec3 normal;
    S scale;
};

/// A material that never exceeds one cosine lobe and, for Lambert's, equals it: evaluate(o) <= scale max(0, normal .
/// o). From it the bound policy forms the joint bound of cosine and distance.
template <class M>
concept CosineLobeMaterial = Material<M> && requires(const M& m) {
    { m.cosine_lobe() } -> std::same_as<CosineLobe<material_spectrum<M>>>;
};

namespace detail {
/// A visitor that accepts any component.
struct AnyComponent {
    template <class M>
    void operator()(const M&) const {}
};
}  // namespace detail

/// A material that is bounded part by part: `for_each_component(f)` calls f(component) for each of some materials whose
/// sum `evaluate` never exceeds, so that each is bounded in its own best way and jointly with the geometry. The
/// components are asked for bounds only: it is `evaluate`, or `evaluate_many`, that says what the material reflects.
template <class M>
concept CompositeMaterial = Material<M> && requires(const M& m, detail::AnyComponent visit) {
    m.for_each_component(visit);
};

/// A material of a thin surface that is lit from both sides: light from behind goes through to the viewer.
/// `is_behind(to_light)` is true if light from there, a vector of any length, arrives behind the surface itself. Shadow
/// rays to such lights then start behind it too. Oracles that are asked about a receiver are shown a copy that says so:
/// a material that cannot be copied is referred to, by `Receiver<const M&>`.
template <class M>
concept TwoSidedMaterial = Material<M> && requires(const M& m, const glm::vec3& to_light) {
    { m.is_behind(to_light) } -> std::same_as<bool>;
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
    LaneSpectra<material_spectrum<M>> terms;
    evaluate_lanes(m, to_lights, count, terms);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) values[i] = values[i] + terms[i];
}

namespace detail {

/// The box in lane `i`, in double; one that holds every direction where float has overflowed.
inline OffsetBox lane_box(const OffsetBlock& block, int i) {
    const OffsetBox box{glm::dvec3(block.lo.at(i)), glm::dvec3(block.hi.at(i))};
    const bool overflown = !(max_distance2(box) < std::numeric_limits<double>::infinity());
    return overflown ? OffsetBox{glm::dvec3(-1e38), glm::dvec3(1e38)} : box;
}

}  // namespace detail

/// The material's cheapest bounds of several boxes: `quick_upper_bounds` if it has them, else `upper_bound` of each.
template <BoundedMaterial M>
void cheapest_upper_bounds(const M& m, const OffsetBlock& offsets, LaneSpectra<material_spectrum<M>>& bounds) {
    if constexpr (QuicklyBoundedMaterial<M>) {
        m.quick_upper_bounds(offsets, bounds);
    } else {
        for (int i = 0; i < lane_count; ++i) {
            bounds[static_cast<std::size_t>(i)] = m.upper_bound(detail::lane_box(offsets, i));
        }
    }
}

}  // namespace lightcuts
