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

/// A piece of an emitter seen as a point.
struct EmissionSample {
    AreaSample place;
    glm::vec3 intensity{0.0f};  ///< along the normal, W/sr
};

/// Area of triangle `t`.
double triangle_area(const Scene& scene, std::uint32_t t);

/// `count` points spread evenly over the area of `triangles`. On a flat surface they depend on its outline alone; on
/// a curved one each has an equal share of the area along a space-filling curve, so that the tessellation matters
/// little. cost: O((T + count) log(T + count)).
std::vector<AreaSample> spread_by_area(const Scene& scene, std::span<const std::uint32_t> triangles, std::size_t count);

/// `count` points of equal power (sum of channels) that stand for the emission of `triangles`: dense where radiance
/// is high, evenly spread where it is constant. Empty iff nothing is emitted. cost: likewise.
std::vector<EmissionSample> spread_by_emission(const Scene& scene, std::span<const std::uint32_t> triangles,
                                               std::size_t count);

/// Area of `triangles` times the sum of channels of the radiance that their fronts emit, taken at 64 points where it
/// varies.
double emitted_power(const Scene& scene, std::span<const std::uint32_t> triangles);

}  // namespace render
