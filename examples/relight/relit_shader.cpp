#include "relit_shader.hpp"

#include <algorithm>
#include <numbers>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <lightcuts/piecewise/merge.hpp>
#include <render/surfaces/surface_material.hpp>

#include "cluster_lights.hpp"
#include "glossy_light.hpp"
#include "glossy_lobe.hpp"
#include "lit_sum.hpp"

namespace relight {

namespace {

using render::SurfacePoint;

}  // namespace

/// What a thread keeps between triangles.
struct RelitShader::Scratch {
    ClusterLights lights;
    std::vector<std::uint32_t> open;
    RelitStatistics statistics;
};

RelitShader::RelitShader(const RelightFile& file, const Sites& sites, const SeenPoints& seen)
    : sites_(sites), seen_(seen), sides_(file.preparation().sides),
      cuts_(sites, seen, [&](std::uint32_t site, lightcuts::PiecewiseConstant<float>& cut) { file.read(site, cut); }) {}

RelitStatistics RelitShader::shade(const Illumination& light, const RelitOptions& options,
                                   std::span<glm::vec3> radiance) const {
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(std::size_t{0}, cuts_.group_count(), [&](std::size_t group) {
        Scratch& scratch = scratches.local();
        const std::span<const std::uint32_t> points = cuts_.group(group);
        merge(points, light, scratch);
        ++scratch.statistics.triangles;
        scratch.statistics.nodes += scratch.lights.node_count();
        scratch.statistics.clusters += scratch.lights.size() * points.size();
        for (const std::uint32_t i : points) {
            const SurfacePoint& point = seen_.points[i];
            const bool is_dark = sides_ == Sides::front && shows_back(sites_, point);
            radiance[i] = is_dark ? glm::vec3(0.0f) : shade(point, light, options, scratch);
            scratch.statistics.backs += is_dark ? 1 : 0;
        }
    });
    RelitStatistics sum;
    for (const Scratch& scratch : scratches) {
        sum.triangles += scratch.statistics.triangles;
        sum.nodes += scratch.statistics.nodes;
        sum.clusters += scratch.statistics.clusters;
        sum.directions += scratch.statistics.directions;
        sum.glossy += scratch.statistics.glossy;
        sum.backs += scratch.statistics.backs;
    }
    return sum;
}

void RelitShader::merge(std::span<const std::uint32_t> points, const Illumination& light, Scratch& scratch) const {
    const SurfacePoint& first = seen_.points[points.front()];
    // Of a triangle that is seen from one side, and lets nothing through, what is below it lights none of its points.
    const bool has_horizon = std::all_of(points.begin(), points.end(), [&](std::uint32_t i) {
        const SurfacePoint& point = seen_.points[i];
        return point.transmitted == glm::vec3(0.0f) && glm::dot(point.geometric_normal, first.geometric_normal) > 0.0f;
    });
    const glm::vec3 up = has_horizon ? first.geometric_normal : glm::vec3(0.0f);
    const glm::uvec3 corners = sites_.of_triangle[first.triangle];
    ClusterLights& lights = scratch.lights;
    lights.clear();
    // Where the illumination's current piece ends, and how wide it is: nodes below one piece are one cluster.
    const std::span<const lightcuts::Piece> pieces = light.cut().pieces();
    std::size_t piece = 0;
    std::uint32_t leaf_end = 0;
    float radius = 0.0f;
    lightcuts::merge(
        [&](std::uint32_t node, std::uint32_t leaves, float a, float b, float c, const glm::vec3&) {
            leaf_end += leaves;
            const Illumination::Light& at = light.light(node);
            radius = std::max(radius, at.radius);
            const bool is_dark = a == 0.0f && b == 0.0f && c == 0.0f;
            if (!is_dark && !(glm::dot(up, at.direction) < -at.radius))
                lights.add(node, at.direction, at.power, {a, b, c});
            if (leaf_end < pieces[piece].leaf_end()) return;
            radius = std::max(radius, light.light(pieces[piece].node()).radius);
            lights.end_cluster(radius);
            radius = 0.0f;
            while (piece < pieces.size() && pieces[piece].leaf_end() <= leaf_end) ++piece;
        },
        cuts_.of_site(corners.x), cuts_.of_site(corners.y), cuts_.of_site(corners.z), light.cut());
    scratch.lights.finish();
}

glm::vec3 RelitShader::shade(const SurfacePoint& point, const Illumination& light, const RelitOptions& options,
                             Scratch& scratch) const {
    const ClusterLights& lights = scratch.lights;
    const glm::vec3 corners = corner_weights(point);
    const glm::vec3 n = point.shading_normal, horizon = point.geometric_normal;
    glm::vec3 diffuse(0.0f);
    if (point.diffuse != glm::vec3(0.0f)) diffuse += point.diffuse * lights.irradiance(corners, n, horizon);
    if (point.transmitted != glm::vec3(0.0f)) {
        diffuse += point.transmitted * lights.irradiance(corners, -n, -horizon);
    }
    diffuse *= static_cast<float>(std::numbers::inv_pi);
    if (!is_glossy(point)) return diffuse;
    ++scratch.statistics.glossy;
    const render::SurfaceMaterial material(GlossyLobe::alone(point));
    LitSum sum(material);
    const GlossyLobe lobe(point, options.gloss_detail);
    add_glossy_light(
        sum, lobe, lights, corners, light.directions().tree,
        [&](std::size_t i) {
            return SeenCluster{lights.where(i), lights.radius(i)};
        },
        [&](std::uint32_t node) {
            return SeenCluster{light.light(node).direction, light.light(node).radius};
        },
        [&](std::uint32_t node) { return light.light(node).power; }, scratch.open);
    const glm::vec3 result = sum.result();
    scratch.statistics.directions += sum.evaluated();
    return diffuse + result;
}

}  // namespace relight
