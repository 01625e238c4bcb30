#pragma once

#include <tiny_gltf.h>
#include <glm/vec3.hpp>

namespace render {

/// What a glTF material says in the extension KHR_materials_diffuse_transmission; without it, that nothing passes.
struct GltfDiffuseTransmission {
    float factor = 0.0f;
    glm::vec3 color{1.0f};
    tinygltf::TextureInfo texture;  ///< without index: none
    tinygltf::TextureInfo color_texture;
};

/// throws: invalid_input naming the member that is not what the extension asks for.
GltfDiffuseTransmission diffuse_transmission(const tinygltf::ExtensionMap& of_material);

}  // namespace render
