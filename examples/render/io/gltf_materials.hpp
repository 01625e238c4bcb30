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
    /// What texels are: reflectance; what an unlit surface shows, which may be above 1; emitted radiance; numbers. All
    /// but the last are sRGB-encoded.
    enum class Coding { color, shown, emission, data };

    Material convert(const JsonObject& source);
    void convert_metallic_roughness(const JsonObject& source, Material& material);
    void convert_specular(const JsonObject& extension, const JsonObject& source, Material& material);
    void convert_specular_glossiness(const JsonObject& extension, Material& material);
    /// The factor and texture of the base or diffuse color in `owner`.
    void convert_base(const JsonObject& owner, const char* factor, const char* map, const JsonObject& source,
                      Material& material);
    void convert_emission(const JsonObject& source, Material& material);
    void convert_transmission(const JsonObject& source, Material& material);
    void convert_normals(const JsonObject& source, Material& material);
    void convert_alpha(const JsonObject& source, Material& material);

    /// The texture that member `key` of `owner` names, if it is there and `wanted`; else it has no effect, as a factor
    /// is 0. `material`: as messages call it.
    TextureUse texture(const JsonObject& owner, const char* key, Coding coding, const JsonObject& material,
                       bool wanted = true);
    std::uint32_t uv_set(std::size_t number);
    int load(std::size_t texture, Coding coding);
    Texture read_image(std::size_t image, Coding coding);
    void note_references(const nlohmann::json& material, bool is_unlit, std::map<std::size_t, std::string>& why) const;

    GltfDocument& document_;
    Scene& scene_;
    std::map<std::optional<std::size_t>, std::uint32_t> added_;
    std::map<std::pair<std::size_t, Coding>, int> textures_;
    std::set<std::size_t> used_images_;
    std::map<std::size_t, std::string> unwanted_;  ///< textures that a used material names without effect, and why
    std::vector<std::size_t> uv_sets_;
};

}  // namespace render
