#include <lightcuts/visibility/flood.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <lightcuts/visibility/occluder_mesh.hpp>

#include "support/random.hpp"
#include "support/triangle_soup.hpp"

namespace {

using namespace lightcuts;
using lightcuts::test::Random;
using lightcuts::test::TriangleSoup;

constexpr double ray_end = 1.0 - 1e-3;

OccluderMesh mesh_of(const TriangleSoup& soup) {
    return OccluderMesh(soup.triangles.size(), [&](std::size_t i) { return soup.triangles[i]; });
}

Box random_box(Random& random, const glm::dvec3& lo, const glm::dvec3& hi, double largest) {
    const glm::dvec3 middle = random.in_box(lo, hi);
    glm::dvec3 half(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        if (random.chance(0.7)) half[axis] = 0.5 * largest * std::pow(random.unit(), 3.0);
    }
    return {glm::vec3(middle - half), glm::vec3(middle + half)};
}

/// Corners of boxes often, for there proofs end.
glm::dvec3 point_of(Random& random, const Box& box) {
    glm::dvec3 p = random.in_box(glm::dvec3(box.lo), glm::dvec3(box.hi));
    if (random.chance(0.6)) {
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = static_cast<double>(random.chance(0.5) ? box.lo[axis] : box.hi[axis]);
        }
    }
    return p;
}

/// What a scene is made of.
struct Case {
    TriangleSoup soup;
    glm::dvec3 lo{-4.0}, hi{4.0};
    double light_size = 1.5;
};

Case soup_of(Random& random, int kind) {
    Case made;
    TriangleSoup& soup = made.soup;
    switch (kind) {
        case 0:  // walls with bumps
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 n = random.on_sphere(), u = glm::normalize(glm::cross(n, random.on_sphere()));
                const glm::dvec3 v = glm::cross(n, u);
                soup.add_sheet(random, random.in_box({-2, -2, -2}, {2, 2, 2}) - 3.0 * (u + v), 6.0 * u, 6.0 * v, 5, 5,
                               random.chance(0.5) ? 0.0 : 0.3);
            }
            break;
        case 1:  // closed boxes that touch and interpenetrate
            for (int i = 0; i < 5; ++i) {
                const glm::dvec3 lo = glm::floor(random.in_box({-3, -3, -3}, {2, 2, 2}));
                soup.add_box(random, lo, lo + glm::dvec3(1.0) + glm::floor(random.in_box({0, 0, 0}, {3, 3, 3})),
                             1 + static_cast<int>(random.below(3)));
            }
            break;
        case 2:  // a room of one closed box with furniture; a window is a hole where triangles are left out
            soup.add_box(random, {-3, -3, -3}, {3, 3, 3}, 6);
            for (int i = 0; i < 6; ++i) {
                soup.triangles.erase(soup.triangles.begin() +
                                     static_cast<std::ptrdiff_t>(random.below(soup.triangles.size())));
            }
            soup.add_box(random, {-1, -1, -3}, {1, 1, -1}, 2);
            break;
        case 3:  // two walls that meet at T-junctions, or leave a gap
            soup.add_sheet(random, {-3, 0, -3}, {3, 0, 0}, {0, 0, 6}, 2, 3);
            soup.add_sheet(random, {random.chance(0.5) ? 1e-6 : 0.0, 0, -3}, {3, 0, 0}, {0, 0, 6}, 2, 5);
            break;
        default:  // slivers, and triangles of no area
            for (int i = 0; i < 200; ++i) {
                const glm::dvec3 a = random.in_box({-3, -3, -3}, {3, 3, 3}), b = random.in_box({-3, -3, -3}, {3, 3, 3});
                const glm::dvec3 between = glm::mix(a, b, random.unit());
                soup.add(a, b, between + random.on_sphere() * (random.chance(0.2) ? 0.0 : random.decades(-7.0, 0.5)));
            }
            soup.add_sheet(random, {-3, 0, -3}, {6, 0, 0}, {0, 0, 6}, 60, 1, 0.01);
    }
    return made;
}

/// Asserts that every sampled shadow ray is blocked if the flood says so; returns how often it did.
template <class Lights>
bool check(const Case& scene, const OccluderMesh& mesh, const ReceiverBox& receivers, const Lights& lights,
           Random& random) {
    const Flood flood(mesh);
    const Flood::Segment middle = Flood::start_segment(receivers, lights);
    if (!middle.exists) return false;
    const Box& box = [&]() -> const Box& {
        if constexpr (std::is_same_v<Lights, Box>) {
            return lights;
        } else {
            return lights.box;
        }
    }();
    const double far = middle.distant ? 100.0 : 1.0;
    for (const std::uint32_t start : scene.soup.hits(middle.from, middle.way() * far)) {
        if (!flood.hides(receivers, lights, start)) continue;
        for (int i = 0; i < 40; ++i) {
            const glm::dvec3 from = point_of(random, receivers.box), to = point_of(random, box);
            const glm::dvec3 way = middle.distant ? to * far : (to - from) * ray_end;
            if (receivers.horizon) {
                const glm::dvec3 position = point_of(random, receivers.horizon->positions);
                const glm::dvec3 seen = middle.distant ? to : to - position;
                if (glm::dot(glm::dvec3(receivers.horizon->normal), seen) <= 0.0) continue;
            }
            EXPECT_FALSE(scene.soup.hits(from, way).empty())
                << "from " << from.x << ' ' << from.y << ' ' << from.z << " to " << to.x << ' ' << to.y << ' ' << to.z;
        }
        return true;
    }
    return false;
}

/// Whether the flood from the first triangle between the middles hides the lights. pre: there is one
template <class Lights>
bool hides_from_first(const TriangleSoup& soup, const Flood& flood, const ReceiverBox& receivers,
                      const Lights& lights) {
    const Flood::Segment segment = Flood::start_segment(receivers, lights);
    return flood.hides(receivers, lights,
                       soup.hits(segment.from, segment.way() * (segment.distant ? 100.0 : 1.0)).front());
}

class Floods : public testing::TestWithParam<int> {};

TEST_P(Floods, HideOnlyWhatEveryRayFindsBlocked) {
    Random random(static_cast<std::uint64_t>(GetParam()) + 1);
    int hidden = 0, hidden_directions = 0;
    for (int scene = 0; scene < 60; ++scene) {
        const Case made = soup_of(random, GetParam());
        const OccluderMesh mesh = mesh_of(made.soup);
        for (int i = 0; i < 400; ++i) {
            ReceiverBox receivers{random_box(random, made.lo, made.hi, random.chance(0.5) ? 0.0 : 0.5)};
            if (random.chance(0.4)) {
                // Shadow rays start off the receivers' positions.
                const glm::vec3 normal(random.on_sphere());
                const glm::vec3 lift = static_cast<float>(random.decades(-6.0, -0.5)) * normal;
                receivers.horizon = Horizon{normal, {receivers.box.lo - lift, receivers.box.hi - lift}};
            }
            if (random.chance(0.5)) {
                hidden += check(made, mesh, receivers, random_box(random, made.lo, made.hi, made.light_size), random);
            } else {
                const glm::dvec3 axis = random.on_sphere();
                const double spread = random.decades(-3.0, 0.0);
                DirectionBox directions;
                for (int k = 0; k < 8; ++k) {
                    directions.box = merge(directions.box, box_of(glm::vec3(random.near(axis, spread))));
                }
                hidden_directions += check(made, mesh, receivers, directions, random);
            }
            if (HasFailure()) FAIL() << "scene " << scene << ", " << i;
        }
    }
    RecordProperty("hidden", hidden);
    // Each kind hides some, so that there is something to be wrong about.
    EXPECT_GT(hidden, 100);
    EXPECT_GT(hidden_directions, 100);
}
INSTANTIATE_TEST_SUITE_P(Soups, Floods, testing::Range(0, 5));

TEST(Flood, ClosedRoomsHideAllThatIsOutside) {
    Random random(1);
    TriangleSoup soup;
    soup.add_box(random, {-2, -2, -2}, {2, 2, 2}, 4);
    const OccluderMesh mesh = mesh_of(soup);
    const Flood flood(mesh);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 from = random.in_box({-1.9, -1.9, -1.9}, {1.9, 1.9, 1.9}), to = 5.0 * random.on_sphere();
        if (std::fabs(to.x) < 2.2 && std::fabs(to.y) < 2.2 && std::fabs(to.z) < 2.2) continue;
        const ReceiverBox receivers{box_of(glm::vec3(from))};
        const Box lights{glm::vec3(to - 0.1), glm::vec3(to + 0.1)};
        EXPECT_TRUE(hides_from_first(soup, flood, receivers, lights)) << i;
        const glm::vec3 direction(random.on_sphere());
        const DirectionBox sky{merge(box_of(direction), box_of(direction + 0.01f))};
        EXPECT_TRUE(hides_from_first(soup, flood, receivers, sky)) << i;
    }
}

TEST(Flood, WindowsShowWhatIsBehindThem) {
    // A wall of 4 x 4 squares of which one is missing; what is seen through it is not hidden, the rest is.
    TriangleSoup soup;
    for (int i = -2; i < 2; ++i) {
        for (int k = -2; k < 2; ++k) {
            if (i == 0 && k == 0) continue;
            const glm::dvec3 a(i, k, 0);
            soup.add(a, a + glm::dvec3(1, 0, 0), a + glm::dvec3(1, 1, 0));
            soup.add(a, a + glm::dvec3(1, 1, 0), a + glm::dvec3(0, 1, 0));
        }
    }
    const OccluderMesh mesh = mesh_of(soup);
    const Flood flood(mesh);
    const auto hides = [&](const glm::dvec3& from, const glm::dvec3& lo, const glm::dvec3& hi) {
        const ReceiverBox receivers{box_of(glm::vec3(from))};
        const Box lights{glm::vec3(lo), glm::vec3(hi)};
        const Flood::Segment middle = Flood::start_segment(receivers, lights);
        for (const std::uint32_t start : soup.hits(middle.from, middle.way())) {
            if (flood.hides(receivers, lights, start)) return true;
        }
        return false;
    };
    const glm::dvec3 eye(-0.5, -0.5, 1.0);
    EXPECT_TRUE(hides(eye, {-0.9, -0.9, -1.0}, {-0.1, -0.1, -0.5}));
    EXPECT_FALSE(hides(eye, {-0.9, -0.9, -1.0}, {2.0, 2.0, -0.5}));  // the window is in the shaft
    EXPECT_FALSE(hides(eye, {-0.9, -0.9, -0.5}, {-0.1, -0.1, 0.5})) << "lights on both sides of the wall";
    EXPECT_FALSE(hides(eye, {-0.9, -0.9, -0.5}, {-0.1, -0.1, 0.0})) << "lights in the wall";
    EXPECT_FALSE(hides({-0.5, -0.5, 0.0}, {-0.9, -0.9, -1.0}, {-0.1, -0.1, -0.5})) << "a receiver in the wall";
    EXPECT_FALSE(hides(eye, {-9.0, -0.9, -1.0}, {-0.1, -0.1, -0.5})) << "beyond the border";
}

TEST(Flood, ReceiversAllHaveToBeHidden) {
    Random random(2);
    TriangleSoup soup;
    soup.add_sheet(random, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2, 2);
    const OccluderMesh mesh = mesh_of(soup);
    const Flood flood(mesh);
    const Box lights{{-0.1f, -0.1f, -1.0f}, {0.1f, 0.1f, -0.9f}};
    // Seen from height 1, lights at depth 1 and the sheet half-way, of half the width between receiver and light.
    const ReceiverBox near{{{-1.5f, -1.5f, 0.9f}, {1.5f, 1.5f, 1.0f}}},
        wide{{{-2.5f, -1.5f, 0.9f}, {2.5f, 1.5f, 1.0f}}};
    EXPECT_TRUE(hides_from_first(soup, flood, near, lights));
    EXPECT_FALSE(hides_from_first(soup, flood, wide, lights));
}

TEST(Flood, NothingBelowTheHorizonNeedsToBeHidden) {
    // A wall on a floor that the receiver lies on; the floor has a border beyond.
    Random random(3);
    TriangleSoup soup;
    soup.add_sheet(random, {2, -9, -0.01}, {0, 18, 0}, {0, 0, 9}, 3, 3);
    const OccluderMesh mesh = mesh_of(soup);
    const Flood flood(mesh);
    const Box lights{{3.0f, -1.0f, -1.0f}, {3.5f, 1.0f, 2.0f}};
    ReceiverBox receivers{box_of({0.0f, 0.0f, 0.001f})};
    EXPECT_FALSE(hides_from_first(soup, flood, receivers, lights));
    receivers.horizon = Horizon{{0.0f, 0.0f, 1.0f}, box_of({0.0f, 0.0f, 0.0f})};
    EXPECT_TRUE(hides_from_first(soup, flood, receivers, lights));
}

TEST(Flood, WhatIsLitFromBelowTheShadowOriginIsNotHidden) {
    // Rays start above the receiver. A wall leaves a gap below that height, through which a low light is seen.
    for (const float lift : {1e-2f, 1e-3f, 1e-4f}) {
        TriangleSoup soup;
        Random random(6);
        soup.add_sheet(random, {0.5, -9, 0.8 * static_cast<double>(lift)}, {0, 18, 0}, {0, 0, 9}, 3, 3);
        const OccluderMesh mesh = mesh_of(soup);
        const ReceiverBox receivers{box_of({0.0f, 0.0f, lift}), Horizon{{0.0f, 0.0f, 1.0f}, box_of(glm::vec3(0.0f))}};
        const auto hides = [&](const Box& lights) { return hides_from_first(soup, Flood(mesh), receivers, lights); };
        EXPECT_FALSE(hides({{1.0f, 0.0f, 0.5f * lift}, {1.0f, 0.0f, 1.0f}}));
        EXPECT_TRUE(hides({{1.0f, 0.0f, 0.9f * lift}, {1.0f, 0.0f, 1.0f}}));
    }
}

TEST(Flood, DirectionsAndTheirOppositesAreNotHiddenByOneTriangle) {
    TriangleSoup soup;
    soup.add({-2, -9, -9}, {-2, 9, -9}, {-2, 0, 9});
    const OccluderMesh mesh = mesh_of(soup);
    const Flood flood(mesh);
    const ReceiverBox receivers{box_of(glm::vec3(0.0f))};
    const auto both = [](const glm::vec3& a, const glm::vec3& b) { return DirectionBox{merge(box_of(a), box_of(b))}; };
    EXPECT_TRUE(flood.hides(receivers, both({-1, 0, 0}, {-1, 0.01f, 0.01f}), 0));
    EXPECT_FALSE(flood.hides(receivers, both({1, 0, 0}, {-1, 0, 0}), 0));
    EXPECT_FALSE(flood.hides(receivers, both({1, 0, 0}, {-1, 1.2246e-16f, 0}), 0));
    EXPECT_FALSE(flood.hides(receivers, both({1, 3e-13f, 3e-13f}, {-1, 6e-13f, 6e-13f}), 0));
    EXPECT_FALSE(flood.hides(receivers, both({1, 0, 0}, {-1, 1e-6f, 0}), 0));
}

TEST(Flood, LongWalksAreGivenUp) {
    Random random(7);
    TriangleSoup soup;
    soup.add_sheet(random, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 40, 40);
    const OccluderMesh mesh = mesh_of(soup);
    const ReceiverBox receivers{box_of({0.0f, 0.0f, 1.0f})};
    const auto hides = [&](float width, const FloodOptions& options) {
        const Box lights{{-width, -width, -1.0f}, {width, width, -0.9f}};
        return hides_from_first(soup, Flood(mesh, options), receivers, lights);
    };
    EXPECT_TRUE(hides(0.1f, {}));
    EXPECT_TRUE(hides(0.3f, {}));
    EXPECT_FALSE(hides(0.3f, {.max_triangles = 20}));
    EXPECT_FALSE(hides(1.5f, {.max_triangles = 512})) << "some two thousand triangles";
    EXPECT_FALSE(hides(0.1f, {.max_triangles = 1}));
}

TEST(Flood, WhatRaysThatEndOffTheirLightReachIsNotHidden) {
    // Rays may end .3 off a light: past the wall behind which it is, or, at the horizon, below it.
    TriangleSoup soup;
    Random random(8);
    soup.add_sheet(random, {1, -9, -0.1}, {0, 18, 0}, {0, 0, 9}, 3, 3);
    const OccluderMesh mesh = mesh_of(soup);
    const Flood ends(mesh, {.end_distance = 0.3}), exact(mesh);
    const ReceiverBox receivers{box_of({0.0f, 0.0f, 0.5f})};
    const auto both = [&](const ReceiverBox& r, const glm::vec3& light) {
        const Box lights = box_of(light);
        return std::pair(hides_from_first(soup, exact, r, lights), hides_from_first(soup, ends, r, lights));
    };
    EXPECT_EQ(both(receivers, {2.0f, 0.0f, 0.5f}), std::pair(true, true));
    EXPECT_EQ(both(receivers, {1.2f, 0.0f, 0.5f}), std::pair(true, false));
    // The wall begins .1 below the light.
    const ReceiverBox above{receivers.box, Horizon{{0.0f, 0.0f, 1.0f}, box_of({0.0f, 0.0f, 0.0f})}};
    EXPECT_EQ(both(above, {2.0f, 0.0f, 0.01f}), std::pair(true, true)) << "the ray falls from .5";
    EXPECT_EQ(both({box_of({0.0f, 0.0f, 0.02f}), above.horizon}, {2.0f, 0.0f, 0.01f}), std::pair(true, false));
}

TEST(Flood, WhatIsNoStartProvesNothing) {
    Random random(4);
    TriangleSoup soup;
    soup.add_box(random, {-1, -1, -1}, {1, 1, 1}, 1);
    const OccluderMesh mesh = mesh_of(soup);
    const Flood flood(mesh);
    const ReceiverBox receivers{box_of(glm::vec3(0.0f))};
    const Box lights{{3.0f, 0.1f, 0.1f}, {3.1f, 0.2f, 0.2f}};
    int proofs = 0;
    for (std::uint32_t t = 0; t < 20; ++t) proofs += flood.hides(receivers, lights, t) ? 1 : 0;
    EXPECT_EQ(proofs, 1) << "one triangle is between the middles";
    EXPECT_FALSE(flood.hides(receivers, lights, OccluderMesh::no_triangle));
    EXPECT_FALSE(flood.hides({Box{}}, lights, 0));
    EXPECT_FALSE(flood.hides(receivers, Box{}, 0));
    const OccluderMesh none;
    EXPECT_FALSE(Flood(none).hides(receivers, lights, 0));
}

TEST(OccluderMesh, EdgesOfEqualCornersAreNeighbors) {
    Random random(5);
    TriangleSoup soup;
    soup.add_box(random, {0, 0, 0}, {1, 2, 3}, 3);
    const OccluderMesh mesh = mesh_of(soup);
    EXPECT_EQ(mesh.size(), soup.triangles.size());
    EXPECT_EQ(mesh.vertex_count(), 56u);  // Euler: a closed surface has 2 + N / 2
    for (std::uint32_t e = 0; e < 3 * mesh.size(); ++e) {
        const std::uint32_t other = mesh.neighbor(e);
        EXPECT_NE(other, e) << "a closed surface has no border";
        EXPECT_EQ(mesh.neighbor(other), e);
        EXPECT_EQ(mesh.start(e), mesh.run_alike(e, other) ? mesh.start(other) : mesh.end(other));
    }
}

TEST(OccluderMesh, RefusesCornersThatAreNotFinite) {
    const float infinity = std::numeric_limits<float>::infinity();
    const auto corners = [&](std::size_t i) {
        return test::Corners{glm::vec3(0.0f), glm::vec3(1.0f, 0.0f, 0.0f),
                             glm::vec3(0.0f, i == 3 ? infinity : 1.0f, 0.0f)};
    };
    try {
        const OccluderMesh mesh(5, corners);
        FAIL();
    } catch (const invalid_input& e) { EXPECT_NE(std::string(e.what()).find("triangle 3"), std::string::npos); }
}

}  // namespace
