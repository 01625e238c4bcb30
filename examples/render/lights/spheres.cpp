#include "lights/spheres.hpp"

#include <cmath>
#include <span>
#include <string>
#include <tuple>

#include <lightcuts/core/invalid_input.hpp>

namespace render {

namespace {

constexpr std::size_t most_lights = 100'000'000;

/// Number `i` of the `each` lights on the surface of `sphere`, which has as many inside, such as `point`.
lightcuts::OrientedPointLight<> shell_light(const lightcuts::SphereLight<>& sphere,
                                            const lightcuts::SpherePointLight<>& point, std::size_t i,
                                            std::size_t each) {
    // A spiral of the golden angle from pole to pole. Of the same flux: 4 pi of an omni light, pi of an oriented.
    const double y = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(each);
    const double turn = static_cast<double>(i) * 2.399963229728653;
    const double across = std::sqrt(1.0 - y * y);
    const glm::vec3 normal(glm::dvec3(across * std::cos(turn), y, across * std::sin(turn)));
    return {sphere.center + sphere.radius * normal, normal, 4.0f * point.intensity, {}};
}

/// How many of `points` each of `spheres` has.
template <class Spheres, class Points>
std::size_t points_of_each(const Spheres& spheres, const Points& points) {
    return spheres.empty() ? 0 : points.size() / spheres.size();
}

}  // namespace

void add_sphere_lights(Scene& scene, std::size_t points, std::uint64_t seed) {
    if (points == 0) return;
    LightsAtInstants& moving = scene.at_instants;
    const std::size_t spheres = scene.spheres.size() + moving.spheres.size();
    if (spheres > most_lights / points) {
        throw lightcuts::invalid_input(scene.name + ": " + std::to_string(points) + " points in each of " +
                                       std::to_string(spheres) +
                                       " spherical lights are too many lights; lower --area-points");
    }
    scene.sphere_points = lightcuts::sphere_lights(std::span<const lightcuts::SphereLight<>>(scene.spheres), points,
                                                   lightcuts::ScrambledSobol{seed});
    for (std::uint32_t i = 0; i < moving.spheres.size(); ++i) {
        const lightcuts::SphereLight<>& sphere = moving.spheres[i];
        for (lightcuts::SpherePointLight<>& point :
             lightcuts::sphere_lights(std::span(&sphere, 1), points, lightcuts::ScrambledSobol{seed})) {
            point.sphere = i;
            moving.sphere_points.push_back({point, moving.spheres[i].instant});
        }
    }
}

std::vector<lightcuts::OrientedPointLight<>> sphere_shells(const Scene& scene) {
    std::vector<lightcuts::OrientedPointLight<>> lights;
    lights.reserve(scene.sphere_points.size());
    const std::size_t each = points_of_each(scene.spheres, scene.sphere_points);
    for (std::size_t i = 0; i < scene.sphere_points.size(); ++i) {
        const lightcuts::SpherePointLight<>& point = scene.sphere_points[i];
        lights.push_back(shell_light(scene.spheres[point.sphere], point, i % each, each));
    }
    return lights;
}

std::vector<lightcuts::InstantLight<lightcuts::OrientedPointLight<>>> moving_sphere_shells(const Scene& scene) {
    const auto& [spheres, points] = std::tie(scene.at_instants.spheres, scene.at_instants.sphere_points);
    std::vector<lightcuts::InstantLight<lightcuts::OrientedPointLight<>>> lights;
    lights.reserve(points.size());
    const std::size_t each = points_of_each(spheres, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        lights.push_back({shell_light(spheres[points[i].sphere], points[i], i % each, each), points[i].instant});
    }
    return lights;
}

}  // namespace render
