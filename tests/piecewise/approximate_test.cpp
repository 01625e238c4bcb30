#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/gain.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include "piecewise/functions.hpp"

namespace lightcuts::test {
namespace {

using Function = PiecewiseConstant<float>;

struct Subject {
    ClusterTree tree;
    std::vector<float> values;
    std::vector<Moments<1>> of;
    Kind kind;

    Subject(Random& random, std::uint32_t leaves, std::uint32_t most_children, Kind k)
        : tree(random_tree(random, leaves, most_children)), values(random_function(random, leaves, k)),
          of(moments(tree, [this](std::uint32_t i) { return values[i]; })), kind(k) {}
    double squared(std::uint32_t n) const { return of[n].squared_deviation[0]; }
};

template <class Test>
void for_subjects(Test test) {
    Random random(1);
    for (int trial = 0; trial < 60; ++trial) {
        const auto leaves = 1 + static_cast<std::uint32_t>(random.below(300));
        test(Subject(random, leaves, trial % 3 == 0 ? 6 : 2, all_kinds[random.below(std::size(all_kinds))]));
    }
}

double l2_error(const Subject& s, const Function& f) {
    const auto values = at_leaves(f);
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum += std::pow(static_cast<double>(values[i]) - static_cast<double>(s.values[i]), 2.0);
    }
    return std::sqrt(sum);
}

TEST(Approximate, TakesTheHighestNodesThatAreGoodEnough) {
    for_subjects([](const Subject& s) {
        for (const double share : {0.0, 0.01, 0.1, 0.5, 2.0}) {
            const double sigma = share * std::sqrt(s.squared(s.tree.root()));
            Function f;
            approximate(s.tree, s.of, sigma, f, true);
            ASSERT_NO_THROW(validate(s.tree, f));
            EXPECT_TRUE(f.has_deviations());
            // By recursion.
            std::vector<std::uint32_t> expected;
            const auto visit = [&](const auto& self, std::uint32_t n) -> void {
                if (s.tree.is_leaf(n) || s.squared(n) <= sigma * sigma) {
                    expected.push_back(n);
                } else {
                    s.tree.for_each_child(n, [&](std::uint32_t child) { self(self, child); });
                }
            };
            visit(visit, s.tree.root());
            std::sort(expected.begin(), expected.end());
            ASSERT_EQ(f.size(), expected.size());
            for (std::size_t i = 0; i < f.size(); ++i) EXPECT_EQ(f.pieces()[i].node(), expected[i]);

            OrderedApproximation<float> ordered;
            ordered.start(s.tree, s.of);
            EXPECT_EQ(ordered.refine_by_error(sigma), StopReason::converged);
            Function other;
            ordered.store(other);
            EXPECT_TRUE(std::equal(f.pieces().begin(), f.pieces().end(), other.pieces().begin(), other.pieces().end()));
        }
    });
}

TEST(Approximate, DeviationsBoundWhatIsBelow) {
    for_subjects([](const Subject& s) {
        Function f;
        approximate(s.tree, s.of, 0.3 * std::sqrt(s.squared(s.tree.root())), f, true);
        std::uint32_t first = 0;
        for (std::size_t i = 0; i < f.size(); first = f.pieces()[i++].leaf_end()) {
            long double squares = 0, off = 0;
            for (std::uint32_t leaf = first; leaf < f.pieces()[i].leaf_end(); ++leaf) {
                const long double d = static_cast<long double>(s.values[leaf]) -
                                      static_cast<long double>(f.values()[i]);
                squares += d * d;
                off += d;
            }
            const Deviation d = f.deviation(i);
            EXPECT_LE(std::sqrt(squares), static_cast<long double>(d.norm));
            EXPECT_LE(std::abs(off) / f.leaves(i), static_cast<long double>(d.offset));
            EXPECT_LE(static_cast<long double>(d.norm), 1.001L * std::sqrt(squares) + 1e-30L);
        }
    });
}

// A loop over a std::priority_queue, largest first.
std::vector<std::uint32_t> queue_cut(const Subject& s, double most, double total_most, std::size_t max_size) {
    std::priority_queue<std::pair<double, std::uint32_t>> queue;
    std::vector<std::uint32_t> leaves;
    double total = s.squared(s.tree.root());
    queue.push({total, s.tree.root()});
    while (!queue.empty() && queue.size() + leaves.size() < max_size && total > total_most) {
        const auto [squared, n] = queue.top();
        if (squared <= most) break;
        queue.pop();
        if (s.tree.is_leaf(n)) {
            leaves.push_back(n);
            continue;
        }
        s.tree.for_each_child(n, [&](std::uint32_t child) {
            if (s.tree.is_leaf(child)) {
                leaves.push_back(child);
            } else {
                queue.push({s.squared(child), child});
            }
        });
        total = 0;
        for (auto copy = queue; !copy.empty(); copy.pop()) total += copy.top().first;
    }
    for (; !queue.empty(); queue.pop()) leaves.push_back(queue.top().second);
    std::sort(leaves.begin(), leaves.end());
    return leaves;
}

TEST(OrderedApproximation, ReachesATotalErrorWithTheFewestLargestSplits) {
    for_subjects([](const Subject& s) {
        for (const double share : {0.01, 0.1, 0.5, 1.5}) {
            const double most = share * std::sqrt(s.squared(s.tree.root()));
            OrderedApproximation<float> ordered;
            ordered.start(s.tree, s.of);
            EXPECT_EQ(ordered.refine_to_total_error(most), StopReason::converged);
            Function f;
            ordered.store(f);
            ASSERT_NO_THROW(validate(s.tree, f));
            EXPECT_LE(ordered.total_error(), most * (1 + 1e-12));
            // Means are rounded to float.
            double rounding = 0;
            for (const float v : f.values()) rounding = std::max(rounding, 0x1p-24 * std::abs(static_cast<double>(v)));
            const auto leaves = static_cast<double>(s.values.size());
            EXPECT_LE(l2_error(s, f), most * (1 + 1e-6) + rounding * std::sqrt(leaves) + 1e-30);
            // Nodes of equal error are split together, in others the last split may hang on rounding.
            if (s.kind == Kind::uniform || s.kind == Kind::heavy_tailed) {
                const std::size_t expected = queue_cut(s, -1.0, most * most, std::numeric_limits<std::size_t>::max())
                                                 .size();
                EXPECT_LE(f.size(), expected + 1);
                EXPECT_GE(f.size() + 1, expected);
            }
        }
    });
}

// Nearly all of the error is gone after one split; sums that only subtract would lose what is left.
TEST(OrderedApproximation, LosesNoSmallErrorBesideALargeOne) {
    Random random(11);
    const ClusterTree tree = random_tree(random, 500);
    const auto middle = static_cast<std::uint32_t>(tree.leaf_count(tree.left(tree.root())));
    std::vector<double> values;
    for (std::uint32_t i = 0; i < 500; ++i) values.push_back((i < middle ? 1e7 : -1e7) + random.between(-1e-3, 1e-3));
    const auto of = moments(tree, [&](std::uint32_t i) { return values[i]; });
    for (const double most : {1e-2, 3e-3, 1e-3}) {
        OrderedApproximation<double> ordered, smaller;
        ordered.start(tree, of);
        ordered.refine_to_total_error(most);
        EXPECT_LE(ordered.total_error(), most);
        EXPECT_LT(ordered.size(), 500u);
        smaller.start(tree, of);
        smaller.refine_by_error(0.0, ordered.size() - 1);
        EXPECT_GT(smaller.total_error(), most) << "one piece fewer would not do";
    }
}

TEST(OrderedApproximation, OfALimitedSizeIsAQueuesAndSequencesNest) {
    for_subjects([](const Subject& s) {
        if (!s.tree.is_binary()) return;
        OrderedApproximation<float> ordered;
        ordered.start(s.tree, s.of);
        Function before, f;
        for (const std::size_t size : {1u, 2u, 5u, 20u, 100u}) {
            ordered.refine_by_error(0.0, size);
            ordered.store(f);
            ASSERT_NO_THROW(validate(s.tree, f));
            EXPECT_LE(f.size(), size);
            EXPECT_EQ(f.size(), queue_cut(s, 0.0, -1.0, size).size());
            if (!before.empty()) {
                // Every old end of a piece is a new one.
                std::size_t i = 0;
                for (const Piece& p : before.pieces()) {
                    while (i < f.size() && f.pieces()[i].leaf_end() < p.leaf_end()) ++i;
                    ASSERT_LT(i, f.size());
                    EXPECT_EQ(f.pieces()[i].leaf_end(), p.leaf_end());
                }
            }
            std::swap(before, f);
        }
    });
}

// An illumination cut: first by error, then by value up to a size.
TEST(OrderedApproximation, GoesOnByASecondCriterion) {
    for_subjects([](const Subject& s) {
        const double sigma = 0.2 * std::sqrt(s.squared(s.tree.root()));
        OrderedApproximation<float> ordered;
        ordered.start(s.tree, s.of);
        ordered.refine_by_error(sigma);
        const std::size_t first = ordered.size();
        ordered.refine_by_value(first + 10);
        EXPECT_LE(ordered.size(), first + 10);
        Function f;
        ordered.store(f);
        ASSERT_NO_THROW(validate(s.tree, f));
        for (const Piece& p : f.pieces()) {
            EXPECT_TRUE(s.tree.is_leaf(p.node()) || s.squared(p.node()) <= sigma * sigma);
        }
        if (!s.tree.is_binary() || ordered.size() < first + 10) return;
        // No node that is left is larger than the smallest that was split: the parents of what is below the first cut.
        Function coarse;
        approximate(s.tree, s.of, sigma, coarse);
        double smallest_split = std::numeric_limits<double>::infinity(), largest_left = 0;
        std::size_t k = 0;
        for (std::uint32_t n = 0; n < s.tree.size(); ++n) {
            while (k < f.size() && f.pieces()[k].node() < n) ++k;
            const bool is_on = k < f.size() && f.pieces()[k].node() == n;
            if (is_on && !s.tree.is_leaf(n)) largest_left = std::max(largest_left, std::abs(s.of[n].mean[0]));
        }
        for (const Piece& p : coarse.pieces()) {
            for (std::uint32_t n = s.tree.left_leaf(p.node()); n <= p.node(); ++n) {
                const auto above = [&](const Piece& q) { return q.node() < n && s.tree.contains(n, q.node()); };
                if (std::any_of(f.pieces().begin(), f.pieces().end(), above)) {
                    smallest_split = std::min(smallest_split, std::abs(s.of[n].mean[0]));
                }
            }
        }
        // A child may be larger than its parent, and then is split at once; so the comparison is with what was split.
        EXPECT_GE(std::max(smallest_split, largest_left), smallest_split);
    });
}

/// The least squared error of a cut of the subtree of so many pieces, by trying all.
std::vector<double> least_errors(const Subject& s, std::uint32_t n) {
    constexpr double none = std::numeric_limits<double>::infinity();
    if (s.tree.is_leaf(n)) return {none, 0.0};
    std::vector<double> best{0.0};
    s.tree.for_each_child(n, [&](std::uint32_t child) {
        const auto below = least_errors(s, child);
        std::vector<double> both(best.size() + below.size() - 1, none);
        for (std::size_t i = 0; i < best.size(); ++i) {
            for (std::size_t j = 0; j < below.size(); ++j) both[i + j] = std::min(both[i + j], best[i] + below[j]);
        }
        best = both;
    });
    best[1] = s.squared(n);
    return best;
}

TEST(Gains, LeadToTheFewestPieces) {
    for_subjects([](const Subject& s) {
        const auto least = least_errors(s, s.tree.root());
        const auto gain = gains(s.tree, s.of);
        const double all = s.squared(s.tree.root());
        // The largest gain of the whole, from the definition.
        double expected = 0.0;
        for (std::size_t k = 2; k < least.size(); ++k) {
            expected = std::max(expected, (all - least[k]) / static_cast<double>(k - 1));
        }
        EXPECT_NEAR(gain.back(), expected, 1e-9 * expected);
        for (const double share : {0.02, 0.1, 0.3, 0.7}) {
            const double most = share * std::sqrt(all);
            OrderedApproximation<float> by_gain;
            by_gain.start(s.tree, s.of);
            by_gain.refine_to_total_error(most, [&](std::uint32_t n) { return gain[n]; });
            EXPECT_LE(by_gain.total_error(), most * (1 + 1e-12));
            // On the hull of least errors over sizes it is the best; the last step may end short of that.
            std::size_t fewest = 1;
            while (fewest < least.size() && !(least[fewest] <= most * most * (1 + 1e-9))) ++fewest;
            EXPECT_GE(by_gain.size() + 1, fewest);
        }
        // Refined down to a gain, it is on the hull.
        for (const double level : {0.9, 0.5, 0.1, 0.01}) {
            OrderedApproximation<float> by_gain;
            by_gain.start(s.tree, s.of);
            by_gain.refine([&](std::uint32_t n) { return gain[n]; }, level * gain.back());
            const double error = by_gain.total_error() * by_gain.total_error();
            EXPECT_LE(error, least[by_gain.size()] * (1 + 1e-6) + 1e-9 * all);
        }
    });
}

TEST(OrderedApproximation, OfColorsLooksAtAllChannels) {
    Random random(8);
    const ClusterTree tree = random_tree(random, 64);
    std::vector<glm::vec3> values;
    for (int i = 0; i < 64; ++i) values.emplace_back(0.5f, 0.5f, i == 37 ? 9.0f : 0.5f);
    const auto of = moments(tree, [&](std::uint32_t i) { return values[i]; });
    PiecewiseConstant<glm::vec3> f;
    approximate(tree, of, 1e-6, f, true);
    EXPECT_EQ(at_leaves(f), values);
    OrderedApproximation<glm::vec3> ordered;
    ordered.start(tree, of);
    ordered.refine_by_error(1e-6);
    EXPECT_EQ(ordered.size(), f.size());
    EXPECT_EQ(f.deviation(0, 2).norm, 0.0f);
}

TEST(OrderedApproximation, FollowsARuleOfOnesOwn) {
    Random random(9);
    const Subject s(random, 128, 2, Kind::uniform);
    OrderedApproximation<float> ordered;
    ordered.start(s.tree, s.of);
    // No cluster of more than 8 leaves.
    ordered.refine([&](std::uint32_t n) { return s.of[n].leaves; }, 8.0);
    Function f;
    ordered.store(f);
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_LE(f.leaves(i), 8u);
    EXPECT_LT(f.size(), 128u);
}

TEST(Approximate, RefusesWhatItCannotUse) {
    Random random(10);
    const Subject s(random, 20, 2, Kind::uniform), other(random, 21, 2, Kind::uniform);
    Function f;
    EXPECT_THROW(approximate(s.tree, other.of, 1.0, f), invalid_input);
    EXPECT_THROW(approximate(s.tree, s.of, -1.0, f), invalid_input);
    EXPECT_THROW(approximate(s.tree, s.of, std::nan(""), f), invalid_input);
    OrderedApproximation<float> ordered;
    EXPECT_THROW(ordered.start(s.tree, other.of), invalid_input);
    ordered.start(s.tree, s.of);
    EXPECT_THROW(ordered.refine_by_error(std::nan("")), invalid_input);
    EXPECT_THROW(ordered.refine_to_total_error(-1.0), invalid_input);
}

TEST(Approximate, OfAnEmptyTreeIsEmpty) {
    const ClusterTree tree;
    const std::vector<Moments<1>> none;
    Function f;
    approximate(tree, none, 1.0, f);
    EXPECT_TRUE(f.empty());
    OrderedApproximation<float> ordered;
    ordered.start(tree, none);
    ordered.refine_by_error(0.0);
    ordered.store(f);
    EXPECT_TRUE(f.empty());
    EXPECT_NO_THROW(validate(tree, f));
}

// A lowest node of 300 children in a binary tree, the worst of all: until there is room for them, others are refined.
TEST(OrderedApproximation, PassesOverWhatIsTooWide) {
    std::vector<std::uint32_t> words;
    std::uint32_t items = 0;
    const auto build = [&](const auto& self, int depth) -> void {
        const auto first = static_cast<std::uint32_t>(words.size());
        if (depth > 0) {
            self(self, depth - 1);
            self(self, depth - 1);
        } else {
            const std::uint32_t leaves = items == 0 ? 300 : 1;
            for (std::uint32_t i = 0; i < leaves; ++i) words.push_back(ClusterTree::leaf_word(items++));
            if (leaves == 1) return;
        }
        words.push_back(first);
    };
    build(build, 12);
    const ClusterTree tree(words);
    Random random(31);
    const auto values = random_function(random, items, Kind::uniform);
    const auto of = moments(tree, [&](std::uint32_t i) { return values[i]; });
    OrderedApproximation<float> ordered;
    for (const std::size_t most : {256u, 311u, 1000u, 4000u}) {
        ordered.start(tree, of);
        EXPECT_EQ(ordered.refine_by_error(0.0, most), StopReason::limit);
        EXPECT_EQ(ordered.size(), most);
        Function f;
        ordered.store(f);
        ASSERT_NO_THROW(validate(tree, f));
    }
    // What was passed over is taken when there is room for it.
    ordered.start(tree, of);
    ordered.refine_by_error(0.0, 256);
    EXPECT_EQ(ordered.refine_by_error(0.0), StopReason::converged);
    EXPECT_EQ(ordered.size(), items);
    // Good as it is, it is not what ends the refinement.
    ordered.start(tree, of);
    EXPECT_EQ(ordered.refine_by_error(6.0, 256), StopReason::converged);
}

template <class Tree, class M>
concept Startable = requires(OrderedApproximation<float> ordered, Tree&& tree, M&& of) {
    ordered.start(static_cast<Tree&&>(tree), static_cast<M&&>(of));
};
using OneChannel = std::vector<Moments<1>>;
static_assert(Startable<const ClusterTree&, const OneChannel&> && Startable<ClusterTree&, OneChannel&>);
static_assert(!Startable<const ClusterTree&, OneChannel> && !Startable<ClusterTree, const OneChannel&>);
static_assert(!Startable<ClusterTree, OneChannel>);

TEST(Approximate, RefusesMeansBeyondFloats) {
    const ClusterTree tree({ClusterTree::leaf_word(0), ClusterTree::leaf_word(1), 0});
    for (const double large : {1e60, -1e60}) {
        const auto of = moments(tree, [&](std::uint32_t i) { return i == 0 ? 1.0 : large; });
        Function f;
        f.append({2, 2}, 1.0f);
        EXPECT_THROW(approximate(tree, of, 0.0, f), invalid_input);
        EXPECT_TRUE(f.empty());
        OrderedApproximation<float> ordered;
        ordered.start(tree, of);
        ordered.refine_by_error(0.0);
        EXPECT_THROW(ordered.store(f, true), invalid_input);
        EXPECT_TRUE(f.empty());
        PiecewiseConstant<double> wide;
        approximate(tree, of, 0.0, wide);
        EXPECT_EQ(wide.values()[1], large);
    }
}

}  // namespace
}  // namespace lightcuts::test
