#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace lightcuts {

/// One shadow ray, as a batched oracle is asked for it.
struct VisibilityQuery {
    glm::vec3 from;          ///< the receiver's `shadow_origin`, on the side where the light is
    std::uint32_t receiver;  ///< the receiver's `id`
    glm::vec3 to;            ///< the light's position; if `distant`, the unit direction towards the light
    std::uint32_t light;     ///< index into the lights of its kind
    std::uint32_t kind;      ///< which light tree of the forest, from 0
    bool distant;            ///< the light is at infinity
};

}  // namespace lightcuts
