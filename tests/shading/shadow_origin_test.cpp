// Thin surfaces that are lit from both sides do not stand in their own light.

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/adaptive_splitting.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/power.hpp>
#include <lightcuts/estimate/ward.hpp>
#include <lightcuts/material/thin_sheet.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
using Leaf = ThinSheet<Lambert<V>, Lambert<V>>;

constexpr V reflectance(0.1f, 0.3f, 0.05f), transmittance(0.2f, 0.6f, 0.1f);

Leaf leaf_facing(const V& normal) {
    return {Lambert<V>{normal, reflectance}, Lambert<V>{-normal, transmittance}, normal};
}

/// A room in which each receiver lies on a leaf of its own, which casts shadows.
struct LeafRoom {
    explicit LeafRoom(std::uint64_t seed) : room(seed) {
        for (const auto& r : room.diffuse_receivers(20)) {
            const glm::dvec3 n(r.material.normal);
            const glm::dvec3 u = glm::normalize(
                glm::cross(n, std::fabs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
            const glm::dvec3 v = glm::cross(n, u), p(r.position);
            for (const double side : {1.0, -1.0}) {
                occluders.add_triangle(p - 0.2 * u, p + 0.2 * u, p + 0.2 * side * v + 0.01 * side * u);
            }
            leaves.push_back({r.position, leaf_facing(r.material.normal), r.shadow_origin, r.id});
        }
    }

    Room<V> room;
    Occluders occluders;
    std::vector<Receiver<Leaf>> leaves;
};

TEST(Leaf, LitFromBehindIsTransmittanceOverPiTimesIrradiance) {
    Occluders blade;
    blade.add_triangle({-5, 0, -5}, {5, 0, -5}, {0, 0, 9});
    const Receiver<Leaf> leaf(V(0.0f), leaf_facing({0.0f, 1.0f, 0.0f}), V(0.0f, 1e-4f, 0.0f));
    const V power(2.0f, 3.0f, 4.0f);
    for (const double x : {0.0, 0.5, 2.0, 8.0}) {
        const std::vector<OmniLight<>> behind{{{static_cast<float>(x), -1.5f, 0.0f}, power, {}}};
        const std::vector<DistantLight<>> sun{{V(0.0f, 0.6f, 0.8f), power}};
        const LightTree near(behind);
        const LightTree far(sun);
        const double d2 = x * x + 2.25;
        const double irradiance = 1.5 / (d2 * std::sqrt(d2)) + 0.6;
        for (int c = 0; c < 3; ++c) {
            const double exact = static_cast<double>(transmittance[c] * power[c]) / std::numbers::pi * irradiance;
            const auto expect = [&](const V& radiance) { EXPECT_NEAR(radiance[c], exact, 1e-5 * exact); };
            expect(shade(LightForest(near, far), leaf, ScalarOccluders{blade}).radiance);
            expect(shade(LightForest(near, far), leaf, BatchedOccluders{blade}).radiance);
            expect(exhaustive(LightForest(near, far), leaf, ScalarOccluders{blade}).radiance);
            expect(exhaustive(LightForest(near, far), leaf, BatchedOccluders{blade}).radiance);
        }
    }
}

TEST(Leaf, UnderLightsOnBothSidesIsTheExhaustiveSumAtRatioZero) {
    LeafRoom scene(21);
    const auto omni = scene.room.omni(150);
    const auto oriented = scene.room.oriented(150);
    const auto distant = scene.room.distant(50);
    const LightTree a(omni);
    const LightTree b(oriented);
    const LightTree c(distant);
    const LightForest lights(a, b, c);
    const ScalarOccluders scalar{scene.occluders};
    const BatchedOccluders batched{scene.occluders};
    EstimateScratch<V> scratch;
    double behind = 0.0, all = 0.0;
    for (const auto& leaf : scene.leaves) {
        // The sum by hand: each side as a receiver of its own.
        const Leaf& m = leaf.material;
        const Receiver top(leaf.position, AboveHorizon{m.reflection, m.geometric_normal}, leaf.shadow_origin);
        const Receiver bottom(leaf.position, AboveHorizon{m.transmission, -m.geometric_normal},
                              leaf.position + (leaf.position - leaf.shadow_origin));
        const V from_behind = exhaustive(lights, bottom, scalar, scratch).radiance;
        const V exact = exhaustive(lights, top, scalar, scratch).radiance + from_behind;
        behind += channel_sum(from_behind);
        all += channel_sum(exact);
        const LightcutOptions every{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0};
        const CutResult<V> cut = shade(lights, leaf, batched, {.max_cut = 0, .exhaustive_below = 0});
        for (int k = 0; k < 3; ++k) {
            const float near = 2e-5f * exact[k];
            EXPECT_NEAR(exhaustive(lights, leaf, scalar, scratch).radiance[k], exact[k], near);
            EXPECT_NEAR(exhaustive(lights, leaf, batched, scratch).radiance[k], exact[k], near);
            EXPECT_NEAR(ward(lights, leaf, scalar, 0.0f, scratch).radiance[k], exact[k], near);
            EXPECT_NEAR(adaptive_splitting(lights, leaf, scalar, 0.0f, 1000, 1, scratch).radiance[k], exact[k], near);
            EXPECT_NEAR(shade(lights, leaf, scalar, every).radiance[k], exact[k], near);
            EXPECT_NEAR(shade(lights, leaf, batched, every).radiance[k], exact[k], near);
            EXPECT_LE(std::fabs(cut.radiance[k] - exact[k]), cut.error_bound[k] + near);
        }
    }
    EXPECT_GT(behind, 0.3 * all);
}

/// Hides all that lies beyond the leaf's plane from where the rays start.
struct OwnPlane {
    template <class R, Light L>
    bool operator()(const R& receiver, const L& light) const {
        return sees(receiver, position_or_direction(light));
    }
protected:
    template <class R>
    static bool is_hidden(const R& receiver, const Box& box) {
        for (int i = 0; i < 8; ++i) {
            const V corner((i & 1) != 0 ? box.lo.x : box.hi.x, (i & 2) != 0 ? box.lo.y : box.hi.y,
                           (i & 4) != 0 ? box.lo.z : box.hi.z);
            if (sees(receiver, corner)) return false;
        }
        return true;
    }

private:
    template <class R>
    static bool sees(const R& receiver, const V& p) {
        const V n = receiver.material.geometric_normal;
        return (glm::dot(n, p - receiver.position) > 0.0f) ==
               (glm::dot(n, receiver.shadow_origin - receiver.position) > 0.0f);
    }
};

struct BoundedOwnPlane : OwnPlane {
    template <class R>
    float upper_bound(const R& receiver, const Box& box) const {
        return is_hidden(receiver, box) ? 0.0f : 1.0f;
    }
};
struct HidingOwnPlane : OwnPlane {
    template <class R>
    bool hides(const R& receiver, const Box& box) const {
        return is_hidden(receiver, box);
    }
};

TEST(Leaf, BoundsOfOraclesAreAskedFromBothSides) {
    LeafRoom scene(22);
    const auto omni = scene.room.omni(400);
    const LightTree tree(omni);
    static_assert(BoundedOracle<BoundedOwnPlane, Receiver<Leaf>, OmniLight<>>);
    static_assert(HidingOracle<HidingOwnPlane, Receiver<Leaf>, OmniLight<>>);
    for (const auto& leaf : scene.leaves) {
        const V exact = exhaustive(tree, leaf, AlwaysVisible{}).radiance;
        const auto expect_right = [&](const auto& oracle) {
            const CutResult<V> cut = shade(tree, leaf, oracle, {.max_cut = 0, .exhaustive_below = 0});
            for (int k = 0; k < 3; ++k) {
                EXPECT_LE(std::fabs(cut.radiance[k] - exact[k]), cut.error_bound[k] + 1e-5f * exact[k]);
                EXPECT_NEAR(cut.radiance[k], exact[k], 0.1f * exact[k]);
            }
        };
        expect_right(BoundedOwnPlane{});
        expect_right(HidingOwnPlane{});
    }
}

}  // namespace
}  // namespace lightcuts::test
