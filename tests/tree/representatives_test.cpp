#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/representatives.hpp>
#include "support/random.hpp"
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

using node_index = ClusterTree::node_index;

struct WeightedTree {
    ClusterTree tree;
    std::vector<double> weights;
};

WeightedTree weighted_tree(std::size_t n, std::uint64_t seed) {
    Random random(seed);
    std::vector<PointItem> items(n);
    for (PointItem& i : items) i = {glm::vec3(random.on_sphere()), random.real(0.05, 1.0)};
    WeightedTree result{divide(std::span<const PointItem>(items)), {}};
    for (node_index k = 0; k < result.tree.size(); ++k) {
        result.weights.push_back(result.tree.is_leaf(k)
                                     ? static_cast<double>(items[result.tree.item(k)].weight)
                                     : result.weights[result.tree.left(k)] + result.weights[result.tree.right(k)]);
    }
    return result;
}

// Over seeds each light represents each cluster above it in proportion to its intensity. Each chi-square test fails by
// chance once in a million runs (of other seeds than these).
void expect_proportional(unsigned limit, int seeds) {
    const WeightedTree t = weighted_tree(24, 1);
    std::vector<std::map<node_index, double>> counts(t.tree.size());
    for (int seed = 0; seed < seeds; ++seed) {
        const Representatives representatives(t.tree, t.weights, limit, static_cast<std::uint64_t>(seed));
        for (node_index n = 0; n < t.tree.size(); ++n) {
            const node_index drawn = representatives.draw(n, hash_keys(static_cast<std::uint64_t>(seed), n, 12345));
            ASSERT_TRUE(t.tree.is_leaf(drawn) && t.tree.contains(n, drawn));
            counts[n][drawn] += 1.0;
        }
    }
    for (node_index n = 0; n < t.tree.size(); ++n) {
        double chi_square = 0.0;
        std::size_t lights = 0;
        for (node_index k = t.tree.left_leaf(n); k <= n; ++k) {
            if (!t.tree.is_leaf(k)) continue;
            const double expected = seeds * t.weights[k] / t.weights[n];
            const double off = counts[n][k] - expected;
            chi_square += off * off / expected;
            ++lights;
        }
        if (lights > 1) {
            EXPECT_LT(chi_square, chi_square_limit(lights - 1))
                << "node " << n << " of " << lights << " lights, limit " << limit;
        }
    }
}

TEST(Representatives, AreProportionalToIntensityWithOneANode) { expect_proportional(1, 20000); }
TEST(Representatives, AreProportionalToIntensityWithTwoANode) { expect_proportional(2, 20000); }
TEST(Representatives, AreProportionalToIntensityWithEightANode) { expect_proportional(8, 20000); }
TEST(Representatives, AreProportionalToIntensityWithThirtyTwoANode) { expect_proportional(32, 20000); }

// A node's list, taken whole, is in proportion too: what one receiver does not draw another does.
TEST(Representatives, OfANodeAreTakenFromItsChildren) {
    const WeightedTree t = weighted_tree(500, 2);
    for (const unsigned limit : {1u, 4u, 32u}) {
        const Representatives representatives(t.tree, t.weights, limit, 7);
        EXPECT_EQ(representatives.single(), limit == 1);
        for (node_index n = 0; n < t.tree.size(); ++n) {
            const auto list = representatives.of(n);
            ASSERT_FALSE(list.empty());
            if (t.tree.is_leaf(n)) {
                EXPECT_EQ(list.size(), 1u);
                EXPECT_EQ(list[0], n);
                continue;
            }
            const auto left = representatives.of(t.tree.left(n)), right = representatives.of(t.tree.right(n));
            for (const node_index leaf : list) {
                const auto side = t.tree.contains(t.tree.left(n), leaf) ? left : right;
                EXPECT_NE(std::find(side.begin(), side.end(), leaf), side.end());
            }
        }
    }
}

// As many as the child with more has, plus one with probability fewer / more, up to the limit [Miksik 2007].
TEST(Representatives, GrowInNumberByMiksiksRule) {
    const WeightedTree t = weighted_tree(200, 3);
    for (unsigned limit = 2; limit <= 32; ++limit) {
        Mean surplus;  // of parents that grow over what their chances promise
        for (std::uint64_t seed = 0; seed < 30; ++seed) {
            const Representatives representatives(t.tree, t.weights, limit, seed);
            for (node_index n = 0; n < t.tree.size(); ++n) {
                if (t.tree.is_leaf(n)) continue;
                const std::size_t a = representatives.of(t.tree.left(n)).size(),
                                  b = representatives.of(t.tree.right(n)).size();
                const std::size_t more = std::max(a, b), fewer = std::min(a, b), own = representatives.of(n).size();
                ASSERT_LE(own, limit);
                if (more == limit) {
                    EXPECT_EQ(own, limit);
                    continue;
                }
                ASSERT_TRUE(own == more || own == more + 1);
                const double chance = static_cast<double>(fewer) / static_cast<double>(more);
                if (fewer == more) {
                    EXPECT_EQ(own, more + 1);
                } else {
                    surplus.add((own > more ? 1.0 : 0.0) - chance);
                }
            }
        }
        // With a limit of 2 no parent has a choice.
        if (limit > 2) { EXPECT_LT(surplus.standard_errors_from(0.0), one_in_a_million) << limit; }
    }
}

// Half-way through the list means the middle of it; every member is drawn equally often.
TEST(Representatives, AreDrawnEvenly) {
    const WeightedTree t = weighted_tree(300, 4);
    const Representatives representatives(t.tree, t.weights, 8, 1);
    const node_index root = t.tree.root();
    const auto list = representatives.of(root);
    ASSERT_EQ(list.size(), 8u);
    std::vector<double> expected(t.tree.size(), 0.0), counts(t.tree.size(), 0.0);
    constexpr int draws = 80000;
    for (const node_index leaf : list) expected[leaf] += draws / 8.0;
    for (int i = 0; i < draws; ++i) counts[representatives.draw(root, hash_keys(9, i))] += 1.0;
    double chi_square = 0.0;
    std::size_t distinct = 0;
    for (node_index n = 0; n < t.tree.size(); ++n) {
        if (expected[n] == 0.0) {
            EXPECT_EQ(counts[n], 0.0);
            continue;
        }
        ++distinct;
        chi_square += (counts[n] - expected[n]) * (counts[n] - expected[n]) / expected[n];
    }
    EXPECT_GT(distinct, 4u);
    EXPECT_LT(chi_square, chi_square_limit(distinct - 1));
    EXPECT_EQ(representatives.draw(root, ~std::uint64_t{0}), list[7]);
    EXPECT_EQ(representatives.draw(root, 0), list[0]);
}

// No division, so denormal and huge intensities pick validly; a side without light is never picked.
TEST(Representatives, OfExtremeWeightsAreValid) {
    const WeightedTree t = weighted_tree(2, 5);
    for (const double scale : {1e-320, 1e-300, 1.0, 1e300}) {
        int right = 0;
        for (std::uint64_t seed = 0; seed < 2000; ++seed) {
            const std::vector<double> weights{1.0 * scale, 3.0 * scale, 4.0 * scale};
            right += Representatives(t.tree, weights, 1, seed).of(2)[0] == 1 ? 1 : 0;
        }
        EXPECT_NEAR(right, 1500, 100) << scale;
    }
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        EXPECT_EQ(Representatives(t.tree, std::vector<double>{0.0, 1.0, 1.0}, 1, seed).of(2)[0], 1u);
        EXPECT_EQ(Representatives(t.tree, std::vector<double>{1.0, 0.0, 1.0}, 1, seed).of(2)[0], 0u);
        const Representatives several(t.tree, std::vector<double>{0.0, 1.0, 1.0}, 4, seed);
        for (const node_index leaf : several.of(2)) EXPECT_EQ(leaf, 1u);
    }
}

// Gather points that see nothing at one instant, say: a node without weight is represented by any leaf below it.
TEST(Representatives, OfNodesWithoutWeightAreAnyLeavesBelow) {
    const WeightedTree t = weighted_tree(60, 6);
    std::vector<double> weights = t.weights;
    for (node_index n = 0; n < t.tree.size(); ++n) {
        if (t.tree.is_leaf(n)) {
            weights[n] = t.tree.item(n) % 3 == 0 ? weights[n] : 0.0;
        } else {
            weights[n] = weights[t.tree.left(n)] + weights[t.tree.right(n)];
        }
    }
    const std::vector<double> dark(t.tree.size(), 0.0);
    for (const unsigned limit : {1u, 8u}) {
        std::map<node_index, int> chosen;
        constexpr int seeds = 2000;
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
            const Representatives some(t.tree, weights, limit, seed), none(t.tree, dark, limit, seed);
            for (node_index n = 0; n < t.tree.size(); ++n) {
                for (const node_index leaf : some.of(n)) {
                    ASSERT_TRUE(t.tree.is_leaf(leaf) && t.tree.contains(n, leaf));
                    if (weights[n] > 0.0) { ASSERT_GT(weights[leaf], 0.0); }
                }
                for (const node_index leaf : none.of(n)) ASSERT_TRUE(t.tree.is_leaf(leaf) && t.tree.contains(n, leaf));
            }
            ++chosen[none.draw(t.tree.root(), hash_keys(seed, 1))];
        }
        // Each child is as likely.
        int left = 0;
        for (const auto& [leaf, count] : chosen) {
            if (t.tree.contains(t.tree.left(t.tree.root()), leaf)) left += count;
        }
        EXPECT_NEAR(left, seeds / 2, 5 * std::sqrt(seeds / 4.0)) << limit;
    }
}

// A side and an instant in the seed: choices are independent of those of another instant.
TEST(Representatives, OfDifferentInstantsAreChosenIndependently) {
    const WeightedTree t = weighted_tree(2, 7);
    const std::vector<double> even{1.0, 1.0, 2.0};
    int same = 0;
    constexpr int seeds = 10000;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const Representatives now(t.tree, even, 1, hash_keys(seed, 0, 3)), then(t.tree, even, 1, hash_keys(seed, 0, 4));
        same += now.of(2)[0] == then.of(2)[0] ? 1 : 0;
    }
    EXPECT_NEAR(same, seeds / 2, 5 * std::sqrt(seeds / 4.0));
}

TEST(Representatives, ChosenAnewAreThoseChosenAtFirst) {
    Representatives reused;
    for (const std::size_t count : {40u, 300u, 2u}) {
        const WeightedTree t = weighted_tree(count, count);
        for (const unsigned limit : {1u, 4u, 1u}) {
            reused.choose(t.tree, t.weights, limit, 9);
            const Representatives fresh(t.tree, t.weights, limit, 9);
            EXPECT_EQ(reused.single(), fresh.single());
            for (node_index n = 0; n < t.tree.size(); ++n) {
                const auto a = reused.of(n), b = fresh.of(n);
                EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
            }
        }
    }
}

TEST(Representatives, OfAnEmptyTreeTakeNoSpace) {
    EXPECT_EQ(Representatives(ClusterTree(), std::vector<double>{}, 1, 1).memory_bytes(), 0u);
    EXPECT_TRUE(Representatives().single());
}

}  // namespace
}  // namespace lightcuts::test
