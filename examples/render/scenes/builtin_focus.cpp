#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include <glm/vec3.hpp>

#include "scenes/builtin.hpp"
#include "scenes/furniture.hpp"
#include "scenes/ornaments.hpp"
#include "scenes/shapes.hpp"
#include "scenes/studio_map.hpp"

namespace render {
namespace {

/// A table in the evening, in meters: its top is y = 0, and things on it recede from the camera, which looks along -z.
class Focus {
public:
    Focus() : m_(scene_) {
        add_table();
        add_sharp();
        add_near();
        add_far();
        add_curtain();
        scene_.cameras.push_back({"table", {-0.10f, 0.28f, 0.98f}, {0.02f, 0.115f, 0.0f}, {0, 1, 0}, 34.0f});
        scene_.cameras.push_back({"above", {0.55f, 0.95f, 1.05f}, {0.0f, 0.0f, -0.25f}, {0, 1, 0}, 42.0f});
        scene_.lighting.environment = studio_map();
    }

    Scene scene() { return std::move(scene_); }

private:
    static constexpr float bulb_radius = 0.02f;
    static constexpr int strings = 13;
    static constexpr int bulbs_a_string = 12;

    void put(float x, float z, float degrees = 0.0f) { m_.stand({x, 0.0002f, z}, degrees); }

    void ball(float x, float z, float radius, std::uint32_t material) {
        put(x, z);
        m_.material = material;
        m_.sphere({0.0f, radius, 0.0f}, radius, 80);
    }

    /// Varnished boards towards the camera.
    void add_table() {
        const std::array boards{m_.paint("walnut board", {0.115f, 0.058f, 0.03f}, 0.22f),
                                m_.paint("brown board", {0.15f, 0.078f, 0.04f}, 0.26f),
                                m_.paint("dark board", {0.09f, 0.046f, 0.026f}, 0.24f)};
        Dice dice(601);
        constexpr int rows = 12;
        constexpr float width = 0.2f;
        for (int row = 0; row < rows; ++row) {
            const float x = width * (static_cast<float>(row) - 0.5f * rows);
            m_.stand({});
            m_.material = boards[dice.pick(boards.size())];
            m_.box({x + 0.001f, -0.04f, -1.9f}, {x + width - 0.001f, 0.0f, 1.1f});
        }
    }

    /// In the plane of focus: a knot of gold among metals and glazes.
    void add_sharp() {
        put(0.02f, 0.0f, 24.0f);
        add_knot(m_, 0.085f, 320, 32, m_.paint("gold", {1.0f, 0.76f, 0.34f}, 0.20f, 1.0f));
        ball(-0.155f, 0.02f, 0.05f, m_.paint("mirror", {0.95f, 0.95f, 0.95f}, 0.0f, 1.0f));
        ball(0.165f, 0.03f, 0.042f, m_.paint("copper", {0.93f, 0.52f, 0.36f}, 0.28f, 1.0f));
        put(0.26f, -0.03f);
        add_vase(m_, 2, 0.13f, 80, m_.paint("jade glaze", {0.10f, 0.38f, 0.26f}, 0.18f));
        put(-0.265f, -0.04f);
        add_goblet(m_, 0.19f, 80, m_.paint("silver", {0.92f, 0.91f, 0.88f}, 0.18f, 1.0f));
    }

    void add_near() {
        const std::uint32_t ivory = m_.paint("ivory", {0.72f, 0.66f, 0.52f}, 0.20f);
        const std::uint32_t steel = m_.paint("steel", {0.72f, 0.73f, 0.75f}, 0.24f, 1.0f);
        const std::uint32_t red = m_.paint("red lacquer", {0.55f, 0.02f, 0.02f}, 0.18f);
        put(-0.235f, 0.47f);
        add_pawn(m_, 0.13f, 64, red);
        put(-0.16f, 0.30f);
        add_pawn(m_, 0.13f, 64, ivory);
        ball(0.085f, 0.40f, 0.032f, steel);
        ball(0.155f, 0.56f, 0.026f, m_.paint("violet glaze", {0.22f, 0.05f, 0.34f}, 0.18f));
        put(-0.02f, 0.21f, 15.0f);
        add_torus(m_, 0.036f, 0.008f, 96, 24, m_.paint("brass", {0.90f, 0.66f, 0.28f}, 0.22f, 1.0f));
    }

    void add_far() {
        const std::uint32_t ebony = m_.paint("ebony", {0.02f, 0.018f, 0.018f}, 0.20f);
        const std::uint32_t brass = m_.paint("old brass", {0.88f, 0.62f, 0.26f}, 0.30f, 1.0f);
        const std::uint32_t cobalt = m_.paint("cobalt glaze", {0.02f, 0.06f, 0.38f}, 0.18f);
        const std::uint32_t orange = m_.paint("orange glaze", {0.75f, 0.22f, 0.02f}, 0.20f);
        put(-0.46f, -0.55f);
        add_vase(m_, 0, 0.38f, 88, cobalt);
        put(0.44f, -0.62f);
        add_vase(m_, 1, 0.36f, 80, m_.paint("white glaze", {0.78f, 0.76f, 0.72f}, 0.20f));
        for (int i = 0; i < 4; ++i) {
            const float step = static_cast<float>(i);
            put(-0.13f + 0.105f * step, -0.30f - 0.17f * step);
            add_pawn(m_, 0.15f, 48, i % 2 == 0 ? ebony : brass);
        }
        ball(-0.16f, -0.62f, 0.075f, orange);
        put(0.02f, -1.15f, -20.0f);
        add_knot(m_, 0.14f, 240, 24, m_.paint("rose gold", {0.95f, 0.62f, 0.48f}, 0.24f, 1.0f));
        ball(0.47f, -1.1f, 0.11f, m_.paint("far silver", {0.92f, 0.91f, 0.88f}, 0.22f, 1.0f));
        put(-0.55f, -1.2f);
        add_goblet(m_, 0.30f, 64, brass);
    }

    /// A curtain of strings of bulbs behind the table. Each bulb is a spherical light around what is seen of it.
    void add_curtain() {
        const std::array hues{glm::vec3(1.0f, 0.60f, 0.24f), glm::vec3(1.0f, 0.42f, 0.20f),
                              glm::vec3(0.80f, 0.76f, 0.68f)};
        constexpr float intensity = 0.035f;  // W/sr of a bulb
        std::array<std::uint32_t, hues.size()> glow{};
        for (std::size_t i = 0; i < hues.size(); ++i) {
            glow[i] = m_.paint("bulb", glm::vec3(0.0f), 1.0f);
            Material& material = scene_.materials[glow[i]];
            material.emission = hues[i] * (intensity / (std::numbers::pi_v<float> * bulb_radius * bulb_radius));
            material.only_seen = true;  // the spherical light around it lights
        }
        const std::uint32_t wire = m_.paint("wire", {0.03f, 0.03f, 0.03f}, 0.6f);
        Dice dice(607);
        m_.stand({});
        for (int i = 0; i < strings; ++i) {
            const float x = 0.24f * (static_cast<float>(i) - 0.5f * static_cast<float>(strings - 1));
            const float z = -2.5f + dice.uniform(-0.25f, 0.25f);
            const float low = dice.uniform(-0.06f, 0.06f);
            for (int k = 0; k < bulbs_a_string; ++k) {
                const float y = low + 0.13f * static_cast<float>(k);
                const glm::vec3 bulb(x + dice.uniform(-0.03f, 0.03f), y, z);
                const std::size_t hue = dice.pick(hues.size());
                m_.material = glow[hue];
                m_.sphere(bulb, bulb_radius, 20);
                scene_.spheres.push_back({bulb, bulb_radius, intensity * hues[hue]});
            }
            m_.material = wire;
            m_.cylinder({x, low, z - 1.2f * bulb_radius}, 0.0015f, 0.13f * bulbs_a_string, 6);
        }
    }

    Scene scene_;
    Modeller m_;
};

}  // namespace

Scene builtin_focus() { return Focus().scene(); }

}  // namespace render
