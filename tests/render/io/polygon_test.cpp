#include <render/io/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <lightcuts/core/random.hpp>

namespace {

using glm::dvec2;
using glm::dvec3;
using render::triangles_of;

/// Numbers in [0, 1), the same on every machine.
class Numbers {
public:
    explicit Numbers(std::uint64_t seed) : seed_(seed) {}
    double next() { return lightcuts::uniform01(lightcuts::hash_keys(seed_, count_++)); }

private:
    std::uint64_t seed_;
    std::uint64_t count_ = 0;
};

/// By the shoelace formula; positive if counter-clockwise.
double area_of(const std::vector<dvec2>& outline) {
    double twice = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const dvec2& a = outline[i];
        const dvec2& b = outline[(i + 1) % outline.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

/// In space, in a plane whose coordinates hide nothing.
std::vector<dvec3> placed(const std::vector<dvec2>& outline, const dvec3& x, const dvec3& y, const dvec3& at) {
    std::vector<dvec3> result;
    for (const dvec2& p : outline) result.push_back(at + p.x * x + p.y * y);
    return result;
}

/// What the triangles of a simple outline have to be: n - 2 of them, none turned over, all corners used, and as large
/// together as the outline: then they cover it once and nothing else.
void expect_covers(const std::vector<dvec2>& outline, const char* what) {
    struct Frame {
        dvec3 x, y, at;
    };
    const dvec3 oblique = glm::normalize(dvec3(0.3, -0.8, 0.52));
    const dvec3 across = glm::normalize(glm::cross(oblique, dvec3(0.1, 0.2, 0.9)));
    const double area = area_of(outline);
    for (const Frame& f : {Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, Frame{{0, 0, 1}, {1, 0, 0}, {0, 5, 0}},
                           Frame{{0, 1, 0}, {1, 0, 0}, {1e5, 1e5, 1e5}}, Frame{oblique, across, {3, -2, 7}}}) {
        const std::vector<dvec3> p = placed(outline, f.x, f.y, f.at);
        const auto triangles = triangles_of(p);
        ASSERT_EQ(triangles.size(), outline.size() - 2) << what;
        const dvec3 normal = glm::cross(f.x, f.y) * (area > 0.0 ? 1.0 : -1.0);
        double sum = 0.0;
        std::set<std::uint32_t> used;
        for (const auto& [a, b, c] : triangles) {
            const double part = 0.5 * glm::dot(glm::cross(p[b] - p[a], p[c] - p[a]), normal);
            EXPECT_GE(part, -1e-9 * std::abs(area)) << what;
            sum += part;
            used.insert({a, b, c});
        }
        EXPECT_NEAR(sum, std::abs(area), 1e-8 * std::abs(area)) << what;
        EXPECT_EQ(used.size(), outline.size()) << what;
    }
}

void expect_covers_both_ways(std::vector<dvec2> outline, const char* what) {
    expect_covers(outline, what);
    std::reverse(outline.begin(), outline.end());
    expect_covers(outline, what);
    // Wherever it begins.
    std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(outline.size() / 3), outline.end());
    expect_covers(outline, what);
}

TEST(Polygon, LettersAreCoveredOnce) {
    expect_covers_both_ways({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, "L");
    expect_covers_both_ways({{0, 0}, {2, 0}, {2, 0.5}, {0.5, 0.5}, {0.5, 1.5}, {2, 1.5}, {2, 2}, {0, 2}}, "C");
    expect_covers_both_ways({{0, 0}, {3, 0}, {0.5, 0.4}, {0, 3}}, "dart");
    std::vector<dvec2> comb{{0, 0}, {8, 0}};
    for (int i = 8; i > 0; --i) {
        comb.emplace_back(i, 3);
        comb.emplace_back(i - 0.5, 1);
    }
    comb.emplace_back(0, 3);
    expect_covers_both_ways(comb, "comb");
    std::vector<dvec2> star;
    for (int i = 0; i < 10; ++i) {
        const double r = i % 2 == 0 ? 1.0 : 0.3;
        star.emplace_back(r * std::cos(0.2 * i * std::numbers::pi), r * std::sin(0.2 * i * std::numbers::pi));
    }
    expect_covers_both_ways(star, "star");
    std::vector<dvec2> spiral;
    for (int i = 0; i < 60; ++i) spiral.push_back((1.0 + 0.1 * i) * dvec2(std::cos(0.3 * i), std::sin(0.3 * i)));
    for (int i = 59; i >= 0; --i) spiral.push_back((0.6 + 0.1 * i) * dvec2(std::cos(0.3 * i), std::sin(0.3 * i)));
    expect_covers_both_ways(spiral, "spiral");
}

TEST(Polygon, BridgedHolesStayOpen) {
    expect_covers_both_ways({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}, "a hole");
    // Two windows in a wall, both reached from one corner.
    expect_covers_both_ways({{0, 0},
                             {3, 1},
                             {3, 3},
                             {5, 3},
                             {5, 1},
                             {3, 1},
                             {0, 0},
                             {9, 0},
                             {9, 4},
                             {0, 4},
                             {0, 0},
                             {1, 1},
                             {1, 2},
                             {2, 2},
                             {2, 1},
                             {1, 1}},
                            "two holes");
    // Round ones, whose bridges end at the rim's corners.
    std::vector<dvec2> ring;
    for (int i = 0; i <= 24; ++i) {
        ring.push_back(2.0 * dvec2(std::cos(i * std::numbers::pi / 12), std::sin(i * std::numbers::pi / 12)));
    }
    ring.back() = ring.front();
    for (int i = 24; i >= 0; --i) {
        ring.emplace_back(std::cos(i * std::numbers::pi / 12), std::sin(i * std::numbers::pi / 12));
    }
    ring.back() = ring[25];
    expect_covers_both_ways(ring, "ring");
}

TEST(Polygon, RandomOutlinesAreCoveredOnce) {
    Numbers numbers(1);
    for (int n = 4; n < 60; ++n) {
        // Seen whole from its middle, with spikes and notches.
        std::vector<dvec2> outline;
        for (int i = 0; i < n; ++i) {
            const double angle = 2.0 * std::numbers::pi * (i + 0.8 * numbers.next()) / n;
            outline.push_back((0.05 + numbers.next()) * dvec2(std::cos(angle), std::sin(angle)));
        }
        expect_covers_both_ways(outline, "spikes");
        // A mountain range and its reflection in water: many corners at one height.
        std::vector<dvec2> range;
        for (int i = 0; i < n; ++i) range.emplace_back(i, 1.0 + std::floor(4.0 * numbers.next()));
        for (int i = n - 1; i >= 0; --i) range.emplace_back(i, -1.0 - std::floor(3.0 * numbers.next()));
        expect_covers_both_ways(range, "mountains");
    }
}

TEST(Polygon, ConvexOutlinesBecomeFans) {
    const std::vector<dvec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const auto triangles = triangles_of(square);
    ASSERT_EQ(triangles.size(), 2u);
    EXPECT_EQ(triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
    EXPECT_EQ(triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

TEST(Polygon, CornersOnStraightEdgesAreCornersOfTriangles) {
    // Where a neighbor ends, so that rays do not slip through between them.
    expect_covers_both_ways({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}, "edges with corners");
    for (std::size_t start = 0; start < 7; ++start) {
        std::vector<dvec2> outline{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
        std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(start), outline.end());
        const std::vector<dvec3> p = placed(outline, {1, 0, 0}, {0, 1, 0}, {0, 0, 0});
        for (const auto& [a, b, c] : triangles_of(p)) {
            EXPECT_GT(glm::length(glm::cross(p[b] - p[a], p[c] - p[a])), 0.0) << start;
        }
    }
}

TEST(Polygon, AnyOutlineEnds) {
    Numbers numbers(2);
    for (int n = 3; n < 40; ++n) {
        for (int kind = 0; kind < 4; ++kind) {
            std::vector<dvec3> tangle;
            for (int i = 0; i < n; ++i) {
                const dvec3 p(numbers.next(), numbers.next(), kind == 3 ? numbers.next() : 0.0);
                tangle.push_back(kind == 1 ? glm::floor(3.0 * p) : kind == 2 ? dvec3(p.x) : p);
            }
            EXPECT_EQ(triangles_of(tangle).size(), tangle.size() - 2);
        }
    }
}

TEST(Polygon, LargeOutlinesTakeLittleTime) {
    std::vector<dvec2> comb{{-1, 0}, {20000, 0}};
    for (int i = 20000; i > 0; --i) comb.emplace_back(i, i % 2 == 0 ? 3.0 : 1.0);
    expect_covers(comb, "a comb of 20,000 teeth");
}

}  // namespace
