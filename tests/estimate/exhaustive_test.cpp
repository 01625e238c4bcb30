#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/estimate/adaptive_splitting.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/power.hpp>
#include <lightcuts/estimate/stochastic_lightcuts.hpp>
#include <lightcuts/estimate/tree_sampling.hpp>
#include <lightcuts/estimate/ward.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

TEST(Exhaustive, IsTheSumOverAllLightsOfAllTrees) {
    Room<V> room(1);
    auto omni = room.omni(1500);  // more than a batch
    omni[17].intensity = V(0.0f);
    const auto distant = room.distant(700);
    const LightTree a(omni);
    const LightTree b(distant);
    const LightForest forest(a, b);
    const Occluders occluders = room.occluders();
    const ScalarOccluders scalar{occluders, 0.25f};
    const BatchedOccluders batched{occluders, 0.25f};
    EstimateScratch<V> scratch;
    for (const auto& receiver : room.glossy_receivers(10)) {
        glm::dvec3 sum(0.0);
        std::uint32_t rays = 0;
        const auto add = [&](const auto& light) {
            const V contribution = unshadowed_transfer(receiver, light) * light.intensity;
            if (contribution == V(0.0f)) return;
            ++rays;
            sum += glm::dvec3(contribution) * static_cast<double>(scalar(receiver, light));
        };
        for (const auto& light : omni) add(light);
        for (const auto& light : distant) add(light);
        const auto result = exhaustive(forest, receiver, scalar, scratch);
        EXPECT_EQ(result.queries, rays);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(result.radiance[c], sum[c], 1e-6 * sum[c]);
        const auto streamed = exhaustive(forest, receiver, batched, scratch);
        EXPECT_EQ(streamed.radiance, result.radiance);
        EXPECT_EQ(streamed.queries, result.queries);
    }
}

TEST(Exhaustive, SendsStreamsOfUpTo1024Rays) {
    struct Streams {
        std::vector<std::size_t>& lengths;
        void many(std::span<const VisibilityQuery> queries, std::span<float> answers) const {
            lengths.push_back(queries.size());
            for (float& a : answers) a = 1.0f;
        }
    };
    const std::vector<OmniLight<>> lights(2500, {{0.0f, 0.0f, 1.0f}, V(1.0f), {}});
    const LightTree tree(lights);
    EstimateScratch<V> scratch;
    std::vector<std::size_t> lengths;
    exhaustive(LightForest(tree), Receiver(V(0.0f), Lambert<V>{{0.0f, 0.0f, 1.0f}, V(1.0f)}), Streams{lengths},
               scratch);
    EXPECT_EQ(lengths, (std::vector<std::size_t>{1024, 1024, 452}));
}

// In double: a naive float sum of ten million tenths is 9 % off.
TEST(Exhaustive, OfManyEqualLightsDoesNotDrift) {
    const std::vector<OmniLight<float>> lights(1000000, {{0.0f, 0.0f, 1.0f}, 0.1f, {}});
    const LightTree tree(lights);
    EstimateScratch<float> scratch;
    const auto result = exhaustive(LightForest(tree), Receiver(V(0.0f), Lambert<float>{{0.0f, 0.0f, 1.0f}, 1.0f}),
                                   AlwaysVisible{}, scratch);
    EXPECT_NEAR(result.radiance, 1e5f * 0.31830988f, 1e-6f * 1e5f);
}

TEST(Exhaustive, TakesATreeAndAsksNothingOfWhatIsAlwaysVisible) {
    Room<V> room(3);
    const auto omni = room.omni(50);
    const LightTree tree(omni);
    EstimateScratch<V> scratch;
    for (const auto& receiver : room.diffuse_receivers(5)) {
        const auto result = exhaustive(tree, receiver, AlwaysVisible{}, scratch);
        EXPECT_EQ(result.queries, 0u);
        EXPECT_EQ(result.radiance, exhaustive(LightForest(tree), receiver).radiance);
        EXPECT_EQ(ward(tree, receiver, AlwaysVisible{}, 0.1f, scratch).queries, 0u);
        EXPECT_EQ(power_sampling(tree, PowerDistribution(tree), receiver, AlwaysVisible{}, 16, 1, scratch).queries, 0u);
        EXPECT_EQ(tree_sampling(tree, receiver, AlwaysVisible{}, 16, 1, scratch).queries, 0u);
        EXPECT_EQ(adaptive_splitting(tree, receiver, AlwaysVisible{}, 0.1f, 16, 1, scratch).queries, 0u);
        EXPECT_EQ(stochastic_lightcuts(tree, receiver, AlwaysVisible{}, 16, 1, scratch).queries, 0u);
    }
}

}  // namespace
}  // namespace lightcuts::test
