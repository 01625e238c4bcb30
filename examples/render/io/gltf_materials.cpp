#include "io/gltf_materials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <lightcuts/core/invalid_input.hpp>

#include "io/escape.hpp"
#include "io/text_file.hpp"
#include "io/uri.hpp"
#include "surfaces/reflectance.hpp"
#include "surfaces/texture.hpp"

namespace render {
namespace {

using lightcuts::invalid_input;

constexpr float most = std::numeric_limits<float>::max();

glm::vec4 color_with_alpha(const JsonObject& source, const char* key) {
    const std::vector<double> v = source.numbers(key, 4);
    return v.empty() ? glm::vec4(1.0f) : glm::vec4(glm::dvec4(v[0], v[1], v[2], v[3]));
}

Texture::Wrap wrap_mode(const JsonObject& sampler, const char* key) {
    switch (sampler.whole_number(key, 10497)) {
        case 10497: return Texture::Wrap::repeat;
        case 33071: return Texture::Wrap::clamp;
        case 33648: return Texture::Wrap::mirror;
        default: sampler.refuse(key, "one that the format knows");
    }
}

/// Of a textureInfo; `material`: as messages call it.
std::optional<JsonObject> texture_transform(const JsonObject& info, const JsonObject& material) {
    constexpr const char* name = "KHR_texture_transform";
    if (!info.extension(name)) return std::nullopt;
    return JsonObject(*info.object("extensions").find(name), material.name() + ": " + name);
}

UvTransform transform_of(const JsonObject& transform) {
    UvTransform result;
    std::vector<double> scale = transform.numbers("scale", 2);
    std::vector<double> offset = transform.numbers("offset", 2);
    if (scale.empty()) scale = {1.0, 1.0};
    if (offset.empty()) offset = {0.0, 0.0};
    // Counter-clockwise as one sees it, v running downwards.
    const double turn = transform.number("rotation", 0.0);
    result.u_axis = glm::vec2(glm::dvec2(std::cos(turn), -std::sin(turn)) * scale[0]);
    result.v_axis = glm::vec2(glm::dvec2(std::sin(turn), std::cos(turn)) * scale[1]);
    result.offset = glm::vec2(glm::dvec2(offset[0], offset[1]));
    return result;
}

/// By its file, or else its own name.
std::string name_of_image(const JsonObject& image) {
    const std::string uri = image.text("uri");
    return !uri.empty() && !is_data_uri(uri) ? excerpt(uri) : image.name();
}

}  // namespace

std::uint32_t GltfMaterials::in_scene(std::optional<std::size_t> index) {
    const auto known = added_.find(index);
    if (known != added_.end()) return known->second;
    static const nlohmann::json nothing = nlohmann::json::object();
    Material material = convert(index ? document_.element("materials", *index, "material")
                                      : JsonObject(nothing, "the default material"));
    const auto place = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.push_back(std::move(material));
    added_.emplace(index, place);
    return place;
}

Material GltfMaterials::convert(const JsonObject& source) {
    Material m;
    m.name = source.text("name");
    m.double_sided = source.flag("doubleSided", false);
    convert_alpha(source, m);
    if (source.extension("KHR_materials_unlit")) m.model = Material::Model::unlit;
    if (const auto old = source.extension("KHR_materials_pbrSpecularGlossiness")) {
        convert_specular_glossiness(*old, m);
    } else {
        convert_metallic_roughness(source, m);
    }
    if (m.model == Material::Model::unlit) {
        // An unlit surface emits its base color.
        m.emission = m.base_color;
        m.emission_texture = m.base_color_texture;
        return m;
    }
    convert_emission(source, m);
    convert_transmission(source, m);
    convert_normals(source, m);
    if (source.has("occlusionTexture")) {
        leave_out(scene_.left_out, "occlusion textures", "what surfaces hide from each other is computed");
    }
    return m;
}

void GltfMaterials::convert_alpha(const JsonObject& source, Material& m) {
    const std::string mode = source.text("alphaMode", "OPAQUE");
    if (mode == "MASK") {
        m.alpha = Material::Alpha::mask;
    } else if (mode == "BLEND") {
        m.alpha = Material::Alpha::blend;
    } else if (mode != "OPAQUE") {
        source.refuse("alphaMode", "OPAQUE, MASK or BLEND");
    }
    m.alpha_cutoff = static_cast<float>(source.number("alphaCutoff", 0.5));
}

void GltfMaterials::convert_base(const JsonObject& owner, const char* factor, const char* map, const JsonObject& source,
                                 Material& m) {
    const glm::vec4 base = color_with_alpha(owner, factor);
    m.base_color = glm::vec3(base);
    m.base_alpha = base.a;
    const bool is_unlit = m.model == Material::Model::unlit;
    const bool wanted = m.base_color != glm::vec3(0.0f) || m.alpha != Material::Alpha::opaque;
    m.base_color_texture = texture(owner, map, is_unlit ? Coding::shown : Coding::color, source, wanted);
}

void GltfMaterials::convert_metallic_roughness(const JsonObject& source, Material& m) {
    const JsonObject pbr = source.object("pbrMetallicRoughness");
    convert_base(pbr, "baseColorFactor", "baseColorTexture", source, m);
    m.metallic = static_cast<float>(pbr.number("metallicFactor", 1.0));
    m.roughness = static_cast<float>(pbr.number("roughnessFactor", 1.0));
    if (m.model == Material::Model::unlit) return;
    const bool varies = m.metallic != 0.0f || m.roughness != 0.0f;
    m.metallic_roughness_texture = texture(pbr, "metallicRoughnessTexture", Coding::data, source, varies);
    if (const auto extension = source.extension("KHR_materials_ior")) {
        m.ior = static_cast<float>(extension->number("ior", 1.5));
    }
    if (const auto extension = source.extension("KHR_materials_specular")) convert_specular(*extension, source, m);
}

void GltfMaterials::convert_specular(const JsonObject& extension, const JsonObject& source, Material& m) {
    m.specular_weight = extension.number_in("specularFactor", 1.0f, 0.0f, 1.0f);
    m.specular_tint = extension.color("specularColorFactor", glm::vec3(1.0f));
    // At grazing incidence the weight acts alone.
    const bool reflects = m.specular_weight != 0.0f;
    const bool is_tinted = reflects && m.specular_tint != glm::vec3(0.0f);
    m.specular_weight_texture = texture(extension, "specularTexture", Coding::data, source, reflects);
    m.specular_texture = texture(extension, "specularColorTexture", Coding::color, source, is_tinted);
}

void GltfMaterials::convert_specular_glossiness(const JsonObject& extension, Material& m) {
    convert_base(extension, "diffuseFactor", "diffuseTexture", extension, m);
    if (m.model == Material::Model::unlit) return;
    m.model = Material::Model::specular_glossiness;
    m.specular = extension.color("specularFactor", glm::vec3(1.0f));
    m.roughness = 1.0f - extension.number_in("glossinessFactor", 1.0f, 0.0f, 1.0f);
    const bool varies = m.specular != glm::vec3(0.0f) || m.roughness != 1.0f;
    m.specular_texture = texture(extension, "specularGlossinessTexture", Coding::color, extension, varies);
}

void GltfMaterials::convert_emission(const JsonObject& source, Material& m) {
    const auto extension = source.extension("KHR_materials_emissive_strength");
    const float strength = extension ? extension->number_in("emissiveStrength", 1.0f, 0.0f, most) : 1.0f;
    m.emission = source.color("emissiveFactor", glm::vec3(0.0f)) * strength;
    // What has no effect is not loaded, here and below.
    const bool emits = m.emission != glm::vec3(0.0f);
    m.emission_texture = texture(source, "emissiveTexture", Coding::emission, source, emits);
}

void GltfMaterials::convert_transmission(const JsonObject& source, Material& m) {
    if (const auto extension = source.extension("KHR_materials_transmission")) {
        m.transmission = static_cast<float>(extension->number("transmissionFactor", 0.0));
        if (extension->has("transmissionTexture")) {
            leave_out(scene_.left_out, "transmission textures", "the factor alone is used");
        }
    }
    const auto extension = source.extension("KHR_materials_diffuse_transmission");
    if (!extension) return;
    m.diffuse_transmission = static_cast<float>(extension->number("diffuseTransmissionFactor", 0.0));
    const bool passes = m.diffuse_transmission != 0.0f;
    m.diffuse_transmission_color = extension->color("diffuseTransmissionColorFactor", glm::vec3(1.0f));
    m.diffuse_transmission_texture = texture(*extension, "diffuseTransmissionTexture", Coding::data, source, passes);
    const bool is_tinted = passes && m.diffuse_transmission_color != glm::vec3(0.0f);
    m.diffuse_transmission_color_texture = texture(*extension, "diffuseTransmissionColorTexture", Coding::color, source,
                                                   is_tinted);
}

void GltfMaterials::convert_normals(const JsonObject& source, Material& m) {
    if (!source.has("normalTexture")) return;
    m.normal_scale = static_cast<float>(source.object("normalTexture").number("scale", 1.0));
    try {
        m.normal_texture = texture(source, "normalTexture", Coding::data, source);
    } catch (const invalid_input& problem) {
        // Left out and not refused: without a normal map only small relief is missing.
        leave_out(scene_.left_out, std::string("a normal map (") + problem.what() + ")", "it cannot be read");
    }
}

TextureUse GltfMaterials::texture(const JsonObject& owner, const char* key, Coding coding, const JsonObject& material,
                                  bool wanted) {
    const nlohmann::json* json = owner.find(key);
    if (!json) return {};
    const std::string name = material.name() + ": " + key;
    static const nlohmann::json nothing = nlohmann::json::object();
    const JsonObject info(json->is_object() ? *json : nothing, name);
    const auto whole = [&](const char* member) {
        try {
            return info.index(member);
        } catch (const invalid_input&) {
            throw invalid_input(name + ": its " + member + " is not a whole number of at least 0; correct it");
        }
    };
    const auto index = whole("index");
    if (!index) throw invalid_input(name + ": its index is missing; correct it");
    const std::size_t own_set = whole("texCoord").value_or(0);
    const auto transform = texture_transform(info, material);
    const UvTransform uv = transform ? transform_of(*transform) : UvTransform();
    const std::size_t set = transform ? transform->whole_number("texCoord", own_set) : own_set;
    if (!wanted) {
        unwanted_.emplace(*index, std::string(key) + " has no effect where its factor is 0");
        return {};
    }
    try {
        return {load(*index, coding), uv_set(set), uv};
    } catch (const invalid_input& problem) { throw invalid_input(name + ": " + problem.what()); }
}

std::uint32_t GltfMaterials::uv_set(std::size_t number) {
    const auto found = std::find(uv_sets_.begin(), uv_sets_.end(), number);
    const auto place = static_cast<std::uint32_t>(found - uv_sets_.begin());
    if (found == uv_sets_.end()) uv_sets_.push_back(number);
    return place;
}

int GltfMaterials::load(std::size_t index, Coding coding) {
    const auto known = textures_.find({index, coding});
    if (known != textures_.end()) return known->second;
    const JsonObject source = document_.element("textures", index, "texture");
    const auto image = source.index("source");
    if (!image) {
        source.fail(source.has("extensions")
                        ? "its only image is of a kind that cannot be read; export it as PNG or JPEG"
                        : "it has no image; the file is damaged");
    }
    Texture texture = read_image(*image, coding);
    if (const auto sampler_index = source.index("sampler")) {
        const JsonObject sampler = document_.element("samplers", *sampler_index, "sampler");
        texture.wrap_u = wrap_mode(sampler, "wrapS");
        texture.wrap_v = wrap_mode(sampler, "wrapT");
        if (sampler.whole_number("magFilter", 9729) == 9728) texture.filter = Texture::Filter::nearest;
    }
    const int place = static_cast<int>(scene_.textures.size());
    scene_.textures.push_back(std::move(texture));
    textures_.emplace(std::pair(index, coding), place);
    return place;
}

Texture GltfMaterials::read_image(std::size_t index, Coding coding) {
    const JsonObject image = document_.element("images", index, "image");
    used_images_.insert(index);
    const std::string name = name_of_image(image);
    const bool is_color = coding != Coding::data;
    const auto premultiplication = coding == Coding::emission ? Premultiplication::keep : Premultiplication::undo;
    Texture texture;
    if (image.has("bufferView")) {
        const std::string_view bytes = document_.view(image.needed("bufferView"));
        texture = texture_of_bytes(bytes, name, is_color, premultiplication);
    } else {
        if (!image.has("uri")) image.fail("it names no file; the scene is damaged");
        texture = texture_of_bytes(document_.resource(image.text("uri")), name, is_color, premultiplication);
    }
    if (coding == Coding::color || coding == Coding::data) clip_reflectance(texture, scene_.left_out);
    return texture;
}

/// Adds why the images that the JSON of a used material mentions have no effect.
void GltfMaterials::note_references(const nlohmann::json& material, bool is_unlit,
                                    std::map<std::size_t, std::string>& why) const {
    std::vector<const nlohmann::json*> open{&material};
    while (!open.empty()) {
        const nlohmann::json& at = *open.back();
        open.pop_back();
        for (auto member = at.begin(); member != at.end(); ++member) {
            if (!member->is_object() || member.key() == "extras") continue;
            open.push_back(&*member);
            const auto index = member->find("index");
            const bool is_texture = member.key().ends_with("Texture") && index != member->end();
            if (!is_texture || !index->is_number_unsigned()) continue;
            const auto texture = index->get<std::size_t>();
            if (texture >= document_.count("textures")) continue;
            const auto note = [&](const nlohmann::json& source, const std::string& reason) {
                if (source.is_number_unsigned()) why.emplace(source.get<std::size_t>(), reason);
            };
            const nlohmann::json& json = document_.root().list("textures")[texture];
            if (const auto image = json.find("source"); image != json.end()) {
                const char* reason = is_unlit ? " of an unlit material has no effect" : " has no effect here";
                note(*image, excerpt(member.key()) + reason);
            }
            const auto extensions = json.find("extensions");
            if (extensions == json.end() || !extensions->is_object()) continue;
            for (auto each = extensions->begin(); each != extensions->end(); ++each) {
                if (!each->is_object() || !each->contains("source")) continue;
                note((*each)["source"], "images of " + excerpt(each.key()) + " cannot be read");
            }
        }
    }
}

void GltfMaterials::note_unused_images() const {
    std::map<std::size_t, std::string> why;
    for (const auto& [texture, reason] : unwanted_) {
        if (texture >= document_.count("textures")) continue;
        if (const auto image = document_.element("textures", texture, "texture").index("source")) {
            why.emplace(*image, reason);
        }
    }
    for (const auto& [index, place] : added_) {
        if (!index) continue;
        const bool is_unlit = scene_.materials[place].model == Material::Model::unlit;
        note_references(document_.root().list("materials")[*index], is_unlit, why);
    }
    for (std::size_t i = 0; i < document_.count("images"); ++i) {
        if (used_images_.contains(i)) continue;
        const JsonObject image = document_.element("images", i, "image");
        const auto known = why.find(i);
        leave_out(scene_.left_out, name_of_image(image),
                  known != why.end() ? known->second : "no material that is used refers to this image");
    }
}

}  // namespace render
