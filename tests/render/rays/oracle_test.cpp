#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/lights/emitters.hpp>
#include <render/rays/oracle.hpp>
#include <render/rays/ray_scene.hpp>

namespace {

using render::RayScene;
using render::Scene;
using render::SceneLights;

struct Receiver {
    glm::vec3 shadow_origin;
    std::uint32_t id = 0;
};

/// A level square, seen from above or below.
void add_level(Scene& s, const glm::vec3& at, float half, std::uint32_t material, bool faces_up) {
    const auto first = static_cast<std::uint32_t>(s.positions.size());
    for (const glm::vec3 d : {glm::vec3(-half, 0, -half), {-half, 0, half}, {half, 0, half}, {half, 0, -half}}) {
        s.positions.push_back(at + d);
    }
    for (const glm::uvec3 t : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
        s.triangles.push_back(first + (faces_up ? t : glm::uvec3(t.x, t.z, t.y)));
        s.triangle_material.push_back(material);
    }
}

/// A lamp of that half-width that shines down from `at`, and, if `gap` is positive, an opaque card below it.
Scene lamp(const glm::vec3& at, float half, float gap) {
    Scene s;
    s.name = "lamp";
    s.materials.resize(2);
    s.materials[1].emission = glm::vec3(100.0f);
    add_level(s, at, half, 1, false);
    if (gap > 0.0f) add_level(s, at - glm::vec3(0, gap, 0), 10.0f * half, 0, true);
    render::add_emitter_lights(s, {.points = 16});
    return s;
}

/// How many of the scene's lights each oracle lets through to `from`.
void count_visible(const Scene& s, const glm::vec3& from, std::size_t wanted) {
    const RayScene rays(s);
    const render::OpaqueOracle opaque(s, rays);
    const render::TransmissiveOracle transmissive(s, rays);
    std::vector<lightcuts::VisibilityQuery> queries;
    std::size_t singly = 0;
    std::size_t tinted = 0;
    for (std::uint32_t i = 0; i < s.oriented.size(); ++i) {
        queries.push_back({from, 0, s.oriented[i].position, i, SceneLights::oriented_kind, false});
        singly += opaque(Receiver{from}, s.oriented[i]) ? 1 : 0;
        tinted += transmissive(Receiver{from}, s.oriented[i]) == glm::vec3(1.0f) ? 1 : 0;
    }
    std::vector<float> answers(queries.size());
    opaque.many(queries, answers);
    std::size_t together = 0;
    for (const float a : answers) together += a > 0.0f ? 1 : 0;
    EXPECT_EQ(singly, wanted);
    EXPECT_EQ(tinted, wanted);
    EXPECT_EQ(together, wanted);
}

TEST(Oracle, LetsNoLightThroughACardBelowALamp) {
    for (const float x : {0.0f, 3.0f, 17.0f, 60.0f, 70.0f, 90.0f, 100.0f, -100.0f}) {
        for (const float far : {1.0f, 10.0f, 100.0f, 1000.0f}) {
            for (const float gap : {0.001f, 0.005f, 0.1f}) {
                SCOPED_TRACE(testing::Message() << x << ", " << far << " m, card " << gap);
                count_visible(lamp({x, 3.0f, 0.3f * x}, 0.05f, gap), {x + 0.3f * far, 3.0f - far, 0.3f * x}, 0);
            }
        }
    }
}

TEST(Oracle, LetsAllLightOfALampOut) {
    // In any direction, also along the lamp: its own surface hides nothing of it.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (const float half : {0.05f, 1.0f, 100.0f}) {
        for (const float coordinate : {0.0f, 1.0f, 100.0f}) {
            const glm::vec3 at(coordinate * unit(random), coordinate * unit(random), coordinate * unit(random));
            const Scene s = lamp(at, half, 0.0f);
            for (const float far : {0.1f, 1.0f, 10.0f, 100.0f, 1000.0f}) {
                for (const float slope : {0.02f, 0.1f, 0.5f, 5.0f}) {
                    for (int i = 0; i < 10; ++i) {
                        const glm::vec3 way = glm::normalize(glm::vec3(unit(random), -slope, unit(random)));
                        SCOPED_TRACE(testing::Message()
                                     << half << " at " << coordinate << ", " << far << ", " << slope);
                        count_visible(s, at + far * way, s.oriented.size());
                    }
                }
            }
        }
    }
}

TEST(Oracle, LetsLightsInASurfaceShine) {
    // Points of a ceiling itself, without any distance.
    Scene s;
    s.materials.resize(1);
    add_level(s, {1.0f, 2.7f, -0.5f}, 4.0f, 0, false);
    const RayScene rays(s);
    const render::OpaqueOracle oracle(s, rays);
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    for (int i = 0; i < 20'000; ++i) {
        const glm::vec3 light(1.0f + 3.9f * unit(random), 2.7f, -0.5f + 3.9f * unit(random));
        const glm::vec3 from(6.0f * unit(random), 1.2f + unit(random), 6.0f * unit(random));
        const glm::vec3 down(0.0f, -1.0f, 0.0f);
        EXPECT_TRUE(oracle(Receiver{from}, lightcuts::OmniLight<>{light, glm::vec3(1.0f), {}}));
        EXPECT_TRUE(oracle(Receiver{from}, lightcuts::OrientedPointLight<>{light, down, glm::vec3(1.0f)}));
    }
}

}  // namespace
