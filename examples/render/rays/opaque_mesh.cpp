#include "rays/opaque_mesh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "motion.hpp"
#include "surfaces/surface_colors.hpp"

namespace render {

lightcuts::OccluderMesh opaque_mesh(const Scene& scene) {
    const std::vector<bool> passes = transmissive_materials(scene);
    return lightcuts::OccluderMesh(scene.triangles.size(), [&](std::size_t t) {
        const glm::uvec3& corners = scene.triangles[t];
        const bool hides = !passes[scene.triangle_material[t]] && motion_of(scene, corners.x) == nullptr;
        const glm::vec3& first = scene.positions[corners.x];
        return std::array{first, hides ? scene.positions[corners.y] : first,
                          hides ? scene.positions[corners.z] : first};
    });
}

}  // namespace render
