#pragma once

#include <memory>

#include "options.hpp"
#include "rays/ray_scene.hpp"
#include "scene.hpp"
#include "shader.hpp"

namespace render {

/// The shader that sums up the lights at each point by a cut [Lightcuts 2005], with proofs that clusters are hidden as
/// `options.visibility_bounds` asks. Both references are kept.
std::unique_ptr<Shader> make_lightcut_shader(const Scene& scene, const RayScene& rays, const Options& options);

}  // namespace render
