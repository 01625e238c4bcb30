#include "surfaces/surface_lobes.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace render {

namespace {

/// A metal smoother than this is a mirror; nothing reflects light of points more sharply.
constexpr float mirror_roughness = 0.02f;

/// Reflectance of a dielectric for unpolarized light; `eta`: index before over index behind the surface.
float fresnel(float cosine, float eta) {
    const float sine2 = eta * eta * (1.0f - cosine * cosine);
    if (sine2 >= 1.0f) return 1.0f;
    const float behind = std::sqrt(1.0f - sine2);
    const float across = (eta * cosine - behind) / (eta * cosine + behind);
    const float along = (cosine - eta * behind) / (cosine + eta * behind);
    return 0.5f * (across * across + along * along);
}

/// One place where a ray meets a surface.
struct Encounter {
    const Material& material;
    const SurfaceColors& colors;
    const SurfaceGeometry& surface;
    const glm::vec3& direction;
    SurfaceResponse& response;

    void pass(const glm::vec3& share) const { response.add_delta_lobe({direction, share, true}); }
    void mirror(const glm::vec3& share) const { response.add_delta_lobe({surface.reflect(direction), share, false}); }
    float cosine() const { return -glm::dot(surface.shading_normal, direction); }

    void meet() const {
        SurfaceLobes& lobes = response.lobes;
        switch (material.model) {
            case Material::Model::unlit: break;
            case Material::Model::mirror: mirror(colors.opacity * colors.base); break;
            case Material::Model::glass: meet_glass(); break;
            case Material::Model::phong:
                lobes.diffuse = colors.base;
                lobes.specular = colors.specular;
                lobes.shininess = material.exponent;
                lobes.model = SurfaceLobes::Model::phong;
                break;
            case Material::Model::microfacet: meet_microfacets(lobes, colors.metallic >= 1.0f); break;
            case Material::Model::specular_glossiness: meet_microfacets(lobes, colors.base == glm::vec3(0.0f)); break;
        }
    }

    /// Schlick's, between normal and grazing incidence.
    glm::vec3 reflectance() const { return glm::mix(colors.specular, glm::vec3(colors.grazing), schlick(cosine())); }

    void meet_glass() const {
        const float eta = surface.front ? 1.0f / material.ior : material.ior;
        const float reflected = fresnel(cosine(), eta);
        mirror(glm::vec3(colors.opacity * reflected));
        if (reflected >= 1.0f) return;
        const float behind = std::sqrt(std::max(0.0f, 1.0f - eta * eta * (1.0f - cosine() * cosine())));
        const glm::vec3 refracted = eta * direction + (eta * cosine() - behind) * surface.shading_normal;
        response.add_delta_lobe({glm::normalize(refracted), colors.opacity * (1.0f - reflected) * colors.base, false});
    }

    void meet_microfacets(SurfaceLobes& lobes, bool is_metal) const {
        const bool smooth = colors.roughness < mirror_roughness;
        if (smooth && is_metal) {
            mirror(colors.opacity * reflectance());
            return;
        }
        if (colors.transmission > 0.0f) {
            // A thin pane: light goes straight on, and a smooth one also mirrors.
            const glm::vec3 reflected = reflectance() * colors.transmission;
            pass(colors.opacity * (colors.transmission - reflected) * colors.base);
            if (smooth) mirror(colors.opacity * reflected);
        }
        const float diffuse = (1.0f - colors.metallic) * (1.0f - colors.transmission);
        lobes.diffuse = colors.base * (diffuse * (1.0f - colors.diffuse_transmission));
        lobes.transmitted = colors.diffuse_transmission_color * (diffuse * colors.diffuse_transmission);
        const bool mirrors_instead = smooth && colors.transmission > 0.0f;
        if (!mirrors_instead) lobes.specular = colors.specular;
        lobes.grazing = colors.grazing;
        const float roughness = std::max(colors.roughness, mirror_roughness);
        lobes.shininess = roughness * roughness;
        lobes.model = SurfaceLobes::Model::microfacet;
    }
};

}  // namespace

float schlick(float cosine) {
    const float m = 1.0f - glm::clamp(cosine, 0.0f, 1.0f);
    return m * m * m * m * m;
}

SurfaceResponse response_of(const Material& material, const SurfaceColors& colors, const SurfaceGeometry& surface,
                            const glm::vec3& direction, Shade shade) {
    SurfaceResponse response;
    response.opacity = colors.opacity;
    const Encounter encounter{material, colors, surface, direction, response};
    if (colors.opacity < 1.0f) encounter.pass(glm::vec3(1.0f - colors.opacity));
    if (shade == Shade::full) {
        encounter.meet();
    } else if (material.model != Material::Model::unlit) {
        response.lobes.diffuse = colors.base;
    }
    if (response.lobes.specular == glm::vec3(0.0f)) response.lobes.model = SurfaceLobes::Model::lambert;
    return response;
}

}  // namespace render
