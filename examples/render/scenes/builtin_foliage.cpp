#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/vec2.hpp>

#include "scenes/broadleaf.hpp"
#include "scenes/builtin.hpp"
#include "scenes/shapes.hpp"

namespace render {
namespace {

/// The edge of a wood in the afternoon, in meters: the camera looks along -z, the sun shines from behind the trees.
class Foliage {
public:
    Foliage() : m_(scene_) {
        add_meadow();
        add_grass();
        add_trees();
        scene_.cameras.push_back({"meadow", {-1.2f, 1.6f, 12.0f}, {0.2f, 3.2f, 0.0f}, {0, 1, 0}, 46.0f});
        scene_.cameras.push_back({"crown", {-1.0f, 1.6f, 3.5f}, {-2.2f, 4.6f, -2.0f}, {0, 1, 0}, 50.0f});
        scene_.lighting.sun = lightcuts::SunPosition{38.0, 118.0, 2.5};
        scene_.lighting.ground = 0.0f;
    }

    Scene scene() { return std::move(scene_); }

private:
    static constexpr float half_size = 160.0f;

    void add_meadow() {
        const std::uint32_t soil = m_.paint("soil", {0.12f, 0.13f, 0.05f}, 1.0f);
        m_.stand({});
        m_.material = soil;
        m_.quad({-half_size, 0, half_size}, {2 * half_size, 0, 0}, {0, 0, -2 * half_size}, 16, 16);
        // Wooded hills hide the horizon.
        m_.material = m_.paint("far wood", {0.06f, 0.10f, 0.045f}, 1.0f);
        Dice dice(809);
        for (int i = 0; i < 40; ++i) {
            const float angle = 0.157f * static_cast<float>(i) + dice.uniform(-0.06f, 0.06f);
            const float distance = dice.uniform(90.0f, 130.0f);
            m_.stand({distance * std::sin(angle), 0.0f, distance * std::cos(angle)});
            m_.place = glm::scale(m_.place, {1.0f, dice.uniform(0.3f, 0.5f), 1.0f});
            m_.sphere({0, 0, 0}, dice.uniform(14.0f, 24.0f), 20);
        }
    }

    /// Blades of three kinds, denser towards the camera.
    void add_grass() {
        const std::array grass{paint_leaf(m_, "grass", {0.16f, 0.27f, 0.06f}, 0.45f),
                               paint_leaf(m_, "young grass", {0.24f, 0.36f, 0.08f}, 0.40f),
                               paint_leaf(m_, "dry grass", {0.40f, 0.34f, 0.15f}, 0.60f)};
        Dice dice(811);
        m_.stand({});
        for (int i = 0; i < 26'000; ++i) {
            const float away = dice.uniform(0.0f, 1.0f);
            const float z = 11.5f - 24.0f * away * away;
            const float x = dice.uniform(-1.0f, 1.0f) * (2.0f + 0.55f * (14.0f - z));
            const float height = dice.uniform(0.12f, 0.42f);
            const float lean = dice.uniform(0.1f, 0.6f) * height;
            const float angle = dice.uniform(0.0f, 6.2832f);
            m_.material = grass[dice.pick(8) < 4 ? 0 : dice.pick(3) < 2 ? 1 : 2];
            const glm::vec3 root(x, 0.0f, z);
            m_.blade(root, root + glm::vec3(lean * std::cos(angle), height, lean * std::sin(angle)), 0.02f, 0.2f * lean,
                     2);
        }
    }

    void add_trees() {
        const std::uint32_t oak_bark = m_.paint("oak bark", {0.17f, 0.12f, 0.08f}, 0.9f);
        const std::uint32_t birch_bark = m_.paint("birch bark", {0.62f, 0.60f, 0.55f}, 0.8f);
        const std::array beech{paint_leaf(m_, "beech", {0.14f, 0.27f, 0.05f}, 0.30f),
                               paint_leaf(m_, "old beech", {0.09f, 0.19f, 0.045f}, 0.28f),
                               paint_leaf(m_, "young beech", {0.27f, 0.40f, 0.07f}, 0.34f)};
        const std::array birch{paint_leaf(m_, "birch", {0.25f, 0.33f, 0.07f}, 0.40f),
                               paint_leaf(m_, "yellow birch", {0.55f, 0.42f, 0.07f}, 0.42f)};
        const std::array maple{paint_leaf(m_, "maple", {0.50f, 0.13f, 0.05f}, 0.36f),
                               paint_leaf(m_, "orange maple", {0.62f, 0.28f, 0.05f}, 0.38f),
                               paint_leaf(m_, "dark maple", {0.27f, 0.06f, 0.05f}, 0.34f)};
        struct Kind {
            Broadleaf shape;
            std::uint32_t bark;
            std::span<const std::uint32_t> leaves;
        };
        const std::array kinds{Kind{{.height = 8.5f, .reach = 0.34f, .bare = 0.22f, .leaf = 0.27f}, oak_bark, beech},
                               Kind{{.height = 9.5f, .reach = 0.24f, .bare = 0.25f, .leaf = 0.21f}, birch_bark, birch},
                               Kind{{.height = 6.0f, .reach = 0.40f, .bare = 0.24f, .leaf = 0.26f}, oak_bark, maple}};
        struct Place {
            glm::vec2 at;
            std::size_t kind;
        };
        constexpr std::array places{Place{{-3.6f, -0.5f}, 0}, Place{{3.4f, 0.5f}, 2},    Place{{0.6f, -4.0f}, 1},
                                    Place{{6.5f, -4.5f}, 0},  Place{{-7.5f, -5.0f}, 2},  Place{{-3.0f, -8.0f}, 1},
                                    Place{{2.8f, -10.0f}, 0}, Place{{-11.0f, -9.0f}, 0}, Place{{10.5f, -9.5f}, 1}};
        Dice dice(821);
        for (const Place& place : places) {
            const Kind& kind = kinds[place.kind];
            m_.stand({place.at.x, 0.0f, place.at.y}, dice.uniform(0.0f, 360.0f));
            add_broadleaf(m_, kind.shape, dice, kind.bark, kind.leaves);
        }
    }

    Scene scene_;
    Modeller m_;
};

}  // namespace

Scene builtin_foliage() { return Foliage().scene(); }

}  // namespace render
