#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "scene.hpp"

namespace render {

/// A point on a triangle, on the side from which its corners run counter-clockwise.
struct AreaSample {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  ///< unit, the face's
    std::uint32_t triangle = 0;
};

/// `count` points spread evenly over the area of `triangles`. On a flat surface they depend on its outline alone; on
/// a curved one each has an equal share of the area along a space-filling curve, so that the tessellation matters
/// little. cost: O((T + count) log(T + count)).
std::vector<AreaSample> spread_by_area(const Scene& scene, std::span<const std::uint32_t> triangles, std::size_t count);

}  // namespace render
