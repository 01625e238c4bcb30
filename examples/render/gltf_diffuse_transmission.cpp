#include "gltf_diffuse_transmission.hpp"

#include <string>

#include <lightcuts/core/invalid_input.hpp>

#include "gltf_texture_info.hpp"

namespace render {
namespace {

[[noreturn]] void refuse(const std::string& member, const char* wanted) {
    throw lightcuts::invalid_input(member + " is not " + wanted + "; correct it");
}

glm::vec3 three_numbers(const tinygltf::Value& value, const char* member) {
    glm::vec3 v(0.0f);
    for (int i = 0; i < 3; ++i) {
        if (value.ArrayLen() != 3 || !value.Get(i).IsNumber()) refuse(member, "an array of three numbers");
        v[i] = static_cast<float>(value.Get(i).GetNumberAsDouble());
    }
    return v;
}

}  // namespace

GltfDiffuseTransmission diffuse_transmission(const tinygltf::ExtensionMap& of_material) {
    constexpr const char* name = "KHR_materials_diffuse_transmission";
    constexpr const char* factor = "diffuseTransmissionFactor";
    constexpr const char* color = "diffuseTransmissionColorFactor";
    GltfDiffuseTransmission result;
    const auto found = of_material.find(name);
    if (found == of_material.end()) return result;
    const tinygltf::Value& extension = found->second;
    if (!extension.IsObject()) refuse(name, "an object");
    if (extension.Has(factor)) {
        if (!extension.Get(factor).IsNumber()) refuse(factor, "a number");
        result.factor = static_cast<float>(extension.Get(factor).GetNumberAsDouble());
    }
    if (extension.Has(color)) result.color = three_numbers(extension.Get(color), color);
    result.texture = texture_info(extension, "diffuseTransmissionTexture");
    result.color_texture = texture_info(extension, "diffuseTransmissionColorTexture");
    return result;
}

}  // namespace render
