#include "gltf_texture_info.hpp"

#include <cmath>
#include <string>

#include <lightcuts/core/invalid_input.hpp>

namespace render {
namespace {

[[noreturn]] void refuse(const char* member, const char* wanted) {
    throw lightcuts::invalid_input(std::string("KHR_texture_transform: ") + member + " is not " + wanted +
                                   "; correct it");
}

double number(const tinygltf::Value& transform, const char* member) {
    if (!transform.Has(member)) return 0.0;
    const tinygltf::Value& value = transform.Get(member);
    if (!value.IsNumber()) refuse(member, "a number");
    return value.GetNumberAsDouble();
}

glm::dvec2 pair(const tinygltf::Value& transform, const char* member, double otherwise) {
    if (!transform.Has(member)) return glm::dvec2(otherwise);
    const tinygltf::Value& value = transform.Get(member);
    if (value.ArrayLen() != 2 || !value.Get(0).IsNumber() || !value.Get(1).IsNumber()) refuse(member, "two numbers");
    return {value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble()};
}

/// `key`: of the textureInfo.
int whole_number(const tinygltf::Value& info, const char* key, const char* member) {
    const tinygltf::Value& value = info.Get(member);
    if (!value.IsInt() || value.GetNumberAsInt() < 0) {
        throw lightcuts::invalid_input(std::string(key) + ": its " + member +
                                       " is not a whole number of at least 0; correct it");
    }
    return value.GetNumberAsInt();
}

}  // namespace

tinygltf::TextureInfo texture_info(const tinygltf::Value& extension, const char* key) {
    tinygltf::TextureInfo info;
    if (!extension.Has(key)) return info;
    const tinygltf::Value& value = extension.Get(key);
    info.index = whole_number(value, key, "index");
    if (value.Has("texCoord")) info.texCoord = whole_number(value, key, "texCoord");
    if (value.Has("extensions") && value.Get("extensions").IsObject()) {
        info.extensions = value.Get("extensions").Get<tinygltf::Value::Object>();
    }
    return info;
}

TextureUse texture_use(int tex_coord, const tinygltf::ExtensionMap& extensions) {
    TextureUse use{tex_coord, {}};
    const auto found = extensions.find("KHR_texture_transform");
    if (found == extensions.end()) return use;
    const tinygltf::Value& transform = found->second;
    const glm::dvec2 scale = pair(transform, "scale", 1.0);
    // Counter-clockwise as one sees it, v running downwards.
    const double turn = number(transform, "rotation");
    use.transform.u_axis = glm::vec2(glm::dvec2(std::cos(turn), -std::sin(turn)) * scale.x);
    use.transform.v_axis = glm::vec2(glm::dvec2(std::sin(turn), std::cos(turn)) * scale.y);
    use.transform.offset = glm::vec2(pair(transform, "offset", 0.0));
    if (transform.Has("texCoord")) {
        const tinygltf::Value& set = transform.Get("texCoord");
        if (!set.IsInt()) refuse("texCoord", "a whole number");
        use.uv_set = set.GetNumberAsInt();
    }
    return use;
}

}  // namespace render
