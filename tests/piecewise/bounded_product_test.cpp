#include <lightcuts/piecewise/bounded_product.hpp>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include <lightcuts/piecewise/algebra.hpp>
#include "piecewise/functions.hpp"

namespace lightcuts::test {
namespace {

using Function = PiecewiseConstant<float>;

struct Factor {
    std::vector<float> values;
    std::vector<Moments<1>> of;
    Function cut;

    Factor(Random& random, const ClusterTree& tree, Kind kind, double keep)
        : values(random_function(random, static_cast<std::uint32_t>(tree.item_count()), kind)),
          of(moments(tree, [this](std::uint32_t i) { return values[i]; })),
          cut(means_on<float>(tree, of, random_cut(random, tree, keep))) {}
    long double operator[](std::size_t i) const { return static_cast<long double>(values[i]); }
};

/// A number of leaves, a shape, a cut's coarseness.
struct Case {
    ClusterTree tree;
    Random& random;

    Case(Random& r, int trial) : tree(), random(r) {
        const auto leaves = 1 + static_cast<std::uint32_t>(r.below(trial % 4 == 0 ? 5 : 100));
        tree = random_tree(r, leaves, trial % 3 == 0 ? 5 : 2);
    }
    Kind kind() const { return all_kinds[random.below(std::size(all_kinds))]; }
    double keep() const { return random.chance(0.15) ? 1.0 : random.chance(0.15) ? 0.0 : random.between(0.0, 0.6); }
    Factor factor() const { return Factor(random, tree, kind(), keep()); }
    Factor visibility() const {
        return Factor(random, tree, random.chance(0.5) ? Kind::binary : Kind::uniform, keep());
    }
};

void expect_bound(const BoundedSum& found, long double exact, long double* slack) {
    const long double error = std::abs(static_cast<long double>(found.value) - exact);
    // The exact sum is itself rounded, in long double.
    EXPECT_LE(error, static_cast<long double>(found.error_bound) * (1 + 1e-15L) + 1e-17L * std::abs(exact));
    if (found.error_bound > 0) *slack = std::max(*slack, error / static_cast<long double>(found.error_bound));
}

TEST(BoundedProduct, OfTwoFactorsHolds) {
    Random random(1);
    long double tightest = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Case c(random, trial);
        const Factor f = c.factor(), g = c.factor();
        long double exact = 0;
        for (std::size_t i = 0; i < f.values.size(); ++i) exact += f[i] * g[i];
        const BoundedSum cuts = bounded_product(f.cut, g.cut);
        expect_bound(cuts, exact, &tightest);
        EXPECT_NEAR(cuts.value, sum_of_products(f.cut, g.cut), 1e-5 * (std::abs(cuts.value) + cuts.error_bound) + 1e-3);
        expect_bound(bounded_product(g.cut, f.cut), exact, &tightest);
        const BoundedSum looked_up = bounded_product(f.cut, WholeTree(g.of));
        expect_bound(looked_up, exact, &tightest);
    }
    EXPECT_GT(tightest, 0.99L) << "some case attains the bound";
}

TEST(BoundedProduct, OfThreeFactorsHolds) {
    Random random(2);
    long double tightest = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Case c(random, trial);
        const Factor v = c.visibility(), f = c.factor(), g = c.factor();
        long double exact = 0;
        for (std::size_t i = 0; i < f.values.size(); ++i) exact += v[i] * f[i] * g[i];
        expect_bound(bounded_product(v.cut, f.cut, g.cut), exact, &tightest);
        expect_bound(bounded_product(v.cut, f.cut, WholeTree(g.of)), exact, &tightest);
        expect_bound(bounded_product(v.cut, WholeTree(f.of), g.cut), exact, &tightest);
        expect_bound(bounded_product(v.cut, WholeTree(f.of), WholeTree(g.of)), exact, &tightest);
    }
    EXPECT_GT(tightest, 0.9L);
}

// All leaves kept: nothing but rounding is left.
TEST(BoundedProduct, OfExactFunctionsIsExact) {
    Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
        const Case c(random, trial);
        const Factor v(random, c.tree, Kind::binary, 0.0), f(random, c.tree, Kind::uniform, 0.0),
            g(random, c.tree, Kind::uniform, 0.0);
        const BoundedSum two = bounded_product(f.cut, g.cut), three = bounded_product(v.cut, f.cut, g.cut);
        EXPECT_LE(two.error_bound, 1e-12 * std::abs(two.value) + 1e-200);
        EXPECT_LE(three.error_bound, 1e-12 * std::abs(three.value) + 1e-200);
    }
}

// a = (1, 0) as one node of mean .5, b = (10, 0) as leaves: 5 instead of 10, but b deviates nowhere from its own mean
// on the nodes of the union [Cut merging 2008, Eq. 8].
TEST(BoundedProduct, HoldsWhereDeviationsOnTheUnionDoNot) {
    const ClusterTree tree({ClusterTree::leaf_word(0), ClusterTree::leaf_word(1), 0});
    const std::vector<float> a{1, 0}, b{10, 0};
    const auto of_a = moments(tree, [&](std::uint32_t i) { return a[i]; });
    const auto of_b = moments(tree, [&](std::uint32_t i) { return b[i]; });
    const Function coarse = means_on<float>(tree, of_a, {2}), fine = means_on<float>(tree, of_b, {0, 1});
    const BoundedSum found = bounded_product(coarse, fine);
    EXPECT_DOUBLE_EQ(found.value, 5.0);
    double printed = 0;
    merge([&](std::uint32_t n, std::uint32_t, float,
              float) { printed += std::sqrt(of_a[n].squared_deviation[0] * of_b[n].squared_deviation[0]); },
          coarse, fine);
    EXPECT_EQ(printed, 0.0) << "while the error is 5";
    EXPECT_GE(found.error_bound, 5.0);
    EXPECT_LE(found.error_bound, 5.0001);
    // Looked up where the product is taken, the mean of the finer function helps nothing; that of the coarser does.
    EXPECT_NEAR(bounded_product(fine, WholeTree(of_a)).value, 10.0, 0.0);
    EXPECT_LE(bounded_product(fine, WholeTree(of_a)).error_bound, 1e-10);
}

// Three factors without a third moment: v = (1, 0, 0, 0), f and g likewise, all as one node.
TEST(BoundedProduct, CountsTheThirdMoment) {
    const ClusterTree tree({ClusterTree::leaf_word(0), ClusterTree::leaf_word(1), ClusterTree::leaf_word(2),
                            ClusterTree::leaf_word(3), 0});
    const std::vector<float> one{1, 0, 0, 0};
    const auto of = moments(tree, [&](std::uint32_t i) { return one[i]; });
    const Function f = means_on<float>(tree, of, {4});
    const BoundedSum found = bounded_product(f, f, f);
    const double error = 1.0 - found.value, s2 = of.back().squared_deviation[0];
    EXPECT_GT(error, 3 * 0.25 * s2) << "more than the printed Eq. 9 allows";
    EXPECT_GE(found.error_bound, error);
}

TEST(BoundedProduct, KnowsThatWhatIsHiddenStaysSo) {
    Random random(6);
    const ClusterTree tree = random_tree(random, 64);
    const std::vector<float> hidden(64, 0.0f), seen(64, 1.0f);
    const auto of_hidden = moments(tree, [&](std::uint32_t i) { return hidden[i]; });
    const auto of_seen = moments(tree, [&](std::uint32_t i) { return seen[i]; });
    const Factor f(random, tree, Kind::heavy_tailed, 0.3), g(random, tree, Kind::uniform, 0.3);
    const auto root = std::vector<std::uint32_t>{tree.root()};
    EXPECT_EQ(bounded_product(means_on<float>(tree, of_hidden, root), f.cut, g.cut).error_bound, 0.0);
    const BoundedSum two = bounded_product(f.cut, g.cut);
    EXPECT_LE(bounded_product(means_on<float>(tree, of_seen, root), f.cut, g.cut).error_bound,
              two.error_bound * (1 + 1e-5));
}

TEST(BoundedProduct, OfAColorIsAChannelAtATime) {
    Random random(7);
    const ClusterTree tree = random_tree(random, 40);
    std::vector<glm::vec3> values;
    for (int i = 0; i < 40; ++i) values.emplace_back(random.in_box({0, 0, 0}, {1, 5, 0.1}));
    const auto of = moments(tree, [&](std::uint32_t i) { return values[i]; });
    const auto color = means_on<glm::vec3>(tree, of, random_cut(random, tree, 0.3));
    const Factor v(random, tree, Kind::binary, 0.3);
    long double tightest = 0;
    for (int c = 0; c < 3; ++c) {
        long double exact = 0;
        for (std::size_t i = 0; i < values.size(); ++i) exact += v[i] * static_cast<long double>(values[i][c]);
        expect_bound(bounded_product(v.cut, PiecewiseChannel(color, c)), exact, &tightest);
        expect_bound(bounded_product(v.cut, WholeTree(of, c)), exact, &tightest);
    }
}

TEST(BoundedProduct, RefusesWhatHasNoDeviations) {
    Random random(8);
    const ClusterTree tree = random_tree(random, 10), other = random_tree(random, 11);
    const Factor f(random, tree, Kind::uniform, 0.3), g(random, other, Kind::uniform, 0.3);
    Function bare = f.cut;
    bare.clear_deviations();
    EXPECT_THROW(bounded_product(bare, f.cut), invalid_input);
    EXPECT_THROW(bounded_product(f.cut, bare), invalid_input);
    EXPECT_THROW(bounded_product(f.cut, g.cut), invalid_input);
    EXPECT_THROW(bounded_product(f.cut, f.cut, g.cut), invalid_input);
}

}  // namespace
}  // namespace lightcuts::test
