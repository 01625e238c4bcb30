#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/refinement.hpp>
#include "support/random.hpp"

namespace lightcuts::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct ToyNode {
    std::uint32_t index;  ///< in an endless binary tree; the children of n are 2n + 1 and 2n + 2
    double priority;
};

/// Refines an endless binary tree whose priorities fall from parent to child, and writes down what the engine does.
/// Evaluates nothing.
struct Toy {
    using node = ToyNode;

    std::uint64_t seed = 1;
    double limit_below = 0.01;
    std::size_t root_count = 1;
    std::vector<std::uint32_t> splits{};
    std::vector<std::size_t> batches{};  ///< sizes of what was evaluated at once
    std::vector<std::uint32_t> seen{};

    void roots(std::vector<node>& out) {
        for (std::uint32_t i = 0; i < root_count; ++i) out.push_back({i, 1.0 + 0.1 * i});
    }
    void evaluate(std::span<node> fresh) {
        batches.push_back(fresh.size());
        for (const node& n : fresh) seen.push_back(n.index);
    }
    double priority(const node& n) const { return n.priority; }
    double threshold() const { return limit_below; }
    void split(const node& n, std::vector<node>& out) {
        splits.push_back(n.index);
        for (const std::uint32_t child : {2 * n.index + root_count_(), 2 * n.index + root_count_() + 1}) {
            out.push_back({child, n.priority * (0.3 + 0.5 * to_unit(hash_keys(seed, child)))});
        }
    }
    bool before(const node& a, const node& b) const { return a.index < b.index; }

private:
    std::uint32_t root_count_() const { return static_cast<std::uint32_t>(root_count); }
};
static_assert(RefinementProblem<Toy>);

/// The papers' order: a heap, one node at a time.
std::vector<std::uint32_t> heap_order(Toy toy, std::size_t max_nodes) {
    std::vector<ToyNode> frontier;
    toy.roots(frontier);
    while (frontier.size() < max_nodes) {
        const auto top = std::max_element(frontier.begin(), frontier.end(),
                                          [](const ToyNode& a, const ToyNode& b) { return a.priority < b.priority; });
        if (!(top->priority > toy.threshold())) break;
        const ToyNode n = *top;
        frontier.erase(top);
        toy.split(n, frontier);
    }
    return toy.splits;
}

std::vector<std::uint32_t> cut_of(const Refinement<ToyNode>& refinement) {
    std::vector<std::uint32_t> cut;
    refinement.for_each([&](const ToyNode& n) { cut.push_back(n.index); });
    std::sort(cut.begin(), cut.end());
    return cut;
}

TEST(Refinement, OneAtATimeIsTheOrderOfAHeap) {
    for (const std::size_t limit : {1u, 2u, 10u, 100u, 100000u}) {
        Toy toy;
        Refinement<ToyNode> refinement;
        refinement.run(toy, {.max_nodes = limit, .round_fraction = 1.0});
        EXPECT_EQ(toy.splits, heap_order(Toy{}, limit));
        EXPECT_EQ(refinement.stop_reason(), limit < 1000 ? StopReason::limit : StopReason::converged);
    }
}

TEST(Refinement, OfAFractionAboveOneIsOneAtATime) {
    Toy one, more;
    Refinement<ToyNode> a, b;
    a.run(one, {.round_fraction = 1.0});
    b.run(more, {.round_fraction = 1.5});
    EXPECT_EQ(more.splits, one.splits);
    EXPECT_EQ(cut_of(b), cut_of(a));
    EXPECT_GT(b.size(), 1u);
}

// Without a limit the cut is the set of nodes where the priority first falls to the threshold, whatever the rounds.
TEST(Refinement, OfAnyRoundsEndsAtTheSameCut) {
    Toy one;
    Refinement<ToyNode> reference;
    reference.run(one, {.round_fraction = 1.0});
    for (const double fraction : {0.9, 0.25, 0.01, 0.0}) {
        Toy toy;
        Refinement<ToyNode> refinement;
        refinement.run(toy, {.round_fraction = fraction});
        EXPECT_EQ(cut_of(refinement), cut_of(reference));
        EXPECT_LT(toy.batches.size(), one.batches.size());
        refinement.for_each([&](const ToyNode& n) { EXPECT_LE(n.priority, toy.threshold()); });
    }
}

TEST(Refinement, OfARoundSplitsDownToTheFractionOfTheLargest) {
    Toy toy;
    Refinement<ToyNode> refinement;
    refinement.start(toy);
    ASSERT_TRUE(refinement.step(toy, {}));  // the roots
    for (;;) {
        std::vector<ToyNode> before;
        refinement.for_each([&](const ToyNode& n) { before.push_back(n); });
        double largest = 0.0;
        for (const ToyNode& n : before) largest = std::max(largest, n.priority);
        std::vector<std::uint32_t> expected;
        for (const ToyNode& n : before) {
            if (n.priority > toy.threshold() && n.priority >= 0.25 * largest) expected.push_back(n.index);
        }
        toy.splits.clear();
        const bool went_on = refinement.step(toy, {.round_fraction = 0.25});
        std::sort(expected.begin(), expected.end());
        std::sort(toy.splits.begin(), toy.splits.end());
        EXPECT_EQ(toy.splits, expected);
        EXPECT_EQ(went_on, !expected.empty());
        if (!went_on) break;
    }
    EXPECT_FALSE(refinement.step(toy, {})) << "what has ended stays so";
}

TEST(Refinement, NeverOvershootsItsLimit) {
    for (std::size_t limit = 1; limit < 60; ++limit) {
        for (const double fraction : {1.0, 0.25, 0.0}) {
            Toy toy;
            Refinement<ToyNode> refinement;
            refinement.start(toy);
            while (refinement.step(toy, {.max_nodes = limit, .round_fraction = fraction})) {
                EXPECT_LE(refinement.size(), limit);
            }
            EXPECT_EQ(refinement.size(), limit);
            EXPECT_EQ(refinement.stop_reason(), StopReason::limit);
        }
    }
}

TEST(Refinement, KeepsAStartingFrontierLargerThanItsLimit) {
    Toy toy;
    toy.root_count = 5;
    Refinement<ToyNode> refinement;
    refinement.run(toy, {.max_nodes = 3});
    EXPECT_EQ(refinement.size(), 5u);
    EXPECT_EQ(refinement.stop_reason(), StopReason::limit);
    EXPECT_TRUE(toy.splits.empty());
}

TEST(Refinement, OfNoRootsIsEmpty) {
    Toy toy;
    toy.root_count = 0;
    Refinement<ToyNode> refinement;
    refinement.run(toy, {});
    EXPECT_EQ(refinement.size(), 0u);
    EXPECT_EQ(refinement.stop_reason(), StopReason::converged);
    EXPECT_TRUE(toy.batches.empty()) << "nothing to evaluate";
}

TEST(Refinement, EvaluatesEveryNodeOnce) {
    Toy toy;
    toy.root_count = 3;
    Refinement<ToyNode> refinement;
    refinement.run(toy, {});
    std::vector<std::uint32_t> seen = toy.seen;
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
    EXPECT_EQ(seen.size(), 3 + 2 * toy.splits.size());
    EXPECT_EQ(refinement.size(), 3 + toy.splits.size());
    EXPECT_EQ(toy.batches.front(), 3u);
}

// Frontiers of fixed priorities.
struct Listed {
    using node = ToyNode;
    std::vector<ToyNode> list;
    std::vector<std::uint32_t> splits{};

    void roots(std::vector<node>& out) { out = list; }
    void evaluate(std::span<node>) {}
    double priority(const node& n) const { return n.priority; }
    double threshold() const { return 0.5; }
    void split(const node& n, std::vector<node>& out) {
        splits.push_back(n.index);
        out.push_back({n.index + 100, 0.0});
        out.push_back({n.index + 200, 0.0});
    }
    /// Larger indices first.
    bool before(const node& a, const node& b) const { return a.index > b.index; }
};

TEST(Refinement, TakesInfinitiesFirstThenTheLargestThenBreaksTies) {
    const std::vector<ToyNode> list{{1, 3.0},      {2, infinity}, {3, 5.0}, {4, 5.0},
                                    {5, infinity}, {6, 0.5},      {7, 5.0}, {8, 2.0}};
    const std::vector<std::uint32_t> order{5, 2, 7, 4, 3, 1, 8};  // 6 is at the threshold, not above
    for (std::size_t room = 0; room <= order.size(); ++room) {
        Listed problem{list};
        Refinement<ToyNode> refinement;
        refinement.run(problem, {.max_nodes = list.size() + room, .round_fraction = 0.0});
        std::vector<std::uint32_t> expected(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(room));
        std::sort(expected.begin(), expected.end());
        std::sort(problem.splits.begin(), problem.splits.end());
        EXPECT_EQ(problem.splits, expected) << room;
        EXPECT_EQ(refinement.stop_reason(), room < order.size() ? StopReason::limit : StopReason::converged);
    }
}

// Infinite priorities do not raise the bar for finite ones: the fraction is of the largest finite one.
TEST(Refinement, SplitsInfinitiesAlongWithTheLargestFiniteInOneRound) {
    Listed problem{{{1, infinity}, {2, 8.0}, {3, 4.0}, {4, 1.0}}};
    Refinement<ToyNode> refinement;
    refinement.start(problem);
    refinement.step(problem, {});
    refinement.step(problem, {.round_fraction = 0.5});
    std::sort(problem.splits.begin(), problem.splits.end());
    EXPECT_EQ(problem.splits, (std::vector<std::uint32_t>{1, 2, 3}));
}

/// Priorities are first guesses, ten times too large.
struct Tightening : Toy {
    std::vector<std::uint32_t> tightened;

    void tighten(std::span<RefinementCandidate<node>> candidates) {
        for (RefinementCandidate<node>& candidate : candidates) {
            node& n = *candidate.node;
            EXPECT_EQ(n.priority, candidate.priority);
            EXPECT_GT(n.priority, threshold()) << "only nodes above the threshold are worth it";
            if (std::find(tightened.begin(), tightened.end(), n.index) != tightened.end()) continue;
            tightened.push_back(n.index);
            candidate.priority = n.priority *= 0.1;
        }
    }
};

TEST(Refinement, TightensBeforeItSplits) {
    Tightening problem;
    problem.limit_below = 0.001;
    Refinement<ToyNode> refinement;
    refinement.run(problem, {});
    for (const std::uint32_t split : problem.splits) {
        EXPECT_NE(std::find(problem.tightened.begin(), problem.tightened.end(), split), problem.tightened.end());
    }
    EXPECT_GT(problem.tightened.size(), problem.splits.size()) << "some are spared";
    refinement.for_each([&](const ToyNode& n) { EXPECT_LE(n.priority, problem.threshold()); });
}

/// Nodes of a priority below 0.02 can never be refined.
struct Settling : Toy {
    mutable std::size_t asked_in_vain = 0;
    bool settled(const node& n) const { return n.priority < 0.02; }
    double priority(const node& n) const {
        asked_in_vain += settled(n) ? 1 : 0;
        return n.priority;
    }
};

TEST(Refinement, LooksAtSettledNodesNoMore) {
    Settling problem;
    Refinement<ToyNode> refinement;
    refinement.run(problem, {});
    EXPECT_EQ(problem.asked_in_vain, 0u);
    Toy toy;
    Refinement<ToyNode> reference;
    toy.limit_below = 0.02;
    reference.run(toy, {});
    EXPECT_EQ(cut_of(refinement), cut_of(reference));
}

/// Priorities are bounds times a weight that rises and falls from round to round, as a total does.
struct Swaying : Toy {
    std::vector<double> weights;
    std::size_t round = 0;
    double weight = 1.0;
    double least = 1.0;
    std::size_t observed = 0;

    double priority(const node& n) const { return n.priority * weight; }
    template <class Visit>
    void observe(const Visit& visit) {
        observed = 0;
        visit([this](const node&) { ++observed; });
        weight = round < weights.size() ? weights[round] : weights.back();
        ++round;
        least = std::min(least, weight);
    }
    void mark() { least = weight; }
    double growth() const { return weight / least; }
};

TEST(Refinement, ForgetsNoNodeWhosePriorityGrowsAgain) {
    Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
        Swaying problem;
        problem.seed = static_cast<std::uint64_t>(trial);
        for (int i = 0; i < 12; ++i) problem.weights.push_back(random.decades(-1.0, 1.0));
        Refinement<ToyNode> refinement;
        refinement.run(problem, {});
        EXPECT_EQ(problem.observed, refinement.size());
        refinement.for_each(
            [&](const ToyNode& n) { EXPECT_LE(problem.priority(n), problem.threshold() * (1.0 + 1e-12)); });
    }
}

TEST(Refinement, CanBeUsedAgain) {
    Refinement<ToyNode> refinement;
    Toy first;
    refinement.run(first, {.max_nodes = 17});
    const auto cut = cut_of(refinement);
    Toy other;
    other.seed = 99;
    other.root_count = 4;
    refinement.run(other, {});
    Toy again;
    refinement.run(again, {.max_nodes = 17});
    EXPECT_EQ(cut_of(refinement), cut);
    EXPECT_EQ(again.splits, first.splits);
}

}  // namespace
}  // namespace lightcuts::test
