#include "surface_colors.hpp"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace render {

namespace {

const Material& material_of(const Scene& scene, std::uint32_t triangle) {
    return scene.materials[scene.triangle_material[triangle]];
}

const Texture& texture_of(const Scene& scene, int index) { return scene.textures[static_cast<std::size_t>(index)]; }

glm::vec4 texel(const Scene& scene, int texture, glm::vec2 uv) {
    return texture == no_texture ? glm::vec4(1.0f) : texture_of(scene, texture).sample(uv);
}

/// The base colour texture's colour and the alpha of whichever texture has it.
glm::vec4 base_texel(const Scene& scene, const Material& material, glm::vec2 uv) {
    glm::vec4 base = texel(scene, material.base_color_texture, material.base_color_uv(uv));
    if (material.alpha_texture != no_texture) base.a = texel(scene, material.alpha_texture, uv).a;
    return base;
}

glm::vec4 metallic_roughness_texel(const Scene& scene, const Material& material, glm::vec2 uv) {
    return texel(scene, material.metallic_roughness_texture, material.metallic_roughness_uv(uv));
}

float cover_of(const Material& material, float alpha) {
    switch (material.alpha) {
        case Material::Alpha::opaque: return 1.0f;
        case Material::Alpha::mask: return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
        case Material::Alpha::blend: return glm::clamp(alpha, 0.0f, 1.0f);
    }
    return 1.0f;
}

float smallest_alpha(const Scene& scene, const Material& material) {
    float smallest = 1.0f;
    const int texture = material.alpha_texture != no_texture ? material.alpha_texture : material.base_color_texture;
    if (texture != no_texture) {
        for (const glm::vec4& t : texture_of(scene, texture).texels) smallest = std::min(smallest, t.a);
    }
    return smallest * material.base_alpha;
}

/// Transmission acts on the part of a surface that is no metal; OBJ's glass has no metallic part.
float transmission_of(const Material& material, float metallic) {
    return glm::clamp(material.transmission * (1.0f - metallic), 0.0f, 1.0f);
}

}  // namespace

glm::vec2 uv_at(const Scene& scene, std::uint32_t triangle, float u, float v) {
    if (scene.uvs.empty()) return glm::vec2(0.0f);
    const glm::uvec3 t = scene.triangles[triangle];
    return (1.0f - u - v) * scene.uvs[t.x] + u * scene.uvs[t.y] + v * scene.uvs[t.z];
}

SurfaceColors colors_at(const Scene& scene, std::uint32_t triangle, float u, float v) {
    const Material& material = material_of(scene, triangle);
    const glm::vec2 uv = uv_at(scene, triangle, u, v);
    const glm::vec4 base = base_texel(scene, material, uv);
    const glm::vec4 metal_rough = metallic_roughness_texel(scene, material, uv);
    SurfaceColors colors;
    colors.base = material.base_color * glm::vec3(base);
    colors.cover = cover_of(material, material.base_alpha * base.a);
    colors.metallic = glm::clamp(material.metallic * metal_rough.b, 0.0f, 1.0f);
    colors.roughness = glm::clamp(material.roughness * metal_rough.g, 0.0f, 1.0f);
    colors.transmission = transmission_of(material, colors.metallic);
    if (material.diffuse_transmission > 0.0f) {
        const float share = texel(scene, material.diffuse_transmission_texture, material.diffuse_transmission_uv(uv)).a;
        colors.diffuse_transmission = glm::clamp(material.diffuse_transmission * share, 0.0f, 1.0f);
        colors.diffuse_transmission_color = material.diffuse_transmission_color *
                                            glm::vec3(texel(scene, material.diffuse_transmission_color_texture,
                                                            material.diffuse_transmission_color_uv(uv)));
    }
    colors.emission = emission_at(scene, triangle, u, v);
    return colors;
}

glm::vec3 emission_at(const Scene& scene, std::uint32_t triangle, float u, float v) {
    const Material& material = material_of(scene, triangle);
    if (material.emission_texture == no_texture) return material.emission;
    const glm::vec2 uv = material.emission_uv(uv_at(scene, triangle, u, v));
    return material.emission * glm::vec3(texel(scene, material.emission_texture, uv));
}

float cover_at(const Scene& scene, std::uint32_t triangle, float u, float v) {
    const Material& material = material_of(scene, triangle);
    if (material.alpha == Material::Alpha::opaque) return 1.0f;
    const glm::vec4 base = base_texel(scene, material, uv_at(scene, triangle, u, v));
    return cover_of(material, material.base_alpha * base.a);
}

glm::vec3 tint_at(const Scene& scene, std::uint32_t triangle, float u, float v) {
    const Material& material = material_of(scene, triangle);
    const glm::vec2 uv = uv_at(scene, triangle, u, v);
    const glm::vec4 base = base_texel(scene, material, uv);
    const float cover = cover_of(material, material.base_alpha * base.a);
    glm::vec3 passed(1.0f - cover);
    if (material.transmission > 0.0f) {
        const float metallic = material.metallic * metallic_roughness_texel(scene, material, uv).b;
        passed += cover * transmission_of(material, metallic) * material.base_color * glm::vec3(base);
    }
    return glm::min(passed, glm::vec3(1.0f));
}

std::vector<bool> transmissive_materials(const Scene& scene) {
    std::vector<bool> passes(scene.materials.size());
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const Material& material = scene.materials[i];
        passes[i] = material.transmission > 0.0f;
        if (!passes[i] && material.alpha != Material::Alpha::opaque) {
            passes[i] = cover_of(material, smallest_alpha(scene, material)) < 1.0f;
        }
    }
    return passes;
}

}  // namespace render
