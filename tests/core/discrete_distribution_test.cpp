#include <lightcuts/core/discrete_distribution.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/core/random.hpp>

namespace {

using lightcuts::hash_keys;
using lightcuts::uniform01;

TEST(DiscreteDistribution, IsTheFirstWhoseSumExceedsTheShare) {
    const std::vector<std::vector<double>> cases = {{1.0},
                                                    {0.0, 2.0, 0.0, 0.0},
                                                    {1e-12, 1.0, 1e-12, 0.0, 1e12, 3.0, 0.0},
                                                    std::vector<double>(1000, 0.1),
                                                    {5.0, 1e-300, 1e-300, 1e-300, 0.0}};
    for (const std::vector<double>& weights : cases) {
        lightcuts::detail::DiscreteDistribution choice;
        for (const double weight : weights) choice.add(weight);
        choice.prepare();
        double probabilities = 0.0;
        for (std::size_t k = 0; k < weights.size(); ++k) {
            EXPECT_NEAR(choice.probability(k), weights[k] / choice.total(), 1e-15);
            probabilities += choice.probability(k);
        }
        EXPECT_NEAR(probabilities, 1.0, 1e-12);
        for (std::uint32_t i = 0; i < 4096; ++i) {
            const double u = i == 0 ? 0.0 : i == 1 ? 1.0 - 0x1p-53 : uniform01(hash_keys(7, i));
            const std::size_t chosen = choice(u);
            ASSERT_LT(chosen, weights.size());
            EXPECT_GT(weights[chosen], 0.0);
            double before = 0.0;
            for (std::size_t k = 0; k < chosen; ++k) before += weights[k];
            EXPECT_LE(before, u * choice.total());
            EXPECT_TRUE(before + weights[chosen] > u * choice.total() || i == 1);
        }
    }
}

}  // namespace
