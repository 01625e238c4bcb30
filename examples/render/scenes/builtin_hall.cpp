#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>

#include "scenes/builtin.hpp"
#include "scenes/furniture.hpp"
#include "scenes/shapes.hpp"

namespace render {
namespace {

// The room: x in [-10, 10], y in [0, 6], z in [-6, 6]. Panels stand in 9 columns and 8 rows; beams and columns
// stand halfway between them.
constexpr float half_length = 10.0f;
constexpr float half_width = 6.0f;
constexpr float ceiling = 6.0f;
constexpr int panel_columns = 9;
constexpr int panel_rows = 8;
constexpr std::array column_x{-5.5555f, -1.1111f, 3.3333f, 7.7777f};
constexpr std::array column_z{-3.0f, 3.0f};
constexpr float partition_x = 5.5f;

class Hall {
public:
    Hall() : m_(scene_) {
        scene_.name = "builtin:hall";
        paint_all();
        add_shell();
        add_panels();
        add_structure();
        add_banners();
        add_partition();
        add_books();
        add_tables();
        add_sculptures();
        add_greenery();
        add_cameras();
    }

    Scene scene() { return std::move(scene_); }

private:
    void paint_all() {
        wall_ = m_.paint("plaster", {0.78f, 0.74f, 0.66f}, 0.9f);
        wainscot_ = m_.paint("wainscot", {0.10f, 0.20f, 0.20f}, 0.45f);
        ceiling_ = m_.paint("ceiling", {0.80f, 0.79f, 0.76f}, 0.9f);
        stone_ = m_.paint("limestone", {0.72f, 0.67f, 0.58f}, 0.4f);
        beam_ = m_.paint("dark oak", {0.16f, 0.09f, 0.05f}, 0.45f);
        oak_ = m_.paint("oak", {0.36f, 0.20f, 0.10f}, 0.3f);
        teal_ = m_.paint("teal lacquer", {0.03f, 0.22f, 0.24f}, 0.3f);
        brass_ = m_.paint("brass", {0.90f, 0.64f, 0.26f}, 0.3f, 1.0f);
        copper_ = m_.paint("copper", {0.90f, 0.50f, 0.33f}, 0.4f, 1.0f);
        steel_ = m_.paint("steel", {0.66f, 0.67f, 0.69f}, 0.45f, 1.0f);
        fixture_ = m_.paint("fixture", {0.5f, 0.5f, 0.5f}, 0.5f);
        leaf_ = m_.paint("leaf", {0.07f, 0.26f, 0.06f}, 0.35f);
        scene_.materials[leaf_].double_sided = true;
        terracotta_ = m_.paint("terracotta", {0.50f, 0.20f, 0.11f}, 0.5f);
        seat_ = m_.paint("leather", {0.42f, 0.07f, 0.05f}, 0.35f);
        marble_ = m_.paint("white marble", {0.82f, 0.80f, 0.77f}, 0.2f);
        rug_ = m_.paint("rug", {0.34f, 0.05f, 0.05f}, 1.0f);
        rug_border_ = m_.paint("rug border", {0.58f, 0.42f, 0.22f}, 1.0f);
        planks_ = {m_.paint("walnut plank", {0.20f, 0.105f, 0.05f}, 0.24f),
                   m_.paint("oiled plank", {0.25f, 0.135f, 0.065f}, 0.28f),
                   m_.paint("honey plank", {0.30f, 0.165f, 0.08f}, 0.26f)};
        glazes_ = {m_.paint("white glaze", {0.80f, 0.79f, 0.75f}, 0.15f),
                   m_.paint("cobalt glaze", {0.03f, 0.09f, 0.45f}, 0.16f),
                   m_.paint("jade glaze", {0.15f, 0.45f, 0.33f}, 0.18f),
                   m_.paint("crimson glaze", {0.55f, 0.03f, 0.04f}, 0.17f),
                   m_.paint("amber glaze", {0.75f, 0.38f, 0.05f}, 0.2f)};
        covers_ = {m_.paint("red cloth", {0.45f, 0.06f, 0.05f}, 0.6f),
                   m_.paint("green cloth", {0.06f, 0.22f, 0.11f}, 0.6f),
                   m_.paint("navy cloth", {0.05f, 0.08f, 0.24f}, 0.55f),
                   m_.paint("ochre cloth", {0.58f, 0.36f, 0.10f}, 0.6f),
                   m_.paint("cream cloth", {0.72f, 0.66f, 0.50f}, 0.7f),
                   m_.paint("brown leather", {0.24f, 0.11f, 0.05f}, 0.4f),
                   m_.paint("black leather", {0.04f, 0.04f, 0.045f}, 0.35f),
                   m_.paint("teal cloth", {0.06f, 0.28f, 0.30f}, 0.6f)};
        panel_ = m_.paint("ceiling panel", glm::vec3(0.0f), 1.0f);
        scene_.materials[panel_].emission = {15.0f, 14.0f, 12.2f};
    }

    void add_shell() {
        m_.stand({0.0f, 0.0f, 0.0f});
        add_floor();
        m_.material = ceiling_;
        m_.quad({-half_length, ceiling, -half_width}, {2 * half_length, 0, 0}, {0, 0, 2 * half_width}, 10, 6);
        m_.material = wall_;
        m_.quad({-half_length, 0, -half_width}, {2 * half_length, 0, 0}, {0, ceiling, 0}, 10, 3);
        m_.quad({half_length, 0, half_width}, {-2 * half_length, 0, 0}, {0, ceiling, 0}, 10, 3);
        m_.quad({-half_length, 0, half_width}, {0, 0, -2 * half_width}, {0, ceiling, 0}, 6, 3);
        m_.quad({half_length, 0, -half_width}, {0, 0, 2 * half_width}, {0, ceiling, 0}, 6, 3);

        // Wainscot of framed panels along the long and the end walls.
        for (const float side : {-1.0f, 1.0f}) {
            add_wainscot(2 * half_length, 20, side < 0 ? glm::vec3(0, 0, -half_width) : glm::vec3(0, 0, half_width),
                         side < 0 ? 0.0f : 180.0f);
            add_wainscot(2 * half_width, 12, {side * half_length, 0, 0}, -side * 90.0f);
        }
    }

    /// Planks along x in staggered rows of three tones, with a hair of a gap.
    void add_floor() {
        Dice dice(11);
        const float depth = 0.25f;
        for (int row = 0; row < 48; ++row) {
            const float z = -half_width + depth * static_cast<float>(row);
            for (float x = -half_length - dice.uniform(0.0f, 1.8f); x < half_length;) {
                const float end = x + dice.uniform(1.6f, 2.4f);
                const float from = std::max(x, -half_length);
                const float to = std::min(end, half_length);
                m_.material = planks_[dice.pick(planks_.size())];
                if (to > from) m_.quad({from, 0, z + depth}, {to - from, 0, 0}, {0, 0, -depth});
                x = end;
            }
        }
    }

    void add_wainscot(float length, int fields, const glm::vec3& at, float degrees) {
        m_.stand(at, degrees);
        m_.material = wainscot_;
        const float x = 0.5f * length;
        m_.box({-x, 0.0f, 0.0f}, {x, 1.05f, 0.02f});
        m_.box({-x, 0.0f, 0.02f}, {x, 0.16f, 0.04f});
        m_.box({-x, 1.05f, 0.0f}, {x, 1.1f, 0.06f});
        const float step = length / static_cast<float>(fields);
        for (int i = 0; i < fields; ++i) {
            const float left = -x + step * static_cast<float>(i) + 0.1f;
            m_.box({left, 0.26f, 0.02f}, {left + step - 0.2f, 0.95f, 0.032f});
        }
        m_.stand({0, 0, 0});
    }

    /// Emissive squares that look down from the underside of flat housings.
    void add_panels() {
        m_.stand({0, 0, 0});
        constexpr float half = 0.3f;
        constexpr float height = ceiling - 0.08f;
        for (int row = 0; row < panel_rows; ++row) {
            for (int column = 0; column < panel_columns; ++column) {
                const float x = half_length * (2.0f * (static_cast<float>(column) + 0.5f) / panel_columns - 1.0f);
                const float z = half_width * (2.0f * (static_cast<float>(row) + 0.5f) / panel_rows - 1.0f);
                m_.material = fixture_;
                m_.box({x - half - 0.03f, height + 0.005f, z - half - 0.03f},
                       {x + half + 0.03f, ceiling - 0.001f, z + half + 0.03f});
                m_.material = panel_;
                m_.quad({x - half, height, z - half}, {2 * half, 0, 0}, {0, 0, 2 * half});
            }
        }
    }

    void add_structure() {
        m_.stand({0, 0, 0});
        m_.material = beam_;
        for (const float x : column_x) m_.box({x - 0.17f, 5.52f, -half_width}, {x + 0.17f, 5.999f, half_width});
        m_.box({-10.0f, 5.52f, -half_width}, {-9.8f, 5.999f, half_width});
        for (const float z : column_z) m_.box({-half_length, 5.62f, z - 0.13f}, {half_length, 5.998f, z + 0.13f});
        for (const float x : column_x) {
            for (const float z : column_z) {
                m_.stand({x, 0, z});
                add_column(m_, 0.24f, 5.519f, 20, stone_);
                for (const float side : {-1.0f, 1.0f}) add_brace(side, x, z);
            }
        }
        // Pilasters against the long walls, behind the columns.
        m_.stand({0, 0, 0});
        m_.material = stone_;
        for (const float x : column_x) {
            for (const float side : {-1.0f, 1.0f}) {
                const float z = side * half_width;
                m_.box({x - 0.2f, 0, std::min(z, z - side * 0.16f)}, {x + 0.2f, 5.519f, std::max(z, z - side * 0.16f)});
            }
        }
    }

    /// Striped cloth on the long wall that has no bookcases, and on the end wall.
    void add_banners() {
        for (const float x : {-7.9f, -3.3f, 1.1f, 5.5f}) add_banner({x, 0.0f, half_width - 0.003f}, 180.0f);
        add_banner({half_length - 0.003f, 0.0f, -2.6f}, -90.0f);
        add_banner({half_length - 0.003f, 0.0f, 2.6f}, -90.0f);
    }

    void add_banner(const glm::vec3& at, float degrees) {
        m_.stand(at, degrees);
        m_.material = brass_;
        m_.box({-0.95f, 4.82f, 0.0f}, {0.95f, 4.88f, 0.06f});
        constexpr std::array<float, 6> edges{-0.85f, -0.6f, -0.5f, 0.5f, 0.6f, 0.85f};
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
            m_.material = i == 2 ? covers_[2] : i % 2 == 0 ? covers_[0] : covers_[3];
            m_.box({edges[i], 1.7f, 0.0f}, {edges[i + 1], 4.82f, 0.025f});
        }
    }

    /// A slanting brace between a column and the beam along z.
    void add_brace(float side, float x, float z) {
        m_.material = beam_;
        m_.place = glm::rotate(glm::translate(glm::mat4(1.0f), {x, 4.75f, z}), side * 0.75f, {1.0f, 0.0f, 0.0f});
        m_.box({-0.06f, 0.1f, -0.06f}, {0.06f, 1.08f, 0.06f});
    }

    /// A lacquered wall that stops short of the ceiling, with a doorway and framed pictures.
    void add_partition() {
        m_.stand({partition_x, 0, 0});
        m_.material = teal_;
        m_.box({-0.1f, 0, -6.0f}, {0.1f, 3.3f, -2.0f});
        m_.box({-0.1f, 2.4f, -2.0f}, {0.1f, 3.3f, -0.8f});
        m_.box({-0.1f, 0, -0.8f}, {0.1f, 3.3f, 1.9f});
        m_.material = oak_;
        m_.box({-0.14f, 3.3f, -6.0f}, {0.14f, 3.38f, 1.94f});
        m_.box({-0.13f, 0, 1.9f}, {0.13f, 3.3f, 1.98f});
        m_.box({-0.13f, 0, -2.0f}, {0.13f, 2.4f, -1.94f});
        m_.box({-0.13f, 0, -0.86f}, {0.13f, 2.4f, -0.8f});
        m_.box({-0.13f, 2.34f, -1.94f}, {0.13f, 2.4f, -0.86f});
        Dice dice(23);
        for (const auto& [z, y, width, height] :
             {std::array{-4.9f, 1.25f, 0.9f, 1.2f}, std::array{-3.4f, 1.35f, 1.1f, 0.9f},
              std::array{-0.35f, 1.2f, 0.75f, 1.1f}, std::array{0.75f, 1.3f, 0.9f, 0.9f}}) {
            add_picture(z, y, width, height, dice);
        }
    }

    void add_picture(float z, float y, float width, float height, Dice& dice) {
        m_.material = brass_;
        m_.box({-0.15f, y, z}, {-0.102f, y + height, z + width});
        // Colored strips as an abstract painting.
        const int strips = 7;
        const float step = (width - 0.12f) / strips;
        for (int i = 0; i < strips; ++i) {
            const float left = z + 0.06f + step * static_cast<float>(i);
            const float split = y + 0.06f + (height - 0.12f) * dice.uniform(0.2f, 0.8f);
            m_.material = covers_[dice.pick(covers_.size())];
            m_.box({-0.158f, y + 0.06f, left}, {-0.15f, split, left + step});
            m_.material = glazes_[dice.pick(glazes_.size())];
            m_.box({-0.158f, split, left}, {-0.15f, y + height - 0.06f, left + step});
        }
    }

    void add_books() {
        Dice dice(31);
        for (const float x : {-8.9f, -7.0f, -4.05f, -2.55f, 0.4f, 2.0f}) {
            m_.stand({x, 0, -half_width + 0.065f});
            add_bookcase(m_, 1.5f, 2.7f, 6, dice, beam_, covers_);
            // Something on top of each.
            const glm::mat4 base = m_.place;
            m_.place = glm::translate(base, {dice.uniform(-0.4f, 0.4f), 2.751f, 0.18f});
            add_some_vase(0.35f, 0.5f, 18, dice);
        }
        m_.stand({partition_x - 0.102f, 0, 1.1f}, -90.0f);
        add_bookcase(m_, 1.2f, 1.05f, 3, dice, oak_, covers_);
        m_.place = glm::translate(m_.place, {0.0f, 1.101f, 0.18f});
        add_vase(m_, 0, 0.42f, 24, glazes_[1]);
    }

    void add_tables() {
        Dice dice(47);
        for (const glm::vec2 at : {glm::vec2(-6.3f, 0.6f), glm::vec2(-2.4f, -0.5f), glm::vec2(1.7f, 0.4f)}) {
            const float angle = dice.uniform(-8.0f, 8.0f);
            m_.stand({at.x, 0, at.y}, angle);
            add_rug(1.75f, 1.45f);
            add_table(m_, 2.2f, 1.0f, oak_, beam_);
            const glm::mat4 table = m_.place;
            for (int i = 0; i < 6; ++i) {
                const float side = i % 2 == 0 ? 1.0f : -1.0f;
                const glm::vec3 seat(-0.7f + 0.7f * static_cast<float>(i / 2), 0.0f,
                                     -side * dice.uniform(0.72f, 0.92f));
                m_.place = glm::rotate(glm::translate(table, seat + glm::vec3(0.0f, 0.012f, 0.0f)),
                                       glm::radians((side > 0 ? 0.0f : 180.0f) + dice.uniform(-22.0f, 22.0f)),
                                       {0, 1, 0});
                add_chair(m_, oak_, seat_);
            }
            dress_table(table, dice);
        }
        m_.stand({-8.7f, 0, 4.6f}, 24.0f);
        add_table(m_, 1.3f, 0.8f, oak_, beam_);
        dress_table(m_.place, dice);
    }

    void add_rug(float x, float z) {
        m_.material = rug_border_;
        m_.box({-x, 0.0005f, -z}, {x, 0.008f, z});
        m_.material = rug_;
        m_.box({-x + 0.18f, 0.008f, -z + 0.18f}, {x - 0.18f, 0.011f, z - 0.18f});
    }

    /// Books, a vase and a ball on a table's top.
    void dress_table(const glm::mat4 table, Dice& dice) {
        const auto put = [&](float x, float z) {
            m_.place = glm::rotate(glm::translate(table, {x, 0.761f, z}), dice.uniform(0.0f, 6.0f), {0, 1, 0});
        };
        put(-0.45f, dice.uniform(-0.2f, 0.2f));
        add_book_stack(m_, 3 + static_cast<int>(dice.pick(4)), dice, covers_);
        put(0.4f, dice.uniform(-0.25f, 0.1f));
        add_book_stack(m_, 2 + static_cast<int>(dice.pick(3)), dice, covers_);
        put(0.02f, dice.uniform(-0.1f, 0.1f));
        add_some_vase(0.34f, 0.46f, 24, dice);
        const float radius = dice.uniform(0.05f, 0.08f);
        put(0.22f, 0.25f);
        m_.material = dice.pick(2) == 0 ? copper_ : steel_;
        m_.sphere({0.0f, radius, 0.0f}, radius, 20);
    }

    void add_sculptures() {
        const auto pedestal = [&](float x, float z, float height) {
            m_.stand({x, 0, z}, 18.0f);
            m_.material = marble_;
            m_.box({-0.32f, 0, -0.32f}, {0.32f, 0.08f, 0.32f});
            m_.box({-0.26f, 0.08f, -0.26f}, {0.26f, height, 0.26f});
            m_.place = glm::translate(m_.place, {0.0f, height, 0.0f});
        };
        pedestal(-3.9f, 3.1f, 0.95f);
        m_.place = glm::translate(m_.place, {0.0f, 0.06f, 0.0f});
        add_knot(m_, 0.42f, 144, 14, brass_);
        pedestal(0.9f, 3.4f, 0.85f);
        m_.material = glazes_[3];
        m_.sphere({0.0f, 0.331f, 0.0f}, 0.33f, 36);
        pedestal(4.2f, -3.6f, 1.0f);
        add_vase(m_, 0, 1.0f, 32, glazes_[1]);
        pedestal(8.0f, 0.2f, 0.8f);
        m_.material = glazes_[4];
        m_.sphere({0.0f, 0.401f, 0.0f}, 0.4f, 36);
        pedestal(-8.6f, -3.3f, 0.9f);
        m_.material = copper_;
        m_.sphere({0.0f, 0.281f, 0.0f}, 0.28f, 32);
        // Balls that have rolled over the floor.
        Dice dice(59);
        for (const glm::vec2 at : {glm::vec2(-5.0f, 2.3f), glm::vec2(-4.6f, 2.75f), glm::vec2(-0.4f, 2.35f),
                                   glm::vec2(2.9f, 2.6f), glm::vec2(-7.6f, 2.6f)}) {
            const float radius = dice.uniform(0.1f, 0.22f);
            m_.stand({at.x, 0, at.y});
            m_.material = glaze(dice);
            m_.sphere({0.0f, radius + 0.0005f, 0.0f}, radius, 24);
        }
    }

    void add_greenery() {
        Dice dice(71);
        for (const auto& [x, z, size] :
             {std::array{-6.3f, -4.4f, 1.2f}, std::array{-6.5f, 3.9f, 1.3f}, std::array{4.6f, 2.6f, 1.25f},
              std::array{8.9f, -5.0f, 1.5f}, std::array{-9.0f, -1.2f, 1.4f}, std::array{3.5f, 4.6f, 1.3f},
              std::array{8.8f, -1.6f, 1.6f}}) {
            m_.stand({x, 0, z}, dice.uniform(0.0f, 360.0f));
            add_plant(m_, size, 30, dice, dice.pick(2) == 0 ? terracotta_ : marble_, leaf_);
        }
    }

    void add_cameras() {
        scene_.cameras.push_back({"reading room", {-9.45f, 2.0f, 1.15f}, {1.5f, 1.5f, 0.2f}, {0, 1, 0}, 52.0f});
        scene_.cameras.push_back({"nave", {-9.6f, 3.6f, 0.0f}, {3.0f, 0.6f, -0.1f}, {0, 1, 0}, 58.0f});
        scene_.cameras.push_back({"still life", {-4.4f, 1.55f, 1.75f}, {-2.3f, 0.8f, -0.5f}, {0, 1, 0}, 38.0f});
        scene_.cameras.push_back({"behind the partition", {9.6f, 2.2f, 4.2f}, {5.6f, 1.2f, -1.6f}, {0, 1, 0}, 52.0f});
    }

    void add_some_vase(float shortest, float tallest, int segments, Dice& dice) {
        const std::uint32_t paint = glaze(dice);
        const float height = dice.uniform(shortest, tallest);
        add_vase(m_, static_cast<int>(dice.pick(3)), height, segments, paint);
    }

    std::uint32_t glaze(Dice& dice) { return glazes_[dice.pick(glazes_.size())]; }

    Scene scene_;
    Modeller m_;
    std::uint32_t wall_{}, wainscot_{}, ceiling_{}, stone_{}, beam_{}, oak_{}, teal_{}, brass_{}, copper_{}, steel_{},
        fixture_{}, leaf_{}, terracotta_{}, seat_{}, marble_{}, rug_{}, rug_border_{}, panel_{};
    std::array<std::uint32_t, 3> planks_{};
    std::array<std::uint32_t, 5> glazes_{};
    std::array<std::uint32_t, 8> covers_{};
};

}  // namespace

Scene builtin_hall() { return Hall().scene(); }

}  // namespace render
