#include <map>
#include <set>

#include <gtest/gtest.h>
#include <relight/fine_mesh.hpp>
#include <render/triangle.hpp>

#include "render/refusal.hpp"
#include "small_world.hpp"

namespace {

render::Scene load(const TemporaryFolder& folder, const std::string& obj) {
    folder.write("m.mtl", two_materials);
    return relight::load_still_scene(folder.write("scene.obj", obj));
}

double area_of(const render::Scene& scene) {
    double sum = 0.0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) sum += render::Triangle(scene, t).area();
    return sum;
}

using Place = std::array<float, 3>;
Place place(const glm::vec3& p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }

TEST(FineMesh, EdgesAreShortAndTheSurfaceStaysClosed) {
    const TemporaryFolder folder;
    render::Scene scene = load(folder, box_alone);
    const double area = area_of(scene);
    relight::refine_mesh(scene, 0.37);
    EXPECT_NEAR(area_of(scene), area, 1e-4);
    std::map<std::pair<Place, Place>, int> directed;
    for (const glm::uvec3& t : scene.triangles) {
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 a = scene.positions[t[k]], b = scene.positions[t[(k + 1) % 3]];
            EXPECT_LE(glm::length(a - b), 0.37f);
            ++directed[{place(a), place(b)}];
        }
    }
    for (const auto& [edge, count] : directed) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(directed.count({edge.second, edge.first}), 1u);
    }
    EXPECT_EQ(scene.triangles.size(), scene.triangle_material.size());
}

TEST(FineMesh, ShortEdgesChangeNothing) {
    const TemporaryFolder folder;
    render::Scene scene = load(folder, box_alone);
    const auto triangles = scene.triangles;
    relight::refine_mesh(scene, 100.0);
    EXPECT_EQ(scene.triangles, triangles);
}

TEST(FineMesh, TooManyTrianglesAreRefused) {
    const TemporaryFolder folder;
    render::Scene scene = load(folder, box_alone);
    EXPECT_NE(refusal([&] { relight::refine_mesh(scene, 1e-3, 10000); }).find("longer ones"), std::string::npos);
}

TEST(Sites, EdgesOfABoxHaveOneForEachSide) {
    const TemporaryFolder folder;
    const render::Scene scene = load(folder, box_alone);
    const relight::Sites sites = relight::sites_of(scene);
    EXPECT_EQ(sites.sites.size(), 24u);
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const render::Triangle triangle(scene, t);
        const glm::dvec3 normal = glm::normalize(triangle.cross());
        for (int k = 0; k < 3; ++k) {
            const relight::Site& site = sites.sites[sites.of_triangle[t][k]];
            EXPECT_GT(glm::dot(normal, glm::dvec3(site.front) - triangle.a), 0.0);
            EXPECT_LT(glm::dot(normal, glm::dvec3(site.back) - triangle.a), 0.0);
            EXPECT_LT(glm::length(site.front - scene.positions[scene.triangles[t][k]]), 0.05f);
        }
    }
}

TEST(Sites, FootOfAWallLooksFromTheWall) {
    // A wall of two sides that stands on a floor, exactly: from the corners of the wall the sky is seen.
    const TemporaryFolder folder;
    const render::Scene scene = load(folder,
                                     "mtllib m.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\n"
                                     "v -1 0 0\nv 1 0 0\nv 1 1 0\nv -1 1 0\n"
                                     "usemtl gray\nf 4 3 2 1\nf 5 6 7 8\n");
    const relight::Sites sites = relight::sites_of(scene);
    const render::RayScene rays(scene);
    render::SkyRays sky;
    const std::vector<glm::vec3> up{glm::normalize(glm::vec3(0.1f, 1.0f, 0.5f))};
    std::vector<float> visible(1);
    for (int k = 0; k < 3; ++k) {
        const relight::Site& site = sites.sites[sites.of_triangle.back()[k]];
        sky.look(rays, site.normal.z > 0.0f ? site.front : site.back, up, visible);
        EXPECT_EQ(visible[0], 1.0f);
    }
}

}  // namespace
