#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
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

/// A bounded material with a second, cheaper bound: as valid, less tight, without iteration.
template <class M>
concept QuicklyBoundedMaterial = BoundedMaterial<M> && requires(const M& m, const OffsetBox& box) {
    { m.quick_upper_bound(box) } -> std::same_as<material_spectrum<M>>;
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

/// A material that is the sum of others. `for_each_component(f)` calls f(material) for each, so that each can be
/// bounded jointly with the geometry.
template <class M>
concept CompositeMaterial = Material<M> && requires(const M& m, detail::AnyComponent visit) {
    m.for_each_component(visit);
};

/// The material's cheapest bound: `quick_upper_bound` if it has one, else `upper_bound`.
template <BoundedMaterial M>
material_spectrum<M> cheapest_upper_bound(const M& m, const OffsetBox& box) {
    if constexpr (QuicklyBoundedMaterial<M>) {
        return m.quick_upper_bound(box);
    } else {
        return m.upper_bound(box);
    }
}

}  // namespace lightcuts
