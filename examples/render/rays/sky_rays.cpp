#include "rays/sky_rays.hpp"

#include <cstddef>

#include <lightcuts/adapt/embree.hpp>

namespace render {

void SkyRays::look(const RayScene& rays, const glm::vec3& from, std::span<const glm::vec3> directions,
                   std::span<float> shares) {
    if (rays.transmissive()) {
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const glm::vec3 passed = rays.to_infinity(from, directions[i]);
            shares[i] = (passed.x + passed.y + passed.z) / 3.0f;
        }
        return;
    }
    queries_.resize(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i) queries_[i] = {from, 0, directions[i], 0, 0, true};
    lightcuts::EmbreeOracle(rays.embree_scene()).many(queries_, shares);
}

void SkyRays::look_at(const RayScene& rays, const glm::vec3& from, std::span<const glm::vec3> places,
                      std::span<float> shares) {
    if (rays.transmissive()) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            const glm::vec3 passed = rays.to_point(from, places[i]);
            shares[i] = (passed.x + passed.y + passed.z) / 3.0f;
        }
        return;
    }
    queries_.resize(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) queries_[i] = {from, 0, places[i], 0, 0, false};
    lightcuts::EmbreeOracle(rays.embree_scene(), 1.0f - RayScene::shadow_ray_end).many(queries_, shares);
}

}  // namespace render
