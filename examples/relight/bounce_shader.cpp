#include "bounce_shader.hpp"

#include <algorithm>
#include <cmath>
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

using render::SurfacePoint;

/// What a thread keeps between triangles.
struct BounceShader::Scratch {
    ClusterLights lights;
    std::vector<std::uint32_t> open;
};

BounceShader::BounceShader(const RelightFile& file, const Sites& sites, const SeenPoints& seen)
    : sites_(sites), seen_(seen), sides_(file.preparation().sides),
      cuts_(sites, seen,
            [&](std::uint32_t site, lightcuts::PiecewiseConstant<float>& cut) { file.read_bounce(site, cut); }) {}

void BounceShader::add(const BounceLight& light, const BounceOptions& options, const RelitOptions& lobes,
                       std::span<glm::vec3> radiance) const {
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(std::size_t{0}, cuts_.group_count(), [&](std::size_t group) {
        Scratch& scratch = scratches.local();
        merge(cuts_.group(group), light, options, scratch);
        for (const std::uint32_t i : cuts_.group(group)) {
            const SurfacePoint& point = seen_.points[i];
            if (sides_ == Sides::front && shows_back(sites_, point)) continue;
            radiance[i] += shade(point, light, lobes, scratch);
        }
    });
}

void BounceShader::merge(std::span<const std::uint32_t> points, const BounceLight& light, const BounceOptions& options,
                         Scratch& scratch) const {
    glm::vec3 middle(0.0f);
    for (const std::uint32_t i : points) middle += seen_.points[i].position / static_cast<float>(points.size());
    const lightcuts::ClusterTree& tree = light.patches().tree;
    const std::vector<PatchCluster>& clusters = light.patches().clusters;
    const float most = std::tan(options.cluster_angle);
    const auto is_wide = [&](std::uint32_t node) {
        return !tree.is_leaf(node) && clusters[node].radius > most * glm::distance(clusters[node].position, middle);
    };
    const glm::uvec3 corners = sites_.of_triangle[seen_.points[points.front()].triangle];
    ClusterLights& lights = scratch.lights;
    lights.clear();
    // Nodes below one piece of the light's cut are one cluster, unless they are wide together.
    const std::span<const lightcuts::Piece> pieces = light.cut().pieces();
    std::size_t piece = 0;
    std::uint32_t leaf_end = 0;
    lightcuts::merge(
        [&](std::uint32_t node, std::uint32_t leaves, float a, float b, float c, const glm::vec3&) {
            leaf_end += leaves;
            const std::uint32_t whole = pieces[piece].node();
            const bool is_alone = leaves >= tree.leaf_count(whole) || is_wide(whole);
            if ((a > 0.0f || b > 0.0f || c > 0.0f) && light.sum(node) != glm::vec3(0.0f)) {
                scratch.open.assign(1, node);
                while (!scratch.open.empty()) {
                    const std::uint32_t n = scratch.open.back();
                    scratch.open.pop_back();
                    if (is_alone && is_wide(n)) {
                        scratch.open.push_back(tree.left(n));
                        scratch.open.push_back(tree.right(n));
                        continue;
                    }
                    lights.add(n, clusters[n].position, light.sum(n), {a, b, c});
                    if (is_alone) lights.end_cluster_of_places(clusters[n].radius);
                }
            }
            if (leaf_end < pieces[piece].leaf_end()) return;
            if (!is_alone) lights.end_cluster_of_places(clusters[whole].radius);
            while (piece < pieces.size() && pieces[piece].leaf_end() <= leaf_end) ++piece;
        },
        cuts_.of_site(corners.x), cuts_.of_site(corners.y), cuts_.of_site(corners.z), light.cut());
    lights.finish();
}

glm::vec3 BounceShader::shade(const SurfacePoint& point, const BounceLight& light, const RelitOptions& lobes,
                              Scratch& scratch) const {
    const ClusterLights& lights = scratch.lights;
    const glm::vec3 corners = corner_weights(point), from = point.position;
    const glm::vec3 n = point.shading_normal, horizon = point.geometric_normal;
    glm::vec3 diffuse(0.0f);
    if (point.diffuse != glm::vec3(0.0f)) {
        diffuse += point.diffuse * lights.irradiance_from_places(corners, from, n, horizon);
    }
    if (point.transmitted != glm::vec3(0.0f)) {
        diffuse += point.transmitted * lights.irradiance_from_places(corners, from, -n, -horizon);
    }
    diffuse *= static_cast<float>(std::numbers::inv_pi);
    if (!is_glossy(point)) return diffuse;
    const Patches& patches = light.patches();
    const render::SurfaceMaterial material(GlossyLobe::alone(point));
    LitSum sum(material);
    const GlossyLobe lobe(point, lobes.gloss_detail);
    const auto view_of = [&](const glm::vec3& place, float radius) {
        const glm::vec3 way = place - from;
        const float distance = std::max(glm::length(way), 1e-30f);
        return SeenCluster{way / distance, std::atan(radius / distance)};
    };
    add_glossy_light(
        sum, lobe, lights, corners, patches.tree,
        [&](std::size_t i) { return view_of(lights.where(i), lights.radius(i)); },
        [&](std::uint32_t node) { return view_of(patches.clusters[node].position, patches.clusters[node].radius); },
        [&](std::uint32_t node) { return light.sum(node); }, scratch.open);
    return diffuse + sum.result();
}

}  // namespace relight
