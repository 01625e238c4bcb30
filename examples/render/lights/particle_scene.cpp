#include "lights/particle_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "bounding_box.hpp"
#include "surfaces/lobe_sampling.hpp"
#include "surfaces/surface_colors.hpp"
#include "surfaces/surface_geometry.hpp"
#include "surfaces/surface_material.hpp"

namespace render {

namespace {

SurfacePoint point_of(const ParticleScene::Hit& met, const glm::vec3& direction) {
    SurfacePoint point;
    static_cast<SurfaceLobes&>(point) = met.response.lobes;
    point.position = met.surface.position;
    point.geometric_normal = met.surface.geometric_normal;
    point.shading_normal = met.surface.shading_normal;
    point.to_viewer = -direction;
    return point;
}

/// About the albedo of all lobes seen from `-direction`, and what goes on as rays.
glm::vec3 albedo_of(const ParticleScene::Hit& met, const glm::vec3& direction) {
    const SurfaceLobes& lobes = met.response.lobes;
    glm::vec3 gloss = lobes.specular;
    if (lobes.model == SurfaceLobes::Model::microfacet) {
        gloss = glm::mix(gloss, glm::vec3(lobes.grazing), schlick(-glm::dot(met.surface.shading_normal, direction)));
    }
    glm::vec3 sum = met.response.opacity * (lobes.diffuse + gloss + lobes.transmitted);
    for (const DeltaLobe& way : met.response.delta_lobes()) sum += way.share;
    return sum;
}

}  // namespace

ParticleScene::ParticleScene(const Scene& scene, const RayScene& rays, Shade shade)
    : scene_(scene), rays_(rays), shade_(shade) {
    for (const glm::uvec3& triangle : scene.triangles) {
        for (int i = 0; i < 3; ++i) bounds_ = merge(bounds_, lightcuts::box_of(scene.positions[triangle[i]]));
    }
    for (const MovingVertices& part : scene.moving) bounds_ = merge(bounds_, bounding_box(part.positions));
}

std::optional<ParticleScene::Hit> ParticleScene::intersect(const glm::vec3& origin, const glm::vec3& direction) const {
    const auto hit = rays_.nearest(origin, direction, time_);
    if (!hit) return std::nullopt;
    const Material& material = scene_.materials[scene_.triangle_material[hit->triangle]];
    const SurfaceColors colors = colors_at(scene_, hit->triangle, hit->u, hit->v);
    std::optional<Hit> result(std::in_place);
    Hit& met = *result;
    met.surface = surface_at(scene_, *hit, direction);
    met.response = response_of(material, colors, met.surface, direction, shade_);
    met.normal = met.surface.geometric_normal;
    met.position = met.surface.leave(met.normal);
    met.position_behind = met.surface.leave(-met.normal);
    return result;
}

glm::vec3 ParticleScene::diffuse_albedo(const Hit& met) const {
    return glm::min(met.response.opacity * met.response.lobes.diffuse, glm::vec3(1.0f));
}

glm::vec3 ParticleScene::diffuse_transmittance(const Hit& met) const {
    return glm::min(met.response.opacity * met.response.lobes.transmitted, glm::vec3(1.0f));
}

lightcuts::ScatteredParticle<> ParticleScene::scatter(const Hit& met, const glm::vec3& direction,
                                                      const glm::vec3& u) const {
    lightcuts::ScatteredParticle<> particle = draw(met, direction, u);
    // Lobes that add up to more than 1 would fill a room with ever more light.
    const glm::vec3 albedo = albedo_of(met, direction);
    particle.weight /= std::max({albedo.r, albedo.g, albedo.b, 1.0f});
    return particle;
}

lightcuts::ScatteredParticle<> ParticleScene::draw(const Hit& met, const glm::vec3& direction,
                                                   const glm::vec3& u) const {
    const LobeSampler lobes(met.response.lobes, met.surface.shading_normal, -direction);
    const double reflected = met.response.opacity * (lobes.diffuse_share() + lobes.gloss_share());
    const double transmitted = met.response.opacity * mean(met.response.lobes.transmitted);
    double all = reflected + transmitted;
    for (const DeltaLobe& way : met.response.delta_lobes()) all += mean(way.share);
    if (!(all > 0.0)) return {};

    double at = static_cast<double>(u.z) * all;
    for (const DeltaLobe& way : met.response.delta_lobes()) {
        const double share = mean(way.share);
        if (at < share) {
            const auto scale = static_cast<float>(all / share);
            return {met.surface.leave(way.direction), way.direction, way.share * scale};
        }
        at -= share;
    }
    if (at < transmitted) {
        const glm::vec3 way(-lobes.diffuse(glm::dvec2(u)));
        if (!(glm::dot(way, met.normal) < 0.0f)) return {};
        const auto scale = static_cast<float>(met.response.opacity * all / transmitted);
        return {met.position_behind, way, met.response.lobes.transmitted * scale};
    }
    at -= transmitted;
    if (!(reflected > 0.0)) return {};
    const double diffuse_probability = lobes.diffuse_share() / (lobes.diffuse_share() + lobes.gloss_share());
    const glm::dvec2 uv(u);
    const glm::dvec3 way = at < diffuse_probability * reflected ? lobes.diffuse(uv) : lobes.glossy(uv);
    if (!(glm::dot(glm::vec3(way), met.normal) > 0.0f)) return {};
    const double density = lobes.density(way, diffuse_probability) * reflected / all;
    const glm::vec3 value = met.response.opacity * SurfaceMaterial(point_of(met, direction)).evaluate(glm::vec3(way));
    if (value == glm::vec3(0.0f) || !(density > 0.0)) return {};
    return {met.position, glm::vec3(way), value * static_cast<float>(1.0 / density)};
}

double FoggyParticleScene::free_flight(const glm::vec3& origin, const glm::vec3& direction, double u) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double way = -std::log1p(-u) / static_cast<double>(fog_.medium.extinction());
    if (!(way < fog_.medium.way_inside(origin, direction, infinity))) return infinity;
    return fog_.medium.way_before(origin, direction) + way;
}

}  // namespace render
