#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/builtin.hpp"
#include "scenes/furniture.hpp"
#include "scenes/ornaments.hpp"
#include "scenes/screen_pictures.hpp"
#include "scenes/shapes.hpp"

namespace render {
namespace {

// The room: x in [-3.2, 3.2], y in [0, 2.9], z in [-2.2, 3.2]. The monitors stand on a desk in front of the wall at -z.
constexpr float half_length = 3.2f;
constexpr float back = -2.2f;
constexpr float front = 3.2f;
constexpr float ceiling = 2.9f;

// A monitor's picture, in pixels and meters.
constexpr int columns = 640;
constexpr int rows = 480;
constexpr float picture_width = 1.2f;
constexpr float picture_height = 0.9f;
constexpr float light_offset = 1e-4f;

class Office {
public:
    Office() : m_(scene_) {
        paint_all();
        add_shell();
        add_panels();
        add_desk();
        add_monitor({-0.70f, 0.0f, -1.42f}, 13.0f, dusk_picture(columns, rows));
        add_monitor({0.70f, 0.0f, -1.42f}, -13.0f, test_card(columns, rows));
        add_desk_things();
        add_room_things();
        scene_.uv_sets[0].resize(scene_.positions.size());
        scene_.cameras.push_back({"desk", {0.55f, 1.50f, 1.25f}, {0.02f, 1.06f, -1.2f}, {0, 1, 0}, 50.0f});
        scene_.cameras.push_back({"room", {2.7f, 1.9f, 2.8f}, {-0.6f, 0.8f, -1.0f}, {0, 1, 0}, 52.0f});
        scene_.cameras.push_back({"still life", {0.5f, 1.15f, 0.1f}, {-0.2f, 0.85f, -1.0f}, {0, 1, 0}, 46.0f});
    }

    Scene scene() { return std::move(scene_); }

private:
    void paint_all() {
        wall_ = m_.paint("plaster", {0.62f, 0.60f, 0.57f}, 0.9f);
        accent_ = m_.paint("slate wall", {0.40f, 0.46f, 0.52f}, 0.8f);
        ceiling_ = m_.paint("ceiling", {0.76f, 0.76f, 0.75f}, 0.9f);
        oak_ = m_.paint("oak", {0.40f, 0.24f, 0.12f}, 0.28f);
        walnut_ = m_.paint("walnut", {0.20f, 0.11f, 0.06f}, 0.34f);
        frame_ = m_.paint("black plastic", {0.03f, 0.03f, 0.032f}, 0.3f);
        steel_ = m_.paint("steel", {0.68f, 0.69f, 0.71f}, 0.34f, 1.0f);
        brass_ = m_.paint("brass", {0.90f, 0.64f, 0.26f}, 0.3f, 1.0f);
        seat_ = m_.paint("seat", {0.35f, 0.07f, 0.05f}, 0.4f);
        leaf_ = m_.paint("leaf", {0.08f, 0.28f, 0.07f}, 0.4f);
        scene_.materials[leaf_].double_sided = true;
        pot_ = m_.paint("pot", {0.60f, 0.57f, 0.52f}, 0.5f);
        rug_ = m_.paint("rug", {0.20f, 0.12f, 0.20f}, 1.0f);
        glazes_ = {m_.paint("white glaze", {0.80f, 0.79f, 0.75f}, 0.2f),
                   m_.paint("cobalt glaze", {0.03f, 0.09f, 0.45f}, 0.22f),
                   m_.paint("crimson glaze", {0.55f, 0.04f, 0.05f}, 0.22f)};
        covers_ = {
            m_.paint("red cloth", {0.45f, 0.08f, 0.06f}, 0.6f), m_.paint("green cloth", {0.08f, 0.26f, 0.14f}, 0.6f),
            m_.paint("ochre cloth", {0.60f, 0.40f, 0.12f}, 0.6f), m_.paint("cream cloth", {0.72f, 0.68f, 0.56f}, 0.7f),
            m_.paint("navy cloth", {0.05f, 0.08f, 0.24f}, 0.55f)};
        panel_ = m_.paint("ceiling panel", glm::vec3(0.0f), 1.0f);
        scene_.materials[panel_].emission = {3.6f, 3.1f, 2.4f};
    }

    void add_shell() {
        m_.stand({0, 0, 0});
        const float length = 2 * half_length;
        const float depth = front - back;
        Dice dice(503);
        const std::array planks{m_.paint("plank", {0.22f, 0.13f, 0.07f}, 0.26f),
                                m_.paint("dark plank", {0.17f, 0.10f, 0.055f}, 0.28f)};
        constexpr int boards = 27;
        for (int i = 0; i < boards; ++i) {
            const float width = depth / boards;
            m_.material = planks[dice.pick(planks.size())];
            m_.quad({-half_length, 0, back + width * static_cast<float>(i + 1)}, {length, 0, 0}, {0, 0, -width}, 4, 1);
        }
        m_.material = ceiling_;
        m_.quad({-half_length, ceiling, back}, {length, 0, 0}, {0, 0, depth}, 6, 6);
        m_.material = wall_;
        m_.quad({half_length, 0, front}, {-length, 0, 0}, {0, ceiling, 0}, 6, 3);
        m_.quad({-half_length, 0, front}, {0, 0, -depth}, {0, ceiling, 0}, 6, 3);
        m_.quad({half_length, 0, back}, {0, 0, depth}, {0, ceiling, 0}, 6, 3);
        m_.material = accent_;
        m_.quad({-half_length, 0, back}, {length, 0, 0}, {0, ceiling, 0}, 6, 3);
        m_.material = walnut_;
        m_.box({-half_length, 0, back}, {half_length, 0.09f, back + 0.015f});
        m_.box({-half_length, 0, back}, {-half_length + 0.015f, 0.09f, front});
        m_.box({half_length - 0.015f, 0, back}, {half_length, 0.09f, front});
    }

    void add_panels() {
        m_.stand({0, 0, 0});
        for (const float x : {-1.5f, 1.5f}) {
            m_.material = frame_;
            m_.box({x - 0.33f, ceiling - 0.06f, 0.37f}, {x + 0.33f, ceiling - 0.001f, 1.03f});
            m_.material = panel_;
            m_.quad({x - 0.3f, ceiling - 0.062f, 0.4f}, {0.6f, 0, 0}, {0, 0, 0.6f});
        }
    }

    void add_desk() {
        m_.stand({0, 0, -1.3f});
        add_table(m_, 3.1f, 1.05f, oak_, walnut_);
        m_.stand({-0.35f, 0, -0.35f}, 172.0f);
        add_chair(m_, walnut_, seat_);
        m_.stand({1.15f, 0, 0.05f}, 138.0f);
        add_chair(m_, walnut_, seat_);
    }

    /// A monitor whose foot stands on the desk at `at`, turned by `degrees`, that shows `picture`.
    void add_monitor(const glm::vec3& at, float degrees, Texture picture) {
        m_.stand(at + glm::vec3(0.0f, 0.7605f, 0.0f), degrees);
        m_.material = steel_;
        m_.box({-0.22f, 0.0f, -0.15f}, {0.22f, 0.012f, 0.10f});
        m_.box({-0.05f, 0.012f, -0.12f}, {0.05f, 0.30f, -0.085f});
        m_.material = frame_;
        const float x = 0.5f * picture_width;
        constexpr float low = 0.14f;
        constexpr float high = low + picture_height;
        m_.box({-x - 0.025f, low - 0.03f, -0.085f}, {x + 0.025f, high + 0.025f, -0.03f});
        m_.box({-x - 0.025f, low - 0.03f, -0.03f}, {-x, high + 0.025f, 0.0f});
        m_.box({x, low - 0.03f, -0.03f}, {x + 0.025f, high + 0.025f, 0.0f});
        m_.box({-x, low - 0.03f, -0.03f}, {x, low, 0.0f});
        m_.box({-x, high, -0.03f}, {x, high + 0.025f, 0.0f});

        Material screen;
        screen.name = picture.name;
        screen.model = Material::Model::phong;
        screen.base_color = glm::vec3(0.01f);
        screen.emission = glm::vec3(1.0f);
        screen.emission_texture.texture = static_cast<int>(scene_.textures.size());
        screen.only_seen = true;  // its pixels are lights already
        m_.material = static_cast<std::uint32_t>(scene_.materials.size());
        scene_.materials.push_back(screen);
        const glm::vec3 corner(-x, low, -0.02f);
        scene_.uv_sets.resize(1);
        std::vector<glm::vec2>& uvs = scene_.uv_sets[0];
        uvs.resize(scene_.positions.size());
        m_.quad(corner, {picture_width, 0, 0}, {0, picture_height, 0});
        for (const glm::vec2 uv : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(0, 0), glm::vec2(1, 0)}) {
            uvs.push_back(uv);
        }
        add_pixel_lights(corner, picture);
        scene_.textures.push_back(std::move(picture));
    }

    void add_pixel_lights(const glm::vec3& corner, const Texture& picture) {
        const glm::vec3 axis = glm::normalize(glm::vec3(m_.place * glm::vec4(0.0f, 0.0f, 1.0f, 0.0f)));
        const glm::vec2 size(picture_width / columns, picture_height / rows);
        for (int y = 0; y < rows; ++y) {
            for (int x = 0; x < columns; ++x) {
                const glm::vec2 p = size * glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(rows - y) - 0.5f);
                const glm::vec3 local = corner + glm::vec3(p, light_offset);
                const glm::vec3 radiance(picture.texels[static_cast<std::size_t>(y * columns + x)]);
                scene_.oriented.push_back(
                    {glm::vec3(m_.place * glm::vec4(local, 1.0f)), axis, radiance * size.x * size.y});
            }
        }
    }

    void add_desk_things() {
        Dice dice(521);
        const auto put = [&](float x, float z, float degrees = 0.0f) { m_.stand({x, 0.7605f, z}, degrees); };
        put(-0.35f, -0.93f, 2.0f);
        add_keyboard();
        put(0.0f, -0.90f);
        m_.material = frame_;
        m_.place = glm::scale(m_.place, {0.033f, 0.018f, 0.055f});
        m_.sphere({0.0f, 0.6f, 0.0f}, 1.0f, 36);
        put(0.46f, -0.95f);
        add_knot(m_, 0.095f, 200, 20, brass_);
        put(0.74f, -0.98f);
        m_.material = glazes_[0];
        m_.sphere({0.0f, 0.075f, 0.0f}, 0.075f, 56);
        put(0.98f, -0.90f);
        add_goblet(m_, 0.19f, 56, steel_);
        put(1.28f, -1.0f, 20.0f);
        add_book_stack(m_, 5, dice, covers_);
        put(-1.22f, -0.98f);
        add_vase(m_, 0, 0.30f, 56, glazes_[1]);
        put(-0.98f, -0.93f);
        m_.material = glazes_[2];
        m_.sphere({0.0f, 0.06f, 0.0f}, 0.06f, 48);
        put(-0.82f, -0.86f, 35.0f);
        m_.material = steel_;
        m_.box({-0.04f, 0.0f, -0.04f}, {0.04f, 0.08f, 0.04f});
        put(0.22f, -0.86f);
        add_torus(m_, 0.042f, 0.013f, 80, 24, steel_);
    }

    void add_keyboard() {
        m_.material = frame_;
        m_.box({-0.23f, 0.0f, -0.075f}, {0.23f, 0.012f, 0.075f});
        m_.material = glazes_[0];
        for (int row = 0; row < 5; ++row) {
            for (int key = 0; key < 15; ++key) {
                const float x = -0.2225f + 0.0298f * static_cast<float>(key);
                const float z = -0.069f + 0.028f * static_cast<float>(row);
                m_.box({x, 0.0121f, z}, {x + 0.026f, 0.02f, z + 0.024f});
            }
        }
    }

    void add_room_things() {
        Dice dice(541);
        m_.stand({-half_length + 0.001f, 0, -0.55f}, 90.0f);
        add_bookcase(m_, 1.7f, 2.0f, 5, dice, walnut_, covers_);
        m_.stand({2.55f, 0, -1.55f});
        add_plant(m_, 1.35f, 36, dice, pot_, leaf_);
        m_.stand({-2.45f, 0, -1.75f});
        add_plant(m_, 1.1f, 30, dice, pot_, leaf_);
        m_.stand({0, 0, 0});
        m_.material = rug_;
        m_.box({-1.7f, 0.0005f, -0.8f}, {1.7f, 0.009f, 1.5f});
        m_.stand({2.15f, 0, 0.15f}, 24.0f);
        m_.material = walnut_;
        m_.box({-0.24f, 0.0f, -0.24f}, {0.24f, 0.52f, 0.24f});
        m_.place = glm::translate(m_.place, {0.0f, 0.5205f, 0.0f});
        add_vase(m_, 2, 0.34f, 48, glazes_[0]);
        m_.stand({-1.75f, 0, 0.1f});
        m_.material = glazes_[1];
        m_.sphere({0.0f, 0.26f, 0.0f}, 0.25f, 64);
    }

    Scene scene_;
    Modeller m_;
    std::uint32_t wall_{}, accent_{}, ceiling_{}, oak_{}, walnut_{}, frame_{}, steel_{}, brass_{}, seat_{}, leaf_{},
        pot_{}, rug_{}, panel_{};
    std::array<std::uint32_t, 3> glazes_{};
    std::array<std::uint32_t, 5> covers_{};
};

}  // namespace

Scene builtin_screens() { return Office().scene(); }

}  // namespace render
