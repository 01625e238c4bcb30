#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/estimate/resampled.hpp>
#include "estimate/unbiasedness.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

template <class Forest, class R, class Oracle, class Scratch>
auto by_power(const Forest& forest, const R& receiver, const Oracle& oracle, const ResamplingOptions& options,
              std::uint64_t seed, Scratch& scratch) {
    return resampled_sampling(forest, PowerDistribution(forest), receiver, oracle, options, seed, scratch);
}

TEST(ResampledSampling, IsUnbiased) {
    for (const ResamplingOptions options : {ResamplingOptions{1, 8}, ResamplingOptions{4, 3}}) {
        expect_unbiased(
            [&](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed, auto& scratch) {
                return resampled_sampling(forest, receiver, oracle, options, seed, scratch);
            });
    }
}

// Half of the candidates are behind their receivers, or face away, and contribute nothing.
TEST(ResampledSampling, IsUnbiasedByPower) {
    for (const ResamplingOptions options : {ResamplingOptions{1, 8}, ResamplingOptions{4, 3}}) {
        expect_unbiased([&](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed,
                            auto& scratch) { return by_power(forest, receiver, oracle, options, seed, scratch); });
    }
}

// One candidate a sample is tree sampling, in which nothing is left to choose.
TEST(ResampledSampling, OfOneCandidateASampleIsTreeSampling) {
    Room<V> room(6);
    const auto lights = room.omni(500);
    const LightTree tree(lights);
    EstimateScratch<V> scratch;
    for (const auto& receiver : room.diffuse_receivers(5)) {
        EXPECT_EQ(resampled_sampling(tree, receiver, AlwaysVisible{}, {16, 1}, 3, scratch).radiance,
                  tree_sampling(tree, receiver, AlwaysVisible{}, 16, 3, scratch).radiance);
    }
}

// Without shadows what is kept stands for all candidates, channel by channel of proportional spectra: the error is
// theirs, not that of the few.
TEST(ResampledSampling, WithoutShadowsIsAsGoodAsItsCandidates) {
    Room<float> room(7);
    const auto lights = room.omni(300);
    const LightTree tree(lights);
    const LightForest forest(tree);
    EstimateScratch<float> scratch;
    for (const auto& receiver : room.diffuse_receivers(4)) {
        const float candidates = tree_sampling(tree, receiver, AlwaysVisible{}, 128, 9, scratch).radiance;
        const float kept = resampled_sampling(tree, receiver, AlwaysVisible{}, {4, 32}, 9, scratch).radiance;
        EXPECT_NEAR(kept, candidates, 1e-5f * candidates);
    }
}

// Each is kept as often as its share of the total says, rounded up or down.
TEST(Resample, KeepsInProportion) {
    for (const double u : {0.0, 0.3, 0.999}) {
        EstimateScratch<float> scratch;
        scratch.contributions = {{1.0f, 0, 0}, {4.0f, 1, 0}, {0.5f, 2, 0}, {2.5f, 3, 0}};
        detail::resample(2, u, scratch);  // a step is 4
        float sum = 0.0f;
        for (const auto& c : scratch.contributions) {
            EXPECT_TRUE(c.light == 1 || c.radiance == 4.0f) << c.light << " " << u;
            sum += c.radiance;
        }
        EXPECT_EQ(sum, 8.0f);
        EXPECT_LE(scratch.contributions.size(), 2u);
    }
}

TEST(ResampledSampling, IsDeterministic) {
    const ResamplingOptions options{16, 8};
    expect_deterministic(
        [&](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed, auto& scratch) {
            return resampled_sampling(forest, receiver, oracle, options, seed, scratch);
        });
    expect_deterministic([&](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed,
                             auto& scratch) { return by_power(forest, receiver, oracle, options, seed, scratch); });
}

TEST(ResampledSampling, OfDarknessIsBlack) {
    const ResamplingOptions options{4, 8};
    expect_black_where_nothing_shines([&](const auto& forest, const auto& receiver, auto& scratch) {
        return resampled_sampling(forest, receiver, AlwaysVisible{}, options, 1, scratch);
    });
    expect_black_where_nothing_shines([&](const auto& forest, const auto& receiver, auto& scratch) {
        return by_power(forest, receiver, AlwaysVisible{}, options, 1, scratch);
    });
}

}  // namespace
}  // namespace lightcuts::test
