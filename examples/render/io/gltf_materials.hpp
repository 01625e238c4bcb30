#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "io/gltf_document.hpp"
#include "scene.hpp"

namespace render {

/// Puts the materials of a glTF file into a scene as they are first used, with the textures that these use.
class GltfMaterials {
public:
    /// Both must outlive this object.
    GltfMaterials(GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}

    /// Index in the scene of material `index`; empty: of the format's default material.
    /// throws: invalid_input naming the material and its member, or the texture that cannot be read.
    std::uint32_t in_scene(std::optional<std::size_t> index);

    /// The numbers n of the attributes TEXCOORD_n that are Scene::uv_sets, as far as materials in the scene use them.
    const std::vector<std::size_t>& uv_sets() const { return uv_sets_; }

    /// Names the images that no material in the scene uses.
    void note_unused_images() const;

private:
    enum class Coding { color, data };  ///< sRGB, or numbers

    Material convert(const JsonObject& source);
    void convert_metallic_roughness(const JsonObject& source, Material& material);
    void convert_specular_glossiness(const JsonObject& extension, Material& material);
    void convert_unlit(Material& material);
    void convert_emission(const JsonObject& source, Material& material);
    void convert_transmission(const JsonObject& source, Material& material);
    void convert_normals(const JsonObject& source, Material& material);
    void convert_alpha(const JsonObject& source, Material& material);

    /// The texture that member `key` of `owner` names, if it is there and `wanted`. `material`: as messages call it.
    TextureUse texture(const JsonObject& owner, const char* key, Coding coding, const JsonObject& material,
                       bool wanted = true);
    std::uint32_t uv_set(std::size_t number);
    int load(std::size_t texture, Coding coding);
    Texture read_image(std::size_t image, Coding coding);

    GltfDocument& document_;
    Scene& scene_;
    std::map<std::optional<std::size_t>, std::uint32_t> added_;
    std::map<std::pair<std::size_t, Coding>, int> textures_;
    std::set<std::size_t> used_images_;
    std::vector<std::size_t> uv_sets_;
};

}  // namespace render
