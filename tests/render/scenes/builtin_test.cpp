#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/io/load_scene.hpp>
#include <render/io/validate.hpp>
#include <render/lights/emitters.hpp>
#include <render/scenes/shapes.hpp>
#include <render/triangle.hpp>

#include "render/area_of.hpp"
#include "render/refusal.hpp"

namespace {

using render::load_scene;
using render::Scene;
using testing::HasSubstr;

TEST(Builtin, AllLoadWithCameras) {
    EXPECT_EQ(
        render::builtin_names(),
        (std::vector<std::string>{"hall", "omni", "directional", "surfaces", "tableau", "wheel", "focus", "colonnade",
                                  "haze", "night", "foliage", "screens", "classroom", "office", "test-card"}));
    for (const std::string& name : render::builtin_names()) {
        const Scene s = load_scene("builtin:" + name);
        EXPECT_EQ(s.name, "builtin:" + name);
        EXPECT_GE(s.cameras.size(), 2u) << name;
        EXPECT_EQ(s.dropped_triangles, 0u) << name;
        EXPECT_EQ(s.dropped_lights, 0u) << name;
        EXPECT_GT(s.triangles.size(), name == "test-card" ? 100u : 10'000u) << name;
    }
}

TEST(Builtin, HallIsAsStated) {
    Scene s = load_scene("builtin:hall");
    EXPECT_NEAR(static_cast<double>(s.triangles.size()), 50'000.0, 5'000.0);
    glm::vec3 low(1e9f);
    glm::vec3 high(-1e9f);
    for (const glm::vec3& p : s.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    EXPECT_LE(glm::distance(low, glm::vec3(-10, 0, -6)), 1e-5f);
    EXPECT_LE(glm::distance(high, glm::vec3(10, 6, 6)), 1e-5f);

    const auto panels = render::emissive_surfaces(s);
    ASSERT_EQ(panels.size(), 72u);
    for (const auto& panel : panels) {
        EXPECT_EQ(panel.triangles.size(), 2u);
        EXPECT_NEAR(area_of(s, panel.triangles), 0.36, 1e-5);
        for (const std::uint32_t t : panel.triangles) EXPECT_LT(s.positions[s.triangles[t].x].y, 6.0f);
    }
    EXPECT_EQ(s.light_count(), 0u);
    render::add_emitter_lights(s, {.points = 64});
    EXPECT_EQ(s.oriented.size(), 72u * 64u);
    for (const auto& light : s.oriented) EXPECT_EQ(light.axis, glm::vec3(0, -1, 0));
    const bool has_glossy = std::any_of(s.materials.begin(), s.materials.end(),
                                        [](const auto& m) { return m.roughness >= 0.15f && m.roughness <= 0.5f; });
    EXPECT_TRUE(has_glossy);
}

TEST(Builtin, LightCounts) {
    EXPECT_EQ(load_scene("builtin:omni").omni.size(), 10'000u);
    EXPECT_EQ(load_scene("builtin:directional").directional.size(), 3'000u);
    EXPECT_EQ(load_scene("builtin:surfaces").oriented.size(), 30'000u);
    EXPECT_EQ(load_scene("builtin:office").oriented.size(), 1'000'000u);
    for (const char* name : {"omni", "directional", "surfaces", "office"}) {
        for (const std::size_t count : {1u, 37u, 5'000u}) {
            const std::string scene = std::string("builtin:") + name + "?lights=" + std::to_string(count);
            EXPECT_EQ(load_scene(scene).light_count(), count) << scene;
        }
    }
}

TEST(Builtin, PowerDoesNotDependOnTheCount) {
    const auto power = [](const std::string& name) {
        const Scene s = load_scene(name);
        double sum = 0;
        for (const auto& l : s.omni) sum += static_cast<double>(l.intensity.x + l.intensity.y + l.intensity.z);
        for (const auto& l : s.oriented) sum += static_cast<double>(l.intensity.x + l.intensity.y + l.intensity.z);
        for (const auto& l : s.directional) sum += static_cast<double>(l.intensity.x + l.intensity.y + l.intensity.z);
        for (const auto& l : s.spheres) sum += static_cast<double>(l.intensity.x + l.intensity.y + l.intensity.z);
        return sum;
    };
    EXPECT_NEAR(power("builtin:night") / power("builtin:night?lights=3000"), 1.0, 0.05);
    for (const std::string name : {"builtin:omni", "builtin:directional", "builtin:surfaces", "builtin:office"}) {
        EXPECT_NEAR(power(name + "?lights=3000") / power(name + "?lights=30000"), 1.0, 0.05) << name;
    }
}

TEST(Builtin, AreDeterministic) {
    for (const std::string name : {"hall", "omni?lights=500", "directional?lights=500", "surfaces?lights=500",
                                   "tableau", "wheel", "focus", "colonnade", "haze", "night?lights=20", "foliage",
                                   "screens", "classroom", "office?lights=500", "test-card"}) {
        const Scene a = load_scene("builtin:" + name);
        const Scene b = load_scene("builtin:" + name);
        EXPECT_EQ(a.positions, b.positions);
        EXPECT_EQ(a.triangles, b.triangles);
        EXPECT_EQ(a.triangle_material, b.triangle_material);
        for (std::size_t i = 0; i < a.omni.size(); ++i) EXPECT_EQ(a.omni[i].position, b.omni[i].position);
        for (std::size_t i = 0; i < a.oriented.size(); ++i) EXPECT_EQ(a.oriented[i].position, b.oriented[i].position);
        ASSERT_EQ(a.spheres.size(), b.spheres.size());
        for (std::size_t i = 0; i < a.spheres.size(); ++i) EXPECT_EQ(a.spheres[i].center, b.spheres[i].center);
    }
}

TEST(Builtin, SurfacesRotated) {
    const Scene turned = load_scene("builtin:surfaces?lights=2000");
    const Scene straight = load_scene("builtin:surfaces?lights=2000&rotated=0");
    ASSERT_EQ(turned.oriented.size(), straight.oriented.size());
    // The same room: distances stay. But no wall is along an axis any more.
    for (std::size_t i = 1; i < turned.oriented.size(); ++i) {
        const float a = glm::distance(turned.oriented[i].position, turned.oriented[i - 1].position);
        const float b = glm::distance(straight.oriented[i].position, straight.oriented[i - 1].position);
        EXPECT_NEAR(a, b, 1e-4f);
        EXPECT_NEAR(glm::length(turned.oriented[i].axis), 1.0f, 1e-5f);
    }
    const auto along_axis = [](const auto& light) {
        const glm::vec3 size = glm::abs(light.axis);
        return std::max({size.x, size.y, size.z}) > 0.9999f;
    };
    const auto count = [&](const Scene& s) { return std::count_if(s.oriented.begin(), s.oriented.end(), along_axis); };
    EXPECT_GT(count(straight), 1000);
    EXPECT_LT(count(turned), 20);
}

TEST(Builtin, LightsStayOffGeometry) {
    const Scene s = load_scene("builtin:surfaces?lights=2000&rotated=0");
    for (const auto& light : s.oriented) {
        EXPECT_LT(std::abs(light.position.x), 4.0f);
        EXPECT_GT(light.position.y, 0.0f);
        EXPECT_LT(light.position.y, 3.2f);
        EXPECT_LT(std::abs(light.position.z), 3.0f);
    }
    for (const auto& light : load_scene("builtin:directional").directional) EXPECT_LT(light.direction.y, 0.0f);
}

TEST(Builtin, BadNames) {
    const auto refused = [](const std::string& name) { return refusal([&] { load_scene(name); }); };
    EXPECT_THAT(refused("builtin:cave"),
                HasSubstr("hall, omni, directional, surfaces, tableau, wheel, focus, colonnade, haze, night, foliage"));
    for (const char* name : {"builtin:omni?lights=0", "builtin:omni?lights=-4", "builtin:omni?lights=",
                             "builtin:omni?x=1", "builtin:omni?lights=5x", "builtin:surfaces?rotated=2"}) {
        EXPECT_THAT(refused(name), HasSubstr("lights=N")) << name;
    }
    EXPECT_THAT(refused("builtin:hall?lights=5"), HasSubstr("--area-points"));
    EXPECT_THAT(refused("builtin:tableau?lights=5"), HasSubstr("--env-lights"));
    EXPECT_THAT(refused("builtin:haze?lights=5"), HasSubstr("--sky-lights"));
    EXPECT_THAT(refused("builtin:omni?rotated=1"), HasSubstr("surfaces"));
}

/// Six times the volume that the triangles enclose: positive iff they look outwards.
double signed_volume(const Scene& s) {
    double sum = 0;
    for (const glm::uvec3& t : s.triangles) {
        sum += glm::dot(glm::dvec3(s.positions[t.x]),
                        glm::cross(glm::dvec3(s.positions[t.y]), glm::dvec3(s.positions[t.z])));
    }
    return sum;
}

TEST(Shapes, LookOutwards) {
    const auto build = [](auto&& add) {
        Scene s;
        render::Modeller m(s);
        m.stand({0.3f, 0.2f, -0.1f}, 33.0f);
        add(m);
        for (std::size_t t = 0; t < s.triangles.size(); ++t) {
            const glm::uvec3 i = s.triangles[t];
            const glm::vec3 n = glm::cross(s.positions[i.y] - s.positions[i.x], s.positions[i.z] - s.positions[i.x]);
            EXPECT_GE(glm::dot(n, s.normals[i.x]), -1e-6f);
        }
        return signed_volume(s) / 6.0;
    };
    EXPECT_NEAR(build([](auto& m) { m.box({0, 0, 0}, {1, 2, 3}); }), 6.0, 1e-5);
    EXPECT_NEAR(build([](auto& m) { m.sphere({0, 0, 0}, 1.0f, 64); }), 4.18879, 0.03);
    EXPECT_NEAR(build([](auto& m) { m.cylinder({0, 0, 0}, 1.0f, 2.0f, 64); }), 6.28319, 0.02);
    EXPECT_NEAR(build([](auto& m) {
                    m.facet({0, 0, 0}, {1, 0, 0}, {0, 0, 1});
                    m.facet({0, 0, 0}, {0, 0, 1}, {0, 1, 0});
                    m.facet({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
                    m.facet({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
                }),
                1.0 / 6.0, 1e-6);
    // Of a cylinder, which is 2 pi, its sides bound two thirds, seen from the middle.
    EXPECT_NEAR(build([](auto& m) {
                    std::vector<glm::vec3> rings;
                    for (int i = 0; i < 96; ++i) {
                        const float a = 0.1308997f * static_cast<float>(i % 48);
                        rings.emplace_back(std::cos(a), i < 48 ? -1.0f : 1.0f, -std::sin(a));
                    }
                    m.sleeve(rings, 48);
                }),
                4.18879, 0.02);
    EXPECT_GT(build([](auto& m) {
                  std::vector<glm::vec3> ring;
                  for (int i = 0; i < 24; ++i) {
                      const float a = 0.2617994f * static_cast<float>(i);
                      ring.emplace_back(std::cos(a), std::sin(a), 0.0f);
                  }
                  m.tube(ring, 0.2f, 12, true);
              }),
              0.6);
}

TEST(Shapes, SolidsKnowTheirInside) {
    Scene s;
    render::Modeller m(s);
    m.stand({5, 0, 0}, 45.0f);
    m.box({-1, 0, -1}, {1, 1, 1});
    m.sphere({0, 3, 0}, 1.0f, 32);
    EXPECT_FALSE(m.is_free({5, 0.5f, 1.3f}, 0.0f));  // the turned box's corner
    EXPECT_TRUE(m.is_free({5.9f, 0.5f, 0.9f}, 0.0f));
    EXPECT_FALSE(m.is_free({5, 3.9f, 0}, 0.0f));
    EXPECT_TRUE(m.is_free({5.8f, 3.8f, 0}, 0.0f));
    EXPECT_FALSE(m.is_free({5, 4.05f, 0}, 0.1f));
}

}  // namespace
