#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "scene.hpp"

namespace render {

/// The point about which positions are to be kept in floats: the origin of coordinates, unless the box around them is
/// farther from there than eight times its size; then near the box's centre, a multiple of the power of two below its
/// size, so that what is written in few binary digits stays exact.
glm::dvec3 world_origin(std::span<const glm::dvec3> positions);

/// Sets `scene.origin` and `scene.positions` of world coordinates, and notes in `scene.left_out` if a float's step
/// there is coarse for the scene's triangles.
void set_positions(Scene& scene, std::span<const glm::dvec3> positions);

}  // namespace render
