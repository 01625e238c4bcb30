#include "rays/sky_rays.hpp"

#include <cstddef>

#include <lightcuts/adapt/embree.hpp>

namespace render {

void SkyRays::look(const RayScene& rays, const glm::vec3& from, std::span<const glm::vec3> directions,
                   std::span<float> shares) {
    ask(rays, from, directions, true, shares);
}

void SkyRays::look_at(const RayScene& rays, const glm::vec3& from, std::span<const glm::vec3> places,
                      std::span<float> shares) {
    ask(rays, from, places, false, shares);
}

void SkyRays::ask(const RayScene& rays, const glm::vec3& from, std::span<const glm::vec3> to, bool distant,
                  std::span<float> shares) {
    if (rays.transmissive()) {
        for (std::size_t i = 0; i < to.size(); ++i) {
            const glm::vec3 passed = distant ? rays.to_infinity(from, to[i]) : rays.to_point(from, to[i]);
            shares[i] = (passed.x + passed.y + passed.z) / 3.0f;
        }
        return;
    }
    queries_.resize(to.size());
    for (std::size_t i = 0; i < to.size(); ++i) queries_[i] = {from, 0, to[i], 0, 0, distant};
    lightcuts::EmbreeOracle(rays.embree_scene(), 1.0f - RayScene::shadow_ray_end).many(queries_, shares);
}

}  // namespace render
