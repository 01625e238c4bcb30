#include <lightcuts/piecewise/bounded_product.hpp>

#include <cmath>
#include <cstdint>
#include <type_traits>
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

/// A function of doubles from the least there is to the largest that has moments, as a cut of V.
template <class V>
struct WideFactor {
    std::vector<double> values;
    std::vector<Moments<1>> of;
    PiecewiseConstant<V> cut;

    WideFactor(Case& c, bool is_visibility) {
        const bool is_fixed = c.random.chance(0.3);
        const double most = is_visibility ? 0.0 : std::is_same_v<V, float> ? 37.0 : 150.0;
        const double fixed = c.random.between(-324.0, most);
        for (std::size_t i = 0; i < c.tree.item_count(); ++i) {
            const double magnitude = is_fixed ? std::pow(10.0, fixed) * c.random.unit()
                                              : c.random.decades(-324.0, most);
            const double sign = !is_visibility && c.random.chance(0.5) ? -1.0 : 1.0;
            values.push_back(c.random.chance(0.2) ? 0.0 : sign * magnitude);
        }
        of = moments(c.tree, [this](std::uint32_t i) { return values[i]; });
        cut = means_on<V>(c.tree, of, random_cut(c.random, c.tree, c.keep()));
    }
};

template <class V, class F, class G>
void expect_bounds_of_wide_factors(std::uint64_t seed) {
    Random random(seed);
    for (int trial = 0; trial < 10000; ++trial) {
        Case c(random, trial);
        const WideFactor<V> v(c, true);
        const WideFactor<F> f(c, false);
        const WideFactor<G> g(c, false);
        long double two = 0, three = 0, magnitude = 0;
        for (std::size_t i = 0; i < v.values.size(); ++i) {
            const long double fg = static_cast<long double>(f.values[i]) * static_cast<long double>(g.values[i]);
            two += fg;
            three += static_cast<long double>(v.values[i]) * fg;
            magnitude += std::abs(fg);
        }
        const auto expect = [&](const BoundedSum& found, long double exact) {
            // The exact sum is rounded, too.
            EXPECT_LE(std::abs(static_cast<long double>(found.value) - exact),
                      static_cast<long double>(found.error_bound) + 1e-17L * magnitude)
                << trial << " " << found.value << " " << exact;
        };
        expect(bounded_product(f.cut, g.cut), two);
        expect(bounded_product(f.cut, WholeTree(g.of)), two);
        expect(bounded_product(v.cut, f.cut, g.cut), three);
        expect(bounded_product(v.cut, f.cut, WholeTree(g.of)), three);
        expect(bounded_product(v.cut, WholeTree(f.of), WholeTree(g.of)), three);
    }
}

TEST(BoundedProduct, OfDoublesFromDenormalToHugeHolds) {
    expect_bounds_of_wide_factors<double, double, double>(4);
    expect_bounds_of_wide_factors<float, double, float>(5);
    expect_bounds_of_wide_factors<double, float, double>(6);
}

using Doubles = std::vector<double>;

template <class V>
PiecewiseConstant<V> cut_of(const ClusterTree& tree, const Doubles& values, const std::vector<std::uint32_t>& nodes) {
    return means_on<V>(tree, moments(tree, [&](std::uint32_t i) { return values[i]; }), nodes);
}

// What cannot be told from zero in the product, or whose square cannot, is no error of zero.
TEST(BoundedProduct, CountsWhatUnderflows) {
    const ClusterTree tree({ClusterTree::leaf_word(0), ClusterTree::leaf_word(1), 0});
    const std::vector<std::uint32_t> root{2}, leaves{0, 1};
    const BoundedSum deviation = bounded_product(cut_of<double>(tree, {1, 0}, root),
                                                 cut_of<double>(tree, {0, 1e-200}, leaves));
    EXPECT_GE(deviation.error_bound, std::abs(deviation.value - 0.0));
    EXPECT_GT(deviation.value, 0.0);
    const BoundedSum rounded = bounded_product(cut_of<float>(tree, {1e-200, 2e-200}, leaves),
                                               cut_of<float>(tree, {1, -1}, root));
    EXPECT_GE(rounded.error_bound, std::abs(rounded.value + 1e-200));
    const auto tiny = cut_of<double>(tree, {1e-200, 1e-200}, leaves);
    EXPECT_GT(bounded_product(tiny, tiny).error_bound, 0.0) << "the exact sum is 2e-400";
    EXPECT_GT(bounded_product(tiny, tiny, tiny).error_bound, 0.0);
    const auto huge = cut_of<double>(tree, {1e150, 1e150}, leaves);
    const BoundedSum three = bounded_product(tiny, tiny, huge);
    EXPECT_GE(three.error_bound + 1e-262, std::abs(three.value - 2e-250));
}

TEST(BoundedProduct, CountsWhatOverflows) {
    constexpr std::uint32_t count = 16384;
    std::vector<std::uint32_t> words, leaves;
    Doubles a, b;
    for (std::uint32_t i = 0; i < count; ++i) {
        words.push_back(ClusterTree::leaf_word(i));
        leaves.push_back(i);
        a.push_back(i % 2 == 0 ? 1.0 : 0.0);
        b.push_back(i % 2 == 0 ? -1e150 : 1e150);
    }
    words.push_back(0);
    const ClusterTree star(words);
    const BoundedSum found = bounded_product(cut_of<double>(star, a, {count}), cut_of<double>(star, b, leaves));
    EXPECT_GE(found.error_bound, std::abs(found.value + 1e150 * (count / 2)));
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

TEST(BoundedProduct, RefusesFunctionsOfOtherTrees) {
    Random random(9);
    const ClusterTree tree = random_tree(random, 10), other = random_tree(random, 11);
    const Factor f(random, tree, Kind::uniform, 0.3), g(random, other, Kind::uniform, 0.3);
    const Function none;
    const std::vector<Moments<1>> no_moments;
    EXPECT_EQ(WholeTree(f.of).leaf_count(), 10u);
    EXPECT_THROW(bounded_product(none, f.cut), invalid_input);
    EXPECT_THROW(bounded_product(f.cut, none), invalid_input);
    EXPECT_THROW(bounded_product(none, f.cut, f.cut), invalid_input);
    EXPECT_THROW(bounded_product(none, WholeTree(f.of)), invalid_input);
    EXPECT_THROW(bounded_product(f.cut, WholeTree(g.of)), invalid_input);
    EXPECT_THROW(bounded_product(f.cut, WholeTree(no_moments)), invalid_input);
    EXPECT_THROW(bounded_product(f.cut, f.cut, WholeTree(g.of)), invalid_input);
    EXPECT_EQ(bounded_product(none, none).error_bound, 0.0);
    EXPECT_EQ(bounded_product(none, WholeTree(no_moments), none).value, 0.0);
}

}  // namespace
}  // namespace lightcuts::test
