#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <glm/vec3.hpp>

#include "../core/cone.hpp"
#include "../core/cosine.hpp"
#include "../core/spectrum.hpp"
#include "../material/conservative_rounding.hpp"
#include "../material/material.hpp"

namespace lightcuts {

/// A lobe that says what dominates it and others like it: `envelope()` returns a ReflectionBound of the lobe, and
/// `merge(a, b)` of two envelopes one of all that either bounds. Clusters of gather points then know one envelope each.
/// A CosineLobeMaterial needs none; of other lobes that have none a cluster asks each for its own bound.
template <class M>
concept EnvelopedMaterial = Material<M> && requires(const M& m) {
    requires ReflectionBound<std::remove_cvref_t<decltype(m.envelope())>, material_spectrum<M>>;
    requires std::semiregular<std::remove_cvref_t<decltype(m.envelope())>>;
    { merge(m.envelope(), m.envelope()) } -> std::same_as<std::remove_cvref_t<decltype(m.envelope())>>;
};

/// Dominates cosine lobes about several normals.
template <Spectrum S>
struct CosineEnvelope {
    Cone normals;                  ///< holds them all
    S largest_scale = black<S>();  ///< 1/sr

    CosineLobe<S, Cone> cosine_lobe() const { return {normals, largest_scale}; }
};

/// Dominates what either dominates.
template <Spectrum S>
CosineEnvelope<S> merge(const CosineEnvelope<S>& a, const CosineEnvelope<S>& b) {
    return {merge(a.normals, b.normals), larger_channels(a.largest_scale, b.largest_scale)};
}

namespace detail {

/// True if clusters of `M` keep an envelope.
template <class M>
inline constexpr bool has_envelope = EnvelopedMaterial<M> || CosineLobeMaterial<M>;

/// The envelope of one lobe.
template <Material M>
    requires has_envelope<M>
auto envelope_of_lobe(const M& m) {
    if constexpr (EnvelopedMaterial<M>) {
        return m.envelope();
    } else {
        const auto lobe = m.cosine_lobe();
        return CosineEnvelope<material_spectrum<M>>{merge(Cone{}, lobe.normal), lobe.scale};
    }
}

/// Upper bound of what `bound` bounds over the directions of a box, whichever way it bounds.
template <Spectrum S, class B>
S upper_bound_over(const B& bound, const OffsetBox& box) {
    if constexpr (BoundsDirections<B, S>) {
        return bound.upper_bound(box);
    } else if constexpr (BoundsByComponents<B>) {
        S sum = black<S>();
        bound.for_each_component([&](const auto& part) { sum = sum + upper_bound_over<S>(part, box); });
        return sum;
    } else {
        const auto lobe = bound.cosine_lobe();
        const Cone normals = merge(Cone{}, lobe.normal);
        const glm::dvec3 axis = unit_axis(normals);
        if (is_single(normals) && lies_below(axis, box, 2.0 * direction_error)) return black<S>();
        const double cosine = widen_cosine(max_cosine(axis, box), normals);
        return scaled_up(S(lobe.scale), (cosine > 0.0 ? cosine : 0.0) + 2.0 * direction_error);
    }
}

}  // namespace detail

}  // namespace lightcuts
