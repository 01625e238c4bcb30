#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/bound/policy.hpp>
#include <lightcuts/light/directional.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/light/spot.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/phong.hpp>
#include <lightcuts/shading/transfer.hpp>
#include "support/random.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
constexpr float infinity = std::numeric_limits<float>::infinity();
const Lambert<V> upward{{0.0f, 0.0f, 1.0f}, V(1.0f)};
constexpr float by_pi = 0.31830988618f;

static_assert(BoundPolicy<SeparateBounds, Lambert<V>, LightCluster<OmniLight<>>> &&
              !TwoStagePolicy<SeparateBounds, Lambert<V>, LightCluster<OmniLight<>>>);
static_assert(BoundPolicy<TwoStageBounds, Lambert<V>, LightCluster<OmniLight<>>> &&
              TwoStagePolicy<TwoStageBounds, Lambert<V>, LightCluster<OmniLight<>>>);

template <Light L>
LightCluster<L> cluster_over(const V& lo, const V& hi) {
    LightCluster<L> cluster;
    cluster.box = {lo, hi};
    cluster.intensity = V(1.0f);
    if constexpr (OrientedLight<L>) cluster.cone = cone_of({0.0f, 0.0f, -1.0f});
    return cluster;
}

template <class M, Light L>
void expect_bounds(const M& material, const LightCluster<L>& cluster, float expected, float looseness = 1.001f) {
    for (const float bound : {TwoStageBounds{}.quick(material, cluster, box_of(V(0.0f))).x,
                              TwoStageBounds{}.tight(material, cluster, box_of(V(0.0f))).x,
                              SeparateBounds{}.quick(material, cluster, box_of(V(0.0f))).x}) {
        if (expected == 0.0f || expected == infinity) {
            EXPECT_EQ(bound, expected);
        } else {
            EXPECT_GE(bound, expected);
            EXPECT_LE(bound, expected * looseness);
        }
    }
}

TEST(Bound, OfAPointClusterIsItsLight) {
    expect_bounds(upward, cluster_over<OmniLight<>>({0.0f, 0.0f, 2.0f}, {0.0f, 0.0f, 2.0f}), by_pi / 4.0f);
    expect_bounds(upward, cluster_over<OmniLight<>>({0.0f, 3.0f, 4.0f}, {0.0f, 3.0f, 4.0f}), by_pi * 0.8f / 25.0f);
    expect_bounds(upward, cluster_over<OrientedPointLight<>>({0.0f, 3.0f, 4.0f}, {0.0f, 3.0f, 4.0f}),
                  by_pi * 0.64f / 25.0f);
    expect_bounds(upward, cluster_over<DistantLight<>>({0.0f, 0.6f, 0.8f}, {0.0f, 0.6f, 0.8f}), by_pi * 0.8f);
}

// The largest cos / d^2 over a rectangle above the receiver is at its nearest point, over a wall beside it at
// height 1 / sqrt(2) of the distance.
TEST(Bound, OfABoxIsNearlyTheLargestOverItsPoints) {
    expect_bounds(upward, cluster_over<OmniLight<>>({-1.0f, -1.0f, 2.0f}, {1.0f, 1.0f, 3.0f}), by_pi / 4.0f, 1.01f);
    const float best = 1.0f / std::sqrt(2.0f);
    const float wall = by_pi * best / std::pow(1.0f + best * best, 1.5f);
    const auto cluster = cluster_over<OmniLight<>>({1.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 2.0f});
    EXPECT_NEAR(TwoStageBounds{}.tight(upward, cluster, box_of(V(0.0f))).x, wall, 0.005f * wall);
    EXPECT_GE(TwoStageBounds{}.tight(upward, cluster, box_of(V(0.0f))).x, wall);
    EXPECT_GE(TwoStageBounds{}.quick(upward, cluster, box_of(V(0.0f))).x, wall);
}

TEST(Bound, IsExactlyZeroBehindTheReceiverBehindTheEmittersAndInTheirPlanes) {
    expect_bounds(upward, cluster_over<OmniLight<>>({-1.0f, -1.0f, -3.0f}, {1.0f, 1.0f, -1.0f}), 0.0f);
    expect_bounds(upward, cluster_over<OmniLight<>>({-1.0f, -1.0f, -3.0f}, {1.0f, 1.0f, 0.0f}), 0.0f);
    expect_bounds(upward, cluster_over<OmniLight<>>({-1.0f, -1.0f, 0.0f}, {1.0f, 1.0f, 0.0f}), 0.0f);
    auto away = cluster_over<OrientedPointLight<>>({-1.0f, -1.0f, 2.0f}, {1.0f, 1.0f, 3.0f});
    away.cone = cone_of({0.0f, 0.0f, 1.0f});
    expect_bounds(upward, away, 0.0f);
    // A cone of axes of a tenth of a radian about it still faces away.
    away.cone = merge(cone_of({0.0f, 0.0f, 1.0f}), V(std::sin(0.1f), 0.0f, std::cos(0.1f)));
    away.box = {{-0.1f, -0.1f, 2.0f}, {0.1f, 0.1f, 3.0f}};
    expect_bounds(upward, away, 0.0f);
    expect_bounds(upward, cluster_over<DistantLight<>>({-0.1f, 0.0f, -1.0f}, {0.1f, 0.6f, -0.8f}), 0.0f);
}

TEST(Bound, IsInfiniteWhereALightMayTouchTheReceiver) {
    expect_bounds(upward, cluster_over<OmniLight<>>({-1.0f, -1.0f, -1.0f}, {1.0f, 1.0f, 1.0f}), infinity);
    expect_bounds(upward, cluster_over<OmniLight<>>({0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}), infinity);
    expect_bounds(upward, cluster_over<OrientedPointLight<>>({0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}), infinity);
    const ModifiedPhong<V> glossy({0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, V(1.0f, 0.0f, 1.0f), 10.0f);
    const V bound = TwoStageBounds{}.quick(glossy, cluster_over<OmniLight<>>({-1.0f, -1.0f, -1.0f}, {1.0f, 1.0f, 1.0f}),
                                           box_of(V(0.0f)));
    EXPECT_EQ(bound.x, infinity);
    EXPECT_EQ(bound.y, 0.0f) << "black times infinity is black";
}

TEST(Bound, OfDirectionalLightsDoesNotDependOnTheReceiverPosition) {
    const auto cluster = cluster_over<DistantLight<>>({-0.3f, 0.1f, 0.5f}, {0.2f, 0.6f, 0.9f});
    for (const V& x : {V(0.0f), V(1e20f), V(-3.0f, 0.5f, 0.1f)}) {
        EXPECT_EQ(TwoStageBounds{}.quick(upward, cluster, box_of(x)),
                  TwoStageBounds{}.quick(upward, cluster, box_of(V(0.0f))));
        EXPECT_EQ(TwoStageBounds{}.tight(upward, cluster, box_of(x)),
                  TwoStageBounds{}.tight(upward, cluster, box_of(V(0.0f))));
    }
}

TEST(Bound, FallsWithTheSquaredDistance) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 a = random.in_box({-1.0, -1.0, 0.2}, {1.0, 1.0, 2.0}),
                         b = random.in_box({-1.0, -1.0, 0.2}, {1.0, 1.0, 2.0});
        const V lo(glm::min(a, b)), hi(glm::max(a, b));
        const float at_one = TwoStageBounds{}.tight(upward, cluster_over<OmniLight<>>(lo, hi), box_of(V(0.0f))).x;
        for (const float scale : {0x1p-40f, 0x1p40f}) {
            const float scaled =
                TwoStageBounds{}.tight(upward, cluster_over<OmniLight<>>(lo * scale, hi * scale), box_of(V(0.0f))).x;
            EXPECT_NEAR(scaled * scale * scale, at_one, 1e-5f * at_one);
        }
    }
}

// A material that may not be asked for its bound where the geometry already says zero.
TEST(Bound, AsksTheMaterialOnlyWhereTheGeometryAllows) {
    struct Touchy {
        V evaluate(const V&) const { return V(1.0f); }
        V upper_bound(const OffsetBox&) const {
            ADD_FAILURE();
            return V(1.0f);
        }
    };
    auto away = cluster_over<OrientedPointLight<>>({-1.0f, -1.0f, 2.0f}, {1.0f, 1.0f, 3.0f});
    away.cone = cone_of({0.0f, 0.0f, 1.0f});
    expect_bounds(Touchy{}, away, 0.0f);
}

TEST(EmissionBound, OfASpotIsOneInsideTheConeAndZeroOutside) {
    LightCluster<SpotLight<>> cluster = cluster_of(
        SpotLight<>{{0.0f, 0.0f, 2.0f}, {0.0f, 0.0f, -1.0f}, V(1.0f), {0.9f, 0.8f}});
    expect_bounds(upward, cluster, by_pi / 4.0f);
    cluster.cone = cone_of({1.0f, 0.0f, 0.0f});
    expect_bounds(upward, cluster, 0.0f);
}

TEST(AttenuationBound, IsThatOfTheNearestPoint) {
    using Lamp = OmniLight<V, PolynomialFalloff>;
    LightCluster<Lamp> cluster = merge_extents(cluster_of(Lamp{{0.0f, 0.0f, 2.0f}, V(1.0f), {1.0f, 1.0f, 0.0f}}),
                                               cluster_of(Lamp{{0.0f, 0.0f, 5.0f}, V(1.0f), {0.0f, 2.0f, 1.0f}}));
    // The envelope is 1 / (0 + 1 d + 0 d^2).
    expect_bounds(upward, cluster, by_pi / 2.0f);
    cluster.box.lo = V(-1.0f);
    expect_bounds(upward, cluster, infinity);
}

}  // namespace
}  // namespace lightcuts::test
