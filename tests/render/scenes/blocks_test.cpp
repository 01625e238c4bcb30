#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <lightcuts/core/random.hpp>
#include <render/scenes/shapes.hpp>

namespace {

/// Random solid cells: every third one.
bool is_solid(const glm::ivec3& cell) {
    return lightcuts::hash_keys(5, static_cast<std::uint64_t>(cell.x + 10 * cell.y + 100 * cell.z)) % 3 == 0;
}

render::BlockGrid uneven_grid() {
    return {{{{-1.0f, 0.0f, 0.25f, 2.0f, 3.0f}, {0.0f, 1.0f, 1.5f, 4.0f}, {2.0f, 2.1f, 5.0f, 6.0f, 7.5f}}}};
}

TEST(Blocks, AreClosedSurfacesThatShareCorners) {
    render::Scene scene;
    render::Modeller(scene).blocks(uneven_grid(), is_solid, [](const glm::ivec3&, int, int) { return 0u; });
    // Each edge is passed as often in one direction as in the other, by the same two vertices.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const glm::uvec3& t : scene.triangles) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            ++balance[{a, b}];
            --balance[{b, a}];
        }
    }
    EXPECT_FALSE(balance.empty());
    for (const auto& [edge, count] : balance) EXPECT_EQ(count, 0) << edge.first << " " << edge.second;
}

// By the divergence theorem: faces look outwards, and none is missing.
TEST(Blocks, EncloseTheVolumeOfTheirCells) {
    render::Scene scene;
    const render::BlockGrid grid = uneven_grid();
    render::Modeller(scene).blocks(grid, is_solid, [](const glm::ivec3&, int, int) { return 0u; });
    double enclosed = 0.0;
    for (const glm::uvec3& t : scene.triangles) {
        const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
        enclosed += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    double expected = 0.0;
    for (int x = 0; x < grid.cells(0); ++x) {
        for (int y = 0; y < grid.cells(1); ++y) {
            for (int z = 0; z < grid.cells(2); ++z) {
                if (!is_solid({x, y, z})) continue;
                double volume = 1.0;
                for (int k = 0; k < 3; ++k) {
                    const auto& planes = grid.planes[static_cast<std::size_t>(k)];
                    const auto at = static_cast<std::size_t>(glm::ivec3(x, y, z)[k]);
                    volume *= static_cast<double>(planes[at + 1]) - static_cast<double>(planes[at]);
                }
                expected += volume;
            }
        }
    }
    EXPECT_GT(expected, 0.0);
    EXPECT_NEAR(enclosed, expected, 1e-5 * expected);
}

TEST(Blocks, ArePaintedByCellAndSide) {
    render::Scene scene;
    const render::BlockGrid one{{{{0.0f, 1.0f}, {0.0f, 1.0f}, {0.0f, 1.0f}}}};
    render::Modeller(scene).blocks(
        one, [](const glm::ivec3&) { return true; },
        [](const glm::ivec3&, int axis, int side) {
            return static_cast<std::uint32_t>(2 * axis + (side > 0 ? 1 : 0));
        });
    ASSERT_EQ(scene.triangles.size(), 12u);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const glm::uvec3 t = scene.triangles[i];
        const glm::vec3 normal = glm::normalize(
            glm::cross(scene.positions[t.y] - scene.positions[t.x], scene.positions[t.z] - scene.positions[t.x]));
        const std::uint32_t paint = scene.triangle_material[i];
        EXPECT_EQ(normal[static_cast<int>(paint / 2)], paint % 2 == 1 ? 1.0f : -1.0f);
    }
}

}  // namespace
