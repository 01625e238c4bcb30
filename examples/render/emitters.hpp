#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene.hpp"

namespace render {

/// An emissive surface: a connected component of the triangles of one emissive material, where vertices at exactly
/// equal positions count as one. What is only seen is none.
struct EmissiveSurface {
    std::uint32_t material = 0;
    std::vector<std::uint32_t> triangles;
    double area = 0;
};

/// All emissive surfaces, in the order of their first triangles. cost: O(T log T) in the emissive triangles.
std::vector<EmissiveSurface> emissive_surfaces(const Scene& scene);

/// Adds to `scene.oriented`, for every emissive surface, `points` lights of equal power spread evenly over its area,
/// slightly off it along the winding's normal; as many on the other side if the material is double-sided. Each has
/// the intensity radiance x area / `points`; on a textured surface they are dense where it is bright.
/// 0 `points` add none. throws: invalid_input when that would be more than 100 million lights.
void add_emitter_lights(Scene& scene, std::size_t points);

}  // namespace render
