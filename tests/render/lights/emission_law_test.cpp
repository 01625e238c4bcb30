#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/lights/emitters.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/surfaces/surface.hpp>
#include <render/surfaces/surface_colors.hpp>

namespace {

using render::EyePathTracer;
using render::Material;
using render::RayScene;
using render::Scene;
using render::Shade;
using render::Texture;

/// A texture of 64 x 64 texels: `f(u, v)` at their centers.
Texture texture_of(const std::function<glm::vec4(float, float)>& f) {
    Texture t;
    t.width = t.height = 64;
    t.wrap_u = t.wrap_v = Texture::Wrap::clamp;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            t.texels.push_back(f((static_cast<float>(x) + 0.5f) / 64.0f, (static_cast<float>(y) + 0.5f) / 64.0f));
        }
    }
    return t;
}

/// An emitter that faces down, 2 x 2 around (0, 2, 0), with uvs and vertex colors. Textures: 0 is a picture, 1 a
/// grating in alpha, 2 a ramp in alpha.
Scene panel() {
    Scene s;
    s.name = "panel";
    s.positions = {{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}};
    s.uv_sets = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    s.colors = {{1, 1, 1, 1}, {1, 0.5f, 0.2f, 0.5f}, {0.1f, 1, 1, 1}, {1, 0.3f, 1, 0.1f}};
    s.triangles = {{0, 1, 2}, {0, 2, 3}};
    s.triangle_material = {0, 0};
    s.textures.push_back(texture_of([](float u, float v) { return glm::vec4(u, 0.2f, v * v, 1.0f); }));
    s.textures.push_back(
        texture_of([](float u, float) { return glm::vec4(1, 1, 1, std::fmod(8.0f * u, 1.0f) < 0.5f); }));
    s.textures.push_back(texture_of([](float u, float v) { return glm::vec4(1, 1, 1, u * v); }));
    Material lamp;
    lamp.name = "lamp";
    lamp.base_color = glm::vec3(0.0f);
    lamp.emission = {4.0f, 2.0f, 1.0f};
    s.materials.push_back(lamp);
    return s;
}

constexpr glm::vec3 probe(0.3f, 0.0f, -0.2f);
constexpr glm::vec3 up(0.0f, 1.0f, 0.0f);

/// On a plane that faces `up` at the probe, of the lights that stand for the emitters.
glm::dvec3 irradiance_of_lights(Scene s) {
    render::add_emitter_lights(s, {.points = 4096});
    glm::dvec3 sum(0.0);
    for (const auto& light : s.oriented) {
        const glm::dvec3 to_light(light.position - probe);
        const double distance = glm::length(to_light);
        const double here = glm::dot(glm::dvec3(up), to_light) / distance;
        const double there = -glm::dot(glm::dvec3(light.axis), to_light) / distance;
        if (here > 0.0 && there > 0.0) sum += glm::dvec3(light.intensity) * (here * there / (distance * distance));
    }
    return sum;
}

/// The same by looking: an integral over a window of the plane y = 2 that shows all of the emitter.
glm::dvec3 irradiance_of_what_is_seen(const Scene& s, float half_window) {
    constexpr int steps = 400;
    const RayScene rays(s);
    const EyePathTracer eye(s, rays, Shade::full);
    std::vector<render::SurfacePoint> points;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const float x = half_window * (2.0f * (static_cast<float>(i) + 0.5f) / steps - 1.0f);
            const float z = half_window * (2.0f * (static_cast<float>(j) + 0.5f) / steps - 1.0f);
            const glm::vec3 way = glm::vec3(x, 2.0f, z) - probe;
            const float distance = glm::length(way);
            points.clear();
            const glm::vec3 seen = eye.follow({probe, way / distance}, 0, 0, points).emitted;
            const double cosine = static_cast<double>(way.y / distance);
            sum += glm::dvec3(seen) * (cosine * cosine / static_cast<double>(distance * distance));
        }
    }
    const double cell = 2.0 * static_cast<double>(half_window) / steps;
    return sum * (cell * cell);
}

struct EmitterType {
    const char* name;
    std::function<void(Scene&, Material&)> make;
};

std::ostream& operator<<(std::ostream& out, const EmitterType& type) { return out << type.name; }

class EveryEmitter : public testing::TestWithParam<EmitterType> {};

TEST_P(EveryEmitter, LightsByWhatIsSeenOfIt) {
    Scene s = panel();
    GetParam().make(s, s.materials[0]);
    const glm::dvec3 lights = irradiance_of_lights(s);
    const glm::dvec3 seen = irradiance_of_what_is_seen(s, 1.05f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_GT(seen[c], 0.0);
        EXPECT_NEAR(lights[c] / seen[c], 1.0, 0.01) << c;
    }
}

const EmitterType emitter_types[] = {
    {"opaque", [](Scene&, Material&) {}},
    {"textured", [](Scene&, Material& m) { m.emission_texture.texture = 0; }},
    {"turned",
     [](Scene& s, Material&) {
         for (glm::uvec3& t : s.triangles) std::swap(t.y, t.z);
         s.materials[0].double_sided = true;
     }},
    {"masked",
     [](Scene&, Material& m) {
         m.alpha = Material::Alpha::mask;
         m.base_color_texture.texture = 1;
     }},
    {"maskedAndTextured",
     [](Scene&, Material& m) {
         m.alpha = Material::Alpha::mask;
         m.base_color_texture.texture = 1;
         m.emission_texture.texture = 0;
     }},
    {"blended",
     [](Scene& s, Material& m) {
         s.colors.clear();
         m.alpha = Material::Alpha::blend;
         m.base_alpha = 0.25f;
     }},
    {"blendedByTexture",
     [](Scene&, Material& m) {
         m.alpha = Material::Alpha::blend;
         m.base_color_texture.texture = 2;
     }},
    {"blendedByVertices", [](Scene&, Material& m) { m.alpha = Material::Alpha::blend; }},
    {"maskedByVertices", [](Scene&, Material& m) { m.alpha = Material::Alpha::mask; }},
    {"opacityByAMap",
     [](Scene&, Material& m) {
         m.model = Material::Model::phong;
         m.alpha = Material::Alpha::blend;
         m.alpha_texture.texture = 2;
         m.base_alpha = 0.5f;
     }},
    {"unlit",
     [](Scene&, Material& m) {
         m.model = Material::Model::unlit;
         m.emission = {0.8f, 0.5f, 0.3f};
     }},
    {"unlitAndMasked",
     [](Scene&, Material& m) {
         m.model = Material::Model::unlit;
         m.alpha = Material::Alpha::mask;
         m.base_color_texture.texture = 1;
         m.emission_texture = m.base_color_texture;
     }},
    {"transparent", [](Scene&, Material& m) { m.transmission = 0.9f; }},
    {"mirror", [](Scene&, Material& m) { m.model = Material::Model::mirror; }},
    {"glass",
     [](Scene&, Material& m) {
         m.model = Material::Model::glass;
         m.transmission = 1.0f;
     }},
};

INSTANTIATE_TEST_SUITE_P(EmissionLaw, EveryEmitter, testing::ValuesIn(emitter_types),
                         [](const auto& about) { return std::string(about.param.name); });

TEST(EmissionLaw, HolesHaveNoLights) {
    Scene s = panel();
    s.colors.clear();
    s.materials[0].alpha = Material::Alpha::mask;
    s.materials[0].base_color_texture.texture = 1;
    render::add_emitter_lights(s, {.points = 500});
    ASSERT_EQ(s.oriented.size(), 500u);
    int in_holes = 0;
    for (const auto& light : s.oriented) {
        const float u = 0.5f * (light.position.x + 1.0f);
        in_holes += std::fmod(8.0f * u, 1.0f) > 0.52f ? 1 : 0;
    }
    EXPECT_EQ(in_holes, 0);
}

TEST(EmissionLaw, WhatEmitsOnOneSideIsDarkFromBehind) {
    Scene s = panel();
    for (glm::uvec3& t : s.triangles) std::swap(t.y, t.z);
    EXPECT_EQ(irradiance_of_lights(s), glm::dvec3(0.0));
    EXPECT_EQ(irradiance_of_what_is_seen(s, 1.05f), glm::dvec3(0.0));
    EXPECT_EQ(render::emitted_radiance(s, 0, 0.3f, 0.3f, false), glm::vec3(0.0f));
    EXPECT_EQ(render::emitted_radiance(s, 0, 0.3f, 0.3f, true), s.materials[0].emission);
}

}  // namespace
