#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <lightcuts/core/random.hpp>
#include <lightcuts/source/emitter.hpp>
#include <render/lights/emission_range.hpp>
#include <render/lights/emitters.hpp>
#include <render/surfaces/surface_colors.hpp>

namespace {

using glm::dvec3;
using render::Material;
using render::Scene;
using render::Texture;

/// A black map.
Texture map_of(int width, int height, Texture::Filter filter = Texture::Filter::linear) {
    Texture t;
    t.name = "map";
    t.width = width;
    t.height = height;
    t.filter = filter;
    t.texels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::vec4(0, 0, 0, 1));
    return t;
}

glm::vec4& texel(Texture& t, int x, int y) {
    return t.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(t.width) + static_cast<std::size_t>(x)];
}

void add_spot(Texture& t, int x, int y, int size, const glm::vec3& color) {
    for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) texel(t, (x + i) % t.width, (y + j) % t.height) = glm::vec4(color, 1.0f);
    }
}

/// In [0, 1), by two numbers.
double draw(std::uint64_t a, std::uint64_t b) { return lightcuts::uniform01(lightcuts::hash_keys(a, b)); }

/// The integral of a map over whole periods, per area: each texel weighs the same, however it is interpolated.
dvec3 mean_of(const Texture& t) {
    dvec3 sum(0.0);
    for (const glm::vec4& texel : t.texels) sum += dvec3(texel);
    return sum / static_cast<double>(t.texels.size());
}

/// An emitter of 2 x 1.5 that faces down, whose uvs run from 0 to `periods`.
Scene panel(Texture map, float periods = 1.0f) {
    Scene s;
    s.name = "panel";
    s.positions = {{0, 3, 0}, {2, 3, 0}, {2, 3, 1.5f}, {0, 3, 1.5f}};
    s.uv_sets = {{{0, 0}, {periods, 0}, {periods, periods}, {0, periods}}};
    s.triangles = {{0, 1, 2}, {0, 2, 3}};
    s.triangle_material = {0, 0};
    s.textures.push_back(std::move(map));
    Material lamp;
    lamp.name = "lamp";
    lamp.emission = {4.0f, 2.0f, 1.0f};
    lamp.emission_texture.texture = 0;
    s.materials.push_back(lamp);
    return s;
}
constexpr double area = 3.0;

dvec3 power_of_lights(Scene& s, std::size_t points) {
    s.oriented.clear();
    render::add_emitter_lights(s, {.points = points});
    dvec3 sum(0.0);
    for (const auto& light : s.oriented) sum += dvec3(light.intensity);
    return sum;
}

void expect_power(Scene& s, const dvec3& mean, const std::string& what) {
    const dvec3 exact = area * dvec3(s.materials[0].emission) * mean;
    for (const std::size_t points : {1u, 2u, 7u, 64u}) {
        const dvec3 power = power_of_lights(s, points);
        EXPECT_EQ(s.oriented.size(), points) << what;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(power[c], exact[c], 0.01 * exact[c]) << what << ", points " << points;
    }
}

TEST(EmissionMaps, FindSpotsDownToATexel) {
    std::uint64_t drawn = 0;
    for (const auto& [width, height] : {std::pair{64, 64}, {512, 128}, {1024, 1024}, {2048, 2048}, {2047, 3}}) {
        for (const int size : {1, 2, 3, 16}) {
            if (size > height) continue;
            for (const auto filter : {Texture::Filter::linear, Texture::Filter::nearest}) {
                Texture map = map_of(width, height, filter);
                const int x = static_cast<int>(draw(1, ++drawn) * width);
                const int y = static_cast<int>(draw(2, drawn) * height);
                add_spot(map, x, y, size, {5.0f, 1.0f, 0.5f});
                const dvec3 mean = mean_of(map);
                Scene s = panel(std::move(map));
                expect_power(s, mean,
                             std::to_string(width) + " x " + std::to_string(height) + ", a spot of " +
                                 std::to_string(size) + " at " + std::to_string(x) + ", " + std::to_string(y));
                for (const auto& light : s.oriented) {
                    const double u = static_cast<double>(light.position.x) / 2.0 * width;
                    const double off = std::abs(u - (x + 0.5 * size));
                    EXPECT_LE(std::min(off, width - off), 0.5 * size + 1.01) << "a light is not on the spot";
                }
            }
        }
    }
}

TEST(EmissionMaps, KeepTheirPowerUnderTransforms) {
    Texture map = map_of(512, 256);
    add_spot(map, 100, 31, 1, {1.0f, 0.0f, 0.0f});
    add_spot(map, 300, 200, 2, {0.0f, 3.0f, 0.0f});
    add_spot(map, 510, 254, 4, {0.0f, 0.0f, 2.0f});
    const dvec3 mean = mean_of(map);
    for (const auto wrap : {Texture::Wrap::repeat, Texture::Wrap::mirror}) {
        map.wrap_u = map.wrap_v = wrap;
        const float whole = wrap == Texture::Wrap::mirror ? 2.0f : 1.0f;
        for (const render::UvTransform& uv : {render::UvTransform{{0.3f, -7.77f}, {1, 0}, {0, 1}},
                                              {{0, 0}, {0, -3}, {2, 0}},
                                              {{5, 5}, {-1, 0}, {0, 4}},
                                              {{0.1f, 0.2f}, {1, 1}, {-1, 1}}}) {
            Scene s = panel(map, whole);
            s.materials[0].emission_texture.uv = uv;
            // Colors apart: each channel is that of its own spots.
            const dvec3 exact = area * dvec3(s.materials[0].emission) * mean;
            const dvec3 power = power_of_lights(s, 64);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(power[c], exact[c], 0.01 * exact[c]);
        }
    }
    map.wrap_u = map.wrap_v = Texture::Wrap::clamp;
    Scene s = panel(map);
    expect_power(s, mean, "clamped");
}

TEST(EmissionMaps, AreThoseOfWhatIsThere) {
    // A bright spot under a mask that hides half of it, and one that is half there: nearest, so that sums are exact.
    const auto nearest = Texture::Filter::nearest;
    for (const auto alpha : {Material::Alpha::mask, Material::Alpha::blend}) {
        for (const int size : {1024, 512, 64}) {
            Texture map = map_of(1024, 1024, nearest);
            add_spot(map, 336, 160, 32, {1000.0f, 2000.0f, 500.0f});
            add_spot(map, 801, 902, 2, {3.0f, 0.0f, 9.0f});
            Texture opacity = map_of(size, size, nearest);
            for (int y = 0; y < size; ++y) {
                for (int x = 0; x < size; ++x) {
                    texel(opacity, x, y).a = x * 1024 / size < 352 ? 0.25f : y * 1024 / size < 600 ? 0.125f : 0.75f;
                }
            }
            dvec3 sum(0.0);
            for (int y = 0; y < 1024; ++y) {
                for (int x = 0; x < 1024; ++x) {
                    const float a = texel(opacity, x * size / 1024, y * size / 1024).a;
                    const float share = alpha == Material::Alpha::blend ? a : a >= 0.2f ? 1.0f : 0.0f;
                    sum += dvec3(texel(map, x, y)) * static_cast<double>(share);
                }
            }
            Scene s = panel(map);
            s.textures.push_back(opacity);
            s.materials[0].alpha = alpha;
            s.materials[0].alpha_cutoff = 0.2f;
            s.materials[0].alpha_texture.texture = 1;
            expect_power(s, sum / (1024.0 * 1024.0), "covered by " + std::to_string(size));
            for (const auto& light : s.oriented) {
                const auto u = static_cast<double>(light.position.x) / 2.0;
                const auto v = static_cast<double>(light.position.z) / 1.5;
                EXPECT_GT(u, 0.32);
                EXPECT_GT(v, 0.15);
            }
        }
    }
}

TEST(EmissionMaps, ShareOutManySpotsWhereTheyAre) {
    // By a probe below, of every texel: a grid of spots, stars of random brightness, and a smooth glow with a sun in
    // it.
    const dvec3 probe(0.4, 0.0, 0.9);
    std::vector<Texture> maps;
    Texture grid = map_of(512, 512);
    for (int i = 0; i < 256; ++i) add_spot(grid, i % 16 * 32 + 5, i / 16 * 32 + 9, 3, {1.0f, 1.0f, 1.0f});
    maps.push_back(grid);
    Texture stars = map_of(1024, 1024);
    for (std::uint64_t i = 0; i < 2000; ++i) {
        add_spot(stars, static_cast<int>(1024 * draw(i, 3)), static_cast<int>(1024 * draw(i, 4)), 1,
                 glm::vec3(static_cast<float>(draw(i, 5))));
    }
    maps.push_back(stars);
    Texture glow = map_of(1024, 512);
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 1024; ++x) texel(glow, x, y) = glm::vec4(glm::vec3(1e-3f * static_cast<float>(x)), 1.0f);
    }
    add_spot(glow, 40, 500, 1, glm::vec3(2e5f));
    maps.push_back(glow);
    for (const Texture& map : maps) {
        dvec3 exact(0.0);
        for (int y = 0; y < map.height; ++y) {
            for (int x = 0; x < map.width; ++x) {
                const dvec3 at(2.0 * (x + 0.5) / map.width, 3.0, 1.5 * (y + 0.5) / map.height);
                const double d2 = glm::dot(at - probe, at - probe);
                Texture& t = const_cast<Texture&>(map);
                exact += dvec3(texel(t, x, y)) * (9.0 / (d2 * d2) * area / (1.0 * map.width * map.height));
            }
        }
        Scene s = panel(map);
        exact *= dvec3(s.materials[0].emission);
        power_of_lights(s, 64);
        dvec3 lit(0.0);
        for (const auto& light : s.oriented) {
            const dvec3 way = dvec3(light.position) - probe;
            const double d2 = glm::dot(way, way);
            lit += dvec3(light.intensity) * (way.y * way.y / (d2 * d2));
        }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(lit[c], exact[c], 0.01 * exact[c]) << map.width << " " << map.height;
    }
}

TEST(EmissionMaps, AreTheSameEachTime) {
    Texture map = map_of(256, 256);
    for (std::uint64_t i = 0; i < 300; ++i) {
        add_spot(map, static_cast<int>(256 * draw(i, 6)), static_cast<int>(256 * draw(i, 7)), 2, glm::vec3(1.0f));
    }
    Scene a = panel(map);
    Scene b = panel(map);
    power_of_lights(a, 64);
    power_of_lights(b, 64);
    ASSERT_EQ(a.oriented.size(), 64u);
    for (std::size_t i = 0; i < 64; ++i) {
        EXPECT_EQ(a.oriented[i].position, b.oriented[i].position);
        EXPECT_EQ(a.oriented[i].intensity, b.oriented[i].intensity);
    }
}

TEST(EmissionMaps, OfAMapOfOneColorAreThoseWithoutAMap) {
    Texture map = map_of(32, 16);
    for (glm::vec4& t : map.texels) t = glm::vec4(0.5f, 0.25f, 1.0f, 1.0f);
    Scene s = panel(map);
    power_of_lights(s, 16);
    Scene plain = panel(map);
    plain.materials[0].emission_texture.texture = render::no_texture;
    plain.materials[0].emission *= glm::vec3(0.5f, 0.25f, 1.0f);
    power_of_lights(plain, 16);
    ASSERT_EQ(s.oriented.size(), 16u);
    for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_EQ(s.oriented[i].position, plain.oriented[i].position);
        for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(s.oriented[i].intensity[c], plain.oriented[i].intensity[c]);
    }
}

TEST(EmissionMaps, NameAMapThatLightsNothing) {
    Texture map = map_of(64, 64);
    add_spot(map, 40, 40, 4, glm::vec3(1.0f));
    Scene s = panel(map, 0.25f);  // which shows a quarter of the map that is black
    power_of_lights(s, 64);
    EXPECT_TRUE(s.oriented.empty());
    ASSERT_EQ(s.left_out.size(), 1u);
    EXPECT_NE(s.left_out[0].what.find("'lamp'"), std::string::npos);
    // One that is black everywhere says what it means.
    s = panel(map_of(64, 64));
    power_of_lights(s, 64);
    EXPECT_TRUE(s.oriented.empty());
    EXPECT_TRUE(s.left_out.empty());
}

TEST(EmissionRange, BoundsWhatIsEmitted) {
    std::uint64_t k = 0;
    const auto random = [&] { return static_cast<float>(draw(11, ++k)); };
    for (int round = 0; round < 300; ++round) {
        Texture map = map_of(1 + static_cast<int>(40 * random()), 1 + static_cast<int>(40 * random()));
        for (glm::vec4& t : map.texels) t = {random(), random(), random(), random()};
        Texture opacity = map;
        std::reverse(opacity.texels.begin(), opacity.texels.end());
        for (Texture* t : {&map, &opacity}) {
            t->wrap_u = static_cast<Texture::Wrap>(static_cast<int>(3 * random()));
            t->wrap_v = static_cast<Texture::Wrap>(static_cast<int>(3 * random()));
            t->filter = random() < 0.5f ? Texture::Filter::linear : Texture::Filter::nearest;
        }
        Scene s = panel(map, 1.0f + 3.0f * random());
        s.textures.push_back(opacity);
        Material& m = s.materials[0];
        m.alpha = static_cast<Material::Alpha>(static_cast<int>(3 * random()));
        m.base_color_texture.texture = 1;
        m.base_color_texture.uv.offset = {10.0f * random() - 5.0f, random()};
        m.emission_texture.uv.u_axis = {random() - 0.5f, random()};
        if (random() < 0.5f) s.colors = {{1, 1, 1, 1}, {0.5f, 1, 1, 0.5f}, {1, 0, 1, 0.9f}, {1, 1, 0.2f, 0.1f}};
        if (random() < 0.5f) m.model = Material::Model::unlit;
        const std::vector<std::uint32_t> materials{0};
        const render::EmissionRange range(s, materials);
        const std::uint32_t triangle = round % 2 == 0 ? 0 : 1;
        lightcuts::PieceCorners corners{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)};
        for (int cut = 0; cut < 24; ++cut) {
            const auto bounds = range.over(triangle, corners);
            for (int i = 0; i < 8; ++i) {
                const float along = std::sqrt(random());
                const glm::vec2 at = glm::mix(corners[0], glm::mix(corners[1], corners[2], random()), along);
                const dvec3 seen(render::emitted_radiance(s, triangle, at.x, at.y, true));
                for (int c = 0; c < 3; ++c) {
                    ASSERT_GE(seen[c], static_cast<double>(bounds.low[c]) - 1e-5) << round << " " << cut;
                    ASSERT_LE(seen[c], static_cast<double>(bounds.high[c]) + 1e-5) << round << " " << cut;
                }
            }
            const std::size_t edge = range.longest_edge(triangle, corners).value_or(0);
            const glm::vec2 halfway = 0.5f * (corners[edge] + corners[(edge + 1) % 3]);
            corners[random() < 0.5f ? edge : (edge + 1) % 3] = halfway;
        }
    }
}

}  // namespace
