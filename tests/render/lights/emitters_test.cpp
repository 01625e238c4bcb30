#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <render/lights/emitters.hpp>
#include <render/scenes/shapes.hpp>
#include <render/triangle.hpp>

#include "render/area_of.hpp"
#include "render/refusal.hpp"

namespace {

using render::add_emitter_lights;
using render::emissive_surfaces;
using render::Material;
using render::Modeller;
using render::Scene;

constexpr glm::vec3 radiance(2.0f, 1.0f, 0.5f);

Scene empty_scene(bool double_sided = false) {
    Scene s;
    Material m;
    m.emission = radiance;
    m.double_sided = double_sided;
    s.materials.push_back(m);
    return s;
}

/// A 3 x 2 rectangle, cut into `u` x `v` cells, anywhere in space.
Scene rectangle(int u, int v) {
    Scene s = empty_scene();
    Modeller m(s);
    m.quad({1, 2, 3}, {2.4f, 1.8f, 0}, {0, 0, 2}, u, v);
    return s;
}

glm::dvec3 total_intensity(const Scene& s) {
    glm::dvec3 sum(0.0);
    for (const auto& light : s.oriented) sum += glm::dvec3(light.intensity);
    return sum;
}

TEST(EmissiveSurfaces, AreComponentsOfOneMaterial) {
    Scene s = empty_scene();
    s.materials.push_back(s.materials[0]);
    s.materials.emplace_back();  // dark
    Modeller m(s);
    m.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2);
    m.quad({1, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2);  // touches: welded by position, not by index
    m.quad({5, 0, 0}, {1, 0, 0}, {0, 1, 0});        // apart
    m.material = 1;
    m.quad({2, 0, 0}, {1, 0, 0}, {0, 1, 0});  // touches, but of another material
    m.material = 2;
    m.quad({7, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const auto surfaces = emissive_surfaces(s);
    ASSERT_EQ(surfaces.size(), 3u);
    EXPECT_EQ(surfaces[0].triangles.size(), 16u);
    EXPECT_DOUBLE_EQ(area_of(s, surfaces[0].triangles), 2.0);
    EXPECT_EQ(surfaces[1].triangles.size(), 2u);
    EXPECT_EQ(surfaces[2].material, 1u);
}

TEST(EmissiveSurfaces, NegativeZeroIsZero) {
    Scene s = empty_scene();
    Modeller m(s);
    m.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    m.quad({-0.0f, -0.0f, -0.0f}, {-1, 0, 0}, {0, -1, 0});
    s.positions[4] = {-0.0f, -0.0f, -0.0f};
    EXPECT_EQ(emissive_surfaces(s).size(), 1u);
}

TEST(EmitterLights, PowerIsRadianceTimesArea) {
    for (const std::size_t count : {1u, 7u, 64u, 1000u}) {
        Scene s = rectangle(3, 1);
        add_emitter_lights(s, {.points = count});
        ASSERT_EQ(s.oriented.size(), count);
        for (const auto& light : s.oriented) {
            EXPECT_NEAR(light.intensity.x, 2.0f * 6.0f / static_cast<float>(count), 1e-5f);
            EXPECT_NEAR(glm::length(light.axis - glm::vec3(0.6f, -0.8f, 0.0f)), 0.0f, 1e-6f);
        }
        EXPECT_NEAR(total_intensity(s).y, 6.0, 1e-4);
    }
}

TEST(EmitterLights, TessellationOfAFlatSurfaceChangesNothing) {
    Scene coarse = rectangle(1, 1);
    add_emitter_lights(coarse, {.points = 64});
    for (const auto& [u, v] : {std::array{2, 5}, std::array{16, 16}, std::array{1, 40}}) {
        Scene fine = rectangle(u, v);
        add_emitter_lights(fine, {.points = 64});
        ASSERT_EQ(fine.oriented.size(), 64u);
        for (std::size_t i = 0; i < 64; ++i) {
            EXPECT_LE(glm::length(fine.oriented[i].position - coarse.oriented[i].position), 1e-4f) << i;
            EXPECT_LE(glm::length(fine.oriented[i].intensity - coarse.oriented[i].intensity), 1e-5f);
        }
    }
}

TEST(EmitterLights, NotOfWhatIsOnlySeen) {
    Scene s = rectangle(2, 2);
    s.materials[0].only_seen = true;
    EXPECT_TRUE(emissive_surfaces(s).empty());
    add_emitter_lights(s, {.points = 64});
    EXPECT_TRUE(s.oriented.empty());
}

TEST(EmitterLights, OneLightLiesInTheMiddle) {
    Scene s = rectangle(4, 4);
    add_emitter_lights(s, {.points = 1});
    EXPECT_LE(glm::length(s.oriented[0].position - glm::vec3(2.2f, 2.9f, 4.0f)), 1e-3f);
}

TEST(EmitterLights, LieSlightlyOffTheSurface) {
    Scene s = rectangle(1, 1);
    add_emitter_lights(s, {.points = 50});
    for (const auto& light : s.oriented) {
        const float height = glm::dot(light.position - glm::vec3(1, 2, 3), light.axis);
        EXPECT_GT(height, 1e-6f);
        EXPECT_LT(height, 1e-3f);
    }
}

TEST(EmitterLights, DoubleSidedEmitsOnBothSides) {
    Scene s = empty_scene(true);
    Modeller(s).quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_emitter_lights(s, {.points = 10});
    ASSERT_EQ(s.oriented.size(), 20u);
    EXPECT_EQ(std::count_if(s.oriented.begin(), s.oriented.end(), [](const auto& l) { return l.axis.z > 0.5f; }), 10);
    EXPECT_NEAR(total_intensity(s).x, 4.0, 1e-5);
    for (const auto& light : s.oriented) EXPECT_GT(light.position.z * light.axis.z, 0.0f);
}

TEST(EmitterLights, NoneWanted) {
    Scene s = rectangle(1, 1);
    add_emitter_lights(s, {.points = 0});
    EXPECT_TRUE(s.oriented.empty());
    EXPECT_THAT(refusal([&] { add_emitter_lights(s, {.points = std::size_t{1} << 40}); }),
                testing::HasSubstr("--area-points"));
}

/// Largest difference between the share of points and the share of area of a box from the rectangle's corner.
double discrepancy(const Scene& s, std::size_t count) {
    double worst = 0;
    for (double x = 0.125; x <= 1.0; x += 0.125) {
        for (double y = 0.125; y <= 1.0; y += 0.125) {
            std::size_t inside = 0;
            for (const auto& light : s.oriented) {
                const glm::vec3 d = light.position - glm::vec3(1, 2, 3);
                const double u = static_cast<double>(glm::dot(d, glm::vec3(0.8f, 0.6f, 0.0f))) / 3.0;
                const double v = static_cast<double>(d.z) / 2.0;
                if (u < x && v < y) ++inside;
            }
            worst = std::max(worst, std::abs(static_cast<double>(inside) / static_cast<double>(count) - x * y));
        }
    }
    return worst;
}

TEST(EmitterLights, SpreadEvenly) {
    for (const std::size_t count : {16u, 64u, 256u, 1024u}) {
        Scene s = rectangle(5, 3);
        add_emitter_lights(s, {.points = count});
        // Independent points would give about 0.8 / sqrt(count).
        EXPECT_LE(discrepancy(s, count), 1.7 / std::pow(static_cast<double>(count), 0.8)) << count;
    }
}

TEST(EmitterLights, FollowTheOutline) {
    // An L of three squares: no light lies in the missing one, each square gets a third.
    Scene s = empty_scene();
    Modeller m(s);
    m.quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, 3);
    m.quad({1, 0, 0}, {1, 0, 0}, {0, 1, 0});
    m.quad({0, 1, 0}, {1, 0, 0}, {0, 1, 0});
    add_emitter_lights(s, {.points = 300});
    std::array<int, 4> in{};
    for (const auto& light : s.oriented) {
        ++in[static_cast<std::size_t>((light.position.x > 1.0f ? 1 : 0) + (light.position.y > 1.0f ? 2 : 0))];
    }
    EXPECT_EQ(in[3], 0);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(in[static_cast<std::size_t>(i)], 100, 8);
}

TEST(EmitterLights, CurvedSurfacesGetEqualShares) {
    // On a sphere, octants have equal areas; the tessellation of one half is four times finer.
    for (const int segments : {16, 48}) {
        Scene s = empty_scene();
        Modeller(s).sphere({0, 0, 0}, 1.0f, segments);
        ASSERT_EQ(emissive_surfaces(s).size(), 1u);
        add_emitter_lights(s, {.points = 800});
        std::array<int, 8> in{};
        glm::vec3 mean(0.0f);
        for (const auto& light : s.oriented) {
            const glm::vec3 p = light.position;
            ++in[static_cast<std::size_t>((p.x > 0 ? 1 : 0) + (p.y > 0 ? 2 : 0) + (p.z > 0 ? 4 : 0))];
            EXPECT_GT(glm::dot(glm::normalize(p), light.axis), 0.9f);
            mean += p / 800.0f;
        }
        for (const int n : in) EXPECT_NEAR(n, 100, 6);
        EXPECT_LE(glm::length(mean), 0.02f);
    }
}

TEST(EmitterLights, TextureDistributesThem) {
    // The left half is three times as bright as the right one, and of another color.
    Scene s = empty_scene();
    s.materials[0].emission = glm::vec3(1.0f);
    s.materials[0].emission_texture.texture = 0;
    render::Texture texture;
    texture.width = 64;
    texture.height = 1;
    for (int i = 0; i < 64; ++i) texture.texels.push_back(i < 32 ? glm::vec4(3, 3, 0, 1) : glm::vec4(0, 0, 2, 1));
    texture.wrap_u = render::Texture::Wrap::clamp;
    s.textures.push_back(texture);
    Modeller(s).quad({0, 0, 0}, {2, 0, 0}, {0, 1, 0});
    s.uv_sets.resize(1);
    for (const glm::vec3& p : s.positions) s.uv_sets[0].emplace_back(0.5f * p.x, p.y);
    add_emitter_lights(s, {.points = 400});
    ASSERT_EQ(s.oriented.size(), 400u);
    int left = 0;
    for (const auto& light : s.oriented) {
        left += light.position.x < 1.0f ? 1 : 0;
        EXPECT_NEAR(light.intensity.x + light.intensity.y + light.intensity.z, 8.0f / 400.0f, 1e-5f);
    }
    EXPECT_NEAR(left, 300, 4);
    EXPECT_NEAR(total_intensity(s).x, 3.0, 0.05);
    EXPECT_NEAR(total_intensity(s).z, 2.0, 0.05);

    s.textures[0].texels.assign(64, glm::vec4(0, 0, 0, 1));
    s.oriented.clear();
    add_emitter_lights(s, {.points = 400});
    EXPECT_TRUE(s.oriented.empty());
}

TEST(EmitterLights, GoWhereTheTextureTransformSays) {
    Scene s = empty_scene();
    s.materials[0].emission = glm::vec3(1.0f);
    s.materials[0].emission_texture.texture = 0;
    s.materials[0].emission_texture.uv = {{1.0f, 0.0f}, {-1.0f, 0.0f}, {0.0f, 1.0f}};  // mirrored
    render::Texture texture;
    texture.width = 64;
    texture.height = 1;
    for (int i = 0; i < 64; ++i) texture.texels.push_back(i < 32 ? glm::vec4(1.0f) : glm::vec4(0.0f));
    texture.wrap_u = render::Texture::Wrap::clamp;
    s.textures.push_back(texture);
    Modeller(s).quad({0, 0, 0}, {2, 0, 0}, {0, 1, 0});
    s.uv_sets.resize(1);
    for (const glm::vec3& p : s.positions) s.uv_sets[0].emplace_back(0.5f * p.x, p.y);
    add_emitter_lights(s, {.points = 100});
    ASSERT_EQ(s.oriented.size(), 100u);
    for (const auto& light : s.oriented) EXPECT_GT(light.position.x, 0.98f);
}

/// `count` lamps apart from each other; every tenth is a hundred times as large. Double-sided if `both`.
Scene many_lamps(int count, bool both = false) {
    Scene s = empty_scene();
    s.materials[0].emission = glm::vec3(3.0f, 2.0f, 1.0f);
    s.materials[0].double_sided = both;
    for (int i = 0; i < count; ++i) {
        const float size = i % 10 == 0 ? 1.0f : 0.1f;
        Modeller(s).quad({3.0f * static_cast<float>(i), 0, 0}, {size, 0, 0}, {0, size, 0});
    }
    return s;
}

glm::dvec3 power_of(const Scene& s) {
    glm::dvec3 sum(0.0);
    for (const auto& light : s.oriented) sum += glm::dvec3(light.intensity);
    return sum;
}

TEST(EmitterLights, OfVeryManyLampsShareATotalByPower) {
    for (const bool both : {false, true}) {
        Scene s = many_lamps(10'000, both);
        add_emitter_lights(s, {.points = 64});
        EXPECT_LE(s.oriented.size(), 200'000u);
        EXPECT_GT(s.oriented.size(), 60'000u);
        const double area = 1000 * 1.0 + 9000 * 0.01;
        const glm::dvec3 power = power_of(s);
        EXPECT_NEAR(power.x, (both ? 2.0 : 1.0) * 3.0 * area, 1e-3 * 3.0 * area);
        // The large ones have the most that one may have, the small ones a hundredth of the power each.
        std::vector<int> lights(10'000);
        for (const auto& light : s.oriented) ++lights[static_cast<std::size_t>(light.position.x / 3.0f)];
        const int sides = both ? 2 : 1;
        for (std::size_t i = 0; i < lights.size(); ++i) {
            EXPECT_GE(lights[i], sides);
            EXPECT_LE(lights[i], 64 * sides);
            if (i % 10 == 0) { EXPECT_EQ(lights[i], 64 * sides); }
        }
    }
}

TEST(EmitterLights, OfFewLampsAreAsManyAsWanted) {
    Scene s = many_lamps(100);
    add_emitter_lights(s, {.points = 4096});
    EXPECT_EQ(s.oriented.size(), 409'600u);
    s = many_lamps(3125);
    add_emitter_lights(s, {.points = 64});
    EXPECT_EQ(s.oriented.size(), 200'000u);
    // A total that is given holds for few as well; below one each it cannot go.
    s = many_lamps(100);
    add_emitter_lights(s, {.points = 64, .total = 1000});
    EXPECT_LE(s.oriented.size(), 1000u);
    EXPECT_GT(s.oriented.size(), 900u);
    s = many_lamps(100);
    add_emitter_lights(s, {.points = 64, .total = 10});
    EXPECT_EQ(s.oriented.size(), 100u);
    s = many_lamps(4000);
    add_emitter_lights(s, {.points = 64, .total = 0});
    EXPECT_EQ(s.oriented.size(), 256'000u);
}

TEST(EmitterLights, OfTwoSidesAreAsDenseAsOfOne) {
    // By a budget, a side of a double-sided lamp gets as many lights as a like lamp of one side.
    Scene s = many_lamps(200);
    s.materials.push_back(s.materials[0]);
    s.materials[1].double_sided = true;
    for (std::size_t t = 0; t < s.triangles.size(); ++t) s.triangle_material[t] = t / 2 % 4 < 2 ? 0 : 1;
    add_emitter_lights(s, {.points = 64, .total = 1000});
    std::vector<std::size_t> up(200);
    std::vector<std::size_t> down(200);
    for (const auto& light : s.oriented) {
        ++(light.axis.z > 0.0f ? up : down)[static_cast<std::size_t>(light.position.x / 3.0f)];
    }
    for (std::size_t i = 0; i < 200; ++i) {
        EXPECT_EQ(up[i], up[i % 10 == 0 ? 0 : 1]) << i;
        EXPECT_EQ(down[i], i % 4 < 2 ? 0 : up[i]) << i;
    }
    EXPECT_GT(up[0], 10u);
    EXPECT_LT(up[0], 64u);
}

}  // namespace
