#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include <glm/vec3.hpp>

#include "../core/assertion.hpp"
#include "../core/vector.hpp"
#include "../material/material.hpp"

namespace lightcuts {

/// A point to be shaded: where it is and what its surface does with light, the outgoing direction being fixed.
/// `M` may be a reference, so that a material need not be copied. pre: positions are finite.
template <class M>
struct Receiver {
    constexpr Receiver(const glm::vec3& at, M surface)
        : position(at), material(std::forward<M>(surface)), shadow_origin(at) {
        LIGHTCUTS_ASSERT(is_finite(position));
    }
    constexpr Receiver(const glm::vec3& at, M surface, const glm::vec3& rays_start, std::uint32_t name = 0)
        : position(at), material(std::forward<M>(surface)), shadow_origin(rays_start), id(name) {
        LIGHTCUTS_ASSERT(is_finite(position) && is_finite(shadow_origin));
    }

    glm::vec3 position;
    M material;
    glm::vec3 shadow_origin;  ///< where shadow rays start: the position, moved off the surface to the viewer's side
    std::uint32_t id = 0;     ///< goes into queries, and into the hash that draws representatives

    static constexpr bool two_sided = TwoSidedMaterial<std::remove_cvref_t<M>>;

    /// `shadow_origin` mirrored about the position: as far off the surface on its other side.
    constexpr glm::vec3 shadow_origin_behind() const { return position + (position - shadow_origin); }
    /// Where a shadow ray along `to_light`, of any length, starts: on the side of a two-sided surface where the light
    /// is.
    constexpr glm::vec3 shadow_origin_towards([[maybe_unused]] const glm::vec3& to_light) const {
        if constexpr (two_sided) {
            if (material.is_behind(to_light)) return shadow_origin_behind();
        }
        return shadow_origin;
    }
};

}  // namespace lightcuts
