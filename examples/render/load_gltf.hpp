#pragma once

#include <filesystem>

#include "scene.hpp"

namespace render {

/// Reads a glTF 2.0 file, .gltf or .glb: its default scene's triangles with node transforms applied, materials,
/// textures, perspective cameras, and the extensions KHR_lights_punctual, KHR_materials_emissive_strength,
/// KHR_materials_transmission, KHR_materials_diffuse_transmission, KHR_materials_ior and KHR_mesh_quantization.
/// Animation, skins, morph targets, normal maps and vertex colours are left out.
/// throws: invalid_input naming the file and the element, if it is no whole glTF 2.0 file; if an element refers to one
/// that does not exist; if a texture cannot be read, or a material's textures use two sets of coordinates; if a member
/// of KHR_materials_diffuse_transmission, KHR_texture_transform or a light is not what it should be; also for an
/// extension that the file requires and this reader does not know.
Scene load_gltf(const std::filesystem::path& path);

}  // namespace render
