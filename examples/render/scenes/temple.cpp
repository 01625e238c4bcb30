#include "scenes/temple.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

#include "scenes/furniture.hpp"
#include "scenes/ornaments.hpp"

namespace render {
namespace {

constexpr float entablature = 1.35f;
constexpr float wall = 0.5f;

class TempleBuilder : Temple {
public:
    explicit TempleBuilder(Modeller& m) : m_(m) {
        paint_all();
        add_floor();
        add_columns();
        add_entablature();
        add_roof();
        add_cella();
        add_figures();
    }

private:
    void paint_all() {
        stone_ = m_.paint("limestone", {0.70f, 0.63f, 0.51f}, 0.9f);
        marble_ = m_.paint("marble", {0.76f, 0.73f, 0.68f}, 0.9f);
        wall_ = m_.paint("plaster", {0.68f, 0.55f, 0.40f}, 0.9f);
        dado_ = m_.paint("dado", {0.40f, 0.11f, 0.07f}, 0.8f);
        beam_ = m_.paint("cedar", {0.30f, 0.17f, 0.09f}, 0.7f);
        coffer_ = m_.paint("coffer", {0.14f, 0.24f, 0.38f}, 0.8f);
        tile_ = m_.paint("roof tile", {0.50f, 0.22f, 0.12f}, 0.8f);
        bronze_ = m_.paint("bronze", {0.66f, 0.44f, 0.22f}, 0.38f, 1.0f);
        clay_ = m_.paint("clay", {0.58f, 0.27f, 0.14f}, 0.3f);
        black_ = m_.paint("black glaze", {0.035f, 0.03f, 0.03f}, 0.24f);
        slabs_ = {m_.paint("pale slab", {0.66f, 0.62f, 0.55f}, 0.30f),
                  m_.paint("gray slab", {0.56f, 0.54f, 0.50f}, 0.28f),
                  m_.paint("rose slab", {0.62f, 0.52f, 0.45f}, 0.32f)};
    }

    /// Steps around, and slabs of three tones.
    void add_floor() {
        m_.stand({0, 0, 0});
        m_.material = stone_;
        for (int i = 0; i < 3; ++i) {
            const float out = 0.85f + 0.42f * static_cast<float>(i);
            const float top = -step_height * static_cast<float>(i) - (i == 0 ? 0.002f : 0.0f);
            m_.box({-half_width - out, top - step_height - 0.05f, -half_length - out},
                   {half_width + out, top, half_length + out});
        }
        Dice dice(409);
        constexpr int across = 14;
        constexpr int along = 26;
        const float w = 2.0f * (half_width + 0.85f) / across;
        const float l = 2.0f * (half_length + 0.85f) / along;
        for (int i = 0; i < across; ++i) {
            for (int j = 0; j < along; ++j) {
                m_.material = slabs_[dice.pick(slabs_.size())];
                const float x = -half_width - 0.85f + w * static_cast<float>(i);
                const float z = -half_length - 0.85f + l * static_cast<float>(j);
                m_.quad({x, 0, z + l}, {w, 0, 0}, {0, 0, -l});
            }
        }
    }

    /// The i-th of `count` places, evenly from -half to half.
    static float spaced(int i, int count, float half) {
        return half * (2.0f * static_cast<float>(i) / static_cast<float>(count - 1) - 1.0f);
    }

    void add_columns() {
        const auto column = [&](float x, float z) {
            m_.stand({x, 0.001f, z});
            add_fluted_column(m_, column_radius, column_height - 0.001f, 20, stone_);
        };
        for (const float side : {-1.0f, 1.0f}) {
            for (int i = 0; i < columns_across; ++i) {
                column(spaced(i, columns_across, half_width), side * half_length);
            }
            for (int i = 1; i + 1 < columns_along; ++i) {
                column(side * half_width, spaced(i, columns_along, half_length));
            }
        }
    }

    /// Architrave, a frieze with triglyphs, and a cornice, on all four sides.
    void add_entablature() {
        const auto ring = [&](float in, float out, float low, float high) {
            m_.box({-half_width - out, low, half_length - in}, {half_width + out, high, half_length + out});
            m_.box({-half_width - out, low, -half_length - out}, {half_width + out, high, -half_length + in});
            m_.box({half_width - in, low, -half_length + in}, {half_width + out, high, half_length - in});
            m_.box({-half_width - out, low, -half_length + in}, {-half_width + in, high, half_length - in});
        };
        m_.stand({0, 0, 0});
        m_.material = stone_;
        const float h = column_height;
        ring(0.46f, 0.46f, h, h + 0.52f);
        ring(0.46f, 0.50f, h + 0.52f, h + 0.60f);
        ring(0.46f, 0.43f, h + 0.60f, h + 1.08f);
        ring(0.46f, 0.75f, h + 1.08f, h + entablature - 0.08f);
        ring(0.46f, 0.85f, h + entablature - 0.08f, h + entablature);
        for (const float side : {-1.0f, 1.0f}) {
            for (int i = 0; i < 2 * columns_across - 1; ++i) {
                m_.stand({spaced(i, 2 * columns_across - 1, half_width), 0, side * (half_length + 0.43f)},
                         side > 0 ? 0.0f : 180.0f);
                add_triglyph(m_, column_height + 0.6f, 0.48f, stone_);
            }
            for (int i = 1; i < 2 * columns_along - 2; ++i) {
                m_.stand({side * (half_width + 0.43f), 0, spaced(i, 2 * columns_along - 1, half_length)}, side * 90.0f);
                add_triglyph(m_, column_height + 0.6f, 0.48f, stone_);
            }
        }
    }

    void add_roof() {
        m_.stand({0, 0, 0});
        const float eaves = column_height + entablature;
        const float x = half_width + 0.95f;
        const float z = half_length + 0.95f;
        const float rise = 0.26f * x;
        m_.material = stone_;
        for (const float side : {-1.0f, 1.0f}) {  // the gables
            const float at = side * (half_length + 0.2f);
            m_.facet({-side * x, eaves, at}, {side * x, eaves, at}, {0.0f, eaves + rise - 0.05f, at});
        }
        m_.material = tile_;
        const glm::vec3 slope(x, -rise, 0.0f);
        for (const float side : {-1.0f, 1.0f}) {
            const glm::vec3 down(side * slope.x, slope.y, 0.0f);
            const glm::vec3 ridge(0.0f, eaves + rise, side * z);
            m_.quad(ridge, down, {0, 0, -side * 2.0f * z});
            m_.quad(ridge - glm::vec3(0, 0.12f, 0), {0, 0, -side * 2.0f * z}, down);
            // Rows of cover tiles run down the slope.
            for (int i = 0; i <= 48; ++i) {
                const float at = spaced(i, 49, z - 0.1f);
                const std::array<glm::vec3, 2> path{glm::vec3(0.0f, eaves + rise, at),
                                                    glm::vec3(0.0f, eaves + rise, at) + 1.01f * down};
                m_.tube(path, 0.07f, 10, false);
            }
        }
        add_ceiling();
    }

    /// Beams over the aisles with a painted board between them.
    void add_ceiling() {
        m_.stand({0, 0, 0});
        m_.material = coffer_;
        m_.box({-half_width + 0.3f, ceiling, -half_length + 0.3f},
               {half_width - 0.3f, ceiling + 0.1f, half_length - 0.3f});
        m_.material = beam_;
        const float x = half_width - 0.46f;
        const float z = half_length - 0.46f;
        for (int i = 0; i < 28; ++i) {
            const float at = spaced(i, 28, z - 0.3f);
            m_.box({-x, ceiling - 0.26f, at - 0.12f}, {x, ceiling - 0.001f, at + 0.12f});
        }
        for (const float at : {-5.0f, -3.9f, 3.9f, 5.0f}) {
            m_.box({at - 0.09f, ceiling - 0.18f, -z}, {at + 0.09f, ceiling - 0.002f, z});
        }
    }

    /// A walled room with a door in front, a dado of red around it, and piers at its corners.
    void add_cella() {
        m_.stand({0, 0, 0});
        const auto walls = [&](float low, float high, float grow) {
            const float x = cella_x + grow;
            const float z = cella_z + grow;
            const float in = wall + 2.0f * grow;
            const float door = 1.1f - grow;
            m_.box({-x, low, -z}, {-x + in, high, z});
            m_.box({x - in, low, -z}, {x, high, z});
            m_.box({-x + in, low, -z}, {x - in, high, -z + in});
            m_.box({-x + in, low, z - in}, {-door, high, z});
            m_.box({door, low, z - in}, {x - in, high, z});
        };
        m_.material = wall_;
        walls(0.001f, ceiling - 0.3f, 0.0f);
        m_.box({-1.1f, 4.0f, cella_z - wall}, {1.1f, ceiling - 0.3f, cella_z});
        m_.material = dado_;
        walls(0.002f, 1.05f, 0.012f);
        m_.material = marble_;
        walls(1.05f, 1.15f, 0.035f);
        walls(0.002f, 0.16f, 0.03f);
        walls(4.55f, 4.68f, 0.03f);
        m_.box({-1.45f, 0.002f, cella_z - 0.02f}, {-1.05f, 4.3f, cella_z + 0.08f});
        m_.box({1.05f, 0.002f, cella_z - 0.02f}, {1.45f, 4.3f, cella_z + 0.08f});
        m_.box({-1.6f, 4.0f, cella_z - 0.02f}, {1.6f, 4.4f, cella_z + 0.12f});
        for (const float sx : {-1.0f, 1.0f}) {
            for (int i = 0; i < 7; ++i) {
                const float z = spaced(i, 7, cella_z - 0.2f);
                const float x = sx * cella_x;
                m_.box({std::min(x, x + sx * 0.1f), 0.003f, z - 0.28f}, {std::max(x, x + sx * 0.1f), 4.55f, z + 0.28f});
            }
        }
    }

    /// Statues and amphorae along the cella's walls, and one statue within.
    void add_figures() {
        Dice dice(419);
        for (const float side : {-1.0f, 1.0f}) {
            for (int i = 0; i < 6; ++i) {
                const float z = spaced(i, 7, cella_z - 0.2f) + (cella_z - 0.2f) / 6.0f;
                m_.stand({side * (cella_x + 0.62f), 0.001f, z}, side * 90.0f);
                if (i % 2 == 1) {
                    add_statue(m_, 2.35f, stone_, i == 3 ? bronze_ : marble_);
                    continue;
                }
                add_vase(m_, 0, dice.uniform(0.95f, 1.15f), 48, i == 2 ? black_ : clay_);
                m_.stand({side * (cella_x + 0.45f), 0.001f, z - 0.62f});
                add_vase(m_, 2, dice.uniform(0.5f, 0.65f), 40, clay_);
            }
        }
        for (const float x : {-2.0f, 2.0f}) {
            m_.stand({x, 0.001f, cella_z + 0.6f});
            add_statue(m_, 2.5f, stone_, bronze_);
        }
        m_.stand({0, 0.001f, -cella_z + 2.2f});
        add_statue(m_, 3.9f, marble_, bronze_);
    }

    Modeller& m_;
    std::uint32_t stone_{}, marble_{}, wall_{}, dado_{}, beam_{}, coffer_{}, tile_{}, bronze_{}, clay_{}, black_{};
    std::array<std::uint32_t, 3> slabs_{};
};

}  // namespace

void add_temple(Modeller& m) { TempleBuilder{m}; }

}  // namespace render
