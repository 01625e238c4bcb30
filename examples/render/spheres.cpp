#include "spheres.hpp"

#include <span>
#include <string>

#include <lightcuts/core/invalid_input.hpp>

namespace render {

namespace {

constexpr std::size_t most_lights = 100'000'000;

}  // namespace

void add_sphere_lights(Scene& scene, std::size_t points, std::uint64_t seed) {
    if (points == 0) return;
    if (scene.spheres.size() > most_lights / points) {
        throw lightcuts::invalid_input(scene.name + ": " + std::to_string(points) + " points in each of " +
                                       std::to_string(scene.spheres.size()) +
                                       " spherical lights are too many lights; lower --area-points");
    }
    scene.sphere_points = lightcuts::sphere_lights(std::span<const lightcuts::SphereLight<>>(scene.spheres), points,
                                                   lightcuts::LowDiscrepancy{seed});
}

}  // namespace render
