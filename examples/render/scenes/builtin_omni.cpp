#include <algorithm>
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

constexpr float two_pi = 2.0f * std::numbers::pi_v<float>;
constexpr float half_size = 18.0f;     ///< of the garden, in meters
constexpr float clearance = 0.12f;     ///< least distance of a firefly from things, in meters
constexpr float total_power = 440.0f;  ///< sum of all intensities, W/sr: does not depend on their number

/// The lawn's height: gentle hills around a level middle.
float ground_height(float x, float z) {
    const float away = glm::smoothstep(4.0f, 14.0f, std::sqrt(x * x + z * z));
    return away * (0.7f * std::sin(0.31f * x + 1.3f) * std::cos(0.27f * z) + 0.35f * std::sin(0.83f * z - 0.6f * x));
}

/// A place that fireflies like: they fly around it, densest at the middle.
struct Swarm {
    glm::vec3 center;
    glm::vec3 spread;
    glm::vec3 color;
    float share;  ///< of all fireflies, relative to the other swarms
};

class Garden {
public:
    Garden() : m_(scene_) {
        paint_all();
        add_lawn();
        add_pavilion();
        add_trees();
        add_lanterns();
        add_rocks();
        scene_.cameras.push_back({"path", {-1.2f, 1.75f, 12.5f}, {0.3f, 1.75f, 0.0f}, {0, 1, 0}, 50.0f});
        scene_.cameras.push_back({"above", {9.5f, 7.5f, 11.5f}, {0.0f, 1.0f, 0.0f}, {0, 1, 0}, 50.0f});
    }

    void add_lights(std::size_t count) {
        Dice dice(307);
        float shares = 0.0f;
        for (const Swarm& swarm : swarms_) shares += swarm.share;
        while (scene_.omni.size() < count) {
            float chosen = dice.uniform(0.0f, shares);
            std::size_t s = 0;
            while (s + 1 < swarms_.size() && chosen > swarms_[s].share) chosen -= swarms_[s++].share;
            const Swarm& swarm = swarms_[s];
            // The sum of three uniform numbers is bell-shaped and bounded.
            const auto bell = [&] {
                float sum = dice.uniform(-1, 1);
                sum += dice.uniform(-1, 1);
                return sum + dice.uniform(-1, 1);
            };
            glm::vec3 offset(0.0f);
            for (int axis = 2; axis >= 0; --axis) offset[axis] = bell();
            const glm::vec3 p = swarm.center + swarm.spread * offset;
            const float brightness = dice.uniform(0.3f, 1.7f);
            if (p.y < ground_height(p.x, p.z) + clearance || !m_.is_free(p, clearance)) continue;
            scene_.omni.push_back({p, swarm.color * (brightness * total_power / static_cast<float>(count))});
        }
    }

    Scene scene() { return std::move(scene_); }

private:
    void paint_all() {
        grass_ = m_.paint("grass", {0.16f, 0.27f, 0.09f}, 0.9f);
        stone_ = m_.paint("stone", {0.48f, 0.46f, 0.42f}, 0.6f);
        marble_ = m_.paint("marble", {0.78f, 0.76f, 0.72f}, 0.25f);
        bark_ = m_.paint("bark", {0.22f, 0.14f, 0.08f}, 0.8f);
        roof_ = m_.paint("glazed tiles", {0.08f, 0.24f, 0.26f}, 0.22f);
        gold_ = m_.paint("gold", {0.95f, 0.70f, 0.30f}, 0.28f, 1.0f);
        red_ = m_.paint("red lacquer", {0.58f, 0.06f, 0.04f}, 0.2f);
        leaves_ = {m_.paint("maple", {0.55f, 0.14f, 0.05f}, 0.5f), m_.paint("ginkgo", {0.62f, 0.46f, 0.08f}, 0.5f),
                   m_.paint("beech", {0.20f, 0.38f, 0.10f}, 0.5f)};
        for (const std::uint32_t leaf : leaves_) scene_.materials[leaf].double_sided = true;
    }

    void add_lawn() {
        constexpr int grid = 72;
        const auto first = static_cast<std::uint32_t>(scene_.positions.size());
        for (int j = 0; j <= grid; ++j) {
            for (int i = 0; i <= grid; ++i) {
                const auto along = [](int k) { return half_size * (2.0f * static_cast<float>(k) / grid - 1.0f); };
                const float x = along(i);
                const float z = along(j);
                constexpr float step = 0.01f;
                const glm::vec3 slope(ground_height(x - step, z) - ground_height(x + step, z), 2.0f * step,
                                      ground_height(x, z - step) - ground_height(x, z + step));
                scene_.positions.emplace_back(x, ground_height(x, z), z);
                scene_.normals.push_back(glm::normalize(slope));
            }
        }
        for (std::uint32_t j = 0; j < grid; ++j) {
            for (std::uint32_t i = 0; i < grid; ++i) {
                const std::uint32_t a = first + j * (grid + 1) + i;
                const std::uint32_t b = a + grid + 1;
                for (const glm::uvec3& t : {glm::uvec3(a, b, b + 1), glm::uvec3(a, b + 1, a + 1)}) {
                    scene_.triangles.push_back(t);
                    scene_.triangle_material.push_back(grass_);
                }
            }
        }
        // Stepping stones from the front to the pavilion.
        Dice dice(313);
        for (int i = 0; i < 14; ++i) {
            const float z = 13.5f - 0.75f * static_cast<float>(i);
            const float x = 0.55f * std::sin(0.7f * z) + dice.uniform(-0.15f, 0.15f);
            m_.stand({x, ground_height(x, z) - 0.2f, z}, dice.uniform(0.0f, 90.0f));
            m_.material = stone_;
            m_.cylinder({0, 0, 0}, dice.uniform(0.28f, 0.36f), 0.245f, 9);
        }
    }

    /// Eight columns under a curved roof, with a golden knot in the middle.
    void add_pavilion() {
        m_.stand({0, 0, 0});
        m_.material = stone_;
        m_.cylinder({0.0f, -0.3f, 0.0f}, 3.1f, 0.45f, 48);
        m_.cylinder({0.0f, 0.151f, 0.0f}, 2.75f, 0.15f, 48);
        for (int i = 0; i < 8; ++i) {
            const float angle = two_pi * (static_cast<float>(i) + 0.5f) / 8.0f;
            m_.stand({2.3f * std::cos(angle), 0.302f, 2.3f * std::sin(angle)}, -glm::degrees(angle));
            add_column(m_, 0.14f, 2.6f, 18, marble_);
        }
        m_.stand({0, 0, 0});
        m_.material = red_;
        const std::array<glm::vec2, 9> ring{{{2.1f, 2.905f},
                                             {2.1f, 2.905f},
                                             {2.5f, 2.905f},
                                             {2.5f, 2.905f},
                                             {2.5f, 3.1f},
                                             {2.5f, 3.1f},
                                             {2.1f, 3.1f},
                                             {2.1f, 3.1f},
                                             {2.1f, 2.905f}}};
        m_.lathe(ring, 48);
        m_.material = roof_;
        const std::array<glm::vec2, 10> roof{{{0.0f, 3.105f},
                                              {3.05f, 3.105f},
                                              {3.05f, 3.105f},
                                              {3.1f, 3.16f},
                                              {2.2f, 3.5f},
                                              {1.4f, 3.95f},
                                              {0.7f, 4.6f},
                                              {0.25f, 5.2f},
                                              {0.1f, 5.35f},
                                              {0.0f, 5.4f}}};
        m_.lathe(roof, 48);
        m_.material = gold_;
        m_.sphere({0.0f, 5.53f, 0.0f}, 0.16f, 20);
        m_.stand({0.0f, 0.302f, 0.0f}, 20.0f);
        m_.material = marble_;
        m_.cylinder({0, 0, 0}, 0.4f, 0.6f, 32);
        m_.place = glm::translate(m_.place, {0.0f, 0.66f, 0.0f});
        add_knot(m_, 0.55f, 144, 14, gold_);
        swarms_.push_back({{0.0f, 1.9f, 0.0f}, {0.75f, 0.45f, 0.75f}, {1.0f, 0.72f, 0.32f}, 1.2f});
        swarms_.push_back({{0.0f, 2.2f, 0.0f}, {1.9f, 1.0f, 1.9f}, {1.0f, 0.8f, 0.42f}, 2.5f});
    }

    void add_trees() {
        Dice dice(331);
        for (const glm::vec2 at :
             {glm::vec2(-6.5f, 3.0f), glm::vec2(6.2f, 2.0f), glm::vec2(-5.0f, -6.0f), glm::vec2(4.5f, -6.8f),
              glm::vec2(10.5f, -4.0f), glm::vec2(-11.0f, -3.5f), glm::vec2(-10.0f, 8.0f), glm::vec2(11.0f, 7.5f)}) {
            add_tree({at.x, ground_height(at.x, at.y), at.y}, dice);
        }
    }

    void add_tree(const glm::vec3& root, Dice& dice) {
        const float tall = dice.uniform(2.6f, 3.6f);
        m_.stand(root, dice.uniform(0.0f, 360.0f));
        m_.material = bark_;
        const std::array<glm::vec2, 5> trunk{
            {{0.0f, -0.3f}, {0.42f, -0.3f}, {0.22f, 0.5f}, {0.13f, tall}, {0.0f, tall + 0.2f}}};
        m_.lathe(trunk, 14);
        m_.material = leaves_[dice.pick(leaves_.size())];
        const glm::vec3 crown(0.0f, tall + 0.5f, 0.0f);
        const float wide = dice.uniform(1.5f, 2.1f);
        for (int i = 0; i < 420; ++i) {
            // Leaves point away from the crown's middle and hang a little.
            const float height = dice.uniform(-0.75f, 1.0f);
            const float angle = dice.uniform(0.0f, two_pi);
            const float ring = std::sqrt(1.0f - height * height);
            const glm::vec3 out(ring * std::cos(angle), 0.75f * height, ring * std::sin(angle));
            const glm::vec3 from = crown + out * (wide * dice.uniform(0.3f, 1.0f));
            const float z = dice.uniform(-0.12f, 0.12f), x = dice.uniform(-0.12f, 0.12f);
            m_.blade(from, from + 0.5f * out + glm::vec3(x, 0.05f, z), 0.2f, 0.14f, 3);
        }
        const glm::vec3 warm(0.95f, 0.85f, 0.35f);
        const glm::vec3 green(0.62f, 0.95f, 0.35f);
        const glm::vec3 color = dice.pick(2) == 0 ? warm : green;
        swarms_.push_back({root + crown, glm::vec3(0.8f, 0.6f, 0.8f) * wide, color, 1.0f});
        swarms_.push_back({root + glm::vec3(0.0f, 1.0f, 0.0f), {0.9f, 0.4f, 0.9f}, color, 0.45f});
    }

    /// Stone lanterns along the path, each with a swarm around its fire box.
    void add_lanterns() {
        for (int i = 0; i < 4; ++i) {
            for (const float side : {-1.0f, 1.0f}) {
                const float z = 11.0f - 2.3f * static_cast<float>(i);
                const float x = side * 1.75f + 0.55f * std::sin(0.7f * z);
                m_.stand({x, ground_height(x, z), z}, 45.0f);
                add_lantern();
                const glm::vec3 fire(x, ground_height(x, z) + 1.05f, z);
                swarms_.push_back({fire, {0.3f, 0.25f, 0.3f}, {1.0f, 0.55f, 0.2f}, 0.35f});
            }
        }
    }

    void add_lantern() {
        m_.material = stone_;
        const std::array<glm::vec2, 10> base{{{0.0f, -0.1f},
                                              {0.3f, -0.1f},
                                              {0.3f, 0.08f},
                                              {0.12f, 0.2f},
                                              {0.1f, 0.65f},
                                              {0.14f, 0.75f},
                                              {0.3f, 0.82f},
                                              {0.3f, 0.88f},
                                              {0.3f, 0.88f},
                                              {0.0f, 0.88f}}};
        m_.lathe(base, 16);
        for (const float x : {-0.15f, 0.11f}) {
            for (const float z : {-0.15f, 0.11f}) m_.box({x, 0.881f, z}, {x + 0.04f, 1.199f, z + 0.04f});
        }
        const std::array<glm::vec2, 8> roof{{{0.0f, 1.2f},
                                             {0.36f, 1.2f},
                                             {0.36f, 1.2f},
                                             {0.38f, 1.25f},
                                             {0.2f, 1.36f},
                                             {0.07f, 1.46f},
                                             {0.06f, 1.54f},
                                             {0.0f, 1.58f}}};
        m_.lathe(roof, 16);
    }

    void add_rocks() {
        Dice dice(347);
        for (int i = 0; i < 46; ++i) {
            const float angle = dice.uniform(0.0f, two_pi);
            const float away = dice.uniform(4.2f, 14.0f);
            const float x = away * std::cos(angle);
            const float z = away * std::sin(angle);
            const float size = dice.uniform(0.15f, 0.55f);
            if (std::abs(x) < 2.6f && z > 0.0f) continue;  // keeps the path open
            m_.stand({x, ground_height(x, z), z}, dice.uniform(0.0f, 360.0f));
            m_.place = glm::scale(m_.place, {1.0f, dice.uniform(0.5f, 0.8f), dice.uniform(0.7f, 1.0f)});
            m_.material = i % 7 == 0 ? red_ : i % 5 == 0 ? marble_ : stone_;
            m_.sphere({0.0f, 0.5f * size, 0.0f}, size, i % 7 == 0 ? 24 : 12);
        }
        swarms_.push_back({{0.0f, 1.2f, 0.0f}, {5.5f, 0.7f, 5.5f}, {0.7f, 1.0f, 0.5f}, 2.5f});
    }

    Scene scene_;
    Modeller m_;
    std::vector<Swarm> swarms_;
    std::uint32_t grass_ = 0;
    std::uint32_t stone_ = 0;
    std::uint32_t marble_ = 0;
    std::uint32_t bark_ = 0;
    std::uint32_t roof_ = 0;
    std::uint32_t gold_ = 0;
    std::uint32_t red_ = 0;
    std::array<std::uint32_t, 3> leaves_{};
};

}  // namespace

Scene builtin_omni(std::size_t lights) {
    Garden garden;
    garden.add_lights(lights);
    return garden.scene();
}

}  // namespace render
