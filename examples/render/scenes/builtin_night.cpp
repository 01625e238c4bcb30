#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/builtin.hpp"
#include "scenes/computed_map.hpp"
#include "scenes/ornaments.hpp"
#include "scenes/shapes.hpp"
#include "scenes/temple.hpp"

namespace render {
namespace {

constexpr float two_pi = 2.0f * std::numbers::pi_v<float>;
constexpr float half_size = 42.0f;         ///< of the ground, in meters: fog fills the scene's box, and hides its edge
constexpr float total_intensity = 130.0f;  ///< of all lamps, W/sr: does not depend on their number
constexpr float lamp_radius = 0.05f;       ///< in meters

/// A dim blue sky with a moon, of five degrees across so that it is some forty pixels of the map.
glm::vec3 night_sky(const glm::vec3& direction) {
    const glm::vec3 towards_moon = glm::normalize(glm::vec3(0.78f, 0.52f, 0.22f));
    const float to_moon = std::acos(glm::clamp(glm::dot(direction, towards_moon), -1.0f, 1.0f));
    if (to_moon < 0.044f) return glm::vec3(34.0f, 40.0f, 50.0f);
    const glm::vec3 horizon(0.010f, 0.014f, 0.026f);
    const glm::vec3 zenith(0.003f, 0.005f, 0.013f);
    const float height = glm::max(direction.y, 0.0f);
    return glm::mix(zenith, horizon, std::exp(-4.0f * height)) + 0.05f * std::exp(-9.0f * to_moon);
}

/// The temple of builtin:colonnade under a moon, with lamps that fly about it.
class Night {
public:
    Night() : m_(scene_) {
        m_.stand({0, Temple::ground, 0});
        m_.material = m_.paint("grass", {0.13f, 0.16f, 0.07f}, 1.0f);
        m_.quad({-half_size, 0, half_size}, {2 * half_size, 0, 0}, {0, 0, -2 * half_size}, 12, 12);
        add_temple(m_);
        add_cypresses();
        scene_.cameras.push_back({"front", {12.6f, 1.5f, 19.5f}, {1.2f, 2.6f, 4.0f}, {0, 1, 0}, 48.0f});
        scene_.cameras.push_back({"aisle", {4.45f, 1.7f, 11.0f}, {4.55f, 2.25f, 0.0f}, {0, 1, 0}, 58.0f});
        scene_.lighting.environment = computed_map(256, night_sky);
        scene_.lighting.indirect = 50'000;
    }

    void add_lamps(std::size_t count) {
        const std::array hues{glm::vec3(1.0f, 0.56f, 0.20f), glm::vec3(1.0f, 0.42f, 0.24f),
                              glm::vec3(0.72f, 0.85f, 0.52f)};
        const float intensity = total_intensity / static_cast<float>(count);
        std::array<std::uint32_t, hues.size()> glow{};
        for (std::size_t i = 0; i < hues.size(); ++i) {
            glow[i] = m_.paint("lamp", glm::vec3(0.0f), 1.0f);
            Material& material = scene_.materials[glow[i]];
            material.emission = hues[i] * (intensity / (0.5f * two_pi * lamp_radius * lamp_radius));
            material.only_seen = true;  // the spherical light around it lights
        }
        Dice dice(521);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t hue = i % 8 < 5 ? 0 : i % 8 < 7 ? 1 : 2;
            add_lamp(circle(dice), dice, glow[hue], intensity * hues[hue]);
        }
    }

    Scene scene() { return std::move(scene_); }

private:
    /// Where a lamp flies.
    struct Circle {
        glm::vec3 center;
        float radius;
    };

    void add_cypresses() {
        const std::uint32_t leaf = m_.paint("cypress", {0.035f, 0.085f, 0.03f}, 1.0f);
        Dice dice(523);
        for (int i = 0; i < 26; ++i) {
            const float angle = dice.uniform(0.0f, two_pi);
            const float distance = dice.uniform(19.0f, 36.0f);
            const glm::vec3 place(distance * std::sin(angle), Temple::ground, distance * std::cos(angle));
            if (place.x > 5.0f && place.z > 8.0f) continue;  // stays out of the front camera's way
            m_.stand(place);
            add_cypress(m_, dice.uniform(5.0f, 9.0f), dice, leaf);
        }
    }

    /// A third of them fly in the aisles over the statues' heads, the others around the temple, away from all there is.
    static Circle circle(Dice& dice) {
        if (dice.uniform(0.0f, 1.0f) < 0.35f) {
            const float side = dice.uniform(0.0f, 1.0f) < 0.5f ? -1.0f : 1.0f;
            const float height = dice.uniform(3.2f, 4.4f);
            const float along = dice.uniform(-1.0f, 1.0f) * (Temple::half_length - 1.6f);
            return {{side * dice.uniform(4.25f, 4.6f), height, along}, dice.uniform(0.25f, 0.75f)};
        }
        constexpr float farthest = 5.0f;
        while (true) {
            const float x = dice.uniform(-1.0f, 1.0f) * (Temple::half_width + farthest);
            const float z = dice.uniform(-1.0f, 1.0f) * (Temple::half_length + farthest);
            const float clear = std::max(std::abs(x) - Temple::half_width, std::abs(z) - Temple::half_length);
            if (clear < 2.4f) continue;
            const float height = Temple::ground + dice.uniform(0.9f, 4.0f);
            return {{x, height, z}, std::min(dice.uniform(0.3f, 1.1f), clear - 1.7f)};
        }
    }

    /// On a circle about an axis that leans a little.
    void add_lamp(const Circle& circle, Dice& dice, std::uint32_t glow, const glm::vec3& intensity) {
        const float start = dice.uniform(0.0f, two_pi);
        const float lean = dice.uniform(-0.25f, 0.25f);
        const glm::vec3 axis = glm::normalize(glm::vec3(lean, 1.0f, dice.uniform(-0.25f, 0.25f)));
        const glm::vec3 aside = glm::normalize(glm::cross(axis, glm::vec3(std::cos(start), 0.0f, std::sin(start))));
        const glm::vec3 place = circle.center + circle.radius * aside;
        const float speed = dice.uniform(0.5f, 1.5f);  // meters a second
        const float direction = dice.uniform(0.0f, 1.0f) < 0.5f ? -1.0f : 1.0f;

        const auto first = static_cast<std::uint32_t>(scene_.positions.size());
        m_.stand({});
        m_.material = glow;
        m_.sphere(place, lamp_radius, 12);
        RigidMotion motion;
        motion.first_vertex = first;
        motion.vertex_count = static_cast<std::uint32_t>(scene_.positions.size()) - first;
        motion.center = glm::dvec3(circle.center);
        motion.axis = glm::normalize(glm::dvec3(axis));
        motion.turn = static_cast<double>(direction * speed / circle.radius);
        motion.first_sphere = static_cast<std::uint32_t>(scene_.spheres.size());
        motion.sphere_count = 1;
        scene_.rigid_motions.push_back(motion);
        scene_.spheres.push_back({place, lamp_radius, intensity});
    }

    Scene scene_;
    Modeller m_;
};

}  // namespace

Scene builtin_night(std::size_t lights) {
    Night night;
    night.add_lamps(lights);
    return night.scene();
}

}  // namespace render
