#include "surfaces/surface_colors.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace render {

namespace {

/// A point of a triangle, by its barycentric coordinates.
struct Spot {
    const Scene& scene;
    std::uint32_t triangle;
    float u;
    float v;

    const Material& material() const { return scene.materials[scene.triangle_material[triangle]]; }

    template <class T>
    T interpolate(const std::vector<T>& per_vertex) const {
        const glm::uvec3 t = scene.triangles[triangle];
        return (1.0f - u - v) * per_vertex[t.x] + u * per_vertex[t.y] + v * per_vertex[t.z];
    }

    glm::vec2 uv(std::uint32_t set) const {
        const bool is_there = set < scene.uv_sets.size() && !scene.uv_sets[set].empty();
        return is_there ? interpolate(scene.uv_sets[set]) : glm::vec2(0.0f);
    }

    glm::vec4 texel(const TextureUse& use) const {
        if (!use.is_there()) return glm::vec4(1.0f);
        return scene.textures[static_cast<std::size_t>(use.texture)].sample(use.uv(uv(use.uv_set)));
    }

    glm::vec4 vertex_color() const {
        return scene.colors.empty() ? glm::vec4(1.0f) : glm::clamp(interpolate(scene.colors), 0.0f, 1.0f);
    }

    /// Base color times vertex color, and the alpha of whichever texture has it.
    glm::vec4 base() const {
        const Material& m = material();
        glm::vec4 texel = this->texel(m.base_color_texture);
        if (m.alpha_texture.is_there()) texel.a = this->texel(m.alpha_texture).a;
        return glm::vec4(m.base_color, m.base_alpha) * texel * vertex_color();
    }

    float opacity() const {
        return material().alpha == Material::Alpha::opaque ? 1.0f : opacity_of_alpha(material(), base().a);
    }
};

float smallest_texture_alpha(const Scene& scene, const TextureUse& use) {
    float smallest = 1.0f;
    if (use.is_there()) {
        for (const glm::vec4& t : scene.textures[static_cast<std::size_t>(use.texture)].texels) {
            smallest = std::min(smallest, t.a);
        }
    }
    return smallest;
}

float smallest_vertex_alpha(const Scene& scene) {
    float smallest = 1.0f;
    for (const glm::vec4& color : scene.colors) smallest = std::min(smallest, color.a);
    return smallest;
}

/// Transmission acts on the part of a surface that is no metal; OBJ's glass has no metallic part.
float transmission_of(const Material& material, float metallic) {
    return glm::clamp(material.transmission * (1.0f - metallic), 0.0f, 1.0f);
}

/// Of a dielectric at normal incidence; `ior` 0 stands for infinity.
float dielectric_reflectance(float ior) {
    if (ior == 0.0f) return 1.0f;
    const double ratio = (static_cast<double>(ior) - 1.0) / (static_cast<double>(ior) + 1.0);
    return static_cast<float>(ratio * ratio);
}

/// KHR_materials_specular for the dielectric part; metals reflect their base color.
void set_microfacet_reflectance(const Spot& spot, SurfaceColors& colors) {
    const Material& m = spot.material();
    const float weight = m.specular_weight * spot.texel(m.specular_weight_texture).a;
    const glm::vec3 tint = m.specular_tint * glm::vec3(spot.texel(m.specular_texture));
    const glm::vec3 facing = glm::min(dielectric_reflectance(m.ior) * tint, glm::vec3(1.0f)) * weight;
    colors.specular = glm::mix(facing, colors.base, colors.metallic);
    colors.grazing = glm::mix(weight, 1.0f, colors.metallic);
}

}  // namespace

float opacity_of_alpha(const Material& material, float alpha) {
    switch (material.alpha) {
        case Material::Alpha::opaque: return 1.0f;
        case Material::Alpha::mask: return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
        case Material::Alpha::blend: return glm::clamp(alpha, 0.0f, 1.0f);
    }
    return 1.0f;
}

glm::vec4 texel_at(const Scene& scene, const TextureUse& use, std::uint32_t triangle, float u, float v) {
    return Spot{scene, triangle, u, v}.texel(use);
}

SurfaceColors colors_at(const Scene& scene, std::uint32_t triangle, float u, float v) {
    const Spot spot{scene, triangle, u, v};
    const Material& material = spot.material();
    const glm::vec4 base = spot.base();
    SurfaceColors colors;
    colors.base = glm::vec3(base);
    colors.opacity = opacity_of_alpha(material, base.a);
    switch (material.model) {
        case Material::Model::microfacet: {
            const glm::vec4 metal_rough = spot.texel(material.metallic_roughness_texture);
            colors.metallic = glm::clamp(material.metallic * metal_rough.b, 0.0f, 1.0f);
            colors.roughness = glm::clamp(material.roughness * metal_rough.g, 0.0f, 1.0f);
            set_microfacet_reflectance(spot, colors);
            break;
        }
        case Material::Model::specular_glossiness: {
            const glm::vec4 texel = spot.texel(material.specular_texture);
            colors.specular = material.specular * glm::vec3(texel);
            colors.roughness = 1.0f - (1.0f - material.roughness) * texel.a;
            // What is reflected at the surface does not get below it.
            colors.base *= std::max(1.0f - std::max({colors.specular.r, colors.specular.g, colors.specular.b}), 0.0f);
            break;
        }
        case Material::Model::phong:
            colors.specular = material.specular * glm::vec3(spot.texel(material.specular_texture));
            break;
        case Material::Model::unlit:
        case Material::Model::mirror:
        case Material::Model::glass: break;
    }
    colors.transmission = transmission_of(material, colors.metallic);
    if (material.diffuse_transmission > 0.0f) {
        const float share = spot.texel(material.diffuse_transmission_texture).a;
        colors.diffuse_transmission = glm::clamp(material.diffuse_transmission * share, 0.0f, 1.0f);
        colors.diffuse_transmission_color = material.diffuse_transmission_color *
                                            glm::vec3(spot.texel(material.diffuse_transmission_color_texture));
    }
    return colors;
}

glm::vec3 emitted_radiance(const Scene& scene, std::uint32_t triangle, float u, float v, bool front) {
    const Spot spot{scene, triangle, u, v};
    const Material& material = spot.material();
    if (material.emission == glm::vec3(0.0f) || !(front || material.double_sided)) return glm::vec3(0.0f);
    glm::vec3 radiance = material.emission * glm::vec3(spot.texel(material.emission_texture));
    if (material.model == Material::Model::unlit) radiance *= glm::vec3(spot.vertex_color());
    return radiance * spot.opacity();
}

bool has_varying_emission(const Scene& scene, const Material& material) {
    if (material.emission_texture.is_there()) return true;
    const bool is_unlit = material.model == Material::Model::unlit;
    if (material.alpha == Material::Alpha::opaque) return is_unlit && !scene.colors.empty();
    return material.base_color_texture.is_there() || material.alpha_texture.is_there() || !scene.colors.empty();
}

float opacity_at(const Scene& scene, std::uint32_t triangle, float u, float v) {
    return Spot{scene, triangle, u, v}.opacity();
}

glm::vec3 tint_at(const Scene& scene, std::uint32_t triangle, float u, float v) {
    const Spot spot{scene, triangle, u, v};
    const Material& material = spot.material();
    const glm::vec4 base = spot.base();
    const float opacity = opacity_of_alpha(material, base.a);
    glm::vec3 passed(1.0f - opacity);
    if (material.transmission > 0.0f) {
        const float metallic = material.metallic * spot.texel(material.metallic_roughness_texture).b;
        passed += opacity * transmission_of(material, metallic) * glm::vec3(base);
    }
    return glm::min(passed, glm::vec3(1.0f));
}

std::vector<bool> transmissive_materials(const Scene& scene) {
    const float vertex_alpha = smallest_vertex_alpha(scene);
    std::vector<bool> passes(scene.materials.size());
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const Material& material = scene.materials[i];
        passes[i] = material.transmission > 0.0f;
        if (!passes[i] && material.alpha != Material::Alpha::opaque) {
            const TextureUse& use = material.alpha_texture.is_there() ? material.alpha_texture
                                                                      : material.base_color_texture;
            const float alpha = material.base_alpha * smallest_texture_alpha(scene, use) * vertex_alpha;
            passes[i] = opacity_of_alpha(material, alpha) < 1.0f;
        }
    }
    return passes;
}

}  // namespace render
