#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <lightcuts/source/sampler.hpp>
#include <render/lights/particle_scene.hpp>
#include <render/surfaces/surface_material.hpp>

namespace {

using render::Material;
using render::Scene;

/// A large triangle in the plane y = 0 of that material.
Scene plane_of(const Material& material) {
    Scene scene;
    scene.positions = {{-50, 0, -50}, {0, 0, 80}, {50, 0, -50}};
    scene.triangles = {{0, 1, 2}};
    scene.triangle_material = {0};
    scene.materials = {material};
    return scene;
}

/// Sums of weight x (1, direction) over all directions, channel by channel.
struct Moments {
    glm::dvec3 whole{0.0}, x{0.0}, y{0.0}, z{0.0};

    void add(const glm::dvec3& weight, const glm::dvec3& direction) {
        whole += weight;
        x += weight * direction.x;
        y += weight * direction.y;
        z += weight * direction.z;
    }
};

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance, const std::string& what) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << what << ", channel " << c;
}

TEST(ParticleScene, ScattersAsSurfacesReflect) {
    const auto material = [](auto&& set) {
        Material m;
        set(m);
        return m;
    };
    const glm::vec3 paint(0.7f, 0.5f, 0.2f);
    struct Case {
        std::string name;
        Material material;
        double tolerance;
    };
    const std::vector<Case> cases = {
        {"plaster", material([&](Material& m) { m.base_color = paint; }), 0.01},
        {"varnish", material([&](Material& m) { m.base_color = paint, m.roughness = 0.4f; }), 0.01},
        {"gold", material([&](Material& m) { m.base_color = paint, m.metallic = 1.0f, m.roughness = 0.3f; }), 0.01},
        {"phong", material([&](Material& m) {
             m.model = Material::Model::phong;
             m.base_color = 0.5f * paint;
             m.specular = {0.1f, 0.3f, 0.4f};
             m.exponent = 20.0f;
         }),
         0.01},
        {"leaf", material([&](Material& m) {
             m.base_color = paint;
             m.alpha = Material::Alpha::blend;
             m.base_alpha = 0.4f;
         }),
         0.01},
        {"pane", material([&](Material& m) {
             m.base_color = paint;
             m.transmission = 0.6f;
             m.roughness = 0.0f;
         }),
         0.01},
        {"thin leaf", material([&](Material& m) {
             m.base_color = paint;
             m.roughness = 0.5f;
             m.diffuse_transmission = 0.6f;
             m.diffuse_transmission_color = {0.3f, 0.9f, 0.1f};
         }),
         0.01},
        {"mirror", material([&](Material& m) { m.model = Material::Model::mirror, m.base_color = paint; }), 1e-5},
        {"glass", material([&](Material& m) { m.model = Material::Model::glass, m.base_color = paint; }), 0.01},
    };
    const glm::vec3 direction = glm::normalize(glm::vec3(0.8f, -0.5f, 0.1f));
    for (const Case& each : cases) {
        const Scene scene = plane_of(each.material);
        const render::RayScene rays(scene);
        const render::ParticleScene surfaces(scene, rays, render::Shade::full);
        const auto met = surfaces.intersect(-2.0f * direction, direction);
        ASSERT_TRUE(met) << each.name;
        EXPECT_EQ(met->normal, glm::vec3(0, 1, 0));

        constexpr std::uint32_t samples = 1u << 15;
        const lightcuts::ScrambledSobol sampler{7};
        Moments found;
        for (std::uint32_t i = 0; i < samples; ++i) {
            const auto number = [&](std::uint32_t d) {
                return std::min(0.99999994f, static_cast<float>(sampler(i, d)));
            };
            const auto way = surfaces.scatter(*met, direction, {number(0), number(1), number(2)});
            if (way.weight == glm::vec3(0.0f)) continue;
            EXPECT_NEAR(glm::length(way.direction), 1.0f, 1e-5f);
            EXPECT_GT(way.direction.y * way.origin.y, 0.0f) << each.name << ": starts behind the surface";
            found.add(glm::dvec3(way.weight) / static_cast<double>(samples), glm::dvec3(way.direction));
        }

        // What surfaces do with an eye ray along that direction, added up.
        std::vector<render::SurfacePoint> points;
        const render::EyePathTracer tracer(scene, rays, render::Shade::full);
        tracer.follow({-2.0f * direction, direction}, 0, 0, points);
        Moments expected;
        for (const auto& way : met->response.delta_lobes())
            expected.add(glm::dvec3(way.share), glm::dvec3(way.direction));
        for (const auto& point : points) {
            const render::SurfaceMaterial reflects(point);
            constexpr int steps = 500;
            for (int i = -steps; i < steps; ++i) {
                for (int j = 0; j < 2 * steps; ++j) {
                    const double y = (i + 0.5) / steps, turn = std::numbers::pi * (j + 0.5) / steps;
                    const double across = std::sqrt(1.0 - y * y);
                    const glm::dvec3 to_light(across * std::cos(turn), y, across * std::sin(turn));
                    expected.add(glm::dvec3(point.weight) * glm::dvec3(reflects.evaluate(glm::vec3(to_light))) *
                                     (std::numbers::pi / steps / steps),
                                 to_light);
                }
            }
        }
        expect_near(found.whole, expected.whole, each.tolerance, each.name + " albedo");
        expect_near(found.x, expected.x, each.tolerance, each.name + " x");
        expect_near(found.y, expected.y, each.tolerance, each.name + " y");
        expect_near(found.z, expected.z, each.tolerance, each.name + " z");
    }
}

TEST(ParticleScene, ScattersNoMoreThanArrives) {
    // Kd + Ks of 1.7 here: in a closed room, light would grow without end.
    Material bright;
    bright.model = Material::Model::phong;
    bright.base_color = glm::vec3(0.9f, 0.8f, 0.1f);
    bright.specular = glm::vec3(0.8f, 0.8f, 0.2f);
    bright.exponent = 5.0f;
    const Scene scene = plane_of(bright);
    const render::RayScene rays(scene);
    const render::ParticleScene surfaces(scene, rays, render::Shade::full);
    const glm::vec3 direction = glm::normalize(glm::vec3(0.3f, -1.0f, 0.1f));
    const auto met = surfaces.intersect(-2.0f * direction, direction);
    ASSERT_TRUE(met);
    constexpr std::uint32_t samples = 1u << 16;
    const lightcuts::ScrambledSobol sampler{3};
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const auto at = [&](std::uint32_t d) { return std::min(static_cast<float>(sampler(i, d)), 1.0f - 0x1p-24f); };
        sum += glm::dvec3(surfaces.scatter(*met, direction, {at(0), at(1), at(2)}).weight);
    }
    for (int c = 0; c < 3; ++c) EXPECT_LT(sum[c] / samples, 1.01) << c;
    EXPECT_GT(sum.x / samples, 0.9);
}

TEST(ParticleScene, KnowsItsBoundsAndAlbedos) {
    Material material;
    material.base_color = {0.5f, 2.0f, 0.25f};
    material.alpha = Material::Alpha::blend;
    material.base_alpha = 0.5f;
    const Scene scene = plane_of(material);
    const render::RayScene rays(scene);
    const render::ParticleScene surfaces(scene, rays, render::Shade::full);
    EXPECT_EQ(surfaces.bounds(), (lightcuts::Box{{-50, 0, -50}, {50, 0, 80}}));
    EXPECT_FALSE(surfaces.intersect({0, 1, 0}, {0, 1, 0}));
    const auto from_below = surfaces.intersect({0, -1, 0}, {0, 1, 0});
    ASSERT_TRUE(from_below);
    EXPECT_EQ(from_below->normal, glm::vec3(0, -1, 0));
    EXPECT_LE(from_below->position.y, 0.0f);
    EXPECT_EQ(surfaces.diffuse_albedo(*from_below), glm::vec3(0.25f, 1.0f, 0.125f));
    EXPECT_EQ(surfaces.diffuse_transmittance(*from_below), glm::vec3(0.0f));
    EXPECT_GT(from_below->position_behind.y, 0.0f);
}

}  // namespace
