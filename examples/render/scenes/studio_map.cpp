#include "scenes/studio_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "scenes/computed_map.hpp"

namespace render {
namespace {

constexpr int height = 512;

/// A rectangle of light that faces the middle of the scene, of panes between bars.
struct Window {
    glm::vec3 towards;  ///< its middle
    glm::vec2 half;     ///< half its width and height, at distance 1
    glm::ivec2 panes;
    glm::vec3 radiance;

    /// Share of light in `direction`: 1 on a pane, with soft edges.
    float brightness(const glm::vec3& direction) const {
        const glm::vec3 axis = glm::normalize(towards);
        const float distance = glm::dot(direction, axis);
        if (distance <= 0.0f) return 0.0f;
        const glm::vec3 aside = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), axis));
        const glm::vec2 p = glm::vec2(glm::dot(direction, aside), glm::dot(direction, glm::cross(axis, aside))) /
                            distance;
        const glm::vec2 place = (0.5f + 0.5f * p / half) * glm::vec2(panes);  // in panes
        float share = 1.0f;
        for (int i = 0; i < 2; ++i) {
            if (place[i] <= 0.0f || place[i] >= static_cast<float>(panes[i])) return 0.0f;
            const float inside = place[i] - std::floor(place[i]);
            const float edge = std::min(inside, 1.0f - inside) * 2.0f * half[i] / static_cast<float>(panes[i]);
            share *= glm::smoothstep(0.006f, 0.022f, edge);
        }
        return share;
    }
};

const std::array windows{
    Window{{-0.85f, 0.50f, 0.25f}, {0.42f, 0.50f}, {2, 3}, {7.0f, 7.4f, 8.4f}},   // the key light, cool
    Window{{0.95f, 0.34f, 0.30f}, {0.16f, 0.55f}, {1, 1}, {6.5f, 5.2f, 3.6f}},    // a warm strip
    Window{{0.10f, 1.00f, -0.35f}, {0.55f, 0.28f}, {1, 1}, {4.5f, 4.4f, 4.2f}},   // overhead
    Window{{-0.42f, 0.36f, -0.90f}, {0.20f, 0.18f}, {2, 2}, {4.2f, 2.9f, 1.8f}},  // behind the table
    Window{{0.40f, 0.36f, -0.90f}, {0.20f, 0.18f}, {2, 2}, {3.4f, 2.3f, 1.5f}},
    Window{{0.15f, 0.28f, 1.00f}, {0.36f, 0.14f}, {3, 1}, {2.2f, 2.4f, 2.8f}}};  // behind the camera

const glm::vec3 towards_lamp(0.48f, 0.74f, 0.36f);
const glm::vec3 lamp_radiance(9000.0f, 7400.0f, 5200.0f);
constexpr float lamp_radius = 0.014f;  ///< radians

/// An evening sky over a dark floor, reddest behind the table.
glm::vec3 dusk(const glm::vec3& direction) {
    const float red = 0.5f - 0.5f * direction.z;
    const glm::vec3 horizon = glm::mix(glm::vec3(0.16f, 0.17f, 0.26f), glm::vec3(0.60f, 0.30f, 0.27f), red * red);
    const glm::vec3 zenith(0.05f, 0.07f, 0.17f);
    const glm::vec3 floor(0.05f, 0.05f, 0.065f);
    if (direction.y < 0.0f) return glm::mix(horizon, floor, glm::smoothstep(0.0f, 0.30f, -direction.y));
    return glm::mix(zenith, horizon, std::exp(-4.0f * direction.y));
}

glm::vec3 radiance(const glm::vec3& direction) {
    const float to_lamp = std::acos(glm::clamp(glm::dot(direction, glm::normalize(towards_lamp)), -1.0f, 1.0f));
    if (to_lamp < lamp_radius) return lamp_radiance;
    glm::vec3 sum = dusk(direction);
    sum += 0.004f * lamp_radiance * std::exp(-60.0f * to_lamp);  // what the lamp's glass scatters
    for (const Window& window : windows) sum += window.brightness(direction) * window.radiance;
    return sum;
}

}  // namespace

Picture studio_map() { return computed_map(height, radiance); }

}  // namespace render
