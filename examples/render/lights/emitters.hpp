#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene.hpp"

namespace render {

/// An emissive surface: a connected component of the triangles of one emissive material, where vertices at exactly
/// equal positions count as one. What is only seen is none.
struct EmissiveSurface {
    std::uint32_t material = 0;
    std::vector<std::uint32_t> triangles;
};

/// All emissive surfaces, in the order of their first triangles. cost: O(T log T) in the emissive triangles.
std::vector<EmissiveSurface> emissive_surfaces(const Scene& scene);

/// How many lights stand for emissive surfaces.
struct EmitterLightOptions {
    std::size_t points = 64;  ///< on each side of a surface that emits, at most; 0: none
    /// About the most in all; 0: any number. Empty: 200,000 where more than 3,125 sides of surfaces emit (which 64
    /// points each would exceed), else any number.
    std::optional<std::size_t> total{};
};

/// Adds to `scene.oriented`, for every emissive surface, `points` lights of equal power spread evenly over its area,
/// slightly off it along the winding's normal; as many on the other side if the material is double-sided. Each has
/// the intensity radiance x area / `points`; where the radiance varies, by texture or opacity, they are dense where it
/// is high. Parts that move have theirs at each instant, in `scene.at_instants`. Where that would be more than `total`,
/// surfaces get fewer, in proportion to their power, but at least one. throws: invalid_input when that would be more
/// than 100 million lights.
void add_emitter_lights(Scene& scene, const EmitterLightOptions& options);

}  // namespace render
