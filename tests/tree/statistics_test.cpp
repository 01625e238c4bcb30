#include <lightcuts/tree/statistics.hpp>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace lightcuts;

constexpr auto leaf = ClusterTree::leaf_word;

TEST(TreeStatistics, OfAnEmptyTreeAreZero) {
    const TreeStatistics s = statistics(ClusterTree{}, std::vector<PointItem>{});
    EXPECT_EQ(s.depth_max, 0u);
    EXPECT_EQ(s.depth_mean, 0);
    EXPECT_EQ(s.cost, 0);
}

TEST(TreeStatistics, OfAChain) {
    // ((0 1) 2) on a line of length 4.
    const std::vector<PointItem> items{{{0, 0, 0}, 1}, {{1, 0, 0}, 2}, {{4, 0, 0}, 4}};
    const ClusterTree tree({leaf(0), leaf(1), 0, leaf(2), 0});
    const TreeStatistics s = statistics(tree, items);
    EXPECT_EQ(s.depth_max, 2u);
    EXPECT_NEAR(s.depth_mean, 5.0 / 3.0, 1e-15);
    EXPECT_NEAR(s.cost, (3.0 * 1.0 / 16.0 + 7.0) / 4.0, 1e-12);
}

TEST(TreeStatistics, CountDirections) {
    // A right angle: beta = 45 degrees.
    const std::vector<OrientedItem> items{{{0, 0, 0}, {0, 0, 1}, 1}, {{0, 0, 0}, {0, 1, 0}, 1}};
    const ClusterTree tree({leaf(0), leaf(1), 0});
    const double spread = 1.0 - std::sqrt(0.5);
    EXPECT_NEAR(statistics(tree, items).cost, 2.0 * spread * spread, 1e-6);
}

}  // namespace
