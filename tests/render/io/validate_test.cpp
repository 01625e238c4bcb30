#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/vec3.hpp>
#include <render/io/validate.hpp>
#include <render/scenes/shapes.hpp>
#include <render/surfaces/texture.hpp>

#include "render/refusal.hpp"

namespace {

using render::Scene;
using render::validate;
using testing::HasSubstr;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

Scene square() {
    Scene s;
    s.name = "square";
    s.materials.emplace_back();
    render::Modeller(s).quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    return s;
}

/// The message for the square after `damage`.
template <class Damage>
std::string refused(Damage&& damage) {
    Scene s = square();
    damage(s);
    const std::string message = refusal([&] { validate(s); });
    EXPECT_EQ(message.rfind("square: ", 0), 0u) << message;
    return message;
}

TEST(Validate, GoodScenesPass) {
    Scene s = square();
    s.omni.push_back({{0, 0, 1}, {1, 1, 1}});
    s.omni.push_back({{0, 0, 1}, {0, 0, 0}});
    validate(s);
    EXPECT_EQ(s.omni.size(), 1u);
    EXPECT_EQ(s.dropped_lights, 1u);
    validate(s);  // again changes nothing
    EXPECT_EQ(s.dropped_lights, 1u);
}

TEST(Validate, BadGeometry) {
    EXPECT_THAT(refused([](Scene& s) { s.triangles.clear(); }), HasSubstr("no triangles"));
    EXPECT_THAT(refused([](Scene& s) { s.positions[2].y = nan; }), HasSubstr("vertex 2"));
    EXPECT_THAT(refused([](Scene& s) { s.positions[2].y = -infinity; }), HasSubstr("vertex 2"));
    EXPECT_THAT(refused([](Scene& s) { s.normals[1].x = nan; }), HasSubstr("normal of vertex 1"));
    EXPECT_THAT(refused([](Scene& s) { s.uv_sets = {std::vector<glm::vec2>(4, glm::vec2(nan))}; }),
                HasSubstr("uv of vertex 0"));
    EXPECT_THAT(refused([](Scene& s) { s.triangles[1].z = 4; }), HasSubstr("triangle 1"));
    EXPECT_THAT(refused([](Scene& s) { s.triangle_material[0] = 1; }), HasSubstr("triangle 0"));
    EXPECT_THAT(refused([](Scene& s) { s.normals.pop_back(); }), HasSubstr("one normal per vertex"));
    EXPECT_THAT(refused([](Scene& s) { s.positions.assign(4, glm::vec3(1.0f)); }), HasSubstr("zero area"));
}

TEST(Validate, BadMaterials) {
    EXPECT_THAT(refused([](Scene& s) { s.materials[0].emission.y = -1; }), HasSubstr("emission"));
    EXPECT_THAT(refused([](Scene& s) { s.materials[0].emission.y = infinity; }), HasSubstr("emission"));
    EXPECT_THAT(refused([](Scene& s) { s.materials[0].emission.y = 3e38f; }), HasSubstr("light of its surfaces"));
    EXPECT_THAT(refused([](Scene& s) { s.materials[0].roughness = nan; }), HasSubstr("roughness"));
    EXPECT_THAT(refused([](Scene& s) { s.materials[0].metallic = 2; }), HasSubstr("metallic"));
    EXPECT_THAT(refused([](Scene& s) { s.materials[0].base_color_texture.texture = 0; }), HasSubstr("texture"));
    EXPECT_THAT(refused([](Scene& s) { s.materials[0].alpha_texture.texture = 0; }), HasSubstr("texture"));
    EXPECT_THAT(refused([](Scene& s) { s.materials[0].emission_texture.uv.offset.x = std::nanf(""); }),
                HasSubstr("texture transform"));
}

TEST(Validate, BadLights) {
    const glm::vec3 one(1.0f);
    EXPECT_THAT(refused([&](Scene& s) { s.omni = {{one, one}, {one, {0, -1, 0}}}; }), HasSubstr("omni light 1: "));
    EXPECT_THAT(refused([&](Scene& s) { s.omni = {{one, {nan, 1, 1}}}; }), HasSubstr("omni light 0: "));
    EXPECT_THAT(refused([&](Scene& s) { s.omni = {{{infinity, 1, 1}, one}}; }), HasSubstr("position"));
    EXPECT_THAT(refused([&](Scene& s) { s.oriented = {{one, {0, 0, 0}, one}}; }), HasSubstr("oriented light 0: "));
    EXPECT_THAT(refused([&](Scene& s) { s.oriented = {{one, {0, 0, 2}, one}}; }), HasSubstr("unit"));
    EXPECT_THAT(refused([&](Scene& s) { s.spots = {{one, {0, nan, 0}, one, {}}}; }), HasSubstr("spot light 0: "));
    EXPECT_THAT(refused([&](Scene& s) { s.directional = {{{0, 0, 0}, one}}; }), HasSubstr("directional light 0: "));
}

TEST(Validate, FlatTrianglesAreDropped) {
    Scene s = square();
    s.triangles.insert(s.triangles.begin(), {0, 0, 1});
    s.triangle_material.insert(s.triangle_material.begin(), 0);
    validate(s);
    EXPECT_EQ(s.triangles.size(), 2u);
    EXPECT_EQ(s.triangle_material.size(), 2u);
    EXPECT_EQ(s.dropped_triangles, 1u);
}

render::Texture two_texels(render::Texture::Wrap wrap) {
    render::Texture t;
    t.width = 2;
    t.height = 1;
    t.texels = {glm::vec4(0.0f), glm::vec4(1.0f)};
    t.wrap_u = t.wrap_v = wrap;
    return t;
}

TEST(Texture, BilinearAndWrapped) {
    using Wrap = render::Texture::Wrap;
    const auto at = [](Wrap wrap, float u) { return two_texels(wrap).sample({u, 0.5f}).x; };
    EXPECT_FLOAT_EQ(at(Wrap::repeat, 0.25f), 0.0f);
    EXPECT_FLOAT_EQ(at(Wrap::repeat, 0.75f), 1.0f);
    EXPECT_FLOAT_EQ(at(Wrap::repeat, 0.5f), 0.5f);
    EXPECT_FLOAT_EQ(at(Wrap::repeat, 0.0f), 0.5f);
    EXPECT_FLOAT_EQ(at(Wrap::repeat, -0.25f), 1.0f);
    EXPECT_FLOAT_EQ(at(Wrap::clamp, 0.0f), 0.0f);
    EXPECT_FLOAT_EQ(at(Wrap::clamp, 7.0f), 1.0f);
    EXPECT_FLOAT_EQ(at(Wrap::mirror, 0.0f), 0.0f);
    EXPECT_FLOAT_EQ(at(Wrap::mirror, 1.25f), 1.0f);
    EXPECT_FLOAT_EQ(at(Wrap::mirror, 1.75f), 0.0f);
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
        for (const float u : {-1e-9f, 1e-9f, 1.0f, -1e20f, 1e20f, 123456.7f}) {
            const float value = at(wrap, u);
            EXPECT_TRUE(value >= 0.0f && value <= 1.0f) << u;
        }
    }
}

TEST(Texture, SrgbDecoding) {
    EXPECT_EQ(render::srgb_to_linear(0.0f), 0.0f);
    EXPECT_NEAR(render::srgb_to_linear(1.0f), 1.0f, 1e-6f);
    EXPECT_NEAR(render::srgb_to_linear(0.5f), 0.21404f, 1e-5f);
    EXPECT_NEAR(render::srgb_to_linear(0.04f), 0.04f / 12.92f, 1e-7f);
    const std::array<std::uint8_t, 4> pixels{128, 64, 255, 0};
    const render::Texture gray = render::make_texture("t", {2, 1, 2, 8, pixels.data(), pixels.size()}, true);
    EXPECT_NEAR(gray.texels[0].b, 0.2159f, 1e-4f);
    EXPECT_NEAR(gray.texels[0].a, 64.0f / 255.0f, 1e-6f);  // alpha is never encoded
    EXPECT_EQ(gray.texels[1].a, 0.0f);
    EXPECT_THAT(refusal([&] {
                    render::make_texture("t", {2, 2, 4, 8, pixels.data(), pixels.size()}, true);
                }),
                HasSubstr("'t'"));
}

}  // namespace
