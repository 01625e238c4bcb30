#include <lightcuts/piecewise/moments.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include "piecewise/functions.hpp"

namespace lightcuts::test {
namespace {

/// Mean and sum of squared deviations below a node, in two passes of long double.
template <class Value>
std::pair<long double, long double> two_passes(const ClusterTree& tree, std::uint32_t n, Value value) {
    long double sum = 0, squares = 0, count = 0;
    for (std::uint32_t d = tree.left_leaf(n); d <= n; ++d) {
        if (!tree.is_leaf(d)) continue;
        sum += static_cast<long double>(value(tree.item(d)));
        count += 1;
    }
    const long double mean = sum / count;
    for (std::uint32_t d = tree.left_leaf(n); d <= n; ++d) {
        if (!tree.is_leaf(d)) continue;
        const long double off = static_cast<long double>(value(tree.item(d))) - mean;
        squares += off * off;
    }
    return {mean, squares};
}

template <class Value>
void expect_moments(const ClusterTree& tree, Value value, long double tightness) {
    const auto found = moments(tree, value);
    ASSERT_EQ(found.size(), tree.size());
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        const auto [mean, squares] = two_passes(tree, n, value);
        EXPECT_EQ(found[n].leaves, static_cast<double>(tree.leaf_count(n)));
        EXPECT_LE(std::abs(static_cast<long double>(found[n].mean[0]) - mean),
                  static_cast<long double>(found[n].mean_error[0]));
        EXPECT_LE(found[n].mean_error[0], 1e-13 * std::abs(found[n].mean[0]) + 1e-13 * std::sqrt(double(squares)));
        EXPECT_GE(static_cast<long double>(found[n].squared_deviation[0]), squares);
        EXPECT_LE(static_cast<long double>(found[n].squared_deviation[0]), squares * (1 + tightness) + 1e-280L);
    }
}

TEST(Moments, AreThoseOfTheLeavesBelow) {
    Random random(1);
    for (int trial = 0; trial < 60; ++trial) {
        const ClusterTree tree = random_tree(random, 1 + static_cast<std::uint32_t>(random.below(200)),
                                             trial % 3 == 0 ? 7 : 2);
        const Kind kind = all_kinds[random.below(std::size(all_kinds))];
        const auto values = random_function(random, static_cast<std::uint32_t>(tree.item_count()), kind);
        expect_moments(
            tree, [&](std::uint32_t i) { return values[i]; }, 1e-6L);
    }
}

// Sums of squares would lose all of it: 1e16 has a last digit of 2.
TEST(Moments, OfLargeValuesThatHardlyDifferAreAccurate) {
    Random random(2);
    const ClusterTree tree = random_tree(random, 65536);
    std::vector<double> values;
    for (int i = 0; i < 65536; ++i) values.push_back(1e8 + random.between(-1e-3, 1e-3));
    const auto found = moments(tree, [&](std::uint32_t i) { return values[i]; });
    const auto [mean, squares] = two_passes(tree, tree.root(), [&](std::uint32_t i) { return values[i]; });
    EXPECT_NEAR(found.back().mean[0], static_cast<double>(mean), found.back().mean_error[0]);
    EXPECT_LE(found.back().mean_error[0], 1e-5);
    EXPECT_GE(found.back().squared_deviation[0], static_cast<double>(squares));
    EXPECT_LE(found.back().squared_deviation[0], 1.001 * static_cast<double>(squares));
}

TEST(Moments, OfConstantsAreExact) {
    Random random(3);
    const ClusterTree tree = random_tree(random, 300, 4);
    for (const float constant : {0.0f, 0.1f, -1e30f, 1e-40f}) {
        for (const auto& m : moments(tree, [&](std::uint32_t) { return constant; })) {
            EXPECT_EQ(m.mean[0], static_cast<double>(constant));
            EXPECT_EQ(m.deviation_from(static_cast<double>(constant), 0).norm, 0.0f);
            EXPECT_EQ(m.deviation_from(static_cast<double>(constant), 0).offset, 0.0f);
        }
    }
}

TEST(Moments, OfVectorsAreThoseOfTheirChannels) {
    Random random(4);
    const ClusterTree tree = random_tree(random, 100);
    std::vector<glm::vec3> values;
    for (int i = 0; i < 100; ++i) values.emplace_back(random.in_box({-1, 0, 5}, {1, 1, 500}));
    const auto all = moments(tree, [&](std::uint32_t i) { return values[i]; });
    for (int c = 0; c < 3; ++c) {
        const auto one = moments(tree, [&](std::uint32_t i) { return values[i][c]; });
        for (std::uint32_t n = 0; n < tree.size(); ++n) {
            EXPECT_EQ(all[n].mean[static_cast<std::size_t>(c)], one[n].mean[0]);
            EXPECT_EQ(all[n].squared_deviation[static_cast<std::size_t>(c)], one[n].squared_deviation[0]);
        }
    }
}

TEST(Moments, RefuseWhatIsNoNumber) {
    Random random(5);
    const ClusterTree tree = random_tree(random, 9);
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1e200}) {
        try {
            moments(tree, [&](std::uint32_t i) { return i == 6 ? bad : 1.0; });
            ADD_FAILURE();
        } catch (const invalid_input& error) {
            EXPECT_EQ(std::string(error.what()).find("item 6: "), 0u) << error.what();
        }
    }
}

}  // namespace
}  // namespace lightcuts::test
