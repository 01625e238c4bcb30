#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

/// Sums of a few hundred floats, rounded in another order.
constexpr double order_of_summation = 2e-5;

template <class Forest, class M>
void expect_error_within_bound(const Forest& forest, const std::vector<Receiver<M>>& receivers,
                               const Occluders& occluders, float through, const LightcutOptions& options) {
    const BatchedOccluders batched{occluders, through};
    const ScalarOccluders scalar{occluders, through};
    EstimateScratch<V> scratch;
    for (const auto& receiver : receivers) {
        const Estimate<V> exact = exhaustive(forest, receiver, scalar, scratch);
        Lightcut cut(forest, receiver, batched, options);
        while (cut.step()) {}
        const CutResult<V> result = cut.result();
        const std::string where = "receiver " + std::to_string(receiver.id);
        for (int c = 0; c < 3; ++c) {
            const double error = std::fabs(static_cast<double>(result.radiance[c]) -
                                           static_cast<double>(exact.radiance[c]));
            EXPECT_LE(error, static_cast<double>(result.error_bound[c]) +
                                 order_of_summation * static_cast<double>(exact.radiance[c]))
                << where << ", channel " << c;
        }
        std::uint32_t nodes = 0;
        cut.for_each([&](const auto&) { ++nodes; });
        EXPECT_EQ(result.cut_size, nodes) << where;
        EXPECT_LE(result.queries, result.cut_size) << where;
        if (options.max_cut > 0) {
            EXPECT_LE(result.cut_size, std::max(options.max_cut, forest.root_count())) << where;
        }
        if (result.stop == StopReason::converged) {
            double largest = 0.0;  // bound over total, in any channel
            cut.for_each([&](const auto& node) {
                for (int c = 0; c < 3; ++c) {
                    if (node.bound[c] == 0.0f) continue;
                    largest = std::max(largest,
                                       static_cast<double>(node.bound[c]) /
                                           static_cast<double>(result.radiance[c] + 0.1f * options.adaptation));
                }
            });
            EXPECT_LE(largest, 1.00001 * static_cast<double>(options.error_ratio)) << where;
        } else {
            EXPECT_EQ(result.stop, StopReason::limit) << where;
            EXPECT_EQ(result.cut_size, std::max(options.max_cut, forest.root_count())) << where;
        }
        if (options.error_ratio == 0.0f && options.max_cut == 0) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_EQ(result.error_bound[c], 0.0f) << where;
                EXPECT_NEAR(result.radiance[c], exact.radiance[c],
                            order_of_summation * static_cast<double>(exact.radiance[c]))
                    << where;
            }
            // Nodes below which nothing can contribute need no rays, and lights that contribute need one each.
            EXPECT_EQ(result.queries, exact.queries) << where;
        }

        // One light at a time, the oracle's answers are the same, so is every bit of the result.
        const CutResult<V> one_by_one = shade(forest, receiver, scalar, options);
        EXPECT_EQ(one_by_one.radiance, result.radiance) << where;
        EXPECT_EQ(one_by_one.error_bound, result.error_bound) << where;
        EXPECT_EQ(one_by_one.cut_size, result.cut_size) << where;
        EXPECT_EQ(one_by_one.queries, result.queries) << where;
    }
}

template <class Forest>
void expect_errors_within_bounds(const Forest& forest, Room<V>& room) {
    const Occluders occluders = room.occluders();
    for (const LightcutOptions& options :
         {LightcutOptions{.exhaustive_below = 0}, LightcutOptions{.error_ratio = 0.1f, .exhaustive_below = 0},
          LightcutOptions{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0},
          LightcutOptions{.error_ratio = 0.01f, .max_cut = 40, .exhaustive_below = 0}, LightcutOptions{.max_cut = 1},
          LightcutOptions{.max_cut = 2}, LightcutOptions{.exhaustive_below = 0, .adaptation = 0.05f},
          LightcutOptions{.error_ratio = 0.05f, .exhaustive_below = 0, .round_fraction = 1.0}}) {
        expect_error_within_bound(forest, room.diffuse_receivers(20), occluders, 0.0f, options);
        expect_error_within_bound(forest, room.glossy_receivers(20), occluders, 0.3f, options);
    }
}

TEST(CutError, IsWithinItsBoundForOmniLights) {
    Room<V> room(1);
    const auto lights = room.omni(700);
    const LightTree tree(lights);
    expect_errors_within_bounds(LightForest(tree), room);
}

TEST(CutError, IsWithinItsBoundForOrientedLights) {
    Room<V> room(2);
    const auto lights = room.oriented(700);
    const LightTree tree(lights);
    expect_errors_within_bounds(LightForest(tree), room);
}

TEST(CutError, IsWithinItsBoundForSpotLights) {
    Room<V> room(3);
    const auto lights = room.spot(700);
    const LightTree tree(lights);
    expect_errors_within_bounds(LightForest(tree), room);
}

TEST(CutError, IsWithinItsBoundForDirectionalLights) {
    Room<V> room(4);
    const auto lights = room.distant(700);
    const LightTree tree(lights);
    expect_errors_within_bounds(LightForest(tree), room);
}

TEST(CutError, IsWithinItsBoundForSeveralTreesRefinedAsOne) {
    Room<V> room(5);
    const auto omni = room.omni(300);
    const auto oriented = room.oriented(300);
    const auto spot = room.spot(100);
    const auto distant = room.distant(50);
    const LightTree a(omni, {.representatives = 4});
    const LightTree b(oriented, {.representatives = 4});
    const LightTree c(spot);
    const LightTree d(distant);
    expect_errors_within_bounds(LightForest(a, b, c, d), room);
}

TEST(CutError, IsWithinItsBoundUnderSeparateBounds) {
    Room<V> room(6);
    const auto lights = room.oriented(500);
    const LightTree tree(lights);
    const LightForest forest(tree);
    const Occluders occluders = room.occluders();
    const ScalarOccluders oracle{occluders};
    EstimateScratch<V> scratch;
    for (const auto& receiver : room.glossy_receivers(50)) {
        const Estimate<V> exact = exhaustive(forest, receiver, oracle, scratch);
        const CutResult<V> result = shade(forest, receiver, oracle, {.error_ratio = 0.05f, .exhaustive_below = 0},
                                          SeparateBounds{});
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(std::fabs(static_cast<double>(result.radiance[c]) - static_cast<double>(exact.radiance[c])),
                      static_cast<double>(result.error_bound[c]) +
                          order_of_summation * static_cast<double>(exact.radiance[c]));
        }
    }
}

// A smaller ratio, a larger cut, a smaller error bound.
TEST(CutError, FallsWithTheErrorRatio) {
    Room<V> room(7);
    const auto lights = room.omni(2000);
    const LightTree tree(lights);
    for (const auto& receiver : room.diffuse_receivers(10)) {
        std::uint32_t size = 0;
        float bound = 1e30f;
        for (const float ratio : {0.2f, 0.1f, 0.05f, 0.02f, 0.01f, 0.005f}) {
            const CutResult<V> result = shade(tree, receiver, AlwaysVisible{},
                                              {.error_ratio = ratio, .max_cut = 0, .exhaustive_below = 0});
            EXPECT_GE(result.cut_size, size);
            EXPECT_LE(result.error_bound.x, bound);
            size = result.cut_size;
            bound = result.error_bound.x;
        }
    }
}

}  // namespace
}  // namespace lightcuts::test
