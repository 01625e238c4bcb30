#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "scenes/builtin.hpp"
#include "scenes/furniture.hpp"
#include "scenes/shapes.hpp"

namespace render {
namespace {

// The room: x in [-4.5, 4.5], y in [0, 3.2], z in [-3.6, 3.6]. Windows are in the walls at +x and -z, the board hangs
// at -x.
constexpr float half_length = 4.5f;
constexpr float half_width = 3.6f;
constexpr float ceiling = 3.2f;
constexpr float wall = 0.3f;  ///< its thickness
constexpr float sill = 0.95f;
constexpr float transom = 2.2f;
constexpr float lintel = 2.85f;
constexpr float half_bar = 0.04f;  ///< of a window's frame

/// Along a wall, where its windows are.
struct Window {
    float from;
    float to;
};
constexpr std::array<Window, 3> side_windows{Window{-3.1f, -1.3f}, Window{-0.9f, 0.9f}, Window{1.3f, 3.1f}};
constexpr std::array<Window, 3> back_windows{Window{-2.9f, -0.9f}, Window{-0.3f, 1.7f}, Window{2.3f, 4.1f}};

class Classroom {
public:
    Classroom() : m_(scene_) {
        paint_all();
        add_shell();
        add_ceiling_things();
        add_front();
        add_desks();
        add_shelves();
        add_radiators();
        scene_.cameras.push_back({"back row", {3.9f, 1.75f, 2.9f}, {-2.4f, 0.85f, -1.2f}, {0, 1, 0}, 56.0f});
        scene_.cameras.push_back({"teacher", {-3.9f, 1.7f, 1.9f}, {2.6f, 0.95f, -1.6f}, {0, 1, 0}, 58.0f});
        scene_.lighting.sun = lightcuts::SunPosition{35.0, 120.0, 3.0};
        scene_.lighting.ground = 0.0f;
        scene_.lighting.indirect = 20'000;
    }

    Scene scene() { return std::move(scene_); }

private:
    void paint_all() {
        plaster_ = m_.paint("plaster", {0.74f, 0.72f, 0.66f}, 0.9f);
        ceiling_ = m_.paint("ceiling", {0.80f, 0.80f, 0.78f}, 0.9f);
        linoleum_ = m_.paint("linoleum", {0.34f, 0.37f, 0.33f}, 0.28f);
        frame_ = m_.paint("window frame", {0.72f, 0.73f, 0.74f}, 0.5f);
        // What reflects nothing has no virtual lights, so that all of them are inside.
        outside_ = m_.paint("outside", glm::vec3(0.0f), 1.0f);
        beech_ = m_.paint("beech", {0.56f, 0.38f, 0.20f}, 0.3f);
        steel_ = m_.paint("painted steel", {0.24f, 0.27f, 0.31f}, 0.4f);
        seat_ = m_.paint("seat", {0.12f, 0.24f, 0.42f}, 0.4f);
        board_ = m_.paint("board", {0.04f, 0.13f, 0.09f}, 0.6f);
        paper_ = m_.paint("paper", {0.76f, 0.74f, 0.68f}, 0.9f);
        radiator_ = m_.paint("radiator", {0.70f, 0.70f, 0.68f}, 0.4f);
        leaf_ = m_.paint("leaf", {0.08f, 0.28f, 0.07f}, 0.4f);
        scene_.materials[leaf_].double_sided = true;
        pot_ = m_.paint("pot", {0.50f, 0.21f, 0.11f}, 0.5f);
        glaze_ = m_.paint("globe", {0.05f, 0.20f, 0.45f}, 0.18f);
        covers_ = {
            m_.paint("red cloth", {0.45f, 0.08f, 0.06f}, 0.6f), m_.paint("green cloth", {0.08f, 0.26f, 0.14f}, 0.6f),
            m_.paint("ochre cloth", {0.60f, 0.40f, 0.12f}, 0.6f), m_.paint("cream cloth", {0.72f, 0.68f, 0.56f}, 0.7f),
            m_.paint("navy cloth", {0.05f, 0.08f, 0.24f}, 0.55f)};
    }

    /// Planes at the ends of a wall's windows, of their bars, and of the room and its walls.
    static std::vector<float> planes_along(float half, const std::array<Window, 3>& windows) {
        std::vector<float> planes{-half - wall, -half, half, half + wall};
        for (const Window& w : windows) {
            const float middle = 0.5f * (w.from + w.to);
            for (const float x : {w.from, middle - half_bar, middle + half_bar, w.to}) planes.push_back(x);
        }
        std::sort(planes.begin(), planes.end());
        return planes;
    }

    static bool is_in_window(float along, float y, const std::array<Window, 3>& windows) {
        if (y < sill || y > lintel || (y > transom - half_bar && y < transom + half_bar)) return false;
        return std::any_of(windows.begin(), windows.end(), [along](const Window& w) {
            const float middle = 0.5f * (w.from + w.to);
            return along > w.from && along < w.to && (along < middle - half_bar || along > middle + half_bar);
        });
    }

    /// Floor, walls, ceiling and the bars of windows, in one piece.
    void add_shell() {
        const BlockGrid grid{
            {planes_along(half_length, back_windows),
             {-wall, 0.0f, sill, transom - half_bar, transom + half_bar, lintel, ceiling, ceiling + wall},
             planes_along(half_width, side_windows)}};
        const auto is_inside = [](const glm::vec3& p) {
            return std::abs(p.x) < half_length && p.y > 0.0f && p.y < ceiling && std::abs(p.z) < half_width;
        };
        const auto solid = [&](const glm::ivec3& cell) {
            const glm::vec3 p = grid.middle(cell);
            if (is_inside(p)) return false;
            if (p.x > half_length && is_in_window(p.z, p.y, side_windows)) return false;
            return !(p.z < -half_width && is_in_window(p.x, p.y, back_windows));
        };
        m_.stand({});
        m_.blocks(grid, solid, [&](const glm::ivec3& cell, int axis, int side) {
            glm::ivec3 beside = cell;
            beside[axis] += side;
            if (beside[axis] < 0 || beside[axis] >= grid.cells(axis)) return outside_;
            const glm::vec3 p = grid.middle(cell), before = grid.middle(beside);
            if (p.y < 0.0f) return linoleum_;
            if (p.y > ceiling) return ceiling_;
            return is_inside(before) ? plaster_ : frame_;
        });
    }

    /// Lamps that are off, and beams.
    void add_ceiling_things() {
        m_.material = frame_;
        for (const float x : {-2.6f, 0.0f, 2.6f}) {
            for (const float z : {-1.8f, 0.0f, 1.8f}) {
                m_.box({x - 0.65f, ceiling - 0.32f, z - 0.09f}, {x + 0.65f, ceiling - 0.25f, z + 0.09f});
                for (const float end : {-0.5f, 0.5f}) {
                    m_.box({x + end - 0.01f, ceiling - 0.25f, z - 0.01f}, {x + end + 0.01f, ceiling, z + 0.01f});
                }
            }
        }
    }

    /// The board, a sheet of paper beside it, and the teacher's desk.
    void add_front() {
        m_.material = board_;
        m_.box({-half_length + 0.002f, 0.95f, -1.9f}, {-half_length + 0.03f, 2.25f, 1.7f});
        m_.material = beech_;
        m_.box({-half_length + 0.002f, 0.90f, -1.95f}, {-half_length + 0.1f, 0.949f, 1.75f});
        m_.box({-half_length + 0.002f, 2.251f, -1.95f}, {-half_length + 0.05f, 2.31f, 1.75f});
        m_.material = paper_;
        for (const float z : {-3.2f, -2.6f, 2.15f, 2.75f}) {
            m_.box({-half_length + 0.002f, 1.3f, z}, {-half_length + 0.006f, 1.95f, z + 0.45f});
        }
        m_.stand({-3.1f, 0.001f, 1.2f}, 90.0f);
        add_table(m_, 1.6f, 0.75f, beech_, steel_);
        m_.stand({-3.75f, 0.001f, 1.2f}, 90.0f);
        add_chair(m_, steel_, seat_);
        Dice dice(811);
        m_.stand({-3.1f, 0.762f, 0.8f}, 20.0f);
        add_book_stack(m_, 5, dice, covers_);
        m_.stand({-3.0f, 0.762f, 1.6f});
        m_.material = glaze_;
        m_.sphere({0.0f, 0.16f, 0.0f}, 0.15f, 40);
    }

    /// Four rows of three double desks with chairs, books and paper on some.
    void add_desks() {
        Dice dice(821);
        for (int row = 0; row < 4; ++row) {
            const float x = -1.35f + 1.45f * static_cast<float>(row);
            for (int column = 0; column < 3; ++column) {
                const float z = -2.15f + 2.1f * static_cast<float>(column);
                m_.stand({x, 0.001f, z}, 90.0f + dice.uniform(-2.0f, 2.0f));
                add_table(m_, 1.4f, 0.6f, beech_, steel_);
                for (const float side : {-0.36f, 0.36f}) {
                    const float turn = -90.0f + dice.uniform(-12.0f, 12.0f);
                    m_.stand({x + dice.uniform(0.5f, 0.66f), 0.001f, z + side}, turn);
                    add_chair(m_, steel_, seat_);
                    const float degrees = dice.uniform(0.0f, 360.0f);
                    m_.stand({x, 0.762f, z + side}, degrees);
                    if (dice.pick(2) == 0) {
                        add_book_stack(m_, 1 + static_cast<int>(dice.pick(4)), dice, covers_);
                    } else {
                        m_.material = paper_;
                        m_.box({-0.105f, 0.0f, -0.148f}, {0.105f, 0.004f, 0.148f});
                    }
                }
            }
        }
    }

    /// Bookcases along the wall at +z and a cupboard with plants.
    void add_shelves() {
        Dice dice(823);
        for (const float x : {-2.7f, -1.1f, 0.5f}) {
            m_.stand({x, 0.001f, half_width - 0.002f}, 180.0f);
            add_bookcase(m_, 1.5f, 2.0f, 5, dice, beech_, covers_);
        }
        m_.stand({});
        m_.material = steel_;
        for (const float x : {1.6f, 2.5f}) {
            m_.box({x, 0.001f, half_width - 0.45f}, {x + 0.88f, 1.8f, half_width - 0.002f});
            m_.box({x + 0.43f, 0.8f, half_width - 0.47f}, {x + 0.45f, 1.0f, half_width - 0.45f});
        }
        for (const float x : {1.9f, 2.9f}) {
            m_.stand({x, 1.801f, half_width - 0.24f});
            add_plant(m_, 0.45f, 18, dice, pot_, leaf_);
        }
    }

    /// Ribs under the windows, and plants on the sills.
    void add_radiators() {
        m_.stand({});
        m_.material = radiator_;
        for (const Window& w : side_windows) {
            for (float z = w.from; z < w.to - 0.05f; z += 0.1f) {
                m_.box({half_length - 0.16f, 0.12f, z}, {half_length - 0.05f, 0.78f, z + 0.06f});
            }
        }
        for (const Window& w : back_windows) {
            for (float x = w.from; x < w.to - 0.05f; x += 0.1f) {
                m_.box({x, 0.12f, -half_width + 0.05f}, {x + 0.06f, 0.78f, -half_width + 0.16f});
            }
        }
        Dice dice(827);
        for (const Window& w : side_windows) {
            m_.stand({half_length + 0.13f, sill + 0.001f, w.from + 0.4f});
            add_plant(m_, 0.35f, 16, dice, pot_, leaf_);
        }
    }

    Scene scene_;
    Modeller m_;
    std::uint32_t plaster_{}, ceiling_{}, linoleum_{}, frame_{}, outside_{}, beech_{}, steel_{}, seat_{}, board_{},
        paper_{}, radiator_{}, leaf_{}, pot_{}, glaze_{};
    std::array<std::uint32_t, 5> covers_{};
};

}  // namespace

Scene builtin_classroom() { return Classroom().scene(); }

}  // namespace render
