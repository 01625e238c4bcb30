#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/ward.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

TEST(Ward, AtThresholdZeroIsTheExhaustiveSum) {
    Room<V> room(1);
    const auto omni = room.omni(300);
    const auto oriented = room.oriented(300);
    const LightTree a(omni);
    const LightTree b(oriented);
    const LightForest forest(a, b);
    const Occluders occluders = room.occluders();
    EstimateScratch<V> scratch;
    for (const float through : {0.0f, 0.4f}) {
        const ScalarOccluders scalar{occluders, through};
        const BatchedOccluders batched{occluders, through};
        for (const auto& receiver : room.glossy_receivers(20)) {
            const auto exact = exhaustive(forest, receiver, scalar, scratch);
            const auto one = ward(forest, receiver, scalar, 0.0f, scratch);
            const auto many = ward(forest, receiver, batched, 0.0f, scratch);
            EXPECT_EQ(one.radiance, many.radiance);
            EXPECT_EQ(one.queries, many.queries);
            EXPECT_EQ(one.queries, exact.queries);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(one.radiance[c], exact.radiance[c], 1e-6f * exact.radiance[c]);
        }
    }
}

// What is left after the bright lights, all of them shadowed, is found although it is beyond the digits of their sum.
TEST(Ward, AtThresholdZeroFindsFaintLightsBehindShadowedBrightOnes) {
    std::vector<OmniLight<float>> lights;
    for (int i = 0; i < 16; ++i) lights.push_back({{0.0f, 0.0f, 1.0f}, 1e20f, {}});
    for (int i = 0; i < 100; ++i) lights.push_back({{0.0f, 1.0f, 1.0f}, 1.0f, {}});
    const LightTree tree(lights);
    const auto faint_only = [](const auto&, const OmniLight<float>& light) { return light.intensity < 2.0f; };
    const Receiver receiver(V(0.0f), Lambert<float>{{0.0f, 0.0f, 1.0f}, 1.0f});
    EstimateScratch<float> scratch;
    const auto exact = exhaustive(LightForest(tree), receiver, faint_only, scratch);
    EXPECT_GT(exact.radiance, 5.0f);
    const auto result = ward(LightForest(tree), receiver, faint_only, 0.0f, scratch);
    EXPECT_NEAR(result.radiance, exact.radiance, 1e-6f * exact.radiance);
}

TEST(Ward, TestsFewerLightsForLargerThresholds) {
    Room<V> room(2);
    const auto lights = room.omni(2000);
    const LightTree tree(lights);
    const LightForest forest(tree);
    const Occluders occluders = room.occluders();
    const ScalarOccluders oracle{occluders};
    EstimateScratch<V> scratch;
    for (const auto& receiver : room.diffuse_receivers(20)) {
        const auto exact = exhaustive(forest, receiver, oracle, scratch);
        std::uint32_t queries = exact.queries;
        for (const float threshold : {0.05f, 0.2f, 1.0f}) {
            const auto result = ward(forest, receiver, oracle, threshold, scratch);
            EXPECT_LE(result.queries, queries);
            queries = result.queries;
            if (exact.radiance.x == 0.0f) continue;
            // The rest could add at most the threshold to what was found, and takes away nothing.
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(result.radiance[c], exact.radiance[c], 3.0f * threshold * exact.radiance[c]);
        }
    }
}

TEST(Ward, AssumesTheRestToBeAsVisibleAsWhatItTested) {
    std::vector<OmniLight<float>> lights;
    for (int i = 0; i < 16; ++i) lights.push_back({{0.0f, 0.0f, 1.0f}, 8.0f, {}});
    for (int i = 0; i < 16; ++i) lights.push_back({{0.0f, 0.0f, 1.0f}, 1.0f, {}});
    const LightTree tree(lights);
    const auto half = [](const auto&, const auto&) { return 0.5f; };
    EstimateScratch<float> scratch;
    const auto result = ward(LightForest(tree), Receiver(V(0.0f), Lambert<float>{{0.0f, 0.0f, 1.0f}, 1.0f}), half, 0.5f,
                             scratch);
    EXPECT_EQ(result.queries, 16u);
    EXPECT_NEAR(result.radiance, 0.5f * 144.0f * 0.31830988f, 1e-5f * 50.0f);
}

TEST(Ward, OfNoLightsIsBlack) {
    const std::vector<OmniLight<>> none;
    const LightTree tree(none);
    EstimateScratch<V> scratch;
    const auto result = ward(LightForest(tree), Receiver(V(0.0f), Lambert<V>{{0.0f, 0.0f, 1.0f}, V(1.0f)}),
                             AlwaysVisible{}, 0.1f, scratch);
    EXPECT_EQ(result.radiance, V(0.0f));
    EXPECT_EQ(result.queries, 0u);
}

}  // namespace
}  // namespace lightcuts::test
