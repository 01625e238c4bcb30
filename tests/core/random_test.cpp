#include <lightcuts/core/random.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_set>

#include <gtest/gtest.h>

namespace {

using lightcuts::hash_keys;
using lightcuts::mix_bits;
using lightcuts::uniform01;

static_assert(hash_keys(1, 2, 3) == hash_keys(1, 2, 3));
static_assert(hash_keys(1, 2, 3) != hash_keys(1, 3, 2));
static_assert(uniform01(0) == 0.0);
static_assert(uniform01(~std::uint64_t{0}) < 1.0);

TEST(Random, EveryInputBitFlipsAboutHalfOfTheOutput) {
    for (int bit = 0; bit < 64; ++bit) {
        int flips = 0;
        for (std::uint64_t x = 0; x < 1000; ++x) flips += std::popcount(mix_bits(x) ^ mix_bits(x ^ (1ull << bit)));
        // Mean 32000, deviation 126: six deviations.
        EXPECT_NEAR(flips, 32000, 760) << bit;
    }
}

TEST(Random, KeysDoNotCollide) {
    std::unordered_set<std::uint64_t> seen;
    for (std::uint64_t pixel = 0; pixel < 300; ++pixel) {
        for (std::uint64_t node = 0; node < 300; ++node) seen.insert(hash_keys(7, pixel, node));
    }
    EXPECT_EQ(seen.size(), 90000u);
}

TEST(Random, ThePositionOfAKeyCounts) {
    EXPECT_NE(hash_keys(1), hash_keys(1, 0));
    EXPECT_NE(hash_keys(0, 1), hash_keys(1, 0));
    EXPECT_NE(hash_keys(5, 0, 0), hash_keys(5, 0));
    EXPECT_EQ(hash_keys(5, 3u), hash_keys(5, std::uint64_t{3}));
}

TEST(Random, NumbersAreUniformAlongEveryKey) {
    // Chi-square with 63 degrees of freedom; 124 is exceeded by chance once in 2e5 runs, and the seeds are fixed.
    for (int along = 0; along < 3; ++along) {
        std::array<int, 64> count{};
        for (std::uint64_t i = 0; i < 64000; ++i) {
            const std::uint64_t h = along == 0   ? hash_keys(i, 1, 2)
                                    : along == 1 ? hash_keys(1, i, 2)
                                                 : hash_keys(1, 2, i);
            const double u = uniform01(h);
            ASSERT_GE(u, 0.0);
            ASSERT_LT(u, 1.0);
            ++count[static_cast<std::size_t>(u * 64.0)];
        }
        double chi2 = 0.0;
        for (const int c : count) chi2 += (c - 1000.0) * (c - 1000.0) / 1000.0;
        EXPECT_LT(chi2, 124.0) << along;
        EXPECT_GT(chi2, 25.0) << along;
    }
}

}  // namespace
