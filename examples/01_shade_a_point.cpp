// Shades one point that a hundred thousand lights shine on, with less than two hundred shadow rays.
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <glm/common.hpp>
#include <lightcuts/lightcuts.hpp>

int main() {
    // A hundred thousand lanterns over a square of 40 x 40 m.
    std::mt19937 random(1);
    std::uniform_real_distribution<float> across(-20.0f, 20.0f), height(3.0f, 8.0f), strength(0.5f, 1.5f);
    std::vector<lightcuts::OmniLight<>> lanterns(100'000);
    for (auto& lantern : lanterns) {
        lantern.position = {across(random), across(random), height(random)};
        lantern.intensity = strength(random) * glm::vec3(1.0f, 0.7f, 0.4f);  // W/sr
    }
    const lightcuts::LightTree tree(lanterns);  // once a scene; it refers to the lights and copies none

    // Your ray tracer says whether a light reaches the point. This one knows a balloon of radius 1.
    const auto visible = [](const auto& receiver, const auto& light) {
        const glm::vec3 ray = light.position - receiver.shadow_origin;
        const glm::vec3 balloon = glm::vec3(1.0f, 0.0f, 2.0f) - receiver.shadow_origin;
        const float nearest = glm::clamp(glm::dot(balloon, ray) / glm::dot(ray, ray), 0.0f, 1.0f);
        return glm::distance(balloon, nearest * ray) > 1.0f;
    };

    const lightcuts::Lambert pavement{glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(0.5f)};  // normal, albedo
    const lightcuts::Receiver point(glm::vec3(0.0f), pavement);
    const auto shaded = lightcuts::shade(tree, point, visible);  // no cluster is off by more than 2 % of the total

    // The same, light by light.
    const auto exact = lightcuts::exhaustive(tree, point, visible);

    const float error = std::abs(shaded.radiance.r - exact.radiance.r);
    std::printf("lightcut    %.2f W/(m^2 sr), %u shadow rays\n", shaded.radiance.r, shaded.queries);
    std::printf("exhaustive  %.2f W/(m^2 sr), %u shadow rays\n", exact.radiance.r, exact.queries);
    std::printf("error       %.2f %%\n", 100.0f * error / exact.radiance.r);
    return error <= shaded.error_bound.r && error < 0.1f * exact.radiance.r && shaded.queries < 300 ? 0 : 1;
}
