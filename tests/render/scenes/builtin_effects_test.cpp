#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <lightcuts/source/sun_sky.hpp>
#include <render/io/load_scene.hpp>
#include <render/motion.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/scenes/temple.hpp>

namespace {

using render::load_scene;
using render::Material;
using render::Scene;
using render::Shutter;
using render::Temple;

/// Where a sphere is at each instant, sphere by sphere.
std::vector<std::vector<glm::vec3>> paths_of(const Scene& s) {
    std::vector<std::vector<glm::vec3>> paths;
    for (const auto& sphere : s.at_instants.spheres) {
        if (sphere.instant == 0) paths.emplace_back();
        paths.back().push_back(sphere.center);
    }
    return paths;
}

/// How far `p` is from the nearest column's axis, on the level.
float distance_from_columns(const glm::vec3& p) {
    float least = 1e9f;
    for (int i = 0; i < Temple::columns_across; ++i) {
        for (int j = 0; j < Temple::columns_along; ++j) {
            const bool is_outer = i == 0 || j == 0 || i + 1 == Temple::columns_across || j + 1 == Temple::columns_along;
            if (!is_outer) continue;
            const auto place = [](int k, int count, float half) {
                return half * (2.0f * static_cast<float>(k) / static_cast<float>(count - 1) - 1.0f);
            };
            least = std::min(least, std::hypot(p.x - place(i, Temple::columns_across, Temple::half_width),
                                               p.z - place(j, Temple::columns_along, Temple::half_length)));
        }
    }
    return least;
}

TEST(Night, LampsFlyAroundAboveTheGroundAndPastTheColumns) {
    for (const double opens : {0.0, 3.7, 1e4}) {
        const Scene s = load_scene("builtin:night", Shutter{opens, 0.5, 32});
        EXPECT_TRUE(s.spheres.empty()) << "all of them move";
        EXPECT_EQ(s.moving.size(), 150u);
        EXPECT_EQ(s.instants.size(), 32u);
        const auto paths = paths_of(s);
        ASSERT_EQ(paths.size(), 150u);
        const float radius = s.at_instants.spheres.front().radius;
        for (const auto& path : paths) {
            ASSERT_EQ(path.size(), 32u);
            EXPECT_GT(glm::distance(path.front(), path.back()), 0.05f);
            for (const glm::vec3& p : path) {
                EXPECT_GT(p.y, Temple::ground + 2.0f * radius);
                EXPECT_LT(p.y, Temple::ceiling - radius);
                EXPECT_GT(distance_from_columns(p), Temple::column_radius + radius);
                EXPECT_FALSE(std::abs(p.x) < Temple::cella_x + radius && std::abs(p.z) < Temple::cella_z + radius);
            }
        }
    }
}

TEST(Night, LampsAreSeenWhereTheyLight) {
    const Scene s = load_scene("builtin:night?lights=9", Shutter{1.5, 0.4, 8});
    ASSERT_EQ(s.moving.size(), 9u);
    const auto paths = paths_of(s);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const std::uint32_t first = s.moving[i].first;
        const auto triangle = static_cast<std::uint32_t>(
            std::find_if(s.triangles.begin(), s.triangles.end(),
                         [&](const glm::uvec3& t) { return s.moving[i].contains(t.x); }) -
            s.triangles.begin());
        ASSERT_LT(triangle, s.triangles.size()) << first;
        const Material& material = s.materials[s.triangle_material[triangle]];
        EXPECT_TRUE(material.only_seen);
        for (std::size_t t = 0; t < paths[i].size(); ++t) {
            const auto& light = s.at_instants.spheres[i * paths[i].size() + t];
            const glm::dvec3 corner = render::triangle_at(s, triangle, s.instants[t]).a;
            // Straight steps between the frames of a circle are a little inside of it.
            EXPECT_NEAR(glm::distance(corner, glm::dvec3(light.center)), static_cast<double>(light.radius), 1e-3);
            const glm::vec3 seen = material.emission * (3.14159265f * light.radius * light.radius);
            EXPECT_NEAR(glm::distance(seen, light.intensity), 0.0f, 1e-4f * glm::length(seen));
        }
    }
}

TEST(Night, StandsStillWithoutAShutter) {
    const Scene s = load_scene("builtin:night");
    EXPECT_TRUE(s.is_still());
    EXPECT_EQ(s.spheres.size(), 150u);
    EXPECT_TRUE(s.at_instants.spheres.empty());
    EXPECT_EQ(load_scene("builtin:night?lights=7").spheres.size(), 7u);
}

TEST(Foliage, HasManyMaterialsThatLetLightThrough) {
    const Scene s = load_scene("builtin:foliage");
    std::set<std::uint32_t> used(s.triangle_material.begin(), s.triangle_material.end());
    EXPECT_EQ(used.size(), s.materials.size());
    const auto lets_through = [&](std::uint32_t m) { return s.materials[m].diffuse_transmission > 0.0f; };
    EXPECT_GE(std::count_if(used.begin(), used.end(), lets_through), 10);
    const auto leaves = std::count_if(s.triangle_material.begin(), s.triangle_material.end(), lets_through);
    EXPECT_GT(leaves, 300'000);
    for (const glm::vec3& p : s.positions) EXPECT_GT(p.y, -16.0f) << "only hills reach below the ground";
}

TEST(Haze, SunStandsInShafts) {
    const Scene s = load_scene("builtin:haze");
    const render::RayScene rays(s);
    ASSERT_TRUE(s.lighting.sun.has_value());
    const lightcuts::SunSky daylight(*s.lighting.sun);
    const glm::vec3 towards_sun(daylight.towards_sun());
    std::size_t lit = 0;
    std::size_t all = 0;
    std::size_t edges = 0;
    for (int i = 0; i < 12; ++i) {
        for (int j = 0; j < 20; ++j) {
            bool before = false;
            for (int k = 0; k < 88; ++k) {
                const glm::vec3 p = glm::vec3(-4.75f, 0.25f, -11.0f) + glm::vec3(0.5f * static_cast<float>(j),
                                                                                 0.5f * static_cast<float>(i),
                                                                                 0.25f * static_cast<float>(k));
                const bool is_lit = !rays.nearest(p, towards_sun);
                lit += is_lit ? 1 : 0;
                edges += is_lit != before ? 1 : 0;
                before = is_lit;
                ++all;
            }
        }
    }
    const double share = static_cast<double>(lit) / static_cast<double>(all);
    EXPECT_GT(share, 0.05);
    EXPECT_LT(share, 0.4);
    EXPECT_GT(edges, 1000u) << "of shafts";
}

TEST(Focus, GlossyThingsStandNearAndFar) {
    const Scene s = load_scene("builtin:focus");
    EXPECT_EQ(s.spheres.size(), 156u);
    const render::Camera& camera = s.cameras.front();
    const double focus = glm::distance(camera.eye, camera.target);
    std::set<std::uint32_t> near, sharp, far;
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
        const std::uint32_t m = s.triangle_material[t];
        const Material& material = s.materials[m];
        if (material.model != Material::Model::microfacet || material.emission != glm::vec3(0.0f)) continue;
        const double distance = glm::distance(camera.eye, glm::dvec3(s.positions[s.triangles[t].x]));
        (distance < 0.75 * focus ? near : distance < 1.2 * focus ? sharp : far).insert(m);
    }
    EXPECT_GE(near.size(), 3u);
    EXPECT_GE(sharp.size(), 4u);
    EXPECT_GE(far.size(), 5u);
}

}  // namespace
