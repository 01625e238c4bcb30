#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/builtin.hpp"
#include "scenes/ornaments.hpp"
#include "scenes/shapes.hpp"
#include "scenes/studio_map.hpp"

namespace render {
namespace {

/// A roulette wheel, in meters; the axis is y, and the table's top y = 0.
class Wheel {
public:
    Wheel() : m_(scene_) {
        add_table();
        add_bowl();
        turning([this] { add_rotor(); }, turns_a_second);
        turning([this] { add_ball(); }, -1.3 * turns_a_second);
        scene_.cameras.push_back({"wheel", {0.12f, 0.52f, 0.62f}, {0.0f, 0.045f, 0.0f}, {0, 1, 0}, 42.0f});
        scene_.cameras.push_back({"bins", {0.16f, 0.24f, 0.36f}, {0.06f, 0.05f, 0.12f}, {0, 1, 0}, 36.0f});
        scene_.lighting.environment = studio_map();
    }

    Scene scene() { return std::move(scene_); }

private:
    static constexpr int bins = 37;
    static constexpr double turns_a_second = 0.8;
    static constexpr float inner = 0.150f;  ///< radii of the ring of bins
    static constexpr float outer = 0.205f;
    static constexpr float floor = 0.052f;  ///< their height

    /// Lets what `add` adds turn about the axis.
    template <class F>
    void turning(const F& add, double turns) {
        const auto first = static_cast<std::uint32_t>(scene_.positions.size());
        add();
        const auto count = static_cast<std::uint32_t>(scene_.positions.size()) - first;
        scene_.rigid_motions.push_back(
            {.first_vertex = first, .vertex_count = count, .turn = 2.0 * std::numbers::pi * turns});
    }

    void lathe(std::span<const glm::vec2> profile, std::uint32_t material) {
        m_.stand({});
        m_.material = material;
        m_.lathe(profile, 180);
    }

    void add_table() {
        m_.stand({});
        m_.material = m_.paint("baize", {0.02f, 0.17f, 0.09f}, 0.9f);
        m_.box({-1.2f, -0.04f, -1.2f}, {1.2f, 0.0f, 1.2f});
    }

    void add_bowl() {
        const std::uint32_t wood = m_.paint("bowl", {0.19f, 0.085f, 0.035f}, 0.25f);
        // Outside up, over the rim, inside down to the rotor.
        const std::array<glm::vec2, 10> profile{{{0.0f, 0.001f},
                                                 {0.36f, 0.001f},
                                                 {0.36f, 0.001f},
                                                 {0.39f, 0.05f},
                                                 {0.40f, 0.11f},
                                                 {0.385f, 0.122f},
                                                 {0.365f, 0.115f},
                                                 {0.345f, 0.095f},
                                                 {0.235f, 0.066f},
                                                 {0.215f, 0.045f}}};
        lathe(profile, wood);
        const std::uint32_t brass = m_.paint("deflector", {0.88f, 0.64f, 0.28f}, 0.24f, 1.0f);
        for (int i = 0; i < 8; ++i) {
            const float angle = glm::radians(45.0f * static_cast<float>(i) + 10.0f);
            m_.place = glm::rotate(
                glm::translate(glm::mat4(1.0f), {0.29f * std::cos(angle), 0.083f, 0.29f * std::sin(angle)}),
                -angle + (i % 2 == 0 ? 0.0f : glm::radians(90.0f)), {0, 1, 0});
            m_.material = brass;
            m_.box({-0.02f, -0.002f, -0.005f}, {0.02f, 0.008f, 0.005f});
        }
    }

    void add_rotor() {
        const std::uint32_t rosewood = m_.paint("rotor", {0.14f, 0.045f, 0.03f}, 0.22f);
        const std::uint32_t brass = m_.paint("turret", {0.92f, 0.70f, 0.32f}, 0.22f, 1.0f);
        const std::uint32_t mirror = m_.paint("fret", {0.95f, 0.94f, 0.92f}, 0.0f, 1.0f);
        const std::array paints{m_.paint("green bin", {0.01f, 0.30f, 0.06f}, 0.28f),
                                m_.paint("red bin", {0.50f, 0.015f, 0.015f}, 0.28f),
                                m_.paint("black bin", {0.02f, 0.02f, 0.022f}, 0.28f)};
        const std::array<glm::vec2, 5> cone{
            {{inner, floor - 0.02f}, {inner, floor + 0.004f}, {inner, floor + 0.004f}, {0.05f, 0.085f}, {0.0f, 0.09f}}};
        lathe(cone, rosewood);
        const std::array<glm::vec2, 7> turret{{{0.05f, 0.084f},
                                               {0.03f, 0.10f},
                                               {0.014f, 0.12f},
                                               {0.012f, 0.15f},
                                               {0.022f, 0.165f},
                                               {0.016f, 0.18f},
                                               {0.0f, 0.187f}}};
        lathe(turret, brass);
        m_.material = brass;
        for (int i = 0; i < 4; ++i) {
            m_.place = glm::rotate(glm::mat4(1.0f), glm::radians(90.0f * static_cast<float>(i)), {0, 1, 0});
            const std::array<glm::vec3, 2> arm{{{0.0f, 0.14f, 0.0f}, {0.07f, 0.14f, 0.0f}}};
            m_.tube(arm, 0.005f, 20, false);
            m_.sphere({0.075f, 0.14f, 0.0f}, 0.010f, 32);
        }
        constexpr float step = 2.0f * std::numbers::pi_v<float> / bins;
        for (int i = 0; i < bins; ++i) {
            // Floors of four flat pieces each, with the numbers' ring outside of them.
            m_.stand({});
            m_.material = paints[i == 0 ? 0u : i % 2 == 1 ? 1u : 2u];
            for (int k = 0; k < 4; ++k) {
                const auto at = [&](float radius, int piece, float height) {
                    const float angle = step * (static_cast<float>(i) + 0.25f * static_cast<float>(piece));
                    return glm::vec3(radius * std::cos(angle), height, radius * std::sin(angle));
                };
                const glm::vec3 a = at(inner, k, floor), b = at(inner, k + 1, floor),
                                c = at(outer, k + 1, floor + 0.003f), d = at(outer, k, floor + 0.003f);
                m_.facet(a, b, c);
                m_.facet(a, c, d);
            }
            m_.place = glm::rotate(glm::mat4(1.0f), -step * static_cast<float>(i), {0, 1, 0});
            m_.material = mirror;
            m_.box({inner, floor - 0.001f, -0.0012f}, {outer, floor + 0.016f, 0.0012f});
        }
        const std::array<glm::vec2, 4> rim{{{outer + 0.006f, floor - 0.02f},
                                            {outer + 0.006f, floor + 0.006f},
                                            {outer + 0.006f, floor + 0.006f},
                                            {outer, floor + 0.002f}}};
        lathe(rim, brass);
    }

    /// It runs against the wheel, on the bowl's track.
    void add_ball() {
        m_.stand({});
        m_.material = m_.paint("ball", {0.80f, 0.78f, 0.74f}, 0.22f);
        m_.sphere({0.21f, 0.112f, 0.255f}, 0.0125f, 48);
    }

    Scene scene_;
    Modeller m_;
};

}  // namespace

Scene builtin_wheel() { return Wheel().scene(); }

}  // namespace render
