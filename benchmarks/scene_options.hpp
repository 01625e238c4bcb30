#pragma once

#include <cstdint>
#include <string>

#include "options.hpp"

namespace benchmark {

/// The renderer's options for a scene as benchmarks name it: a file or builtin:NAME, and after `?` any of its lights,
/// clamping and materials, eye rays, lens, shutter, fog and what cuts ask for as KEY=VALUE, separated by `&`: the
/// renderer's option --KEY, or what a built-in scene knows itself. Such as `builtin:surfaces?lights=1000&rotated=0` or
/// `room.glb?sun-sky=35,120&indirect=10000`. `area_points`: lights per emissive surface where the name does not say.
/// throws: invalid_input, which names the scene, for a key or a value that cannot be.
render::Options scene_options(const std::string& name, std::uint32_t area_points = 64);

}  // namespace benchmark
