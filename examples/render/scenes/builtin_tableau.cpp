#include <array>
#include <cstdint>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/builtin.hpp"
#include "scenes/furniture.hpp"
#include "scenes/ornaments.hpp"
#include "scenes/shapes.hpp"
#include "scenes/studio_map.hpp"

namespace render {
namespace {

constexpr float tray_top = 0.022f;

/// A still life, in meters; the table's top is y = 0, the camera looks from +z.
class Tableau {
public:
    Tableau() : m_(scene_) {
        add_table_top();
        add_tray();
        add_vessels();
        add_metals();
        add_plastics();
        add_beads();
        scene_.cameras.push_back({"table", {0.12f, 0.56f, 1.36f}, {0.01f, 0.135f, -0.02f}, {0, 1, 0}, 37.0f});
        scene_.cameras.push_back({"close", {-0.42f, 0.30f, 0.78f}, {0.02f, 0.10f, 0.0f}, {0, 1, 0}, 40.0f});
        scene_.lighting.environment = studio_map();
    }

    Scene scene() { return std::move(scene_); }

private:
    void put(float x, float z, float degrees = 0.0f) { m_.stand({x, tray_top + 0.0002f, z}, degrees); }

    void ball(float x, float z, float radius, std::uint32_t material, int segments = 72) {
        put(x, z);
        m_.material = material;
        m_.sphere({0.0f, radius, 0.0f}, radius, segments);
    }

    void cube(float x, float z, float degrees, float side, std::uint32_t material) {
        put(x, z, degrees);
        m_.material = material;
        m_.box({-0.5f * side, 0.0f, -0.5f * side}, {0.5f * side, side, 0.5f * side});
    }

    /// Boards along x.
    void add_table_top() {
        const std::array boards{m_.paint("walnut board", {0.115f, 0.058f, 0.03f}, 0.30f),
                                m_.paint("brown board", {0.15f, 0.078f, 0.04f}, 0.34f),
                                m_.paint("dark board", {0.09f, 0.046f, 0.026f}, 0.32f)};
        Dice dice(307);
        constexpr int rows = 12;
        constexpr float depth = 0.2f;
        for (int row = 0; row < rows; ++row) {
            const float z = depth * (static_cast<float>(row) - 0.5f * rows);
            m_.material = boards[dice.pick(boards.size())];
            m_.box({-1.6f, -0.04f, z + 0.001f}, {1.6f, 0.0f, z + depth - 0.001f});
        }
    }

    void add_tray() {
        const std::uint32_t lacquer = m_.paint("lacquer", {0.035f, 0.03f, 0.035f}, 0.24f);
        const std::uint32_t linen = m_.paint("linen", {0.62f, 0.57f, 0.48f}, 0.9f);
        const std::uint32_t brass = m_.paint("tray brass", {0.88f, 0.62f, 0.26f}, 0.32f, 1.0f);
        constexpr float x = 0.64f;
        constexpr float z = 0.40f;
        m_.stand({0, 0.0004f, 0});
        m_.material = lacquer;
        m_.box({-x, 0.0f, -z}, {x, 0.02f, z});
        for (const float side : {-1.0f, 1.0f}) {
            m_.box({-x, 0.02f, side * (z - 0.01f) - 0.01f}, {x, 0.05f, side * (z - 0.01f) + 0.01f});
            m_.box({side * (x - 0.01f) - 0.01f, 0.02f, -z + 0.02f}, {side * (x - 0.01f) + 0.01f, 0.05f, z - 0.02f});
        }
        m_.material = linen;
        m_.box({-x + 0.035f, 0.0195f, -z + 0.035f}, {x - 0.035f, tray_top - 0.0004f, z - 0.035f});
        m_.material = brass;
        for (const float side : {-1.0f, 1.0f}) {
            const std::array<glm::vec3, 7> handle{{{side * x, 0.03f, -0.13f},
                                                   {side * (x + 0.035f), 0.035f, -0.13f},
                                                   {side * (x + 0.065f), 0.05f, -0.10f},
                                                   {side * (x + 0.07f), 0.055f, 0.0f},
                                                   {side * (x + 0.065f), 0.05f, 0.10f},
                                                   {side * (x + 0.035f), 0.035f, 0.13f},
                                                   {side * x, 0.03f, 0.13f}}};
            m_.tube(handle, 0.012f, 20, false);
        }
    }

    void add_vessels() {
        put(-0.40f, -0.20f);
        add_vase(m_, 0, 0.46f, 96, m_.paint("cobalt glaze", {0.02f, 0.06f, 0.38f}, 0.22f));
        put(0.43f, -0.21f);
        add_vase(m_, 1, 0.40f, 80, m_.paint("jade glaze", {0.10f, 0.38f, 0.26f}, 0.24f));
        put(0.235f, -0.24f);
        add_vase(m_, 2, 0.19f, 80, m_.paint("white glaze", {0.78f, 0.76f, 0.72f}, 0.26f));
        put(-0.20f, -0.25f);
        add_goblet(m_, 0.25f, 72, m_.paint("silver", {0.92f, 0.91f, 0.88f}, 0.26f, 1.0f));
    }

    void add_metals() {
        const std::uint32_t gold = m_.paint("gold", {1.0f, 0.76f, 0.34f}, 0.28f, 1.0f);
        const std::uint32_t copper = m_.paint("copper", {0.93f, 0.52f, 0.36f}, 0.36f, 1.0f);
        put(0.03f, -0.19f, 22.0f);
        add_knot(m_, 0.145f, 300, 28, m_.paint("brass", {0.90f, 0.66f, 0.28f}, 0.30f, 1.0f));
        ball(-0.185f, -0.03f, 0.088f, m_.paint("mirror", {0.95f, 0.95f, 0.95f}, 0.0f, 1.0f), 120);
        ball(0.40f, 0.02f, 0.075f, copper, 96);
        // A ring that leans on the copper ball.
        m_.place = glm::rotate(glm::translate(glm::mat4(1.0f), {0.262f, tray_top + 0.0815f, 0.075f}),
                               glm::radians(68.0f), glm::vec3(0.35f, 0.0f, 1.0f));
        m_.place = glm::translate(m_.place, {0.0f, -0.012f, 0.0f});
        add_torus(m_, 0.075f, 0.012f, 120, 28, gold);
        put(0.115f, 0.235f, 15.0f);
        add_torus(m_, 0.042f, 0.009f, 96, 24, gold);
    }

    void add_plastics() {
        const std::uint32_t red = m_.paint("red plastic", {0.55f, 0.02f, 0.02f}, 0.26f);
        const std::uint32_t blue = m_.paint("blue plastic", {0.02f, 0.10f, 0.48f}, 0.30f);
        const std::uint32_t orange = m_.paint("orange plastic", {0.75f, 0.22f, 0.02f}, 0.22f);
        const std::uint32_t chalk = m_.paint("chalk", {0.74f, 0.73f, 0.70f}, 1.0f);
        const std::uint32_t clay = m_.paint("clay", {0.48f, 0.19f, 0.10f}, 1.0f);
        const std::uint32_t ebony = m_.paint("ebony", {0.02f, 0.018f, 0.018f}, 0.28f);
        const std::uint32_t ivory = m_.paint("ivory", {0.72f, 0.66f, 0.52f}, 0.25f);
        cube(-0.43f, 0.10f, 31.0f, 0.115f, red);
        m_.place = glm::rotate(glm::translate(m_.place, {0.0f, 0.1151f, 0.0f}), 0.4f, {0, 1, 0});
        m_.material = chalk;
        m_.box({-0.035f, 0.0f, -0.035f}, {0.035f, 0.07f, 0.035f});
        cube(0.535f, 0.12f, 12.0f, 0.07f, clay);
        put(-0.02f, 0.07f);
        add_torus(m_, 0.075f, 0.027f, 120, 40, blue);
        put(-0.02f, 0.07f);
        m_.material = orange;
        m_.sphere({0.0f, 0.078f, 0.0f}, 0.046f, 64);
        ball(-0.545f, -0.02f, 0.06f, chalk);
        ball(0.145f, 0.02f, 0.052f, clay);
        put(-0.27f, 0.15f);
        add_pawn(m_, 0.15f, 60, ebony);
        put(-0.17f, 0.215f);
        add_pawn(m_, 0.15f, 60, ivory);
        put(0.54f, -0.10f);
        const std::array<glm::vec2, 3> cone{{{0.06f, 0.0f}, {0.03f, 0.09f}, {0.0f, 0.18f}}};
        add_turned(m_, cone, 1.0f, 72, blue);
    }

    /// A row of balls, from smooth to rough.
    void add_beads() {
        constexpr std::array<float, 6> roughness{0.18f, 0.24f, 0.30f, 0.38f, 0.46f, 0.56f};
        for (std::size_t i = 0; i < roughness.size(); ++i) {
            const auto step = static_cast<float>(i);
            ball(0.20f + 0.066f * step, 0.305f - 0.012f * step, 0.028f,
                 m_.paint("steel bead", {0.72f, 0.73f, 0.75f}, roughness[i], 1.0f), 56);
        }
        ball(-0.05f, 0.285f, 0.024f, m_.paint("green bead", {0.04f, 0.30f, 0.10f}, 0.24f), 48);
        ball(-0.40f, 0.275f, 0.036f, m_.paint("violet bead", {0.22f, 0.05f, 0.34f}, 0.26f), 56);
    }

    Scene scene_;
    Modeller m_;
};

}  // namespace

Scene builtin_tableau() { return Tableau().scene(); }

}  // namespace render
