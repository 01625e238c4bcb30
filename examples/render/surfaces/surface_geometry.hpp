#pragma once

#include <glm/vec3.hpp>

#include "rays/ray_scene.hpp"
#include "scene.hpp"

namespace render {

/// The surface where a ray meets it, seen from the ray's origin.
struct SurfaceGeometry {
    glm::vec3 position{0.0f};
    glm::vec3 geometric_normal{0.0f};  ///< unit, towards the viewer
    glm::vec3 shading_normal{0.0f};    ///< unit, towards the viewer and above the surface
    float offset = 0;                  ///< by which rays leave the surface
    bool front = true;                 ///< the viewer sees the side from which the corners run counter-clockwise

    /// Where a ray of that direction leaves the surface.
    glm::vec3 leave(const glm::vec3& direction) const;

    /// The mirror direction of `direction` about the shading normal; about the geometric one where that would lead
    /// below the surface.
    glm::vec3 reflect(const glm::vec3& direction) const;
};

/// The surface at `hit` of a ray along the unit `direction`, where it is at the ray's time. The shading normal is that
/// of the vertices, bent by the material's normal map; where it faces away from the viewer near silhouettes it is bent
/// until it does not.
SurfaceGeometry surface_at(const Scene& scene, const Hit& hit, const glm::vec3& direction);

}  // namespace render
