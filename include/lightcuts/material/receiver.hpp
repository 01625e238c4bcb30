#pragma once

#include <cstdint>
#include <utility>

#include <glm/vec3.hpp>

namespace lightcuts {

/// A point to be shaded: where it is and what its surface does with light, the outgoing direction being fixed.
/// `M` may be a reference, so that a material need not be copied.
template <class M>
struct Receiver {
    constexpr Receiver(const glm::vec3& at, M surface)
        : position(at), material(std::forward<M>(surface)), shadow_origin(at) {}
    constexpr Receiver(const glm::vec3& at, M surface, const glm::vec3& rays_start, std::uint32_t name = 0)
        : position(at), material(std::forward<M>(surface)), shadow_origin(rays_start), id(name) {}

    glm::vec3 position;
    M material;
    glm::vec3 shadow_origin;  ///< where shadow rays start: the position, moved off the surface
    std::uint32_t id = 0;     ///< goes into queries, and into the hash that draws representatives
};

}  // namespace lightcuts
