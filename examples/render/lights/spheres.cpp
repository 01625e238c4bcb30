#include "lights/spheres.hpp"

#include <cmath>
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
                                                   lightcuts::ScrambledSobol{seed});
}

std::vector<lightcuts::OrientedPointLight<>> sphere_shells(const Scene& scene) {
    std::vector<lightcuts::OrientedPointLight<>> lights;
    lights.reserve(scene.sphere_points.size());
    const std::size_t each = scene.spheres.empty() ? 0 : scene.sphere_points.size() / scene.spheres.size();
    for (std::size_t i = 0; i < scene.sphere_points.size(); ++i) {
        const lightcuts::SpherePointLight<>& point = scene.sphere_points[i];
        const lightcuts::SphereLight<>& sphere = scene.spheres[point.sphere];
        // A spiral of the golden angle from pole to pole. Of the same flux: 4 pi of an omni light, pi of an oriented.
        const double y = 1.0 - (2.0 * static_cast<double>(i % each) + 1.0) / static_cast<double>(each);
        const double turn = static_cast<double>(i % each) * 2.399963229728653;
        const double across = std::sqrt(1.0 - y * y);
        const glm::vec3 normal(glm::dvec3(across * std::cos(turn), y, across * std::sin(turn)));
        lights.push_back({sphere.center + sphere.radius * normal, normal, 4.0f * point.intensity, {}});
    }
    return lights;
}

}  // namespace render
