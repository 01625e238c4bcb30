#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "../core/cone.hpp"
#include "../core/offset_block.hpp"
#include "../core/spectrum.hpp"

namespace lightcuts {

/// One spectrum for each lane.
template <Spectrum S>
using LaneSpectra = std::array<S, lane_count>;

/// Bounds what some surfaces reflect, by directions: `upper_bound(box)` is a spectrum (BRDF x cosine, 1/sr) that no
/// channel of what a surface's `evaluate(p / |p|)` returns exceeds for any offset p in `box`, where p / |p| is rounded
/// to float and evaluate() is taken as compiled. Exactly zero only if that is zero for all of them. p = 0 does not
/// count.
template <class B, class S>
concept BoundsDirections = Spectrum<S> && requires(const B& b, const OffsetBox& box) {
    { b.upper_bound(box) } -> std::same_as<S>;
};

/// Bounds what some surfaces reflect, by directions, in a second, cheaper way besides `upper_bound`: as valid, less
/// tight, without iteration, and for several boxes at once. `quick_upper_bounds(offsets, bounds)` sets bounds[i] to a
/// bound over the box in lane i of `offsets`.
template <class B, class S>
concept QuicklyBoundsDirections = BoundsDirections<B, S> &&
    requires(const B& b, const OffsetBlock& offsets, LaneSpectra<S>& bounds) {
    b.quick_upper_bounds(offsets, bounds);
};

/// scale * max(0, cos) about a normal. `normal`: a unit vector, or, for many surfaces, the Cone that holds all of
/// theirs; `scale`: 1/sr.
template <Spectrum S, class Normal = glm::vec3>
struct CosineLobe {
    Normal normal;
    S scale;
};

/// Bounds what some surfaces reflect by one cosine lobe, about one normal or any of a cone: from it the bound policy
/// forms the joint bound of cosine and distance.
template <class B, class S>
concept BoundsByCosineLobe = Spectrum<S> && requires(const B& b) {
    requires std::same_as<std::remove_cvref_t<decltype(b.cosine_lobe())>, CosineLobe<S>> ||
        std::same_as<std::remove_cvref_t<decltype(b.cosine_lobe())>, CosineLobe<S, Cone>>;
};

namespace detail {
/// A visitor that accepts any component.
struct AnyComponent {
    template <class B>
    void operator()(const B&) const {}
};
}  // namespace detail

/// Bounds what some surfaces reflect by a sum: `for_each_component(f)` calls f(component) for each of some bounds, so
/// that each is formed in its own best way and jointly with the geometry. Each component is a ReflectionBound of the
/// same spectrum, which is checked where it is asked.
template <class B>
concept BoundsByComponents = requires(const B& b, detail::AnyComponent visit) {
    b.for_each_component(visit);
};

/// Bounds what some surfaces reflect, in one of three ways. A material that bounds itself is one, of its own surface;
/// what stands for many surfaces needs no `evaluate`.
template <class B, class S>
concept ReflectionBound = BoundsByComponents<B> || BoundsByCosineLobe<B, S> || BoundsDirections<B, S>;

namespace detail {

/// The box in lane `i`, in double; one that holds every direction where float has overflowed.
inline OffsetBox lane_box(const OffsetBlock& block, int i) {
    const OffsetBox box{glm::dvec3(block.lo.at(i)), glm::dvec3(block.hi.at(i))};
    const bool overflown = !(max_distance2(box) < std::numeric_limits<double>::infinity());
    return overflown ? OffsetBox{glm::dvec3(-1e38), glm::dvec3(1e38)} : box;
}

}  // namespace detail

/// The cheapest bounds of several boxes: `quick_upper_bounds` if there are any, else `upper_bound` of each.
template <Spectrum S, BoundsDirections<S> B>
void cheapest_upper_bounds(const B& b, const OffsetBlock& offsets, LaneSpectra<S>& bounds) {
    if constexpr (QuicklyBoundsDirections<B, S>) {
        b.quick_upper_bounds(offsets, bounds);
    } else {
        for (int i = 0; i < lane_count; ++i) {
            bounds[static_cast<std::size_t>(i)] = b.upper_bound(detail::lane_box(offsets, i));
        }
    }
}

}  // namespace lightcuts
