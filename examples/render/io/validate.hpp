#pragma once

#include "scene.hpp"

namespace render {

/// Makes a scene safe to render, or says in one line why it is not.
/// Left out and counted in the scene: triangles of zero area, lights of zero intensity. Cut off and named in
/// `left_out`: what colors of reflection have above 1.
/// throws: invalid_input for an empty scene, a vertex, normal, uv, material value, texture or light that is not
/// finite or out of its range, a texture coordinate or the light of a material's surfaces that no float holds, a
/// zero-length axis; it names the scene and the index, and leaves the scene unchanged.
/// Cameras are checked when one is chosen.
void validate(Scene& scene);

/// throws: invalid_input when the scene neither has lights nor had any of zero intensity.
void require_lights(const Scene& scene);

}  // namespace render
