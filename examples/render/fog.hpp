#pragma once

#include <glm/vec3.hpp>
#include <lightcuts/visibility/medium.hpp>

namespace render {

/// A uniform medium that fills the box of a scene's triangles.
struct Fog {
    lightcuts::UniformMedium medium;
    float albedo = 1.0f;      ///< share of the light that it scatters rather than absorbs
    float anisotropy = 0.0f;  ///< mean cosine of Henyey and Greenstein's phase function

    /// Points of an eye ray through fog that hides everything; fewer where it hides less.
    float points_per_ray = 4.0f;

    bool is_there() const { return medium.is_there(); }
};

}  // namespace render
