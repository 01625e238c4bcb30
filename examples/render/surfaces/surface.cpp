#include "surfaces/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <lightcuts/core/random.hpp>

#include "shutter.hpp"
#include "surfaces/fog_points.hpp"
#include "surfaces/surface_colors.hpp"
#include "surfaces/surface_geometry.hpp"

namespace render {

namespace {

constexpr int deepest_mirror = 8;
/// Leaves and panes in a row that one eye ray passes.
constexpr int most_layers = 64;
/// Parts of an eye ray that carry less are left out.
constexpr float smallest_weight = 1e-4f;

/// Part of an eye ray that is still to be followed.
struct Branch {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f};
    glm::vec3 weight{1.0f};
    float traveled = 0;
    int mirrors = 0;
    int layers = 0;
};

/// Where `way` leads from the surface that `at` met at `distance` from the eye.
Branch continued(const Branch& at, const SurfaceGeometry& surface, const DeltaLobe& way, float distance) {
    const int step = way.passes ? 1 : 0;
    return {surface.leave(way.direction), way.direction,   at.weight * way.share, distance,
            at.mirrors + 1 - step,        at.layers + step};
}

bool is_worth_following(const Branch& branch) {
    const bool bright = std::max({branch.weight.x, branch.weight.y, branch.weight.z}) >= smallest_weight;
    return bright && branch.mirrors <= deepest_mirror && branch.layers <= most_layers;
}

}  // namespace

std::uint32_t receiver_name(const Scene& scene, const SurfacePoint& point) {
    const std::uint64_t name = lightcuts::hash_keys(point.pixel, point.sample, point.vertex);
    return name_with_instant(static_cast<std::uint32_t>(name), point.instant, scene.instants.size());
}

EyeRaySeen EyePathTracer::follow(const EyeRay& ray, std::uint32_t pixel, std::uint32_t sample,
                                 std::vector<SurfacePoint>& points) const {
    return follow_until(ray, pixel, sample, points, [this](const glm::vec3& direction, const glm::vec3& weight) {
        return weight * scene_.background.radiance(direction);
    });
}

EyeRaySeen EyePathTracer::follow(const EyeRay& ray, std::uint32_t pixel, std::uint32_t sample,
                                 std::vector<SurfacePoint>& points, std::vector<Escape>& escapes) const {
    return follow_until(ray, pixel, sample, points, [&](const glm::vec3& direction, const glm::vec3& weight) {
        escapes.push_back({direction, weight, pixel});
        return glm::vec3(0.0f);
    });
}

/// `background(direction, weight)`: radiance that a part of the ray of that weight gets where there is no surface.
template <class Background>
EyeRaySeen EyePathTracer::follow_until(const EyeRay& ray, std::uint32_t pixel, std::uint32_t sample,
                                       std::vector<SurfacePoint>& points, Background&& background) const {
    EyeRaySeen seen;
    seen.depth = std::numeric_limits<float>::infinity();
    std::uint32_t vertex = 0;
    const float time = scene_.is_still() ? 0.0f : scene_.instants[ray.instant];
    std::vector<Branch> open;
    open.push_back({ray.origin, ray.direction, glm::vec3(1.0f), 0.0f, 0, 0});
    for (bool first = true; !open.empty(); first = false) {
        Branch at = open.back();
        open.pop_back();
        const auto hit = rays_.nearest(at.origin, at.direction, time);
        if (scene_.fog.is_there()) {
            const float length = hit ? hit->distance : std::numeric_limits<float>::infinity();
            const RaySegment segment{at.origin, at.direction, length, at.traveled,
                                     at.weight, pixel,        sample, ray.instant};
            at.weight *= add_fog_points(scene_.fog, segment, vertex, points);
        }
        if (!hit) {
            seen.emitted += background(at.direction, at.weight);
            continue;
        }
        const SurfaceGeometry surface = surface_at(scene_, *hit, at.direction);
        const Material& material = scene_.materials[scene_.triangle_material[hit->triangle]];
        const SurfaceColors colors = colors_at(scene_, hit->triangle, hit->u, hit->v);
        if (first) {
            seen.depth = hit->distance;
            seen.normal = surface.shading_normal;
        }
        const glm::vec3 weight = at.weight * colors.opacity;
        seen.emitted += at.weight * emitted_radiance(scene_, hit->triangle, hit->u, hit->v, surface.front);

        const float distance = at.traveled + hit->distance;
        const SurfaceResponse response = response_of(material, colors, surface, at.direction, shade_);
        for (const DeltaLobe& way : response.delta_lobes()) {
            const Branch branch = continued(at, surface, way, distance);
            if (is_worth_following(branch)) open.push_back(branch);
        }
        if (response.lobes.is_black() || weight == glm::vec3(0.0f)) continue;
        SurfacePoint point;
        static_cast<SurfaceLobes&>(point) = response.lobes;
        point.position = surface.position;
        point.geometric_normal = surface.geometric_normal;
        point.shading_normal = surface.shading_normal;
        point.ray_origin = surface.leave(surface.geometric_normal);
        point.to_viewer = -at.direction;
        point.distance = distance;
        point.weight = weight;
        point.pixel = pixel;
        point.sample = sample;
        point.vertex = vertex++;
        point.instant = ray.instant;
        point.triangle = hit->triangle;
        point.u = hit->u;
        point.v = hit->v;
        points.push_back(point);
    }
    return seen;
}

}  // namespace render
