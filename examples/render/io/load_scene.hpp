#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene.hpp"
#include "shutter.hpp"

namespace render {

/// Reads a scene and checks it: a glTF 2.0 file (.gltf, .glb), an OBJ file (.obj), or `builtin:NAME`, optionally
/// with `?lights=N` and, for `surfaces`, `&rotated=0`. Emissive surfaces have no lights yet: see add_emitter_lights.
/// The scene is as `shutter` opens; what moves while it is open is in motion. throws: invalid_input, one line: what is
/// wrong, where, what to do.
Scene load_scene(std::string_view path_or_builtin, const Shutter& shutter = {});

/// The names that may follow `builtin:`.
std::vector<std::string> builtin_names();

}  // namespace render
