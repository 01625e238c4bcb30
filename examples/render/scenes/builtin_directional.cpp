#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/builtin.hpp"
#include "scenes/furniture.hpp"
#include "scenes/shapes.hpp"

namespace render {
namespace {

constexpr int cells = 34;        ///< along each side of the field
constexpr float spacing = 1.6f;  ///< of the clutter, in meters
constexpr float two_pi = 2.0f * std::numbers::pi_v<float>;

/// Radiance of a clear sky: blue above, pale at the horizon, with a bright glow about the sun.
glm::vec3 sky(const glm::vec3& up) {
    const glm::vec3 sun = glm::normalize(glm::vec3(-0.55f, 0.42f, 0.35f));
    const glm::vec3 zenith(0.10f, 0.20f, 0.46f);
    const glm::vec3 horizon(0.52f, 0.54f, 0.56f);
    const float height = std::pow(1.0f - up.y, 3.0f);
    const float angle = std::acos(glm::clamp(glm::dot(up, sun), -1.0f, 1.0f));
    const float glow = 26.0f * std::exp(-18.0f * angle * angle) + 0.9f * std::exp(-2.0f * angle);
    return glm::mix(zenith, horizon, height) + glow * glm::vec3(1.0f, 0.80f, 0.52f);
}

class Field {
public:
    Field() : m_(scene_) {
        paint_all();
        m_.material = ground_;
        const float half = 0.5f * spacing * static_cast<float>(cells) + 30.0f;
        m_.quad({-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}, 24, 24);
        Dice dice(211);
        for (int i = 0; i < cells; ++i) {
            for (int j = 0; j < cells; ++j) {
                const auto at = [&](int k) {
                    return spacing * (static_cast<float>(k - cells / 2) + dice.uniform(0.25f, 0.75f));
                };
                const float x = at(i);
                const float z = at(j);
                m_.stand({x, 0.0f, z}, dice.uniform(0.0f, 360.0f));
                add_thing(dice);
            }
        }
        scene_.cameras.push_back({"overlook", {-3.0f, 8.5f, 27.5f}, {0.5f, 0.0f, 9.5f}, {0, 1, 0}, 40.0f});
        scene_.cameras.push_back({"among the clutter", {0.3f, 2.0f, 17.0f}, {-0.5f, 0.3f, 8.0f}, {0, 1, 0}, 55.0f});
    }

    /// A spiral over the half sphere [Vogel 1979]: every light stands for an equal solid angle.
    void add_lights(std::size_t count) {
        constexpr double golden_angle = 2.399963229728653;
        const float solid_angle = two_pi / static_cast<float>(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double height = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
            const double ring = std::sqrt(1.0 - height * height);
            const double angle = std::fmod(golden_angle * static_cast<double>(i), 2.0 * std::numbers::pi);
            const glm::vec3 up(ring * std::cos(angle), height, ring * std::sin(angle));
            scene_.directional.push_back({-glm::normalize(up), sky(up) * solid_angle});
        }
    }

    Scene scene() { return std::move(scene_); }

private:
    void paint_all() {
        ground_ = m_.paint("ground", {0.46f, 0.42f, 0.36f}, 0.9f);
        leaf_ = m_.paint("leaf", {0.12f, 0.34f, 0.08f}, 0.45f);
        scene_.materials[leaf_].double_sided = true;
        paints_ = {m_.paint("white", {0.80f, 0.79f, 0.76f}, 0.4f),   m_.paint("coral", {0.80f, 0.28f, 0.20f}, 0.35f),
                   m_.paint("mint", {0.32f, 0.66f, 0.50f}, 0.5f),    m_.paint("sky blue", {0.22f, 0.45f, 0.70f}, 0.3f),
                   m_.paint("mustard", {0.78f, 0.55f, 0.12f}, 0.5f), m_.paint("plum", {0.32f, 0.12f, 0.30f}, 0.2f),
                   m_.paint("slate", {0.20f, 0.23f, 0.27f}, 0.25f),  m_.paint("sand", {0.70f, 0.58f, 0.42f}, 0.8f)};
        copper_ = m_.paint("copper", {0.90f, 0.52f, 0.35f}, 0.35f, 1.0f);
    }

    std::uint32_t paint(Dice& dice) { return paints_[dice.pick(paints_.size())]; }

    void add_thing(Dice& dice) {
        m_.material = paint(dice);
        const float size = dice.uniform(0.3f, 0.62f);
        switch (dice.pick(9)) {
            case 0: m_.sphere({0.0f, size, 0.0f}, size, 18); break;
            case 1: m_.cylinder({0.0f, 0.0f, 0.0f}, 0.7f * size, dice.uniform(0.5f, 2.2f), 20); break;
            case 2: add_ring(size); break;
            case 3: add_cone(size, dice.uniform(0.8f, 1.8f)); break;
            case 4: add_plant(m_, 2.2f * size, 12, dice, paint(dice), leaf_); break;
            case 5: {
                const std::uint32_t glaze = paint(dice);
                add_vase(m_, static_cast<int>(dice.pick(3)), 2.2f * size, 14, glaze);
                break;
            }
            case 6: add_arch(size); break;
            default: add_boxes(dice); break;
        }
    }

    /// Up to four crates on each other.
    void add_boxes(Dice& dice) {
        const std::size_t count = 1 + dice.pick(4);
        float y = 0.0f;
        for (std::size_t i = 0; i < count; ++i) {
            const float half = dice.uniform(0.2f, 0.42f);
            const float height = dice.uniform(0.25f, 0.7f);
            m_.material = paint(dice);
            m_.place = glm::rotate(m_.place, dice.uniform(-0.5f, 0.5f), glm::vec3(0.0f, 1.0f, 0.0f));
            m_.box({-half, y, -half}, {half, y + height, half});
            y += height;
        }
    }

    void add_cone(float radius, float height) {
        const std::array<glm::vec2, 4> profile{{{0.0f, 0.0f}, {radius, 0.0f}, {radius, 0.0f}, {0.0f, height}}};
        m_.lathe(profile, 22);
    }

    /// A ring that stands on its edge.
    void add_ring(float radius) {
        m_.material = copper_;
        std::vector<glm::vec3> path;
        for (int i = 0; i < 20; ++i) {
            const float angle = two_pi * static_cast<float>(i) / 20.0f;
            path.emplace_back(radius * std::cos(angle), 1.2f * radius + radius * std::sin(angle), 0.0f);
        }
        m_.tube(path, 0.2f * radius, 8, true);
    }

    void add_arch(float size) {
        m_.box({-size, 0, -0.15f}, {-size + 0.22f, 2.2f * size, 0.15f});
        m_.box({size - 0.22f, 0, -0.15f}, {size, 2.2f * size, 0.15f});
        m_.box({-1.15f * size, 2.2f * size, -0.2f}, {1.15f * size, 2.2f * size + 0.2f, 0.2f});
    }

    Scene scene_;
    Modeller m_;
    std::uint32_t ground_ = 0;
    std::uint32_t leaf_ = 0;
    std::uint32_t copper_ = 0;
    std::array<std::uint32_t, 8> paints_{};
};

}  // namespace

Scene builtin_directional(std::size_t lights) {
    Field field;
    field.add_lights(lights);
    return field.scene();
}

}  // namespace render
