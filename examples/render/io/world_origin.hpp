#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "scene.hpp"

namespace render {

/// Sets `scene.origin` and `scene.positions` of world coordinates, and notes in `scene.left_out` if many of
/// `scene.triangles`, or stray ones, are so small and far away that rays leave them by a tenth of their size.
///
/// The origin, about which positions are kept in floats, is that of the coordinates, unless the middle of the
/// triangles, or of their area, is farther from there than eight times its size and much less is lost about it; then
/// near that middle, a multiple of the power of two below its size, so that what is written in few binary digits stays
/// exact. Middles are medians, which stray triangles do not move. cost: O(triangles)
void set_positions(Scene& scene, std::span<const glm::dvec3> positions);

}  // namespace render
