#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/tree/cluster_tree.hpp>
#include <render/scene.hpp>

#include "seen_points.hpp"
#include "site_sky.hpp"

namespace relight {

/// What is known of a node of a tree over patches.
struct PatchCluster {
    glm::vec3 position{0.0f};    ///< mean of those below
    float radius = 0.0f;         ///< largest distance between it and them, plus the radius of a disc of their area
    glm::vec3 normal{0.0f};      ///< of a leaf: unit, on the side that it reflects on
    std::uint32_t triangle = 0;  ///< of a leaf
    float u = 0.0f, v = 0.0f;    ///< of a leaf: barycentric, of the triangle's second and third corner

    bool operator==(const PatchCluster&) const = default;
};

/// Small pieces of the surface of a mesh, all of one area, and a tree over them. Item i is the i-th leaf from the left.
struct Patches {
    lightcuts::ClusterTree tree;
    std::vector<PatchCluster> clusters;  ///< by node
    std::vector<std::uint32_t> leaves;   ///< nodes, by item
    float area = 0.0f;                   ///< of each

    std::size_t size() const { return leaves.size(); }
    bool empty() const { return leaves.empty(); }
    const PatchCluster& operator[](std::size_t item) const { return clusters[leaves[item]]; }

    /// Solid angle of patch `item` at `from`. A place nearer to its plane than half of what patches are apart is taken
    /// to be as far: so all patches of a plane together fill half of the sphere from any place before it, and none is
    /// ever above 3.5 steradians. 0 from less than `clearance` before its plane, where rounding decides what is seen of
    /// it, and from behind.
    float solid_angle(std::size_t item, const glm::vec3& from, float clearance) const;
};

/// Spreads `points` places evenly over the surface of `scene`: each is a patch a side. pre: points > 0.
/// throws: invalid_input if the mesh has no area. threads: those of the calling arena.
Patches spread_patches(const render::Scene& scene, std::size_t points, Sides sides, std::uint64_t seed);

/// The patches as points to be shaded, by item, with the diffuse parts of their materials alone; weights are opacities.
/// throws: invalid_input if one lies on a triangle that there is not.
SeenPoints points_of(const Patches& patches, const render::Scene& scene, render::Shade shade);

/// By item, where rays to a patch end: off the surface, on the side that it reflects on.
std::vector<glm::vec3> ray_ends(const Patches& patches, const render::Scene& scene);

/// The bytes of a file of them, and what is in one. throws: invalid_input, one line, if it is damaged, or of a mesh
/// with other triangles.
std::vector<std::byte> to_bytes(const Patches& patches);
Patches read_patches(std::span<const std::byte> bytes, float area);

}  // namespace relight
