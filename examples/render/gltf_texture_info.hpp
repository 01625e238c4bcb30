#pragma once

#include <tiny_gltf.h>

#include "scene.hpp"

namespace render {

/// How a glTF material addresses one of its textures.
struct TextureUse {
    int uv_set = 0;
    UvTransform transform;
};

/// The textureInfo `key` of an extension; one without index if it is not there.
/// throws: invalid_input naming it if its index or set of coordinates is no whole number of at least 0.
tinygltf::TextureInfo texture_info(const tinygltf::Value& extension, const char* key);

/// Of a textureInfo with these members, the extension KHR_texture_transform applied.
/// throws: invalid_input naming the member that is no number.
TextureUse texture_use(int tex_coord, const tinygltf::ExtensionMap& extensions);

}  // namespace render
