#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/light/incidence.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/source/area.hpp>
#include <lightcuts/source/sphere.hpp>
#include "support/occluders.hpp"
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
using Sphere = SphereLight<V>;
static_assert(PointLight<SpherePointLight<V>> && !OrientedLight<SpherePointLight<V>>);

/// Of a sphere whose surface emits `radiance`.
V intensity_of(float radius, const V& radiance) { return std::numbers::pi_v<float> * radius * radius * radiance; }

std::vector<SpherePointLight<V>> lights_of(const Sphere& sphere, std::size_t count, std::uint64_t seed = 0) {
    return sphere_lights(std::span<const Sphere>(&sphere, 1), count, ScrambledSobol{seed});
}

TEST(SphereLights, ProjectUniformlyOnTheSpheresDiscSeenFromAnywhere) {
    // The density of points on a chord at distance b of the center, per area of the disc: seen from any distance d,
    // what an eye gathers along a ray is the sum of points near it / their distance^2 / solid angle of the cone.
    const Sphere sphere{V(1.0f, -2.0f, 0.5f), 2.0f, V(1.0f)};
    constexpr std::size_t count = 4096;
    constexpr std::uint64_t seeds = 100;
    std::vector<std::vector<SpherePointLight<V>>> sets;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) sets.push_back(lights_of(sphere, count, seed));
    for (const double distance : {2.5, 4.0, 50.0}) {
        for (const glm::dvec3& towards : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0.48, 0.6, 0.64)}) {
            const glm::dvec3 eye = glm::dvec3(sphere.center) + distance * towards;
            // Rings of equal solid angle of the sphere's cone; each light weighs 1 / its distance^2.
            const double cos_edge = std::sqrt(1.0 - 4.0 / (distance * distance));
            constexpr int rings = 8;
            // Radiance is intensity / (pi R^2) [chord integral of Eq. 7], so a ring gathers that x its solid angle.
            const double expected = 2.0 * std::numbers::pi * (1.0 - cos_edge) / rings / (std::numbers::pi * 4.0);
            std::vector<Mean> means(rings);
            for (const auto& lights : sets) {
                std::vector<double> weights(rings, 0.0);
                for (const auto& l : lights) {
                    const glm::dvec3 offset = glm::dvec3(l.position) - eye;
                    const double cosine = glm::dot(glm::normalize(offset), -towards);
                    const int ring = std::min(int((1.0 - cosine) / (1.0 - cos_edge) * rings), rings - 1);
                    weights[static_cast<std::size_t>(ring)] += 1.0 / glm::dot(offset, offset) / count;
                }
                for (std::size_t r = 0; r < rings; ++r) means[r].add(weights[r]);
            }
            for (const Mean& mean : means) {
                EXPECT_NEAR(mean.value() / expected, 1.0, 0.02) << distance;
                EXPECT_LT(mean.standard_errors_from(expected), 6.0)
                    << distance;  // Student, 99 degrees: a chance of 3e-8
            }
        }
    }
}

TEST(SphereLights, GiveTheExactIrradianceAtADistance) {
    const Sphere sphere{V(0.0f, 0.0f, 0.0f), 1.0f, intensity_of(1.0f, V(2.0f, 3.0f, 0.0f))};
    const auto lights = lights_of(sphere, 16384);
    for (const float d : {1.2f, 2.0f, 10.0f, 1000.0f}) {
        // A facing plane gets pi L (R/d)^2 = I / d^2 from a whole sphere above its horizon.
        glm::dvec3 sum(0.0);
        for (const auto& l : lights) {
            const Incidence arriving = incidence(l, V(0.0f, 0.0f, d));
            sum += arriving.geometric * std::max(0.0, -double(arriving.to_light.z)) * glm::dvec3(l.intensity);
        }
        const double scale = std::numbers::pi / (double(d) * double(d));
        EXPECT_NEAR(sum.x / (2.0 * scale), 1.0, d < 2.0f ? 0.01 : 1e-3) << d;
        EXPECT_NEAR(sum.y / (3.0 * scale), 1.0, d < 2.0f ? 0.01 : 1e-3) << d;
        EXPECT_EQ(sum.z, 0.0);
    }
}

/// The unit sphere, or near enough: a regular grid of longitudes and latitudes, facing outwards.
std::vector<EmissiveTriangle<V>> triangulated(const Sphere& sphere, const V& radiance, int rows) {
    const auto at = [&](int i, int j) {
        const double theta = std::numbers::pi * j / rows, phi = std::numbers::pi * i / rows;
        return V(glm::dvec3(sphere.center) + double(sphere.radius) * glm::dvec3(std::sin(theta) * std::cos(phi),
                                                                                std::sin(theta) * std::sin(phi),
                                                                                std::cos(theta)));
    };
    std::vector<EmissiveTriangle<V>> triangles;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < 2 * rows; ++i) {
            triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1), radiance});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j), radiance});
        }
    }
    return triangles;
}

/// Shadow rays that end at the sphere.
struct SphereShadows {
    const Occluders& occluders;
    const Sphere& sphere;

    template <class R, Light L>
    bool operator()(const R& receiver, const L& light) const {
        const V end = shadow_end(sphere, receiver.shadow_origin, light.position);
        return !occluders.block(receiver.shadow_origin, end, false);
    }
};

TEST(SphereLights, EqualTheirTriangulatedTwinShadowsIncluded) {
    const V radiance(1.0f, 0.5f, 2.0f);
    const Sphere sphere{V(0.0f, 0.0f, 3.0f), 0.8f, intensity_of(0.8f, radiance)};
    const auto points = lights_of(sphere, 4096);
    const auto triangles = triangulated(sphere, radiance, 64);
    const auto twins = area_lights(EmissiveTriangles<V>(triangles), 16384);

    Occluders screen;  // half of the way up, over x > 0.1
    screen.add_triangle({0.1, -10.0, 1.0}, {0.1, 10.0, 1.0}, {20.0, 0.0, 1.0});
    // Something inside the sphere: shadows only rays that do not end at its surface.
    Occluders with_core = screen;
    with_core.add_sphere(glm::dvec3(sphere.center), 0.5);

    // The triangulated sphere shadows its own far side: a sphere a little smaller does.
    Occluders with_body = screen;
    with_body.add_sphere(glm::dvec3(sphere.center), 0.79);
    const LightTree sphere_tree(points);
    const LightTree twin_tree(twins);
    for (const V& at : {V(-1.0f, 0.0f, 0.0f), V(0.1f, 0.2f, 0.0f), V(0.3f, 0.0f, 0.5f), V(-3.0f, 0.5f, 1.0f)}) {
        const Receiver receiver(at, Lambert<V>{{0.0f, 0.0f, 1.0f}, V(1.0f)});
        const V a = exhaustive(sphere_tree, receiver, SphereShadows{with_core, sphere}).radiance;
        const V b = exhaustive(twin_tree, receiver, ScalarOccluders{with_body}).radiance;
        const V lit = exhaustive(sphere_tree, receiver, AlwaysVisible{}).radiance;
        ASSERT_GT(a.x, 0.0f);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / lit[c], b[c] / lit[c], 0.01f) << at.x;
    }
}

TEST(ShadowEnd, IsTheNearPointOfTheSphere) {
    const Sphere sphere{V(0.0f, 0.0f, 5.0f), 1.0f, V(1.0f)};
    for (const auto& l : lights_of(sphere, 500)) {
        const V end = shadow_end(sphere, V(0.2f, -0.1f, 0.0f), l.position);
        EXPECT_NEAR(glm::distance(end, sphere.center), 1.0f, 1e-5f);
        EXPECT_LT(end.z, l.position.z);
        const V along = glm::normalize(end - V(0.2f, -0.1f, 0.0f));
        EXPECT_NEAR(glm::dot(along, glm::normalize(l.position - V(0.2f, -0.1f, 0.0f))), 1.0f, 1e-6f);
    }
    EXPECT_EQ(shadow_end(sphere, V(0.0f, 0.5f, 5.0f), V(0.0f, 0.0f, 5.5f)), V(0.0f, 0.5f, 5.0f)) << "from inside";
    const VisibilityQuery query{V(0.0f), 1, V(0.0f, 0.0f, 5.5f), 2, 3, false};
    const VisibilityQuery shorter = ending_at(sphere, query);
    EXPECT_EQ(shorter.to, V(0.0f, 0.0f, 4.0f));
    EXPECT_EQ(shorter.light, 2u);
}

TEST(SphereLights, KnowTheirSphereAndKeepItsPower) {
    const std::vector<Sphere> spheres{{V(0.0f), 1.0f, V(1.0f)}, {V(5.0f), 0.1f, V(2.0f, 0.0f, 7.0f)}};
    const auto lights = sphere_lights(std::span<const Sphere>(spheres), 33);
    ASSERT_EQ(lights.size(), 66u);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        EXPECT_EQ(lights[i].sphere, i / 33);
        const Sphere& sphere = spheres[i / 33];
        EXPECT_LE(glm::distance(lights[i].position, sphere.center), sphere.radius * 1.00001f);
        if (i >= 33) sum += glm::dvec3(lights[i].intensity);
    }
    EXPECT_NEAR(sum.z, 7.0, 1e-5);
}

std::string refusal(const Sphere& sphere) {
    try {
        const std::vector<Sphere> spheres{{V(0.0f), 1.0f, V(1.0f)}, sphere};
        sphere_lights(std::span<const Sphere>(spheres), 4);
    } catch (const invalid_input& e) { return e.what(); }
    return "";
}

TEST(SphereLights, RefuseWhatIsNoSphere) {
    using testing::HasSubstr;
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal({V(0.0f), 0.0f, V(1.0f)}), HasSubstr("spherical light 1: radius 0.000000"));
    EXPECT_THAT(refusal({V(0.0f), nan, V(1.0f)}), HasSubstr("radius"));
    EXPECT_THAT(refusal({V(0.0f, nan, 0.0f), 1.0f, V(1.0f)}), HasSubstr("center"));
    EXPECT_THAT(refusal({V(0.0f), 1.0f, V(1.0f, -1.0f, 1.0f)}), HasSubstr("intensity -1.000000"));
    EXPECT_EQ(refusal({V(0.0f), 1.0f, V(1.0f)}), "");
}

}  // namespace
}  // namespace lightcuts::test
