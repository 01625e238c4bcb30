#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/material/phase_function.hpp>
#include <lightcuts/tree/light_tree.hpp>
#include <lightcuts/visibility/medium.hpp>
#include <render/fog.hpp>
#include <render/surfaces/fog_points.hpp>

namespace {

using V = glm::vec3;

render::Fog some_fog(float extinction) {
    return {lightcuts::UniformMedium(extinction, {V(-10.0f), V(10.0f)}), 0.8f, 0.6f, 8.0f};
}

TEST(FogPoints, HideWhatTheTransmittanceLeaves) {
    for (const float extinction : {1e-4f, 0.05f, 0.3f, 2.0f, 50.0f}) {
        const render::Fog fog = some_fog(extinction);
        std::vector<render::SurfacePoint> points;
        std::uint32_t vertex = 3;
        const float left = render::add_fog_points(fog, {V(0.0f), V(0.0f, 0.0f, 1.0f), 4.0f, 1.0f, V(0.5f), 7, 2},
                                                  vertex, points);
        EXPECT_NEAR(left, std::exp(-4.0f * extinction), 1e-6f);
        EXPECT_EQ(vertex, 3 + points.size());
        float weight = 0.0f;
        for (const auto& p : points) {
            weight += p.weight.x;
            EXPECT_EQ(p.weight, points[0].weight);
            EXPECT_GE(p.position.z, 0.0f);
            EXPECT_LE(p.position.z, 4.0f);
            EXPECT_FLOAT_EQ(p.distance, 1.0f + p.position.z);
        }
        EXPECT_NEAR(weight, 0.5f * 0.8f * (1.0f - left), 1e-5f);
    }
}

TEST(FogPoints, AreNoneOutsideTheFog) {
    std::vector<render::SurfacePoint> points;
    std::uint32_t vertex = 0;
    const render::RaySegment beside{V(0.0f, 20.0f, 0.0f), V(0.0f, 0.0f, 1.0f), 1e30f, 0.0f, V(1.0f), 0, 0};
    EXPECT_EQ(render::add_fog_points(some_fog(1.0f), beside, vertex, points), 1.0f);
    EXPECT_TRUE(points.empty());
    const render::RaySegment into{V(0.0f, 0.0f, -20.0f), V(0.0f, 0.0f, 1.0f), 1e30f, 0.0f, V(1.0f), 0, 0};
    EXPECT_NEAR(render::add_fog_points(some_fog(0.1f), into, vertex, points), std::exp(-2.0f), 1e-6f);
    for (const auto& p : points) EXPECT_GE(p.position.z, -10.001f);
}

/// Light that one lamp scatters into a ray, by the points and by the integral along it.
TEST(FogPoints, GiveTheIntegralOfScatteredLight) {
    const render::Fog fog = some_fog(0.25f);
    const V lamp(1.0f, 0.5f, 2.0f);
    const double intensity = 3.0;
    const lightcuts::HenyeyGreenstein<float> phase(V(0.0f, 0.0f, -1.0f), 1.0f, 0.6f);
    const auto scattered = [&](const glm::dvec3& at) {
        const glm::dvec3 to_lamp = glm::dvec3(lamp) - at;
        const double d = glm::length(to_lamp);
        return static_cast<double>(phase.evaluate(V(to_lamp / d))) * intensity / (d * d) * std::exp(-0.25 * d);
    };
    double integral = 0.0;
    constexpr int steps = 100'000;
    for (int i = 0; i < steps; ++i) {
        const double s = 5.0 * (i + 0.5) / steps;
        integral += 0.8 * 0.25 * std::exp(-0.25 * s) * scattered({0.0, 0.0, s}) * 5.0 / steps;
    }
    double sum = 0.0;
    constexpr int rays = 4000;
    for (std::uint32_t ray = 0; ray < rays; ++ray) {
        std::vector<render::SurfacePoint> points;
        std::uint32_t vertex = 0;
        render::add_fog_points(fog, {V(0.0f), V(0.0f, 0.0f, 1.0f), 5.0f, 0.0f, V(1.0f), 0, ray}, vertex, points);
        for (const auto& p : points) sum += static_cast<double>(p.weight.x) * scattered(glm::dvec3(p.position)) / rays;
    }
    EXPECT_NEAR(sum / integral, 1.0, 2e-3);
}

}  // namespace
