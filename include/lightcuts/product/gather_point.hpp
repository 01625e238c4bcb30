#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include <glm/vec3.hpp>

#include "../core/spectrum.hpp"
#include "../shading/receiver.hpp"

namespace lightcuts {

/// A point of a sum over many points and many lights [Multidimensional Lightcuts 2006, Eq. 4]: a receiver, and what
/// the light that leaves it is multiplied by.
///
/// A pixel's gather points are what its eye rays find, each with its share of the pixel's filter; those of a light-map
/// texel cover the texel. A surface of several lobes is one gather point a lobe; `receiver.material` is a lobe or, in a
/// medium, a phase function, which has no cosine. Put albedo and texture into `strength` and let the lobe be a shape:
/// then clusters average textures exactly.
template <class M, Spectrum S = glm::vec3>
struct GatherPoint {
    using material_type = std::remove_cvref_t<M>;
    using spectrum = S;

    Receiver<M> receiver;
    S strength;  ///< pre: finite, not negative. Black ones are left out.
};

/// A gather point that exists at one instant of several, at which alone lights of that instant reach it.
template <class M, Spectrum S = glm::vec3>
struct InstantGatherPoint : GatherPoint<M, S> {
    std::uint32_t instant = 0;  ///< pre: below the number of instants
};

namespace detail {

template <class G>
inline constexpr bool is_gather_point = false;
template <class M, Spectrum S>
inline constexpr bool is_gather_point<GatherPoint<M, S>> = true;
template <class M, Spectrum S>
inline constexpr bool is_gather_point<InstantGatherPoint<M, S>> = true;

}  // namespace detail

/// A GatherPoint or an InstantGatherPoint.
template <class G>
concept AnyGatherPoint = detail::is_gather_point<std::remove_cvref_t<G>>;

/// A gather point with an instant.
template <class G>
concept TimedGatherPoint = AnyGatherPoint<G> && requires(const G& point) {
    { point.instant } -> std::convertible_to<std::uint32_t>;
};

}  // namespace lightcuts
