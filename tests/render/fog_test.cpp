#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <lightcuts/core/basis.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/material/phase_function.hpp>
#include <lightcuts/tree/light_tree.hpp>
#include <lightcuts/visibility/medium.hpp>
#include <render/fog.hpp>
#include <render/io/validate.hpp>
#include <render/lights/emitters.hpp>
#include <render/lights/indirect.hpp>
#include <render/lights/particle_scene.hpp>
#include <render/moving_view.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/render_loop.hpp>
#include <render/shader.hpp>
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

/// Particles fly by the law of the fog, from where they enter it.
TEST(FogParticles, StopByTheExponentialLaw) {
    const render::Scene s;
    const render::RayScene rays(s);
    const render::FoggyParticleScene particles(render::ParticleScene(s, rays, render::Shade::full), some_fog(0.3f));
    const V forward(0.0f, 0.0f, 1.0f);
    for (const double u : {0.0, 0.2, 0.9}) {
        const double way = -std::log(1.0 - u) / 0.3;
        EXPECT_NEAR(particles.free_flight(V(0.0f), forward, u), way, 1e-6);
        EXPECT_NEAR(particles.free_flight(V(0.0f, 0.0f, -15.0f), forward, u), way + 5.0, 1e-5);
    }
    // The way inside, 10 from the middle, is longer than this.
    const double passes = -std::expm1(-0.3 * 10.0);
    EXPECT_LT(particles.free_flight(V(0.0f), forward, passes - 1e-4), 10.0);
    EXPECT_EQ(particles.free_flight(V(0.0f), forward, passes + 1e-4), std::numeric_limits<double>::infinity());
    EXPECT_EQ(particles.free_flight(V(0.0f, 20.0f, 0.0f), forward, 0.5), std::numeric_limits<double>::infinity());
    EXPECT_FLOAT_EQ(particles.scattering_at(V(0.0f)).albedo.x, 0.8f);
    EXPECT_FLOAT_EQ(particles.scattering_at(V(0.0f)).asymmetry, 0.6f);
}

/// Oblique light that passes a box of fog: what it scatters is what the box lets not through.
TEST(FogParticles, ScatterWhatFogTakesOfDistantLight) {
    for (const V towards_light : {V(0.9f, 0.2f, 0.3f), V(0.0f, 1.0f, 0.0f), V(-0.3f, -0.1f, 0.8f)}) {
        render::Scene s;
        s.name = "fog";
        s.positions = {V(0.0f), V(1e-3f, 0.0f, 0.0f), V(0.0f, 0.0f, 1e-3f)};
        s.triangles = {{0, 1, 2}};
        s.triangle_material = {0};
        s.materials.resize(1);
        s.materials[0].model = render::Material::Model::phong;
        s.materials[0].base_color = V(0.0f);
        const lightcuts::Box box{V(-2.0f, -1.0f, -2.0f), V(2.0f, 1.0f, 1.0f)};
        const lightcuts::UniformMedium medium(0.4f, box);
        s.fog = {medium, 0.01f, 0.0f, 8.0f};
        const glm::dvec3 travel = -glm::normalize(glm::dvec3(towards_light));
        s.directional.push_back({V(travel), V(3.0f)});
        render::validate(s);
        render::add_virtual_lights(s, render::RayScene(s), 2000, render::Shade::full, 1);
        double flux = 0.0;
        for (const auto& light : s.volume_lights) {
            flux += 4.0 * std::numbers::pi * static_cast<double>(light.intensity.x);
        }
        // Over a plane before the box.
        const lightcuts::Basis across(travel);
        constexpr int steps = 400;
        constexpr double half = 4.0;
        double expected = 0.0;
        for (int i = 0; i < steps; ++i) {
            for (int k = 0; k < steps; ++k) {
                const glm::dvec3 at = half * ((2.0 * i + 1.0) / steps - 1.0) * across.x +
                                      half * ((2.0 * k + 1.0) / steps - 1.0) * across.y - 8.0 * travel;
                const double way = medium.way_inside(V(at), V(travel), 100.0);
                expected += -std::expm1(-0.4 * way) * 3.0 * 0.01 * std::pow(2.0 * half / steps, 2.0);
            }
        }
        EXPECT_NEAR(flux / expected, 1.0, 0.05) << towards_light.x;
    }
}

/// A closed room of side 2 whose walls emit radiance 1, albedo 0.5, filled with fog that absorbs nothing: the radiance
/// is 1 / (1 - 0.5) everywhere and in all directions, whatever the fog.
class FoggyFurnace : public testing::Test {
protected:
    static render::Scene room(float extinction, float anisotropy) {
        render::Scene s;
        s.name = "furnace";
        s.materials.resize(1);
        s.materials[0].model = render::Material::Model::phong;
        s.materials[0].base_color = V(0.5f);
        s.materials[0].emission = V(1.0f);
        for (int axis = 0; axis < 3; ++axis) {
            for (const float side : {-1.0f, 1.0f}) {
                const auto first = static_cast<std::uint32_t>(s.positions.size());
                for (const glm::vec2 d : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                    V p(0.0f);
                    p[axis] = side;
                    p[(axis + 1) % 3] = d.x;
                    p[(axis + 2) % 3] = d.y;
                    s.positions.push_back(p);
                }
                for (const glm::uvec3 t : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
                    s.triangles.push_back(first + (side < 0.0f ? t : glm::uvec3(t.x, t.z, t.y)));
                    s.triangle_material.push_back(0);
                }
            }
        }
        s.fog = {lightcuts::UniformMedium(extinction, {V(-1.01f), V(1.01f)}), 1.0f, anisotropy, 8.0f};
        render::validate(s);
        render::add_emitter_lights(s, {.points = 1024});
        render::add_virtual_lights(s, render::RayScene(s), 20000, render::Shade::full, 1);
        return s;
    }

    static double radiance(const render::Scene& s) {
        render::Options options;
        options.clamp = {};
        return radiance(s, options);
    }
    static double radiance(const render::Scene& s, render::Options options) {
        options.method = "multidimensional";
        options.spp = 8;
        options.quiet = true;
        const render::RayScene rays(s);
        const auto shader = render::make_shader(s, rays, options);
        const render::EyePathTracer surfaces(s, rays, render::Shade::full);
        render::Camera camera;
        camera.eye = {0.1, 0.2, -0.3};
        camera.target = {0.3, -0.2, 0.8};
        camera.vertical_fov = 60.0f;
        const render::MovingView view(camera, s, 8, 8);
        double sum = 0.0;
        const render::Picture picture = render::render_picture(view, surfaces, *shader, options).picture;
        for (const V& p : picture.pixels) sum += static_cast<double>(p.y) / 64.0;
        return sum;
    }
};

class FoggyFurnaces : public FoggyFurnace, public testing::WithParamInterface<float> {};

TEST_P(FoggyFurnaces, AreAsBrightAsWithoutFog) {
    const render::Scene s = room(GetParam(), 0.4f);
    EXPECT_EQ(s.volume_lights.size() > 100, GetParam() > 0.01f);
    // Points of the fog lie close to lights in it, so that the sum varies widely.
    EXPECT_NEAR(radiance(s), 2.0, 0.08);
}

/// How much a virtual light on a surface may add does not depend on how strongly fog scatters ahead.
TEST_F(FoggyFurnace, LightsOnSurfacesAreClampedAsWithoutThoseInFog) {
    render::Scene s = room(1e-6f, 0.0f);
    render::Options options;
    options.adaptation = 0.05f;
    const double without = radiance(s, options);
    const double free = radiance(s);
    EXPECT_LT(without, 0.98 * free) << "some are clamped";
    // It shines away from the room, from outside of it.
    s.volume_lights.push_back({{V(0.0f, 50.0f, 0.0f), V(0.0f, 1.0f, 0.0f), V(1e6f), {0.99f}}});
    EXPECT_NEAR(radiance(s, options), without, 0.01 * without);
}

INSTANTIATE_TEST_SUITE_P(Extinction, FoggyFurnaces, testing::Values(1e-6f, 0.05f, 0.5f, 2.0f));

}  // namespace
