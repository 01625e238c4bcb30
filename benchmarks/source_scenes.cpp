#include "source_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <lightcuts/source/area.hpp>
#include <lightcuts/source/environment.hpp>

#include "io/load_scene.hpp"

namespace benchmark {

namespace {

constexpr int map_height = 512;

/// Radiance from above and from below the horizon.
glm::vec3 sky(const glm::dvec3& direction) {
    const auto glow = [&](const glm::dvec3& center, double sharpness) {
        return static_cast<float>(std::exp(sharpness * (glm::dot(direction, glm::normalize(center)) - 1.0)));
    };
    const auto up = static_cast<float>(direction.y);
    if (up < 0.0f) return glm::vec3(0.06f, 0.05f, 0.04f) * (1.0f + up);
    const glm::vec3 blue = glm::mix(glm::vec3(0.6f, 0.62f, 0.65f), glm::vec3(0.1f, 0.2f, 0.5f), std::sqrt(up));
    return blue + 400.0f * glow({-0.5, 0.5, 0.4}, 2000.0) * glm::vec3(1.0f, 0.85f, 0.6f) +
           3.0f * glow({0.9, 0.25, -0.2}, 40.0) * glm::vec3(1.0f, 0.6f, 0.4f);
}

}  // namespace

render::Scene room_with_lamp(std::size_t points) {
    render::Scene scene = render::load_scene("builtin:surfaces?lights=1&rotated=0");
    scene.oriented.clear();
    constexpr float half = 0.5f, height = 3.15f;
    const glm::vec3 a(-half, height, -half), b(half, height, -half), c(half, height, half), d(-half, height, half);
    const glm::vec3 radiance(12.0f, 11.0f, 9.0f);
    const std::array<lightcuts::EmissiveTriangle<>, 2> lamp{{{a, b, c, radiance}, {a, c, d, radiance}}};
    scene.oriented = lightcuts::area_lights(lightcuts::EmissiveTriangles<glm::vec3>(lamp), points);
    return scene;
}

void surround(render::Scene& scene) {
    if (scene.background.environment) return;
    render::Environment& around = scene.background.environment.emplace();
    around.picture = render::Picture(2 * map_height, map_height);
    for (int y = 0; y < map_height; ++y) {
        for (int x = 0; x < 2 * map_height; ++x) {
            const glm::dvec3 direction = around.map().direction_at({x + 0.5, y + 0.5});
            around.picture.pixels[static_cast<std::size_t>(y * 2 * map_height + x)] = sky(direction);
        }
    }
}

void light_by_map(render::Scene& scene, std::size_t count) {
    scene.directional = lightcuts::environment_lights(scene.background.environment->map(), count,
                                                      lightcuts::CenteredSobol{1});
    scene.environment_lights = scene.directional.size();
}

}  // namespace benchmark
