#pragma once

#include <filesystem>

#include "io/file_source.hpp"
#include "scene.hpp"
#include "shutter.hpp"

namespace render {

/// Reads a glTF 2.0 file, .gltf or .glb: its default scene's triangles, posed as nodes, skins, morph weights and the
/// first animation say as the shutter opens, and in motion while it is open; materials, textures, vertex colors, normal
/// maps, cameras and lights; and the extensions that docs/renderer.md lists. Only what the scene shows is read. What
/// the file carries besides is named in `left_out`, also a normal map that cannot be read. throws: invalid_input naming
/// the file, the element and the member: if it is no whole glTF 2.0 file, if an element that is used is damaged or
/// refers to what does not exist, if an image that is used cannot be read, or for an extension that the file requires
/// and this reader does not know.
Scene load_gltf(const std::filesystem::path& path, const FileSource& files = DiskFiles(), const Shutter& shutter = {});

}  // namespace render
