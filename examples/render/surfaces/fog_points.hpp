#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "fog.hpp"
#include "surfaces/surface.hpp"

namespace render {

/// A part of an eye ray, from a place in space to the next surface.
struct RaySegment {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f};  ///< unit
    float length = 0;           ///< infinite if there is no surface
    float traveled = 0;         ///< from the eye to `origin`
    glm::vec3 weight{1.0f};     ///< share of its light in the eye ray's
    std::uint32_t pixel = 0;
    std::uint32_t sample = 0;
    std::uint32_t instant = 0;
};

/// Appends the points at which fog scatters light into an eye ray: of equal weight, at equal steps of what the fog
/// hides [Multidimensional Lightcuts 2006, section 4], jittered evenly over the rays of a pixel. Their number grows
/// with how much it hides. `vertex`: of the first, raised by their number. Returns the transmittance of the segment.
float add_fog_points(const Fog& fog, const RaySegment& segment, std::uint32_t& vertex,
                     std::vector<SurfacePoint>& points);

}  // namespace render
