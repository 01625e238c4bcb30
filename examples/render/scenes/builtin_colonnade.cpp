#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/ext/matrix_transform.hpp>

#include "scenes/builtin.hpp"
#include "scenes/ornaments.hpp"
#include "scenes/shapes.hpp"
#include "scenes/temple.hpp"

namespace render {
namespace {

class Colonnade {
public:
    Colonnade() : m_(scene_) {
        add_ground();
        add_temple(m_);
        add_cypresses();
        scene_.cameras.push_back({"aisle", {4.45f, 1.7f, 11.0f}, {4.55f, 2.25f, 0.0f}, {0, 1, 0}, 58.0f});
        scene_.cameras.push_back({"front", {13.5f, 1.9f, 24.0f}, {0.5f, 3.0f, 3.0f}, {0, 1, 0}, 46.0f});
        scene_.lighting.sun = lightcuts::SunPosition{30.0, 58.0, 3.0};
        scene_.lighting.ground = 0.0f;
        scene_.lighting.indirect = 20'000;
        scene_.lighting.clamp = 0.5f;  // some fifty lights reach the ceiling: twice their mean is a spike
    }

    Scene scene() { return std::move(scene_); }

private:
    void add_ground() {
        m_.stand({0, Temple::ground, 0});
        m_.material = m_.paint("dry grass", {0.30f, 0.26f, 0.13f}, 1.0f);
        m_.quad({-700, 0, 700}, {1400, 0, 0}, {0, 0, -1400}, 40, 40);
        // Hills in the distance.
        Dice dice(401);
        for (int i = 0; i < 26; ++i) {
            const float angle = 0.2417f * static_cast<float>(i) + dice.uniform(-0.08f, 0.08f);
            const float distance = dice.uniform(300.0f, 520.0f);
            m_.stand({distance * std::sin(angle), Temple::ground, distance * std::cos(angle)});
            m_.place = glm::scale(m_.place, {1.0f, dice.uniform(0.14f, 0.26f), 1.0f});
            m_.sphere({0, 0, 0}, dice.uniform(70.0f, 120.0f), 24);
        }
    }

    void add_cypresses() {
        const std::uint32_t leaf = m_.paint("cypress", {0.035f, 0.085f, 0.03f}, 1.0f);
        Dice dice(431);
        for (int i = 0; i < 34; ++i) {
            const float angle = dice.uniform(0.0f, 6.2832f);
            const float distance = dice.uniform(19.0f, 75.0f);
            const float x = distance * std::sin(angle);
            const float z = 1.25f * distance * std::cos(angle);
            if (x > 8.0f && z > 8.0f) continue;  // stays out of the front camera's way
            m_.stand({x, Temple::ground, z});
            add_cypress(m_, dice.uniform(6.0f, 11.0f), dice, leaf);
        }
    }

    Scene scene_;
    Modeller m_;
};

}  // namespace

Scene builtin_colonnade() { return Colonnade().scene(); }

}  // namespace render
