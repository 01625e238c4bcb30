#include <lightcuts/visibility/medium.hpp>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <lightcuts/bound/attenuated.hpp>
#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/shading/transfer.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

static_assert(BoundedMedium<UniformMedium>);

constexpr AlwaysVisible nothing{};

/// Largest distance of shadow origins in `Room`.
constexpr float shadow_offset = 2e-4f;

TEST(UniformMedium, AttenuatesByTheWayInside) {
    const UniformMedium fog(0.5f, {V(0.0f), V(2.0f)});
    EXPECT_FLOAT_EQ(fog.transmittance(V(1.0f, 1.0f, 1.0f), V(1.5f, 1.0f, 1.0f)), std::exp(-0.25f));
    EXPECT_FLOAT_EQ(fog.transmittance(V(-9.0f, 1.0f, 1.0f), V(9.0f, 1.0f, 1.0f)), std::exp(-1.0f));
    EXPECT_FLOAT_EQ(fog.transmittance(V(-9.0f, 3.0f, 1.0f), V(9.0f, 3.0f, 1.0f)), 1.0f);
    EXPECT_FLOAT_EQ(fog.transmittance_to_infinity(V(1.0f, 1.0f, 1.0f), V(0.0f, -1.0f, 0.0f)), std::exp(-0.5f));
    EXPECT_FLOAT_EQ(fog.transmittance(V(1.0f), V(1.0f)), 1.0f);
    EXPECT_EQ(UniformMedium().transmittance(V(0.0f), V(1e9f)), 1.0f);
    const UniformMedium wall(1e6f, {V(0.0f), V(2.0f)});
    EXPECT_EQ(wall.transmittance(V(0.5f), V(1.5f)), 0.0f);
}

TEST(UniformMedium, BoundIsAtLeastTheTransmittance) {
    Random random(1);
    for (int i = 0; i < 100'000; ++i) {
        const UniformMedium fog(static_cast<float>(random.decades(-3.0, 3.0)), {V(-1.0f), V(1.0f)});
        Box a, b;
        const glm::dvec3 from = random.in_box({-1, -1, -1}, {1, 1, 1}), to = random.in_box({-1, -1, -1}, {1, 1, 1});
        const double size = random.decades(-6.0, 0.3);
        std::vector<V> starts, ends;
        for (int k = 0; k < 3; ++k) {
            starts.push_back(V(from + size * random.on_sphere()));
            ends.push_back(V(to + size * random.on_sphere()));
            a = merge(a, box_of(starts.back()));
            b = merge(b, box_of(ends.back()));
        }
        const float bound = fog.upper_bound(a, b);
        for (const V& s : starts) {
            for (const V& e : ends) ASSERT_LE(fog.transmittance(s, e), bound);
        }
    }
}

/// Of a box of receivers, with shadow origins off their positions.
TEST(AttenuatedBounds, HoldForBoxesOfReceivers) {
    using Cluster = LightCluster<OmniLight<V>>;
    Random random(2);
    for (int i = 0; i < 20'000; ++i) {
        const UniformMedium fog(static_cast<float>(random.decades(-2.0, 3.0)), {V(-1.0f), V(1.0f)});
        const float offset = static_cast<float>(random.decades(-6.0, -1.0));
        const AttenuatedBounds bounds(fog, offset);
        Cluster cluster = cluster_of(OmniLight<V>{V(random.in_box({-1, -1, -1}, {1, 1, 1})), V(1.0f), {}});
        std::vector<OmniLight<V>> lights{{cluster.box.lo, V(1.0f), {}}};
        for (int k = 0; k < 2; ++k) {
            lights.push_back({lights[0].position + V(0.3 * random.on_sphere()), V(1.0f), {}});
            cluster = merge_extents(cluster, cluster_of(lights.back()));
        }
        Box box;
        std::vector<Receiver<Lambert<V>>> receivers;
        const glm::dvec3 middle = random.in_box({-1, -1, -1}, {1, 1, 1}), normal = random.on_sphere();
        for (std::uint32_t k = 0; k < 3; ++k) {
            const V p(middle + 0.2 * random.on_sphere());
            receivers.push_back({p, Lambert<V>{V(normal), V(1.0f)}, p + offset * V(normal), k});
            box = merge(box, box_of(p));
        }
        const V bound = bounds.quick(receivers[0].material, cluster, box);
        const ThroughMedium<AlwaysVisible, UniformMedium> see(nothing, fog);
        for (const auto& r : receivers) {
            for (const auto& l : lights) {
                ASSERT_LE(unshadowed_transfer(r, l).x * static_cast<float>(see(r, l)), bound.x) << i;
            }
        }
    }
}

TEST(ThroughMedium, CutsAreWithinTheirBoundsAndAgreeForBothKindsOfOracle) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Random random(seed);
        Room<V> room(seed);
        const auto lights = room.oriented(300);
        const LightTree tree(lights);
        const auto occluders = room.occluders();
        const ScalarOccluders one{occluders};
        const BatchedOccluders many{occluders};
        const UniformMedium fog(static_cast<float>(random.decades(-2.0, 1.5)), {V(-5.0f), V(5.0f)});
        const ThroughMedium one_in_fog(one, fog);
        const ThroughMedium many_in_fog(many, fog);
        const AttenuatedBounds<UniformMedium, TwoStageBounds> policy(fog, shadow_offset);
        for (const auto& receiver : room.glossy_receivers(10)) {
            const LightcutOptions options{.error_ratio = 0.05f, .max_cut = 0, .exhaustive_below = 0};
            const auto cut = shade(tree, receiver, one_in_fog, options, policy);
            const auto batched = shade(tree, receiver, many_in_fog, options, policy);
            const auto unbounded = shade(tree, receiver, one_in_fog, options);
            EXPECT_EQ(cut.radiance, batched.radiance);
            EXPECT_LE(cut.cut_size, unbounded.cut_size);
            const auto truth = exhaustive(tree, receiver, one_in_fog);
            for (int c = 0; c < 3; ++c) {
                EXPECT_LE(std::abs(cut.radiance[c] - truth.radiance[c]),
                          cut.error_bound[c] + 2e-5f * truth.radiance[c]);
            }
        }
    }
}

}  // namespace
}  // namespace lightcuts::test
