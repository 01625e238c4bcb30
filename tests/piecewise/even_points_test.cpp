#include <lightcuts/piecewise/even_points.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <lightcuts/core/random.hpp>

namespace lightcuts::test {
namespace {

/// The least that corners may be made of.
struct Place {
    float x, y, z;
};
using Mesh = std::vector<std::array<Place, 3>>;

EvenPoints points_on(const Mesh& mesh, std::size_t count, std::uint64_t seed = 0, int steps = 20) {
    return even_points(
        mesh.size(), [&](std::size_t i) -> const std::array<Place, 3>& { return mesh[i]; }, count, seed, steps);
}

glm::vec3 at(const Place& p) { return {p.x, p.y, p.z}; }

double area_of(const Mesh& mesh) {
    double sum = 0.0;
    for (const auto& t : mesh) {
        sum += 0.5 * static_cast<double>(glm::length(glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]))));
    }
    return sum;
}

void add_quad(Mesh& mesh, Place a, Place b, Place c, Place d) {
    mesh.push_back({a, b, c});
    mesh.push_back({a, c, d});
}

/// The square (0, 1) x (0, 1) at height z, of side x side x 2 triangles.
Mesh square(int side, float z = 0.0f) {
    Mesh mesh;
    const auto c = [side](int i) { return static_cast<float>(i) / static_cast<float>(side); };
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            add_quad(mesh, {c(x), c(y), z}, {c(x + 1), c(y), z}, {c(x + 1), c(y + 1), z}, {c(x), c(y + 1), z});
        }
    }
    return mesh;
}

/// The unit sphere by longitude and latitude; triangles at the poles are slivers without an area.
Mesh sphere(int rows) {
    const auto on = [rows](int x, int y) -> Place {
        const double phi = std::numbers::pi * (x % (2 * rows)) / rows, theta = std::numbers::pi * y / rows;
        const double r = y == 0 || y == rows ? 0.0 : std::sin(theta);
        return {static_cast<float>(r * std::cos(phi)), static_cast<float>(std::cos(theta)),
                static_cast<float>(r * std::sin(phi))};
    };
    Mesh mesh;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < 2 * rows; ++x) add_quad(mesh, on(x, y), on(x + 1, y), on(x + 1, y + 1), on(x, y + 1));
    }
    return mesh;
}

/// The box (0, 1) x (0, height) x (0, 1), outwards.
Mesh box(float height) {
    const auto c = [height](int i) -> Place {
        return {static_cast<float>(i & 1), (i & 2) != 0 ? height : 0.0f, static_cast<float>(i >> 2)};
    };
    Mesh mesh;
    add_quad(mesh, c(0), c(1), c(5), c(4));
    add_quad(mesh, c(2), c(6), c(7), c(3));
    add_quad(mesh, c(0), c(2), c(3), c(1));
    add_quad(mesh, c(4), c(5), c(7), c(6));
    add_quad(mesh, c(0), c(4), c(6), c(2));
    add_quad(mesh, c(1), c(3), c(7), c(5));
    return mesh;
}

/// The distance of each point to the nearest that faces alike, in units of a hexagonal lattice's, ascending.
std::vector<double> spacings(const EvenPoints& even) {
    const double unit = std::sqrt(even.area * 2.0 / std::sqrt(3.0));
    std::vector<double> result;
    for (const SurfaceSample& p : even.points) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const SurfaceSample& q : even.points) {
            if (&p == &q || !(glm::dot(p.normal, q.normal) > 0.0f)) continue;
            nearest = std::min(nearest, static_cast<double>(glm::distance(p.position, q.position)));
        }
        result.push_back(nearest / unit);
    }
    std::sort(result.begin(), result.end());
    return result;
}

void expect_on_triangles(const Mesh& mesh, const EvenPoints& even) {
    EXPECT_NEAR(even.area * static_cast<double>(even.points.size()), area_of(mesh), 1e-4 * area_of(mesh));
    for (const SurfaceSample& p : even.points) {
        ASSERT_LT(p.triangle, mesh.size());
        ASSERT_GE(p.u, 0.0f);
        ASSERT_GE(p.v, 0.0f);
        ASSERT_LE(p.u + p.v, 1.0f);
        const auto& [a, b, c] = mesh[p.triangle];
        const glm::vec3 expected = (1.0f - p.u - p.v) * at(a) + p.u * at(b) + p.v * at(c);
        ASSERT_LT(glm::distance(p.position, expected), 1e-6f * (1.0f + glm::length(expected)));
        const glm::vec3 cross = glm::cross(at(b) - at(a), at(c) - at(a));
        ASSERT_GT(glm::dot(p.normal, cross), 0.999f * glm::length(cross));
    }
}

TEST(EvenPoints, LieOnTheirTriangles) {
    for (const Mesh& mesh :
         {square(1), square(30), sphere(24), box(0.01f), Mesh{{{{0, 0, 0}, {3, 1, 0}, {1, 0, 2}}}}}) {
        for (const std::size_t count : {1u, 7u, 500u}) {
            const EvenPoints even = points_on(mesh, count, count);
            ASSERT_EQ(even.points.size(), count);
            expect_on_triangles(mesh, even);
        }
    }
}

// Whether triangles are much larger than what points are apart, or much smaller.
TEST(EvenPoints, KeepApart) {
    for (const Mesh& mesh : {square(1), square(50), sphere(40), box(1.0f), box(0.001f)}) {
        for (const std::size_t count : {300u, 2000u}) {
            const auto apart = spacings(points_on(mesh, count, 1)), before = spacings(points_on(mesh, count, 1, 0));
            EXPECT_GT(apart[0], 0.5) << count;
            EXPECT_GT(apart[count / 2], 0.8) << count;
            EXPECT_LT(before[0], 0.2) << count;
        }
    }
}

/// RMS of how far the numbers of points in some balls are from their shares of the area, over that of as many
/// independent ones. `share(center, radius)`: of the ball.
template <class Share>
double unevenness(const EvenPoints& even, const std::vector<glm::vec3>& centers, float radius, const Share& share) {
    double off = 0.0, random = 0.0;
    const auto count = static_cast<double>(even.points.size());
    for (const glm::vec3& center : centers) {
        const double expected = share(center, radius);
        const auto inside = std::count_if(even.points.begin(), even.points.end(), [&](const SurfaceSample& p) {
            return glm::distance(p.position, center) < radius;
        });
        off += std::pow(static_cast<double>(inside) - count * expected, 2);
        random += count * expected * (1.0 - expected);
    }
    return std::sqrt(off / random);
}

TEST(EvenPoints, PatchesHaveTheirShare) {
    std::vector<glm::vec3> centers;
    for (std::uint64_t i = 0; i < 200; ++i) {
        centers.emplace_back(uniform01(hash_keys(i, 1)) * 0.6 + 0.2, uniform01(hash_keys(i, 2)) * 0.6 + 0.2, 0.0);
    }
    const auto disc = [](const glm::vec3&, float radius) {
        return std::numbers::pi * static_cast<double>(radius) * static_cast<double>(radius);
    };
    std::vector<glm::vec3> on_sphere = centers;
    for (glm::vec3& c : on_sphere) c = glm::normalize(c - glm::vec3(0.5f, 0.5f, 0.1f));
    const auto cap = [](const glm::vec3&, float radius) {
        return static_cast<double>(radius) * static_cast<double>(radius) / 4.0;
    };
    for (const int steps : {0, 20}) {
        const double most = steps == 0 ? 0.5 : 0.3;
        EXPECT_LT(unevenness(points_on(square(1), 2000, 3, steps), centers, 0.19f, disc), most);
        EXPECT_LT(unevenness(points_on(square(60), 2000, 3, steps), centers, 0.19f, disc), most);
        EXPECT_LT(unevenness(points_on(sphere(100), 2000, 3, steps), on_sphere, 0.5f, cap), most);
    }
}

// Half of the neighbors are missing there: without a push of the border points would crowd on it.
TEST(EvenPoints, BordersAreNoDenser) {
    for (const int side : {1, 40}) {
        double inside = 0.0, upon = 0.0;
        const std::size_t count = 1000;
        const double width = 0.06;  // some two rows
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            for (const SurfaceSample& p : points_on(square(side), count, seed).points) {
                const glm::vec3 from = glm::abs(p.position - glm::vec3(0.5f));
                inside += static_cast<double>(std::max(from.x, from.y)) > 0.5 - width ? 1.0 : 0.0;
                upon += static_cast<double>(std::max(from.x, from.y)) > 0.5 - 1e-5 ? 1.0 : 0.0;
            }
        }
        const double expected = 10.0 * static_cast<double>(count) * (1.0 - std::pow(1.0 - 2.0 * width, 2));
        EXPECT_NEAR(inside / expected, 1.0, 0.06) << side;
        EXPECT_LT(upon / expected, 0.02) << side;
    }
}

TEST(EvenPoints, SmallPartsHaveTheirShare) {
    Mesh mesh;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        const auto random = [&](std::uint64_t k) { return static_cast<float>(uniform01(hash_keys(i, k))); };
        const float size = 0.001f + 0.1f * std::pow(random(0), 4.0f);
        const glm::vec3 place(random(1), random(2), random(3));
        for (auto t : box(0.5f)) {
            for (Place& p : t) p = {place.x + size * p.x, place.y + size * p.y, place.z + size * p.z};
            mesh.push_back(t);
        }
    }
    const double area = area_of(mesh);
    for (const std::size_t count : {100u, 20000u}) {
        const EvenPoints even = points_on(mesh, count, 2);
        expect_on_triangles(mesh, even);
        // A part is the side of a box, two triangles.
        std::vector<double> found(mesh.size() / 2, 0.0);
        for (const SurfaceSample& p : even.points) ++found[p.triangle / 2];
        double worst = 0.0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double share = area_of({mesh[2 * i], mesh[2 * i + 1]}) / area;
            worst = std::max(worst, std::abs(found[i] - static_cast<double>(count) * share));
        }
        EXPECT_LT(worst, 2.0);
    }
}

/// A sheet (0, 1) x (0, 1) folded over a round edge, so that it faces up and down.
Mesh folded_sheet() {
    std::vector<glm::vec2> profile{{0.0f, 1e-3f}};
    for (int i = 0; i <= 16; ++i) {
        const double angle = std::numbers::pi * (0.5 - i / 16.0);
        profile.emplace_back(1.0 + 1e-3 * std::cos(angle), 1e-3 * std::sin(angle));
    }
    profile.emplace_back(0.0f, -1e-3f);
    Mesh mesh;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        const glm::vec2 a = profile[i], b = profile[i + 1];
        add_quad(mesh, {a.x, 0, a.y}, {b.x, 0, b.y}, {b.x, 1, b.y}, {a.x, 1, a.y});
    }
    return mesh;
}

TEST(EvenPoints, BothSidesOfAThinSheetHaveHalf) {
    // As a body with sharp edges, with a round one, and as two sheets that share all their vertices.
    Mesh doubled = square(20);
    for (const auto& [a, b, c] : square(20)) doubled.push_back({c, b, a});
    Mesh slab = box(1e-4f);
    for (auto& t : slab) {
        for (Place& p : t) p = {p.x, p.z, p.y};
    }
    for (const Mesh& mesh : {doubled, slab, folded_sheet()}) {
        const EvenPoints even = points_on(mesh, 2000, 4);
        expect_on_triangles(mesh, even);
        const auto above = std::count_if(even.points.begin(), even.points.end(),
                                         [](const SurfaceSample& p) { return p.normal.z > 0.5f; });
        EXPECT_NEAR(static_cast<double>(above), 1000.0, 30.0);
        // A few stand on the round edge, where they face neither way.
        const std::vector<double> apart = spacings(even);
        EXPECT_GT(apart[40], 0.5);
        EXPECT_GT(apart[1000], 0.8);
    }
}

// Neighbors may wind in opposite ways: they are one surface all the same.
TEST(EvenPoints, WindingDoesNotMatter) {
    Mesh mixed = square(20);
    for (std::size_t i = 0; i < mixed.size(); ++i) {
        if (hash_keys(i) % 2 == 0) std::swap(mixed[i][1], mixed[i][2]);
    }
    EvenPoints even = points_on(mixed, 1000, 5);
    expect_on_triangles(mixed, even);
    for (SurfaceSample& p : even.points) p.normal = {0.0f, 0.0f, 1.0f};
    EXPECT_GT(spacings(even)[0], 0.5);
}

TEST(EvenPoints, MeshesMayBeDegenerate) {
    Mesh mesh = square(3);
    mesh.push_back({{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}});
    mesh.push_back({{{0, 0, 0}, {0.5f, 0.5f, 0}, {1, 1, 0}}});
    mesh.push_back({{{0, 0, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}}});
    mesh.push_back({{{2, 0, 0}, {3, 0, 0}, {2.5f, 1e-7f, 0}}});
    mesh.push_back({{{-0.0f, 2, 0}, {1, 2, -0.0f}, {1, 3, 0}}});
    // Many at one edge, and many in one place.
    for (int i = 0; i < 300; ++i) {
        const float angle = 0.02f * static_cast<float>(i);
        mesh.push_back({{{0, 0, 5}, {0, 0, 6}, {std::cos(angle), std::sin(angle), 5}}});
        mesh.push_back({{{0, 0, 9}, {0.1f, 0, 9}, {0, 0.1f, 9}}});
    }
    for (const std::size_t count : {1u, 50u, 5000u}) {
        const EvenPoints even = points_on(mesh, count, 6);
        ASSERT_EQ(even.points.size(), count);
        expect_on_triangles(mesh, even);
        for (const SurfaceSample& p : even.points) { EXPECT_TRUE(p.triangle < 18 || p.triangle > 20) << p.triangle; }
    }
}

TEST(EvenPoints, MeshesWithoutAreaAreRefused) {
    EXPECT_TRUE(points_on({}, 0).points.empty());
    EXPECT_THROW(points_on({}, 1), invalid_input);
    EXPECT_THROW(points_on({{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}}}, 3), invalid_input);
    Mesh mesh = square(2);
    mesh[5][1].y = std::numeric_limits<float>::quiet_NaN();
    try {
        points_on(mesh, 3);
        ADD_FAILURE() << "a corner that is no number was taken";
    } catch (const invalid_input& problem) {
        EXPECT_NE(std::string(problem.what()).find("triangle 5"), std::string::npos) << problem.what();
    }
}

// Without steps the expected number of points anywhere is exactly the share of the area.
TEST(EvenPoints, AreDrawnByArea) {
    Mesh mesh = square(1);
    mesh.push_back({{{2, 0, 0}, {3, 0, 0}, {2, 0.3f, 0}}});
    double small = 0.0, left = 0.0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        for (const SurfaceSample& p : points_on(mesh, 3, seed, 0).points) {
            small += p.triangle == 2 ? 1.0 : 0.0;
            left += p.position.x < 0.3f ? 1.0 : 0.0;
        }
    }
    EXPECT_NEAR(small / 12000.0, 0.15 / 1.15, 0.01);
    EXPECT_NEAR(left / 12000.0, 0.3 / 1.15, 0.012);
}

TEST(EvenPoints, AreTheSameOnEveryRun) {
    EXPECT_EQ(points_on(sphere(10), 300, 1).points, points_on(sphere(10), 300, 1).points);
    EXPECT_NE(points_on(sphere(10), 300, 1).points, points_on(sphere(10), 300, 2).points);
}

}  // namespace
}  // namespace lightcuts::test
