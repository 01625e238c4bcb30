#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "surface_colors.hpp"
#include "surface_geometry.hpp"

namespace render {

namespace {

constexpr int deepest_mirror = 8;
/// Leaves and panes in a row that one eye ray passes.
constexpr int most_layers = 64;
/// Parts of an eye ray that carry less are left out.
constexpr float smallest_weight = 1e-4f;
/// A metal smoother than this is a mirror; nothing reflects light of points more sharply.
constexpr float mirror_roughness = 0.02f;
constexpr float dielectric_reflectance = 0.04f;

/// Reflectance of a dielectric for unpolarised light; `eta`: index before over index behind the surface.
float fresnel(float cosine, float eta) {
    const float sine2 = eta * eta * (1.0f - cosine * cosine);
    if (sine2 >= 1.0f) return 1.0f;
    const float behind = std::sqrt(1.0f - sine2);
    const float across = (eta * cosine - behind) / (eta * cosine + behind);
    const float along = (cosine - eta * behind) / (cosine + eta * behind);
    return 0.5f * (across * across + along * along);
}

float schlick(float cosine) {
    const float m = 1.0f - glm::clamp(cosine, 0.0f, 1.0f);
    return m * m * m * m * m;
}

/// Part of an eye ray that is still to be followed.
struct Branch {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f};
    glm::vec3 weight{1.0f};
    float travelled = 0;
    int mirrors = 0;
    int layers = 0;
};

/// One place where a branch meets a surface: what goes on from there, and what reflects light there.
struct Encounter {
    const Branch& at;
    const SurfaceGeometry& surface;
    const SurfaceColors& colors;
    const Material& material;
    float distance;
    std::vector<Branch>& open;

    void go_on(Branch branch) const {
        const bool bright = std::max({branch.weight.x, branch.weight.y, branch.weight.z}) >= smallest_weight;
        if (bright && branch.mirrors <= deepest_mirror && branch.layers <= most_layers) open.push_back(branch);
    }
    void pass(const glm::vec3& share) const {
        go_on({surface.leave(at.direction), at.direction, at.weight * share, distance, at.mirrors, at.layers + 1});
    }
    void turn(const glm::vec3& direction, const glm::vec3& share) const {
        go_on({surface.leave(direction), direction, at.weight * share, distance, at.mirrors + 1, at.layers});
    }
    void mirror(const glm::vec3& share) const { turn(surface.reflect(at.direction), share); }
    float cosine() const { return -glm::dot(surface.shading_normal, at.direction); }

    /// Sets the lobes of `point`, which are black, and opens the branches of mirrors and glass.
    void meet(SurfacePoint& point) const {
        switch (material.model) {
            case Material::Model::mirror: mirror(colors.cover * colors.base); break;
            case Material::Model::glass: meet_glass(); break;
            case Material::Model::phong:
                point.diffuse = colors.base;
                point.specular = material.specular;
                point.shininess = material.exponent;
                point.model = SurfacePoint::Model::phong;
                break;
            case Material::Model::microfacet: meet_microfacets(point); break;
        }
    }

    void meet_glass() const {
        const float eta = surface.front ? 1.0f / material.ior : material.ior;
        const float reflected = fresnel(cosine(), eta);
        mirror(glm::vec3(colors.cover * reflected));
        if (reflected >= 1.0f) return;
        const float behind = std::sqrt(std::max(0.0f, 1.0f - eta * eta * (1.0f - cosine() * cosine())));
        const glm::vec3 refracted = eta * at.direction + (eta * cosine() - behind) * surface.shading_normal;
        turn(glm::normalize(refracted), colors.cover * (1.0f - reflected) * colors.base);
    }

    void meet_microfacets(SurfacePoint& point) const {
        const glm::vec3 facing = glm::mix(glm::vec3(dielectric_reflectance), colors.base, colors.metallic);
        const bool smooth = colors.roughness < mirror_roughness;
        if (smooth && colors.metallic >= 1.0f) {
            mirror(colors.cover * glm::mix(facing, glm::vec3(1.0f), schlick(cosine())));
            return;
        }
        if (colors.transmission > 0.0f) {
            // A thin pane: light goes straight on, and a smooth one also mirrors.
            const float reflected = glm::mix(dielectric_reflectance, 1.0f, schlick(cosine())) * colors.transmission;
            pass(colors.cover * (colors.transmission - reflected) * colors.base);
            if (smooth) mirror(glm::vec3(colors.cover * reflected));
        }
        point.diffuse = colors.base * (1.0f - colors.metallic) * (1.0f - colors.transmission);
        const bool mirrors_instead = smooth && colors.transmission > 0.0f;
        if (!mirrors_instead) point.specular = facing;
        const float roughness = std::max(colors.roughness, mirror_roughness);
        point.shininess = roughness * roughness;
        point.model = SurfacePoint::Model::microfacet;
    }
};

}  // namespace

EyeRaySeen SurfaceFinder::follow(const EyeRay& ray, std::uint32_t pixel, std::uint32_t sample,
                                 std::vector<SurfacePoint>& points) const {
    const glm::vec3 black(0.0f);
    EyeRaySeen seen;
    seen.depth = std::numeric_limits<float>::infinity();
    std::uint32_t vertex = 0;
    std::vector<Branch> open;
    open.push_back({ray.origin, ray.direction, glm::vec3(1.0f), 0.0f, 0, 0});
    for (bool first = true; !open.empty(); first = false) {
        const Branch at = open.back();
        open.pop_back();
        const auto hit = rays_.nearest(at.origin, at.direction);
        if (!hit) {
            seen.emitted += at.weight * scene_.background.radiance(at.direction);
            continue;
        }
        const SurfaceGeometry surface = surface_at(scene_, *hit, at.origin, at.direction);
        const Material& material = scene_.materials[scene_.triangle_material[hit->triangle]];
        const SurfaceColors colors = colors_at(scene_, hit->triangle, hit->u, hit->v);
        if (first) {
            seen.depth = hit->distance;
            seen.normal = surface.shading_normal;
        }
        const glm::vec3 weight = at.weight * colors.cover;
        if (surface.front || material.double_sided) seen.emitted += weight * colors.emission;

        const Encounter encounter{at, surface, colors, material, at.travelled + hit->distance, open};
        if (colors.cover < 1.0f) encounter.pass(glm::vec3(1.0f - colors.cover));
        SurfacePoint point;
        if (shade_ == Shade::full) {
            encounter.meet(point);
        } else {
            point.diffuse = colors.base;
        }
        if ((point.diffuse == black && point.specular == black) || weight == black) continue;
        if (point.specular == black) point.model = SurfacePoint::Model::lambert;
        point.position = surface.position;
        point.geometric_normal = surface.geometric_normal;
        point.shading_normal = surface.shading_normal;
        point.ray_origin = surface.leave(surface.geometric_normal);
        point.to_viewer = -at.direction;
        point.distance = encounter.distance;
        point.weight = weight;
        point.pixel = pixel;
        point.sample = sample;
        point.vertex = vertex++;
        points.push_back(point);
    }
    return seen;
}

}  // namespace render
