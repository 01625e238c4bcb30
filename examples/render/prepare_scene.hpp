#pragma once

#include "options.hpp"
#include "scene.hpp"
#include "surfaces/surface_lobes.hpp"
#include "view.hpp"

namespace render {

/// Reads `options.scene` and lights it as the options say: by a table, emissive surfaces, spheres, a map, sun and sky.
/// Options that have not been given take the scene's own values. Indirect light is added to the result by
/// add_virtual_lights, which takes rays.
/// throws: invalid_input for a file that cannot be used, or if there is no light; usage_error for options that do not
/// go with what lights the scene.
Scene prepare_scene(Options& options);

Shade shade_of(const Options& options);

/// Fog::points_per_ray for that many eye rays a pixel.
float fog_points_per_ray(int spp);

/// Focused on the camera's target where the options do not say.
Lens lens_of(const Options& options, const Camera& camera);

}  // namespace render
