#pragma once

#include "options.hpp"
#include "scene.hpp"

namespace render {

/// Puts around `scene` what `options` name, a map (OpenEXR, Radiance) or sun and sky, or else what `scene.lighting`
/// does, and sets those of the options that have not been given to what was used.
///
/// A latitude-longitude map becomes background, and distant lights of equal power. Preetham's sun and clear sky become
/// background, 64 distant lights for the sun's disc, and others of equal power for the sky and for the ground below the
/// horizon, which sun and sky light.
/// throws: invalid_input naming the map, and its pixel that is negative or not finite; also if all are black or it is
/// not twice as wide as high; usage_error if an option says more of a map or a sky that there is not,
/// or how to clamp virtual lights that the method does not clamp.
void add_surroundings(Scene& scene, Options& options);

}  // namespace render
