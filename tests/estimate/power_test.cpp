#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/power.hpp>
#include "support/scene.hpp"
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

TEST(PowerDistribution, HasProbabilitiesThatSumToOneAndFollowTheIntensities) {
    Room<V> room(1);
    auto omni = room.omni(200);
    omni[0].intensity = omni[9].intensity = omni[199].intensity = V(0.0f);
    const auto spot = room.spot(100);
    const LightTree a(omni);
    const LightTree b(spot);
    const PowerDistribution distribution(LightForest(a, b));
    double total = 0.0;
    for (const auto& l : omni) total += channel_sum(l.intensity);
    for (const auto& l : spot) total += channel_sum(l.intensity);

    // Walk over [0, 1) from light to light.
    double u = 0.0, sum = 0.0;
    std::size_t lights = 0;
    while (u < 1.0 - 1e-12) {
        const auto choice = distribution.choose(u + 1e-14);
        const double power = choice.kind == 0 ? channel_sum(omni[choice.light].intensity)
                                              : channel_sum(spot[choice.light].intensity);
        EXPECT_GT(power, 0.0);
        EXPECT_NEAR(choice.probability, power / total, 1e-12);
        sum += choice.probability;
        u += choice.probability;
        ++lights;
        ASSERT_LE(lights, 300u);
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_EQ(lights, 297u) << "each lit light once, no dark one";
}

TEST(PowerDistribution, ChoosesALitLightAtEitherEnd) {
    std::vector<OmniLight<float>> lights(5);
    lights[1].intensity = 1.0f;
    lights[3].intensity = 3.0f;
    const LightTree tree(lights);
    const PowerDistribution distribution{LightForest(tree)};
    EXPECT_EQ(distribution.choose(0.0).light, 1u);
    EXPECT_EQ(distribution.choose(0.2499).light, 1u);
    EXPECT_EQ(distribution.choose(0.2501).light, 3u);
    EXPECT_EQ(distribution.choose(1.0).light, 3u) << "rounding may bring u to 1";
    EXPECT_EQ(distribution.choose(0.5).probability, 0.75);
}

TEST(PowerSampling, IsUnbiased) {
    Room<float> room(2);
    const auto omni = room.omni(100);
    const auto distant = room.distant(20);
    const LightTree a(omni);
    const LightTree b(distant);
    const LightForest forest(a, b);
    const PowerDistribution distribution(forest);
    const Occluders occluders = room.occluders();
    const ScalarOccluders oracle{occluders};
    EstimateScratch<float> scratch;
    for (const auto& receiver : room.diffuse_receivers(3)) {
        const double exact = static_cast<double>(exhaustive(forest, receiver, oracle, scratch).radiance);
        for (const std::uint32_t samples : {1u, 8u}) {
            Mean mean;
            for (std::uint64_t seed = 0; seed < 20000; ++seed) {
                mean.add(static_cast<double>(
                    power_sampling(forest, distribution, receiver, oracle, samples, seed, scratch).radiance));
            }
            EXPECT_LT(mean.standard_errors_from(exact), one_in_a_million) << mean.value() << " against " << exact;
        }
    }
}

TEST(PowerSampling, DependsOnSeedAndReceiverOnly) {
    Room<V> room(3);
    const auto lights = room.omni(100);
    const LightTree tree(lights);
    const LightForest forest(tree);
    const PowerDistribution distribution(forest);
    const Occluders occluders = room.occluders();
    EstimateScratch<V> scratch;
    const auto receivers = room.diffuse_receivers(2);
    const auto by = [&](std::size_t i, std::uint64_t seed) {
        return power_sampling(forest, distribution, receivers[i], ScalarOccluders{occluders}, 16, seed, scratch);
    };
    const auto streamed = power_sampling(forest, distribution, receivers[0], BatchedOccluders{occluders}, 16, 5,
                                         scratch);
    EXPECT_EQ(by(0, 5).radiance, streamed.radiance);
    EXPECT_EQ(by(0, 5).queries, streamed.queries);
    EXPECT_EQ(by(0, 5).radiance, by(0, 5).radiance);
    EXPECT_NE(by(0, 5).radiance, by(0, 6).radiance);
    EXPECT_LE(by(0, 5).queries, 16u);
}

TEST(PowerSampling, OfDarknessIsBlack) {
    const std::vector<OmniLight<>> dark(3);
    const LightTree tree(dark);
    const LightForest forest(tree);
    const PowerDistribution distribution(forest);
    EXPECT_TRUE(distribution.empty());
    EstimateScratch<V> scratch;
    const Receiver receiver(V(0.0f), Lambert<V>{{0.0f, 0.0f, 1.0f}, V(1.0f)});
    EXPECT_EQ(power_sampling(forest, distribution, receiver, AlwaysVisible{}, 8, 1, scratch).radiance, V(0.0f));
}

}  // namespace
}  // namespace lightcuts::test
