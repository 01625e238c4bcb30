#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/source/sampler.hpp>
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

static_assert(Sampler<ScrambledSobol> && Sampler<IndependentSampler> && Sampler<CenteredRecurrence>);

TEST(ScrambledSobol, PutsOneNumberIntoEachElementaryBox) {
    constexpr std::uint32_t count = 256;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const ScrambledSobol sampler{seed};
        for (const std::uint32_t pair : {0u, 1u, 7u}) {
            for (std::uint32_t wide = 1; wide <= count; wide *= 2) {
                const std::uint32_t high = count / wide;
                std::set<std::pair<std::uint32_t, std::uint32_t>> boxes;
                for (std::uint32_t i = 0; i < count; ++i) {
                    const double x = sampler(i, 2 * pair), y = sampler(i, 2 * pair + 1);
                    ASSERT_TRUE(x >= 0.0 && x < 1.0 && y >= 0.0 && y < 1.0);
                    boxes.emplace(static_cast<std::uint32_t>(x * wide), static_cast<std::uint32_t>(y * high));
                }
                EXPECT_EQ(boxes.size(), count) << wide << " x " << high << ", seed " << seed;
            }
        }
    }
}

TEST(ScrambledSobol, IsUniformOverSeedsAndUncorrelatedBetweenPairs) {
    std::vector<double> histogram(16, 0.0);
    Mean product;
    constexpr std::uint64_t seeds = 16000;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const ScrambledSobol sampler{seed};
        const double x = sampler(5, 2), y = sampler(5, 4);
        histogram[static_cast<std::size_t>(x * 16.0)] += 1.0;
        product.add((x - 0.5) * (y - 0.5));
    }
    double chi_square = 0.0;
    for (const double n : histogram) chi_square += (n - seeds / 16.0) * (n - seeds / 16.0) / (seeds / 16.0);
    EXPECT_LT(chi_square, chi_square_limit(15));
    EXPECT_LT(product.standard_errors_from(0.0), one_in_a_million);

    // Within one seed: different pairs of dimensions are shuffled differently.
    const ScrambledSobol sampler{3};
    Mean between;
    for (std::uint32_t i = 0; i < 4096; ++i) between.add((sampler(i, 0) - 0.5) * (sampler(i, 2) - 0.5));
    EXPECT_LT(std::fabs(between.value()), 0.005);
}

TEST(CenteredRecurrence, LiesNearTheMiddleOfSharesButNotInIt) {
    const CenteredRecurrence sampler;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < 4096; ++i) {
        const double u = sampler(i, 0);
        ASSERT_TRUE(u >= 0.375 && u < 0.625);
        for (const double part : {0.375, 0.4375, 0.5, 0.5625}) EXPECT_NE(u, part);
        sum += u;
    }
    EXPECT_NEAR(sum / 4096, 0.5, 1e-3);
}

TEST(CenteredRecurrence, BeginsInTheMiddleAndIsEvenForAnyCount) {
    const CenteredRecurrence sampler;
    EXPECT_EQ(sampler(0, 2), 0.5);
    EXPECT_EQ(sampler(0, 3), 0.5);
    for (const std::uint32_t count : {10u, 37u, 100u, 1000u}) {
        double worst = 0.0;
        for (int x = 1; x <= 8; ++x) {
            for (int y = 1; y <= 8; ++y) {
                int inside = 0;
                for (std::uint32_t i = 0; i < count; ++i) {
                    ASSERT_TRUE(sampler(i, 1) >= 0.0 && sampler(i, 1) < 1.0);
                    inside += sampler(i, 2) * 8.0 < x && sampler(i, 3) * 8.0 < y ? 1 : 0;
                }
                worst = std::max(worst, std::fabs(inside / double(count) - x * y / 64.0));
            }
        }
        // Independent points would give about 0.8 / sqrt(count).
        EXPECT_LE(worst, 1.7 / std::pow(double(count), 0.8)) << count;
    }
}

}  // namespace
}  // namespace lightcuts::test
