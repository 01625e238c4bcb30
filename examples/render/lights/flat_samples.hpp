#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lights/area_samples.hpp"
#include "scene.hpp"

namespace render {

/// `count` points of a low-discrepancy sequence on a flat surface, laid out in the smallest rectangle around it, so
/// that they depend on its outline alone. Empty if `triangles` do not lie in one plane facing one way, or fill their
/// rectangle too sparsely. cost: O(count T + H^2 log H) for H corners of the convex hull.
std::vector<AreaSample> spread_on_flat(const Scene& scene, std::span<const std::uint32_t> triangles, std::size_t count);

}  // namespace render
