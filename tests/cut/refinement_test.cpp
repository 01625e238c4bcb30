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
    using Node = ToyNode;

    std::uint64_t seed = 1;
    double limit_below = 0.01;
    std::size_t root_count = 1;
    std::vector<std::uint32_t> splits{};
    std::vector<std::size_t> batches{};  ///< sizes of what was evaluated at once
    std::vector<std::uint32_t> seen{};

    void roots(ReusableList<Node>& out) {
        for (std::uint32_t i = 0; i < root_count; ++i) out.append({i, 1.0 + 0.1 * i});
    }
    void evaluate(std::span<Node> fresh) {
        batches.push_back(fresh.size());
        for (const Node& n : fresh) seen.push_back(n.index);
    }
    double priority(const Node& n) const { return n.priority; }
    double threshold() const { return limit_below; }
    void split(const Node& n, ReusableList<Node>& out) {
        splits.push_back(n.index);
        for (const std::uint32_t child : {2 * n.index + root_count_(), 2 * n.index + root_count_() + 1}) {
            out.append({child, n.priority * (0.3 + 0.5 * uniform01(hash_keys(seed, child)))});
        }
    }
    bool precedes(const Node& a, const Node& b) const { return a.index < b.index; }

private:
    std::uint32_t root_count_() const { return static_cast<std::uint32_t>(root_count); }
};
static_assert(RefinementProblem<Toy>);

/// The papers' order: a heap, one node at a time.
std::vector<std::uint32_t> heap_order(Toy toy, std::size_t max_nodes) {
    ReusableList<ToyNode> list;
    toy.roots(list);
    std::vector<ToyNode> frontier(list.data(), list.data() + list.size());
    while (frontier.size() < max_nodes) {
        const auto top = std::max_element(frontier.begin(), frontier.end(),
                                          [](const ToyNode& a, const ToyNode& b) { return a.priority < b.priority; });
        if (!(top->priority > toy.threshold())) break;
        const ToyNode n = *top;
        frontier.erase(top);
        list.clear();
        toy.split(n, list);
        frontier.insert(frontier.end(), list.data(), list.data() + list.size());
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
    using Node = ToyNode;
    std::vector<ToyNode> list;
    std::vector<std::uint32_t> splits{};

    void roots(ReusableList<Node>& out) {
        for (const Node& n : list) out.append(n);
    }
    void evaluate(std::span<Node>) {}
    double priority(const Node& n) const { return n.priority; }
    double threshold() const { return 0.5; }
    void split(const Node& n, ReusableList<Node>& out) {
        splits.push_back(n.index);
        out.append({n.index + 100, 0.0});
        out.append({n.index + 200, 0.0});
    }
    /// Larger indices first.
    bool precedes(const Node& a, const Node& b) const { return a.index > b.index; }
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

    void tighten(ReusableList<Node>& frontier, std::span<RefinementCandidate> candidates) {
        for (RefinementCandidate& candidate : candidates) {
            Node& n = frontier[candidate.at];
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
    bool is_final(const Node& n) const { return n.priority < 0.02; }
    double priority(const Node& n) const {
        asked_in_vain += is_final(n) ? 1 : 0;
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
    double base = 1.0;
    std::size_t observed = 0;

    double priority(const Node& n) const { return n.priority * base; }
    template <class Visit>
    void observe(const Visit& visit) {
        observed = 0;
        visit([this](const Node&) { ++observed; });
        weight = round < weights.size() ? weights[round] : weights.back();
        ++round;
    }
    void checkpoint() { base = weight; }
    double priority_scale() const { return weight / base; }
    double priority_spread() const { return spread; }
    double spread = 1.0;
};

TEST(Refinement, ForgetsNoNodeWhosePriorityGrowsAgain) {
    Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
        Swaying problem;
        problem.seed = static_cast<std::uint64_t>(trial);
        problem.spread = trial % 3 == 0 ? 2.0 : 1.0;
        for (int i = 0; i < 12; ++i) problem.weights.push_back(random.decades(-1.0, 1.0));
        Refinement<ToyNode> refinement;
        refinement.run(problem, {.round_fraction = trial % 2 == 0 ? 0.1 : 1.0});
        EXPECT_EQ(problem.observed, refinement.size());
        refinement.for_each(
            [&](const ToyNode& n) { EXPECT_LE(n.priority * problem.weight, problem.threshold() * (1.0 + 1e-12)); });
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

/// The same tree, whose priorities are said to be fixed.
struct FixedToy : Toy {
    static constexpr bool fixed_priorities = true;
};
static_assert(FixedPriorityProblem<FixedToy> && !FixedPriorityProblem<Toy>);

TEST(Refinement, OfFixedPrioritiesIsTheSameWithAHeap) {
    for (const double fraction : {1.0, 0.5, 0.1, 0.0}) {
        for (const std::size_t limit : {1u, 7u, 50u, 100000u}) {
            Toy scanned;
            FixedToy heaped;
            Refinement<ToyNode> a, b;
            a.run(scanned, {.max_nodes = limit, .round_fraction = fraction});
            b.run(heaped, {.max_nodes = limit, .round_fraction = fraction});
            EXPECT_EQ(cut_of(a), cut_of(b)) << fraction << " " << limit;
            EXPECT_EQ(scanned.batches, heaped.batches);
            EXPECT_EQ(a.stop_reason(), b.stop_reason());
        }
    }
}

/// Counts what the engine asks of it.
template <class T>
struct Counting : T {
    mutable std::uint64_t asked = 0;
    double priority(const ToyNode& n) const {
        ++asked;
        return T::priority(n);
    }
    bool precedes(const ToyNode& a, const ToyNode& b) const {
        ++asked;
        return T::precedes(a, b);
    }
};

// One at a time, n splits of a frontier that a scan would look at n^2 / 2 times.
TEST(Refinement, OneAtATimeAsksForEveryPriorityOnce) {
    Counting<FixedToy> toy;
    toy.limit_below = 1e-5;
    Refinement<ToyNode> refinement;
    refinement.run(toy, {.max_nodes = 20000, .round_fraction = 1.0});
    EXPECT_EQ(refinement.size(), 20000u);
    EXPECT_LE(toy.asked, 2 * toy.splits.size() + 1);
}

TEST(Refinement, KeepsTwoPlacesANodeAtMost) {
    for (const double fraction : {1.0, 0.1}) {
        Toy toy;
        toy.limit_below = 1e-3;
        Refinement<ToyNode> refinement;
        refinement.start(toy);
        std::size_t children = 0;
        while (refinement.step(toy, {.max_nodes = 5000, .round_fraction = fraction})) {
            children = std::max(children, toy.batches.back());
            // Storage grows by doubling.
            EXPECT_LE(refinement.capacity(), 2 * (refinement.size() + children));
        }
    }
}

/// Lazy clusters of any number of children, some of which vanish: node n has 0 to 7.
struct Lazy {
    using Node = ToyNode;
    static constexpr std::size_t most_children = 7;
    std::uint64_t seed = 1;
    std::vector<std::uint32_t> splits{};

    void roots(ReusableList<Node>& out) { out.append({1, 1.0}); }
    void evaluate(std::span<Node>) {}
    double priority(const Node& n) const { return n.priority; }
    double threshold() const { return 0.01; }
    std::uint32_t child_count(const Node& n) const { return static_cast<std::uint32_t>(hash_keys(seed, n.index) % 8); }
    void split(const Node& n, ReusableList<Node>& out) {
        splits.push_back(n.index);
        for (std::uint32_t k = 0; k < child_count(n); ++k) {
            const std::uint32_t child = 7 * n.index + k + 1;
            out.append({child, n.priority * (0.2 + 0.4 * uniform01(hash_keys(seed, child, 1)))});
        }
    }
    bool precedes(const Node& a, const Node& b) const { return a.index < b.index; }
};
struct FixedLazy : Lazy {
    static constexpr bool fixed_priorities = true;
};

template <class P>
void refine_lazily(std::uint64_t seed, const RefinementOptions& options) {
    P problem;
    problem.seed = seed;
    Refinement<ToyNode> refinement;
    refinement.start(problem);
    while (refinement.step(problem, options)) EXPECT_LE(refinement.size(), options.max_nodes);
    // By recursion: the nodes whose parents were split and which were not.
    std::vector<std::uint32_t> expected;
    ReusableList<ToyNode> stack;
    P again;
    again.seed = seed;
    again.roots(stack);
    while (!stack.empty()) {
        const ToyNode n = stack[stack.size() - 1];
        stack.pop_back();
        const bool is_split = std::find(problem.splits.begin(), problem.splits.end(), n.index) != problem.splits.end();
        if (is_split) {
            stack.reserve(stack.size() + P::most_children);
            again.split(n, stack);
        } else {
            expected.push_back(n.index);
        }
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(cut_of(refinement), expected) << seed;
    EXPECT_EQ(refinement.size(), expected.size());
    if (refinement.stop_reason() == StopReason::converged) {
        refinement.for_each([&](const ToyNode& n) { EXPECT_LE(n.priority, problem.threshold()); });
    }
}

TEST(Refinement, TakesAnyNumberOfChildren) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        for (const double fraction : {1.0, 0.1, 0.0}) {
            refine_lazily<Lazy>(seed, {.max_nodes = 100, .round_fraction = fraction});
            refine_lazily<FixedLazy>(seed, {.max_nodes = 100, .round_fraction = fraction});
            refine_lazily<Lazy>(seed, {.max_nodes = 2000, .round_fraction = fraction});
        }
    }
}

/// A sum over pairs of two ranges of numbers: a node is a pair of ranges, split on the side that is longer. Pairs whose
/// product is zero throughout are dropped. The bound of a pair is the largest product times the number of pairs.
struct ProductGraph {
    struct Node {
        std::uint32_t a = 0, a_end = 0, b = 0, b_end = 0;
        double sum = 0.0;
    };
    static constexpr bool fixed_priorities = true;
    static constexpr std::uint32_t size = 64;
    double total = 0.0;
    double ratio = 0.02;

    static double left(std::uint32_t i) { return i % 16 < 8 ? 0.0 : 1.0 / (1.0 + i); }
    static double right(std::uint32_t i) { return uniform01(hash_keys(5, i)); }
    template <class F>
    static double largest(std::uint32_t begin, std::uint32_t end, F f) {
        double most = 0.0;
        for (std::uint32_t i = begin; i < end; ++i) most = std::max(most, f(i));
        return most;
    }

    void append(std::uint32_t a, std::uint32_t a_end, std::uint32_t b, std::uint32_t b_end, ReusableList<Node>& out) {
        if (largest(a, a_end, left) > 0.0) out.append({a, a_end, b, b_end});
    }
    void roots(ReusableList<Node>& out) { append(0, size, 0, size, out); }
    void evaluate(std::span<Node> fresh) {
        for (Node& n : fresh) {
            n.sum = left(n.a) * right(n.b) * (n.a_end - n.a) * (n.b_end - n.b);
            total += n.sum;
        }
    }
    double priority(const Node& n) const {
        if (n.a_end - n.a == 1 && n.b_end - n.b == 1) return 0.0;
        return largest(n.a, n.a_end, left) * largest(n.b, n.b_end, right) * (n.a_end - n.a) * (n.b_end - n.b);
    }
    double threshold() const { return ratio * total; }
    void split(const Node& n, ReusableList<Node>& out) {
        total -= n.sum;
        if (n.a_end - n.a >= n.b_end - n.b) {
            const std::uint32_t middle = (n.a + n.a_end) / 2;
            append(n.a, middle, n.b, n.b_end, out);
            append(middle, n.a_end, n.b, n.b_end, out);
        } else {
            const std::uint32_t middle = (n.b + n.b_end) / 2;
            append(n.a, n.a_end, n.b, middle, out);
            append(n.a, n.a_end, middle, n.b_end, out);
        }
    }
    bool precedes(const Node& a, const Node& b) const { return a.a != b.a ? a.a < b.a : a.b < b.b; }
};

TEST(Refinement, RefinesAProductGraphToItsBounds) {
    double exact = 0.0;
    for (std::uint32_t a = 0; a < ProductGraph::size; ++a) {
        for (std::uint32_t b = 0; b < ProductGraph::size; ++b) exact += ProductGraph::left(a) * ProductGraph::right(b);
    }
    for (const double ratio : {0.1, 0.01, 0.0}) {
        ProductGraph problem;
        problem.ratio = ratio;
        Refinement<ProductGraph::Node> refinement;
        refinement.run(problem, {});
        double sum = 0.0, bound = 0.0;
        refinement.for_each([&](const ProductGraph::Node& n) {
            sum += n.sum;
            bound += problem.priority(n);
            EXPECT_LE(problem.priority(n), problem.threshold() * (1.0 + 1e-12));
        });
        EXPECT_NEAR(sum, problem.total, 1e-9);
        EXPECT_NEAR(sum, exact, bound + 1e-9);
        if (ratio == 0.0) { EXPECT_NEAR(sum, exact, 1e-9); }
    }
}

/// Approximation of a function by a cut: intervals are halved where it varies, and then, while the limit allows, where
/// it is largest.
struct Approximation {
    struct Node {
        double from = 0.0, to = 1.0;
    };
    static constexpr bool fixed_priorities = true;
    bool by_variance = true;
    double limit = 1e-3;

    static double value(double x) { return x < 0.3 ? 1.0 : x * x; }
    double variance(const Node& n) const {
        double mean = 0.0, square = 0.0;
        for (int i = 0; i < 16; ++i) {
            const double v = value(n.from + (n.to - n.from) * (i + 0.5) / 16.0);
            mean += v / 16.0;
            square += v * v / 16.0;
        }
        return std::max(0.0, square - mean * mean) * (n.to - n.from);
    }
    void roots(ReusableList<Node>& out) { out.append({0.0, 1.0}); }
    void evaluate(std::span<Node>) {}
    double priority(const Node& n) const {
        return by_variance ? variance(n) : value(0.5 * (n.from + n.to)) * (n.to - n.from);
    }
    double threshold() const { return by_variance ? limit : 0.0; }
    void split(const Node& n, ReusableList<Node>& out) {
        const double middle = 0.5 * (n.from + n.to);
        out.append({n.from, middle});
        out.append({middle, n.to});
    }
    bool precedes(const Node& a, const Node& b) const { return a.from < b.from; }
};

TEST(Refinement, GoesOnWithASecondCriterion) {
    Approximation first;
    Refinement<Approximation::Node> refinement;
    refinement.run(first, {.max_nodes = 1000});
    EXPECT_EQ(refinement.stop_reason(), StopReason::converged);
    const std::size_t pieces = refinement.size();
    EXPECT_LT(pieces, 64u);
    refinement.for_each([&](const Approximation::Node& n) { EXPECT_LE(first.variance(n), first.limit); });

    Approximation second;
    second.by_variance = false;
    refinement.reprioritize(second);
    while (refinement.step(second, {.max_nodes = 64, .round_fraction = 1.0})) {}
    EXPECT_EQ(refinement.size(), 64u);
    EXPECT_EQ(refinement.stop_reason(), StopReason::limit);
    double length = 0.0, largest = 0.0;
    refinement.for_each([&](const Approximation::Node& n) {
        length += n.to - n.from;
        largest = std::max(largest, second.priority(n));
        EXPECT_LE(first.variance(n), first.limit) << "nothing becomes coarser";
    });
    EXPECT_DOUBLE_EQ(length, 1.0);
    // The largest is not larger than the parent of any piece that the second criterion made.
    Refinement<Approximation::Node> coarse;
    coarse.run(first, {.max_nodes = 1000});
    double before = 0.0;
    coarse.for_each([&](const Approximation::Node& n) { before = std::max(before, second.priority(n)); });
    EXPECT_LT(largest, before);
}

}  // namespace
}  // namespace lightcuts::test
