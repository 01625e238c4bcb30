#include "patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <oneapi/tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/piecewise/even_points.hpp>
#include <lightcuts/piecewise/tree_file.hpp>
#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/build/two_centers.hpp>
#include <lightcuts/tree/leaf_order.hpp>
#include <render/surfaces/surface_colors.hpp>
#include <render/surfaces/surface_geometry.hpp>
#include <render/surfaces/surface_lobes.hpp>
#include <render/tbb_executor.hpp>

namespace relight {

namespace {

constexpr std::uint64_t summaries_tag = 0x7061'7463'6865'73u;

std::vector<std::uint32_t> leaves_of(const lightcuts::ClusterTree& tree) {
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        if (tree.is_leaf(n)) leaves.push_back(n);
    }
    return leaves;
}

/// Fills in the nodes above the leaves.
void summarize(Patches& patches) {
    const lightcuts::ClusterTree& tree = patches.tree;
    const float own = std::sqrt(patches.area / static_cast<float>(std::numbers::pi));
    std::vector<glm::dvec3> sums(tree.size());
    std::size_t end = 0;  // leaves before the subtree's end
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        PatchCluster& cluster = patches.clusters[n];
        if (tree.is_leaf(n)) {
            sums[n] = glm::dvec3(cluster.position);
            cluster.radius = own;
            ++end;
            continue;
        }
        sums[n] = sums[tree.left(n)] + sums[tree.right(n)];
        const std::size_t count = tree.leaf_count(n);
        cluster.position = glm::vec3(sums[n] / static_cast<double>(count));
        float radius = 0.0f;
        for (std::size_t i = end - count; i < end; ++i) {
            radius = std::max(radius, glm::distance(cluster.position, patches[i].position));
        }
        cluster.radius = radius + own;
    }
}

/// The surface at a patch, seen from the side that it reflects on.
render::SurfaceGeometry surface_of(const PatchCluster& patch, const render::Scene& scene) {
    return render::surface_at(scene, {patch.triangle, patch.u, patch.v, 0.0f, 0.0f}, -patch.normal);
}

[[noreturn]] void refuse(const std::string& what) {
    throw lightcuts::invalid_input("tree of patches: " + what + "; prepare it anew");
}

}  // namespace

float Patches::solid_angle(std::size_t item, const glm::vec3& from, float clearance) const {
    const PatchCluster& patch = (*this)[item];
    const glm::vec3 way = from - patch.position;
    const float distance2 = glm::dot(way, way), along = glm::dot(way, patch.normal);
    if (!(along > clearance)) return 0.0f;
    // Half of the distance of neighbors in a hexagonal lattice.
    const float least = 0.5f * std::sqrt(area * 2.0f / std::sqrt(3.0f));
    const float height = std::max(along, least);
    const float square = distance2 - along * along + height * height;
    return area * height / (std::sqrt(square) * square);
}

Patches spread_patches(const render::Scene& scene, std::size_t points, Sides sides, std::uint64_t seed) {
    const lightcuts::EvenPoints even = lightcuts::even_points(
        scene.triangles.size(),
        [&](std::size_t t) {
            const glm::uvec3 corners = scene.triangles[t];
            return std::array{scene.positions[corners.x], scene.positions[corners.y], scene.positions[corners.z]};
        },
        points, seed);
    std::vector<PatchCluster> all;
    std::vector<lightcuts::OrientedItem> items;
    for (const lightcuts::SurfaceSample& p : even.points) {
        for (const float side : {1.0f, -1.0f}) {
            if (side < 0.0f && sides == Sides::front) continue;
            all.push_back({p.position, 0.0f, side * p.normal, p.triangle, p.u, p.v});
            items.push_back({p.position, side * p.normal, 1.0f});
        }
    }
    lightcuts::LeafOrder ordered = lightcuts::in_leaf_order(
        lightcuts::divide(items, lightcuts::TwoCenters{}, render::TbbExecutor{}));
    Patches patches;
    patches.tree = std::move(ordered.tree);
    patches.area = static_cast<float>(even.area);
    patches.leaves = leaves_of(patches.tree);
    patches.clusters.resize(patches.tree.size());
    for (std::size_t i = 0; i < all.size(); ++i) patches.clusters[patches.leaves[i]] = all[ordered.items[i]];
    summarize(patches);
    return patches;
}

SeenPoints points_of(const Patches& patches, const render::Scene& scene, render::Shade shade) {
    for (std::size_t i = 0; i < patches.size(); ++i) {
        if (patches[i].triangle >= scene.triangles.size()) refuse("is of a mesh with more triangles");
    }
    SeenPoints seen;
    seen.points.resize(patches.size());
    tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t i) {
        const PatchCluster& patch = patches[i];
        const render::SurfaceGeometry surface = surface_of(patch, scene);
        const render::SurfaceColors colors = render::colors_at(scene, patch.triangle, patch.u, patch.v);
        const render::Material& material = scene.materials[scene.triangle_material[patch.triangle]];
        const render::SurfaceLobes lobes = render::response_of(material, colors, surface, -patch.normal, shade).lobes;
        render::SurfacePoint& point = seen.points[i];
        point.diffuse = lobes.diffuse;
        point.transmitted = lobes.transmitted;
        point.position = surface.position;
        point.geometric_normal = surface.geometric_normal;
        point.shading_normal = surface.shading_normal;
        point.ray_origin = surface.leave(surface.geometric_normal);
        point.to_viewer = patch.normal;
        point.weight = glm::vec3(colors.opacity);
        point.triangle = patch.triangle;
        point.u = patch.u;
        point.v = patch.v;
    });
    return seen;
}

std::vector<glm::vec3> ray_ends(const Patches& patches, const render::Scene& scene) {
    std::vector<glm::vec3> ends;
    ends.reserve(patches.size());
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const render::SurfaceGeometry surface = surface_of(patches[i], scene);
        ends.push_back(surface.leave(surface.geometric_normal));
    }
    return ends;
}

std::vector<std::byte> to_bytes(const Patches& patches) {
    return lightcuts::tree_file(patches.tree, std::span<const PatchCluster>(patches.clusters), summaries_tag);
}

Patches read_patches(std::span<const std::byte> bytes, float area) {
    auto saved = lightcuts::read_tree<PatchCluster>(bytes, summaries_tag);
    if (saved.tree.empty() || !saved.tree.is_binary()) refuse("has no patches, or more than two parts a node");
    std::uint32_t next = 0;
    for (std::uint32_t n = 0; n < saved.tree.size(); ++n) {
        const PatchCluster& c = saved.summaries[n];
        const bool is_leaf = saved.tree.is_leaf(n);
        const glm::vec3 p = c.position;
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z) || !(c.radius >= 0.0f)) {
            refuse("node " + std::to_string(n) + " has no position, or no radius");
        }
        if (!is_leaf) continue;
        if (!(std::abs(glm::length(c.normal) - 1.0f) < 1e-3f && c.u >= 0.0f && c.v >= 0.0f && c.u + c.v <= 1.0f)) {
            refuse("node " + std::to_string(n) + " has no unit normal, or lies on no triangle");
        }
        if (saved.tree.item(n) != next++) refuse("its leaves are not in order");
    }
    Patches result{std::move(saved.tree), std::move(saved.summaries), {}, area};
    result.leaves = leaves_of(result.tree);
    return result;
}

}  // namespace relight
