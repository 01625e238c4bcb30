#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/estimate/adaptive_splitting.hpp>
#include "estimate/unbiasedness.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

// The variance of 1/d^2 over distances spread evenly in [a, b], by numbers.
TEST(DistanceDeviation, IsThatOfTheInverseSquare) {
    for (const double a : {0.1, 1.0, 3.0}) {
        for (const double length : {0.05, 1.0, 10.0}) {
            const double b = a + length;
            Mean g;
            for (int i = 0; i < 200000; ++i) {
                const double d = a + (i + 0.5) / 200000 * length;
                g.add(1.0 / (d * d));
            }
            // Lights in a row away from the receiver: their box is a segment.
            LightCluster<OmniLight<>> cluster;
            cluster.box = {V(0.0f, 0.0f, static_cast<float>(a)), V(0.0f, 0.0f, static_cast<float>(b))};
            EXPECT_NEAR(detail::distance_deviation(cluster, V(0.0f)), g.deviation() / g.value(),
                        1e-4 * g.deviation() / g.value());
        }
    }
    LightCluster<OmniLight<>> around;
    around.box = {V(-1.0f), V(1.0f)};
    EXPECT_EQ(detail::distance_deviation(around, V(0.5f)), std::numeric_limits<double>::infinity());
    EXPECT_LT(detail::distance_deviation(around, V(1000.0f)), 0.01);
}

TEST(AdaptiveSplitting, IsUnbiased) {
    for (const float threshold : {0.0f, 0.5f}) {
        expect_unbiased(
            [&](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed, auto& scratch) {
                return adaptive_splitting(forest, receiver, oracle, threshold, 8, seed, scratch);
            });
    }
}

// A sample for each light and no threshold: everything is split.
TEST(AdaptiveSplitting, IsExactWithASampleForEachLight) {
    Random random(4);
    std::vector<OmniLight<>> lights(40);
    for (auto& l : lights) l = {V(random.in_box({-1, -1, -1}, {1, 1, 3})), V(random.real(0.1, 1.0)), {}};
    expect_exact_sum(lights, [](const auto& forest, const auto& receiver, auto& scratch) {
        return adaptive_splitting(forest, receiver, AlwaysVisible{}, 0.0f, 40, 1, scratch);
    });
}

// Nothing to split for: lights at one distance that nearly coincide. All samples are left for one node.
TEST(AdaptiveSplitting, SharesOutTheSamplesThatSplittingLeaves) {
    std::vector<OmniLight<float>> lights(1000);
    Random random(5);
    for (auto& l : lights) l = {V(random.in_box({-0.01, -0.01, 10.0}, {0.01, 0.01, 10.01})), 1.0f, {}};
    const LightTree tree(lights);
    const Receiver receiver(V(0.0f), Lambert<float>{{0.0f, 0.0f, 1.0f}, 1.0f});
    const auto open = [](const auto&, const auto&) { return true; };
    EXPECT_EQ(adaptive_splitting(tree, receiver, open, 0.5f, 64, 1).queries, 64u);
    EXPECT_EQ(adaptive_splitting(tree, receiver, open, 0.0f, 64, 1).queries, 64u);
}

TEST(AdaptiveSplitting, IsDeterministic) {
    expect_deterministic(
        [](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed, auto& scratch) {
            return adaptive_splitting(forest, receiver, oracle, 0.2f, 16, seed, scratch);
        });
}

TEST(AdaptiveSplitting, OfDarknessIsBlack) {
    expect_black_where_nothing_shines([](const auto& forest, const auto& receiver, auto& scratch) {
        return adaptive_splitting(forest, receiver, AlwaysVisible{}, 0.1f, 16, 1, scratch);
    });
}

}  // namespace
}  // namespace lightcuts::test
