#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <lightcuts/adapt/embree.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/surfaces/surface_geometry.hpp>
#include <render/view.hpp>

namespace {

using render::RayScene;
using render::Scene;

using Random = std::mt19937;

float uniform(Random& random, float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
}

glm::vec3 unit_vector(Random& random) {
    const float z = uniform(random, -1.0f, 1.0f), turn = uniform(random, 0.0f, 2.0f * std::numbers::pi_v<float>);
    const float out = std::sqrt(1.0f - z * z);
    return {out * std::cos(turn), out * std::sin(turn), z};
}

/// Two triangles that share the edge ac, and nothing else in the order of their corners: the way of writing a quad that
/// leaks first.
void add_quad(Scene& scene, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    scene.triangles.push_back({a, b, c});
    scene.triangles.push_back({c, d, a});
}

void finish(Scene& scene) {
    scene.triangle_material.assign(scene.triangles.size(), 0);
    scene.materials.resize(1);
}

Scene box() {
    Scene scene;
    for (unsigned i = 0; i < 8; ++i) {
        scene.positions.push_back({(i & 1) != 0 ? 1.7f : -1.3f, (i & 2) != 0 ? 2.1f : -0.6f, (i & 4) != 0 ? 3.1f : -1});
    }
    for (const glm::uvec4 q :
         {glm::uvec4(0, 1, 3, 2), {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}) {
        add_quad(scene, q.x, q.y, q.z, q.w);
    }
    finish(scene);
    return scene;
}

/// Rings of `around` corners, joined to their neighbors: the last ring to the first if `closed`, and else both to a
/// pole.
Scene rings(std::vector<glm::vec3> positions, std::uint32_t around, bool closed) {
    Scene scene;
    scene.positions = std::move(positions);
    const auto count = static_cast<std::uint32_t>(scene.positions.size()) / around;
    for (std::uint32_t r = 0; r < (closed ? count : count - 1); ++r) {
        const std::uint32_t low = r * around, high = (r + 1) % count * around;
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t next = (i + 1) % around;
            add_quad(scene, low + i, low + next, high + next, high + i);
        }
    }
    finish(scene);
    return scene;
}

Scene sphere(std::uint32_t around, const glm::vec3& radius, const glm::vec3& at) {
    std::vector<glm::vec3> positions;
    const std::uint32_t levels = around / 2;
    for (std::uint32_t r = 1; r < levels; ++r) {
        const float up = std::numbers::pi_v<float> * static_cast<float>(r) / static_cast<float>(levels);
        for (std::uint32_t i = 0; i < around; ++i) {
            const float turn = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(around);
            positions.push_back(
                at + radius * glm::vec3(std::sin(up) * std::cos(turn), std::cos(up), std::sin(up) * std::sin(turn)));
        }
    }
    Scene scene = rings(positions, around, false);
    const auto top = static_cast<std::uint32_t>(scene.positions.size()), bottom = top + 1;
    scene.positions.push_back(at + radius * glm::vec3(0, 1, 0));
    scene.positions.push_back(at - radius * glm::vec3(0, 1, 0));
    for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t next = (i + 1) % around;
        scene.triangles.push_back({i, top, next});
        scene.triangles.push_back({bottom, top - around + i, top - around + next});
    }
    finish(scene);
    return scene;
}

constexpr float ring_radius = 3.0f;
constexpr float tube_radius = 0.5f;

Scene torus() {
    constexpr std::uint32_t along = 96, around = 24;
    std::vector<glm::vec3> positions;
    for (std::uint32_t r = 0; r < along; ++r) {
        const float a = 2.0f * std::numbers::pi_v<float> * static_cast<float>(r) / along;
        for (std::uint32_t i = 0; i < around; ++i) {
            const float b = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / around;
            const float out = ring_radius + tube_radius * std::cos(b);
            positions.push_back({out * std::cos(a), tube_radius * std::sin(b), out * std::sin(a)});
        }
    }
    return rings(std::move(positions), around, true);
}

/// A mesh without holes, and points within.
struct ClosedMesh {
    std::string name;
    Scene scene;
    glm::vec3 (*inside)(Random&);
};

std::vector<ClosedMesh> closed_meshes() {
    std::vector<ClosedMesh> meshes;
    meshes.push_back({"box", box(), [](Random& random) {
                          return glm::vec3(uniform(random, -1.2f, 1.6f), uniform(random, -0.5f, 2.0f),
                                           uniform(random, -0.9f, 3.0f));
                      }});
    meshes.push_back({"sphere", sphere(64, glm::vec3(2.0f), glm::vec3(0.0f)),
                      [](Random& random) { return uniform(random, 0.0f, 1.9f) * unit_vector(random); }});
    meshes.push_back({"torus, from within the tube", torus(), [](Random& random) {
                          const float turn = uniform(random, 0.0f, 2.0f * std::numbers::pi_v<float>);
                          return ring_radius * glm::vec3(std::cos(turn), 0.0f, std::sin(turn)) +
                                 uniform(random, 0.0f, 0.9f * tube_radius) * unit_vector(random);
                      }});
    meshes.push_back({"needle", sphere(32, {0.01f, 100.0f, 0.02f}, glm::vec3(0.0f)), [](Random& random) {
                          return uniform(random, 0.0f, 0.9f) * glm::vec3(0.01f, 100.0f, 0.02f) * unit_vector(random);
                      }});
    // Coordinates step by 1/256 there.
    meshes.push_back({"sphere far from the origin", sphere(48, glm::vec3(2.0f), {40000.0f, -33000.0f, 50000.0f}),
                      [](Random& random) {
                          return glm::vec3(40000.0f, -33000.0f, 50000.0f) +
                                 uniform(random, 0.0f, 1.8f) * unit_vector(random);
                      }});
    return meshes;
}

/// A point on an edge of `scene`, not quite at its ends: rays towards it have to hit either of its triangles. A ray
/// aimed at the very corner may pass between all of its triangles, as each edge is judged by itself.
glm::dvec3 point_on_an_edge(const Scene& scene, Random& random) {
    const std::size_t t = std::uniform_int_distribution<std::size_t>(0, scene.triangles.size() - 1)(random);
    const int corner = std::uniform_int_distribution<int>(0, 2)(random);
    const glm::dvec3 a(scene.positions[scene.triangles[t][corner]]);
    const glm::dvec3 b(scene.positions[scene.triangles[t][(corner + 1) % 3]]);
    return a + static_cast<double>(uniform(random, 0.001f, 0.999f)) * (b - a);
}

/// Rays to trace in each mesh, unless the environment says otherwise.
std::size_t rays_to_trace() {
    const char* wanted = std::getenv("LIGHTCUTS_TEST_RAYS");
    return wanted ? std::strtoull(wanted, nullptr, 10) : 1'000'000;
}

TEST(RayScene, LetsNoRayOutOfAClosedMesh) {
    const std::size_t count = rays_to_trace();
    for (const ClosedMesh& mesh : closed_meshes()) {
        const RayScene rays(mesh.scene);
        const lightcuts::EmbreeOracle oracle(rays.embree_scene());
        Random random(7);
        std::vector<lightcuts::VisibilityQuery> queries(256);
        std::vector<float> visible(queries.size());
        std::size_t missed = 0, seen_through = 0, light_through = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 from = mesh.inside(random);
            // Every other ray goes to an edge, where leaks are.
            const glm::vec3 direction = i % 2 == 0 ? unit_vector(random)
                                                   : glm::vec3(glm::normalize(point_on_an_edge(mesh.scene, random) -
                                                                              glm::dvec3(from)));
            missed += rays.nearest(from, direction) ? 0 : 1;
            light_through += rays.to_infinity(from, direction) == glm::vec3(0.0f) ? 0 : 1;
            queries[i % queries.size()] = {from, 0, direction, 0, 0, true};
            if (i % queries.size() + 1 < queries.size()) continue;
            oracle.many(queries, visible);
            seen_through += static_cast<std::size_t>(
                std::count_if(visible.begin(), visible.end(), [](float v) { return v > 0.0f; }));
        }
        EXPECT_EQ(missed, 0u) << mesh.name << ": eye rays of " << count;
        EXPECT_EQ(light_through, 0u) << mesh.name << ": shadow rays of " << count;
        EXPECT_EQ(seen_through, 0u) << mesh.name << ": shadow rays in streams of " << count;
    }
}

TEST(RayScene, ShowsAFloorWithoutHoles) {
    constexpr int size = 65;
    for (const float half : {4.0f, 7.30352f, 17.8025f, 19.9451f}) {
        Scene floor;
        floor.positions = {{-half, 0, -half}, {half, 0, -half}, {half, 0, half}, {-half, 0, half}};
        add_quad(floor, 3, 2, 1, 0);
        finish(floor);
        const RayScene rays(floor);
        const glm::dvec3 eye(0.0, static_cast<double>(0.7f * half), 0.0), target(0.0);
        render::Camera camera;
        camera.eye = eye;
        camera.target = target;
        camera.up = render::default_up(eye, target);
        const render::View view(camera, glm::dvec3(0.0), size, size);
        int holes = 0;
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const render::EyeRay ray = view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
                holes += rays.nearest(ray.origin, ray.direction) ? 0 : 1;
            }
        }
        EXPECT_EQ(holes, 0) << half;
    }
}

TEST(RayScene, TintsAShadowRayOncePerPane) {
    Random random(3);
    for (const bool welded : {true, false}) {
        Scene panes;
        for (const float y : {0.0f, 1.0f}) {
            const auto first = static_cast<std::uint32_t>(panes.positions.size());
            const float half = 10.0f;
            for (const glm::vec3 p :
                 {glm::vec3(-half, y, -half), {half, y, -half}, {half, y, half}, {-half, y, half}}) {
                panes.positions.push_back(p);
            }
            add_quad(panes, first + 3, first + 2, first + 1, first);
            if (welded) continue;
            // The second triangle has corners of its own, as flat faces do in many files.
            glm::uvec3& second = panes.triangles.back();
            for (int i = 0; i < 3; ++i) {
                panes.positions.push_back(panes.positions[second[i]]);
                second[i] = static_cast<std::uint32_t>(panes.positions.size() - 1);
            }
        }
        finish(panes);
        panes.materials[0].transmission = 1.0f;
        panes.materials[0].base_color = glm::vec3(0.5f);
        const RayScene rays(panes);
        for (int i = 0; i < 20'000; ++i) {
            const glm::vec3 from(uniform(random, -3.0f, 3.0f), -1.0f, uniform(random, -3.0f, 3.0f));
            glm::dvec3 at(static_cast<double>(uniform(random, -3.0f, 3.0f)), i % 2,
                          static_cast<double>(uniform(random, -3.0f, 3.0f)));
            if (i % 4 < 2) at.z = -at.x;  // on the edge that the triangles of a pane share
            const glm::vec3 direction(glm::normalize(at - glm::dvec3(from)));
            ASSERT_EQ(rays.to_infinity(from, direction), glm::vec3(0.25f)) << (welded ? "welded, ray " : "ray ") << i;
        }
    }
}

/// Half-transparent sheets z = 0, each a square of two triangles: cut along either diagonal, facing either way, their
/// corners shared or not.
Scene sheets(std::size_t count, unsigned kinds) {
    Scene s;
    const std::vector<glm::vec3> square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    for (std::size_t i = 0; i < count; ++i) {
        const unsigned kind = kinds >> (3 * i) & 7u;
        std::array<std::uint32_t, 4> q{0, 1, 2, 3};
        if ((kind & 1u) != 0) q = {1, 2, 3, 0};
        if ((kind & 2u) != 0) std::reverse(q.begin(), q.end());
        const bool is_first = s.positions.empty();
        const auto base = (kind & 4u) != 0 || is_first ? static_cast<std::uint32_t>(s.positions.size()) : 0u;
        if (base > 0 || is_first) s.positions.insert(s.positions.end(), square.begin(), square.end());
        s.triangles.push_back({base + q[0], base + q[1], base + q[2]});
        s.triangles.push_back({base + q[0], base + q[2], base + q[3]});
    }
    finish(s);
    s.materials[0].alpha = render::Material::Alpha::blend;
    s.materials[0].base_alpha = 0.5f;
    return s;
}

TEST(RayScene, TakesCoincidentSheetsAsOneLayer) {
    Random random(8);
    for (std::size_t count = 1; count <= 3; ++count) {
        for (unsigned kinds = 0; kinds < 1u << (3 * count); ++kinds) {
            const Scene s = sheets(count, kinds);
            const RayScene rays(s);
            for (int i = 0; i < 20; ++i) {
                glm::vec3 at(uniform(random, -0.99f, 0.99f), uniform(random, -0.99f, 0.99f), 0.0f);
                if (i % 4 == 0) at.y = at.x;  // on the diagonals
                if (i % 4 == 1) at.y = -at.x;
                const glm::vec3 way(uniform(random, -1.0f, 1.0f), uniform(random, -1.0f, 1.0f), i % 2 == 0 ? 1 : -1);
                ASSERT_EQ(rays.to_point(at - way, at + way), glm::vec3(0.5f)) << count << " sheets, " << kinds;
            }
        }
    }
}

TEST(RayScene, SeesAsManyLayersAsItLights) {
    // Sheets at distances about that at which rays leave a surface: as many darken the light as an eye ray meets.
    Random random(9);
    for (const float gap : {0.0f, 1e-7f, 1e-6f, 3e-6f, 5e-6f, 1e-5f, 1e-3f}) {
        Scene s = sheets(3, 0111);
        s.positions.clear();
        s.triangles.clear();
        for (const float z : {0.0f, gap, 2.0f * gap}) {
            const auto base = static_cast<std::uint32_t>(s.positions.size());
            for (const glm::vec2 p : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) s.positions.emplace_back(p, z);
            add_quad(s, base, base + 1, base + 2, base + 3);
        }
        const RayScene rays(s);
        for (int i = 0; i < 50; ++i) {
            const glm::vec3 from(uniform(random, -0.5f, 0.5f), uniform(random, -0.5f, 0.5f), i % 2 == 0 ? 1.0f : -1.0f);
            const glm::vec3 way = glm::normalize(
                glm::vec3(uniform(random, -0.4f, 0.4f), uniform(random, -0.4f, 0.4f), -from.z));
            float seen = 1.0f;
            glm::vec3 at = from;
            while (const auto hit = rays.nearest(at, way)) {
                at = render::surface_at(s, *hit, way).leave(way);
                seen *= 0.5f;
            }
            EXPECT_EQ(rays.to_infinity(from, way), glm::vec3(seen)) << gap;
        }
    }
}

TEST(RayScene, CountsBothSidesOfAWedgeNearItsRidge) {
    // A ray that crosses a sharp wedge a little below its ridge meets two sheets, one at its very ridge at most that.
    Scene s;
    s.positions = {{-10, 0, 0}, {10, 0, 0}, {10, -10, 1}, {-10, -10, 1}, {10, -10, -1}, {-10, -10, -1}};
    add_quad(s, 3, 2, 1, 0);
    add_quad(s, 0, 1, 4, 5);
    finish(s);
    s.materials[0].alpha = render::Material::Alpha::blend;
    s.materials[0].base_alpha = 0.5f;
    const RayScene rays(s);
    for (const float below : {0.003f, 0.01f, 0.1f, 1.0f}) {
        EXPECT_EQ(rays.to_infinity({0.3f, -below, 100.0f}, {0, 0, -1}), glm::vec3(0.25f)) << below;
    }
    EXPECT_EQ(rays.to_infinity({0.3f, 1e-3f, 100.0f}, {0, 0, -1}), glm::vec3(1.0f));
    // From above, along the ridge itself, it enters by one side.
    EXPECT_EQ(rays.to_point({0.3f, 1.0f, 0.0f}, {0.3f, -5.0f, 0.0f}), glm::vec3(0.5f));
}

}  // namespace
