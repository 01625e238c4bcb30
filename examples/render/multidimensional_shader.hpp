#pragma once

#include <memory>

#include "options.hpp"
#include "rays/ray_scene.hpp"
#include "scene.hpp"
#include "shader.hpp"

namespace render {

/// The shader that sums up all lobes of a pixel by one cut through the pairs of gather points and lights
/// [Multidimensional Lightcuts 2006], or, for the method `unified-cut`, of single gather points and clusters of lights.
/// Both references are kept.
std::unique_ptr<Shader> make_multidimensional_shader(const Scene& scene, const RayScene& rays, const Options& options);

/// The same where some lights exist at one instant each.
std::unique_ptr<Shader> make_shader_of_moving_lights(const Scene& scene, const RayScene& rays, const Options& options);

}  // namespace render
