#pragma once

#include "options.hpp"
#include "scene.hpp"

namespace render {

/// The camera that `options` describe by --eye and --target, or name by --camera, or the scene's first.
/// throws: invalid_input if there is none, or it spans no picture; usage_error if --fov does not go with it.
Camera choose_camera(const Scene& scene, const Options& options);

}  // namespace render
