#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <lightcuts/light/incidence.hpp>
#include <lightcuts/source/area.hpp>
#include "support/random.hpp"
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
using Triangles = std::vector<EmissiveTriangle<V>>;

static_assert(EmissiveMesh<EmissiveTriangles<V>> && EmissiveMesh<EmissiveTriangles<float>>);

/// The rectangle [0, x] x [0, y] at z = 0, which shines along +z.
Triangles rectangle(float x, float y, const V& radiance) {
    const V a(0.0f), b(x, 0.0f, 0.0f), c(x, y, 0.0f), d(0.0f, y, 0.0f);
    return {{a, b, c, radiance}, {a, c, d, radiance}};
}

Triangles crumpled(std::size_t n, std::uint64_t seed) {
    Random random(seed);
    Triangles triangles;
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec3 p = random.in_box(glm::dvec3(-2.0), glm::dvec3(2.0));
        const double size = random.decades(-2.0, 0.0), power = random.decades(-2.0, 2.0);
        triangles.push_back({V(p), V(p + size * random.on_sphere()), V(p + size * random.on_sphere()),
                             V(power * random.unit(), power * random.unit(), power * random.unit()),
                             random.chance(0.3)});
    }
    return triangles;
}

glm::dvec3 sum_of(const std::vector<OrientedPointLight<V>>& lights) {
    glm::dvec3 sum(0.0);
    for (const auto& l : lights) sum += glm::dvec3(l.intensity);
    return sum;
}

TEST(AreaLights, KeepThePowerOfEveryChannelAndAreOfEqualPower) {
    for (const std::size_t count : {1u, 7u, 64u, 3000u}) {
        const Triangles triangles = crumpled(50, count);
        glm::dvec3 truth(0.0);
        for (const auto& t : triangles) {
            const double area = 0.5 * glm::length(glm::cross(glm::dvec3(t.b - t.a), glm::dvec3(t.c - t.a)));
            truth += glm::dvec3(t.radiance) * area * (t.two_sided ? 2.0 : 1.0);
        }
        const auto lights = area_lights(EmissiveTriangles<V>(triangles), count);
        ASSERT_EQ(lights.size(), count);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum_of(lights)[i] / truth[i], 1.0, 1e-6);
        const double share = (truth.x + truth.y + truth.z) / double(count);
        for (const auto& l : lights) {
            EXPECT_NEAR(channel_sum(l.intensity) / share, 1.0, 1e-5);
            EXPECT_NEAR(glm::length(l.axis), 1.0f, 1e-6f);
        }
    }
}

TEST(AreaLights, LieOnTheirTrianglesAndFaceTheSideThatShines) {
    const Triangles triangles = crumpled(20, 1);
    for (const auto& l : area_lights(EmissiveTriangles<V>(triangles), 1000)) {
        double nearest = 1e30;
        for (const auto& t : triangles) {
            const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(t.b - t.a), glm::dvec3(t.c - t.a)));
            const double facing = glm::dot(normal, glm::dvec3(l.axis));
            if (t.two_sided ? std::fabs(facing) < 0.9999 : facing < 0.9999) continue;
            const auto outside = [&](const V& from, const V& to) {  // of the edge, beyond it
                return -glm::dot(glm::cross(normal, glm::normalize(glm::dvec3(to - from))),
                                 glm::dvec3(l.position - from));
            };
            const double beyond = std::max({outside(t.a, t.b), outside(t.b, t.c), outside(t.c, t.a), 0.0});
            nearest = std::min(nearest, beyond + std::fabs(glm::dot(normal, glm::dvec3(l.position - t.a))));
        }
        EXPECT_LT(nearest, 1e-5);
    }
}

TEST(AreaLights, ShineOnBothSidesIfAsked) {
    Triangles triangles = rectangle(1.0f, 1.0f, V(1.0f));
    for (auto& t : triangles) t.two_sided = true;
    std::size_t up = 0;
    const auto lights = area_lights(EmissiveTriangles<V>(triangles), 100);
    for (const auto& l : lights) up += l.axis.z > 0.0f ? 1u : 0u;
    EXPECT_EQ(up, 50u);
    EXPECT_NEAR(sum_of(lights).x, 2.0, 1e-6);
}

/// Largest error, over many half planes and corners of the unit square, of the share of points that lie in them.
double discrepancy(const std::vector<OrientedPointLight<V>>& lights) {
    double largest = 0.0;
    for (int i = 1; i < 16; ++i) {
        for (int j = 1; j <= 16; ++j) {
            double inside = 0.0;
            for (const auto& l : lights) inside += l.position.x * 16.0f < float(i) && l.position.y * 16.0f < float(j);
            largest = std::max(largest, std::fabs(inside / double(lights.size()) - i * j / 256.0));
        }
    }
    return largest;
}

TEST(AreaLights, AreSpreadEvenlyWhateverTheTriangles) {
    Triangles fan;  // of slivers
    const V middle(0.3f, 0.4f, 0.0f);
    const auto edge = [](int i) {
        const float t = float(i % 8) / 8.0f;
        return i % 32 < 8 ? V(t, 0, 0) : i % 32 < 16 ? V(1, t, 0) : i % 32 < 24 ? V(1 - t, 1, 0) : V(0, 1 - t, 0);
    };
    for (int i = 0; i < 32; ++i) fan.push_back({middle, edge(i), edge(i + 1), V(1.0f)});
    for (const auto& triangles : {rectangle(1.0f, 1.0f, V(1.0f)), fan}) {
        for (const std::size_t count : {64u, 100u, 1024u}) {
            Mean even, independent;
            for (std::uint64_t seed = 0; seed < 20; ++seed) {
                even.add(discrepancy(area_lights(EmissiveTriangles<V>(triangles), count, ScrambledSobol{seed})));
                Random random(seed);
                std::vector<OrientedPointLight<V>> points(count);
                for (auto& p : points) p.position = V(random.in_box(glm::dvec3(0.0), glm::dvec3(1.0)));
                independent.add(discrepancy(points));
            }
            const double ratio = count > 1000 ? 0.35 : 0.65;
            EXPECT_LT(even.value(), ratio * independent.value()) << count << " lights";
        }
    }
}

TEST(TrianglePiece, IsSampledUniformly) {
    const detail::TrianglePiece<V> piece{{glm::vec2(0.0f), {1.0f, 0.0f}, {0.0f, 1.0f}}, 0, false, 0.5, V(1.0f)};
    constexpr int cells = 200;
    glm::dvec3 moments(0.0);  // of u, v and u^2
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            const glm::dvec2 uv = piece.at((i + 0.5) / cells, (j + 0.5) / cells);
            moments += glm::dvec3(uv.x, uv.y, uv.x * uv.x) / double(cells * cells);
        }
    }
    EXPECT_NEAR(moments.x, 1.0 / 3.0, 1e-4);
    EXPECT_NEAR(moments.y, 1.0 / 3.0, 1e-4);
    EXPECT_NEAR(moments.z, 1.0 / 6.0, 1e-4);
}

/// Irradiance at the origin on a plane that faces +z, from a rectangle [0, x] x [0, y] at height z of radiance 1:
/// Lambert's sum over the polygon's edges.
double irradiance_of_rectangle(double x, double y, double z) {
    const double a = x / std::hypot(x, z), b = y / std::hypot(x, z), c = y / std::hypot(y, z), d = x / std::hypot(y, z);
    return 0.5 * (a * std::atan(b) + c * std::atan(d));
}

TEST(AreaLights, LightAPointAsTheirRectangleDoes) {
    Triangles triangles = rectangle(2.0f, 1.0f, V(1.0f));
    for (auto& t : triangles) {
        std::swap(t.b, t.c);  // shines down
        t.a.z = t.b.z = t.c.z = 1.5f;
    }
    double sum = 0.0;
    for (const auto& l : area_lights(EmissiveTriangles<V>(triangles), 4096)) {
        const Incidence arriving = incidence(l, V(0.0f));
        sum += arriving.geometric * double(arriving.to_light.z) * double(l.intensity.x);
    }
    EXPECT_NEAR(sum / irradiance_of_rectangle(2.0, 1.0, 1.5), 1.0, 1e-3);
}

TEST(AreaLights, FollowATexture) {
    const Triangles triangles = rectangle(1.0f, 1.0f, V(0.0f));
    // Radiance 1 + 8 x along the square: triangle 0 has corners (0,0) (1,0) (1,1), triangle 1 (0,0) (1,1) (0,1).
    const TexturedTriangles emitter(std::span<const EmissiveTriangle<V>>(triangles),
                                    [](std::uint32_t t, const glm::vec2& uv) {
                                        const float x = t == 0 ? uv.x + uv.y : uv.x;
                                        return V(1.0f + 8.0f * x, 1.0f, 0.0f);
                                    });
    const auto lights = area_lights(emitter, 500);
    EXPECT_NEAR(sum_of(lights).x, 5.0, 1e-5);
    EXPECT_NEAR(sum_of(lights).y, 1.0, 1e-5);
    EXPECT_EQ(sum_of(lights).z, 0.0);
    for (const float x : {0.25f, 0.5f, 0.75f}) {
        double left = 0.0;
        for (const auto& l : lights) left += l.position.x < x ? channel_sum(l.intensity) : 0.0;
        EXPECT_NEAR(left / 6.0, double(x * 2.0f + 4.0f * x * x) / 6.0, 0.01);
    }
}

TEST(AreaLights, AreUnbiasedOverSeeds) {
    Triangles triangles = crumpled(6, 9);
    for (auto& t : triangles) t.radiance = V(t.radiance.x);
    const auto mean_height = [](const auto& lights) {
        double sum = 0.0;
        for (const auto& l : lights) sum += double(l.position.x) * channel_sum(l.intensity);
        return sum;
    };
    double truth = 0.0;
    for (const auto& t : triangles) {
        const double area = 0.5 * glm::length(glm::cross(glm::dvec3(t.b - t.a), glm::dvec3(t.c - t.a)));
        truth += area * channel_sum(t.radiance) * double(t.a.x + t.b.x + t.c.x) / 3.0 * (t.two_sided ? 2.0 : 1.0);
    }
    Mean mean;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        mean.add(mean_height(area_lights(EmissiveTriangles<V>(triangles), 5, ScrambledSobol{seed})));
    }
    EXPECT_LT(mean.standard_errors_from(truth), one_in_a_million);
}

std::string refusal(const Triangles& triangles) {
    try {
        area_lights(EmissiveTriangles<V>(triangles), 10);
    } catch (const invalid_input& e) { return e.what(); }
    return "";
}

TEST(AreaLights, RefuseEmittersThatCannotShine) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal({}), HasSubstr("its 0 triangles have no area"));
    EXPECT_THAT(refusal({{V(0.0f), V(1.0f), V(2.0f), V(1.0f)}}), HasSubstr("its 1 triangles have no area"));
    EXPECT_THAT(refusal(rectangle(1.0f, 1.0f, V(0.0f))), HasSubstr("black"));
    Triangles bad = rectangle(1.0f, 1.0f, V(1.0f));
    bad[1].radiance.y = -1.0f;
    EXPECT_THAT(refusal(bad), HasSubstr("triangle 1: radiance -1.000000 is negative"));
    bad[1].radiance.y = std::numeric_limits<float>::infinity();
    EXPECT_THAT(refusal(bad), HasSubstr("triangle 1"));
    bad = rectangle(1.0f, 1.0f, V(1.0f));
    bad[1].c.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal(bad), HasSubstr("triangle 1: a corner is not finite"));
    Triangles one_flat = rectangle(1.0f, 1.0f, V(1.0f));
    one_flat.push_back({V(0.0f), V(1.0f), V(2.0f), V(1.0f)});
    EXPECT_EQ(refusal(one_flat), "");
}

}  // namespace
}  // namespace lightcuts::test
