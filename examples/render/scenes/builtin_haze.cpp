#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <glm/common.hpp>

#include "scenes/builtin.hpp"
#include "scenes/furniture.hpp"
#include "scenes/shapes.hpp"

namespace render {
namespace {

// A refectory: x in [-5, 5], y in [0, 7], z in [-12, 12]. The sun comes in at +x, through windows between whose piers
// columns stand.
constexpr float half_width = 5.0f;
constexpr float half_length = 12.0f;
constexpr float ceiling = 7.0f;
constexpr float wall = 0.4f;  ///< its thickness
constexpr int windows = 6;
constexpr float bay = 2.0f * half_length / windows;
constexpr float sill = 2.3f;
constexpr float lintel = 5.9f;
constexpr float half_window = 0.95f;
constexpr float column_x = 2.9f;

class Haze {
public:
    Haze() : m_(scene_) {
        paint_all();
        add_floor();
        add_walls();
        add_windows();
        add_ceiling();
        add_columns();
        add_lamps();
        add_furniture();
        scene_.cameras.push_back({"hall", {-2.1f, 1.7f, 11.3f}, {0.9f, 2.75f, 0.0f}, {0, 1, 0}, 56.0f});
        scene_.cameras.push_back({"windows", {-4.4f, 1.6f, 1.0f}, {4.5f, 3.2f, -4.5f}, {0, 1, 0}, 62.0f});
        scene_.lighting.sun = lightcuts::SunPosition{36.0, 110.0, 2.5};
        scene_.lighting.ground = 0.0f;  // it would light the ceiling a little, and hundreds of clusters are in vain
        scene_.lighting.indirect = 50'000;
    }

    Scene scene() { return std::move(scene_); }

private:
    void paint_all() {
        plaster_ = m_.paint("plaster", {0.50f, 0.44f, 0.36f}, 0.9f);
        stone_ = m_.paint("limestone", {0.66f, 0.60f, 0.50f}, 0.6f);
        oak_ = m_.paint("dark oak", {0.16f, 0.09f, 0.05f}, 0.5f);
        board_ = m_.paint("table board", {0.26f, 0.14f, 0.07f}, 0.28f);
        iron_ = m_.paint("iron", {0.05f, 0.05f, 0.05f}, 0.5f);
        leather_ = m_.paint("leather", {0.34f, 0.08f, 0.05f}, 0.4f);
        clay_ = m_.paint("clay pot", {0.50f, 0.21f, 0.11f}, 0.5f);
        leaf_ = m_.paint("leaf", {0.08f, 0.26f, 0.06f}, 0.4f);
        // Nothing sees the outside. What reflects nothing has no virtual lights, so that all of them are in the hall.
        outside_ = m_.paint("outside", glm::vec3(0.0f), 1.0f);
        slabs_ = {m_.paint("pale slab", {0.52f, 0.47f, 0.40f}, 0.28f),
                  m_.paint("gray slab", {0.40f, 0.38f, 0.34f}, 0.26f),
                  m_.paint("brown slab", {0.42f, 0.33f, 0.25f}, 0.30f)};
        glazes_ = {m_.paint("cobalt glaze", {0.03f, 0.09f, 0.45f}, 0.16f),
                   m_.paint("white glaze", {0.80f, 0.79f, 0.75f}, 0.15f),
                   m_.paint("amber glaze", {0.75f, 0.38f, 0.05f}, 0.2f)};
        covers_ = {m_.paint("red cloth", {0.45f, 0.06f, 0.05f}, 0.6f),
                   m_.paint("green cloth", {0.06f, 0.22f, 0.11f}, 0.6f),
                   m_.paint("ochre cloth", {0.58f, 0.36f, 0.10f}, 0.6f),
                   m_.paint("brown leather", {0.24f, 0.11f, 0.05f}, 0.4f)};
    }

    void add_floor() {
        m_.stand({});
        m_.material = outside_;
        m_.box({-half_width - wall, -0.3f, -half_length - wall}, {half_width + wall, -0.01f, half_length + wall});
        Dice dice(701);
        constexpr int across = 10;
        constexpr int along = 24;
        constexpr float w = 2.0f * half_width / across;
        constexpr float l = 2.0f * half_length / along;
        for (int i = 0; i < across; ++i) {
            for (int j = 0; j < along; ++j) {
                m_.material = slabs_[dice.pick(slabs_.size())];
                const float x = -half_width + w * static_cast<float>(i);
                const float z = -half_length + l * static_cast<float>(j);
                m_.box({x + 0.004f, -0.0099f, z + 0.004f}, {x + w - 0.004f, 0.0f, z + l - 0.004f});
            }
        }
    }

    /// A box between any two opposite corners.
    void block(const glm::vec3& a, const glm::vec3& b) { m_.box(glm::min(a, b), glm::max(a, b)); }

    /// Part of a wall at +x or -x: plaster within, and the outside.
    void long_wall(float side, float low, float high, float from, float to) {
        const auto layer = [&](float in, float out) {
            block({side * (half_width + in), low, from}, {side * (half_width + out), high, to});
        };
        m_.material = plaster_;
        layer(0.0f, wall - 0.02f);
        m_.material = outside_;
        layer(wall - 0.019f, wall);
    }

    void add_walls() {
        m_.stand({});
        long_wall(-1.0f, 0.0f, ceiling, -half_length, half_length);
        long_wall(1.0f, 0.0f, sill, -half_length, half_length);
        long_wall(1.0f, lintel, ceiling, -half_length, half_length);
        for (int i = 0; i <= windows; ++i) {
            const float middle = -half_length + bay * static_cast<float>(i);
            const float half = 0.5f * bay - half_window;
            long_wall(1.0f, sill, lintel, std::max(middle - half, -half_length), std::min(middle + half, half_length));
        }
        for (const float side : {-1.0f, 1.0f}) {
            const float middle = side * (half_length + wall - 0.02f);
            m_.material = plaster_;
            block({-half_width, 0.0f, side * half_length}, {half_width, ceiling, middle});
            m_.material = outside_;
            block({-half_width - wall, 0.0f, middle}, {half_width + wall, ceiling, side * (half_length + wall)});
            m_.material = stone_;  // a plinth around
            const float x = side * half_width;
            const float z = side * half_length;
            block({x, 0.001f, -half_length + 0.06f}, {x - side * 0.06f, 0.35f, half_length - 0.06f});
            block({-half_width, 0.001f, z}, {half_width, 0.35f, z - side * 0.06f});
        }
        // A ledge under the windows.
        m_.box({half_width - 0.14f, sill - 0.12f, -half_length + 0.1f},
               {half_width, sill - 0.001f, half_length - 0.1f});
    }

    /// A mullion and a transom of stone and bars of iron, which cut the light to shafts.
    void add_windows() {
        m_.stand({});
        const float x = half_width + 0.5f * wall;
        for (int i = 0; i < windows; ++i) {
            const float middle = -half_length + bay * (static_cast<float>(i) + 0.5f);
            const auto across = [&](float share, float half) {
                const float y = glm::mix(sill, lintel, share);
                m_.box({x - half, y - half, middle - half_window}, {x + half, y + half, middle + half_window});
            };
            m_.material = stone_;
            m_.box({x - 0.1f, sill, middle - 0.1f}, {x + 0.1f, lintel, middle + 0.1f});
            across(0.62f, 0.1f);
            m_.material = iron_;
            across(0.31f, 0.03f);
        }
    }

    void add_ceiling() {
        m_.stand({});
        m_.material = plaster_;
        m_.box({-half_width, ceiling, -half_length}, {half_width, ceiling + 0.2f, half_length});
        m_.material = outside_;
        m_.box({-half_width - wall, ceiling + 0.201f, -half_length - wall},
               {half_width + wall, ceiling + 0.25f, half_length + wall});
        for (const float side : {-1.0f, 1.0f}) {
            block({side * half_width, ceiling + 0.001f, -half_length},
                  {side * (half_width + wall), ceiling + 0.2f, half_length});
        }
        m_.material = oak_;
        for (int i = 0; i <= windows; ++i) {
            const float z = glm::clamp(-half_length + bay * static_cast<float>(i), -half_length + 0.16f,
                                       half_length - 0.16f);
            m_.box({-half_width, ceiling - 0.45f, z - 0.15f}, {half_width, ceiling - 0.001f, z + 0.15f});
        }
        for (int i = -4; i <= 4; ++i) {
            const float x = static_cast<float>(i);
            m_.box({x - 0.06f, ceiling - 0.16f, -half_length}, {x + 0.06f, ceiling - 0.002f, half_length});
        }
    }

    void add_columns() {
        for (const float side : {-1.0f, 1.0f}) {
            for (int i = 1; i < windows; ++i) {
                m_.stand({side * column_x, 0.001f, -half_length + bay * static_cast<float>(i)});
                add_column(m_, 0.24f, ceiling - 0.452f, 36, stone_);
            }
        }
    }

    /// Globes on rods from the ceiling, in the middle of the bays.
    void add_lamps() {
        const std::uint32_t glow = m_.paint("globe", glm::vec3(0.0f), 1.0f);
        scene_.materials[glow].emission = {85.0f, 58.0f, 30.0f};
        for (int i = 0; i < windows; ++i) {
            m_.stand({0.0f, 0.0f, -half_length + bay * (static_cast<float>(i) + 0.5f)});
            m_.material = iron_;
            m_.cylinder({0.0f, 4.6f, 0.0f}, 0.015f, ceiling - 4.602f, 8);
            m_.material = glow;
            m_.sphere({0.0f, 4.45f, 0.0f}, 0.14f, 24);
        }
    }

    void add_furniture() {
        Dice dice(709);
        for (int i = 0; i < 5; ++i) {
            const float z = -9.2f + 4.0f * static_cast<float>(i);
            m_.stand({0.0f, 0.001f, z}, 90.0f);
            add_table(m_, 3.2f, 1.0f, board_, oak_);
            for (int k = 0; k < 5; ++k) {
                m_.stand({dice.uniform(-0.25f, 0.25f), 0.762f, z - 1.2f + 0.6f * static_cast<float>(k)});
                const auto style = static_cast<int>(dice.pick(3));
                const std::uint32_t glaze = glazes_[dice.pick(glazes_.size())];
                add_vase(m_, style, dice.uniform(0.16f, 0.34f), 28, glaze);
            }
            for (const float side : {-1.0f, 1.0f}) {
                for (int k = 0; k < 4; ++k) {
                    const float turn = (side > 0.0f ? -90.0f : 90.0f) + dice.uniform(-8.0f, 8.0f);
                    const float x = side * dice.uniform(0.72f, 0.9f);
                    m_.stand({x, 0.001f, z - 1.2f + 0.8f * static_cast<float>(k)}, turn);
                    add_chair(m_, oak_, leather_);
                }
            }
        }
        for (int i = 0; i < windows; ++i) {
            const float z = -half_length + bay * (static_cast<float>(i) + 0.5f);
            m_.stand({-half_width + 0.061f, 0.001f, z}, 90.0f);
            add_bookcase(m_, 2.6f, 3.0f, 6, dice, oak_, covers_);
            m_.stand({half_width - 0.7f, 0.001f, z});
            add_plant(m_, dice.uniform(0.7f, 1.0f), 26, dice, clay_, leaf_);
        }
    }

    Scene scene_;
    Modeller m_;
    std::uint32_t plaster_{}, stone_{}, oak_{}, board_{}, iron_{}, leather_{}, clay_{}, leaf_{}, outside_{};
    std::array<std::uint32_t, 3> slabs_{};
    std::array<std::uint32_t, 3> glazes_{};
    std::array<std::uint32_t, 4> covers_{};
};

}  // namespace

Scene builtin_haze() { return Haze().scene(); }

}  // namespace render
