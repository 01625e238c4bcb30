#include <lightcuts/piecewise/merge.hpp>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include <lightcuts/piecewise/algebra.hpp>
#include "piecewise/functions.hpp"

namespace lightcuts::test {
namespace {

using Function = PiecewiseConstant<float>;

Function random_piecewise(Random& random, const ClusterTree& tree) {
    const auto nodes = random_cut(random, tree, random.chance(0.2) ? 1.0 : random.between(0.0, 0.5));
    std::vector<float> values;
    for (std::size_t i = 0; i < nodes.size(); ++i) values.push_back(random.real(-2.0, 2.0));
    Function f;
    assign<float>(tree, nodes, values, f);
    return f;
}

struct Call {
    std::uint32_t node, leaves;
    std::vector<float> values;
    friend bool operator==(const Call&, const Call&) = default;
};

/// From the definition: of all nodes that any of the cuts has, those that have none of the others below.
std::vector<Call> by_definition(const ClusterTree& tree, const std::vector<Function>& functions) {
    std::vector<bool> marked(tree.size(), false);
    for (const Function& f : functions) {
        for (const Piece& p : f.pieces()) marked[p.node()] = true;
    }
    std::vector<std::vector<float>> values;
    for (const Function& f : functions) values.push_back(at_leaves(f));
    std::vector<Call> calls;
    std::uint32_t leaf = 0;
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        if (!marked[n]) continue;
        const std::uint32_t first = tree.left_leaf(n);
        if (std::any_of(marked.begin() + first, marked.begin() + n, [](bool m) { return m; })) continue;
        Call call{n, static_cast<std::uint32_t>(tree.leaf_count(n)), {}};
        for (const auto& v : values) call.values.push_back(v[leaf]);
        calls.push_back(call);
        leaf += call.leaves;
    }
    EXPECT_EQ(leaf, tree.item_count());
    return calls;
}

template <std::size_t N>
std::vector<Call> by_merge(const std::vector<Function>& f) {
    std::vector<Call> calls;
    const auto op = [&](std::uint32_t node, std::uint32_t leaves, auto... values) {
        calls.push_back({node, leaves, {values...}});
    };
    [&]<std::size_t... k>(std::index_sequence<k...>) { merge(op, f[k]...); }
    (std::make_index_sequence<N>{});
    return calls;
}

TEST(Merge, VisitsTheDeepestNodesOfAllCutsOnce) {
    Random random(1);
    MergeScratch<float> scratch;
    for (int trial = 0; trial < 300; ++trial) {
        const auto leaves = 1 + static_cast<std::uint32_t>(random.below(trial % 2 == 0 ? 6 : 120));
        const ClusterTree tree = random_tree(random, leaves, trial % 3 == 0 ? 6 : 2);
        std::vector<Function> f;
        for (int i = 0; i < 8; ++i) f.push_back(random_piecewise(random, tree));
        for (std::size_t n = 1; n <= 8; ++n) {
            const std::vector<Function> some(f.begin(), f.begin() + static_cast<std::ptrdiff_t>(n));
            const auto expected = by_definition(tree, some);
            std::vector<Call> dynamic;
            merge(std::span<const Function>(some), scratch,
                  [&](std::uint32_t node, std::uint32_t count, std::span<const float> values) {
                      dynamic.push_back({node, count, {values.begin(), values.end()}});
                  });
            EXPECT_EQ(dynamic, expected);
            if (n == 1) { EXPECT_EQ(by_merge<1>(some), expected); }
            if (n == 2) { EXPECT_EQ(by_merge<2>(some), expected); }
            if (n == 3) { EXPECT_EQ(by_merge<3>(some), expected); }
            if (n == 4) { EXPECT_EQ(by_merge<4>(some), expected); }
            if (n == 5) { EXPECT_EQ(by_merge<5>(some), expected); }
            if (n == 8) { EXPECT_EQ(by_merge<8>(some), expected); }
        }
    }
}

TEST(Merge, OfFunctionsOfDifferentTypes) {
    Random random(2);
    const ClusterTree tree = random_tree(random, 50);
    const Function f = random_piecewise(random, tree), g = random_piecewise(random, tree);
    PiecewiseConstant<glm::vec3> color;
    merged(
        color, [](float a) { return glm::vec3(a, 2.0f, a * a); }, f);
    ASSERT_NO_THROW(validate(tree, color));
    const glm::vec3 sum = sum_of_products(color, g);
    const auto a = at_leaves(f), b = at_leaves(g);
    glm::dvec3 expected(0.0);
    for (std::size_t i = 0; i < a.size(); ++i) expected += glm::dvec3(a[i], 2.0, a[i] * a[i]) * double(b[i]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], expected[c], 1e-4);
    // One channel of a color.
    EXPECT_NEAR(sum_of_products(PiecewiseChannel(color, 2), g), expected[2], 1e-4);
}

TEST(Algebra, IsThatOfTheLeaves) {
    Random random(3);
    for (int trial = 0; trial < 100; ++trial) {
        const ClusterTree tree = random_tree(random, 1 + static_cast<std::uint32_t>(random.below(80)),
                                             trial % 2 == 0 ? 2 : 5);
        std::vector<Function> f;
        for (int i = 0; i < 3; ++i) f.push_back(random_piecewise(random, tree));
        const auto a = at_leaves(f[0]), b = at_leaves(f[1]), c = at_leaves(f[2]);
        Function products, sums, mixed;
        product(products, f[0], f[1], f[2]);
        sum(sums, f[0], f[1], f[2]);
        const std::vector<float> weights{0.2f, 0.5f, 0.3f};
        MergeScratch<float> scratch;
        interpolate(mixed, std::span<const float>(weights), std::span<const Function>(f), scratch);
        for (const Function* g : {&products, &sums, &mixed}) ASSERT_NO_THROW(validate(tree, *g));
        double total = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            EXPECT_FLOAT_EQ(at_leaves(products)[i], a[i] * b[i] * c[i]);
            EXPECT_EQ(at_leaves(sums)[i], a[i] + b[i] + c[i]);
            EXPECT_EQ(at_leaves(mixed)[i], a[i] * 0.2f + b[i] * 0.5f + c[i] * 0.3f);
            total += static_cast<double>(a[i]) * static_cast<double>(b[i]) * static_cast<double>(c[i]);
        }
        EXPECT_NEAR(sum_of_products(f[0], f[1], f[2]), total, 1e-12 * static_cast<double>(a.size()) * 8);
        EXPECT_NEAR(sum_of_products(products), total, 1e-6 * static_cast<double>(a.size()) * 8);
        const double largest = sum_over_leaves([](float x, float y) { return x > y ? x : y; }, f[0], f[1]);
        double expected = 0;
        for (std::size_t i = 0; i < a.size(); ++i) expected += static_cast<double>(std::max(a[i], b[i]));
        EXPECT_NEAR(largest, expected, 1e-10);
    }
}

TEST(Merge, OfNothingAtAll) {
    Function f, g;
    merge([](auto...) { ADD_FAILURE(); }, f, g);
    EXPECT_EQ(sum_of_products(f, g), 0.0);
    MergeScratch<float> scratch;
    const std::vector<Function> empty{f, g}, none;
    merge(std::span<const Function>(empty), scratch, [](auto...) { ADD_FAILURE(); });
    EXPECT_THROW(merge(std::span<const Function>(none), scratch, [](auto...) {}), invalid_input);
}

TEST(Merge, RefusesFunctionsOfDifferentTrees) {
    Random random(4);
    const ClusterTree a = random_tree(random, 10), b = random_tree(random, 11);
    const Function f = random_piecewise(random, a), g = random_piecewise(random, b), none;
    EXPECT_THROW(sum_of_products(f, g), invalid_input);
    EXPECT_THROW(sum_of_products(f, none), invalid_input);
    MergeScratch<float> scratch;
    const std::vector<Function> both{f, g};
    EXPECT_THROW(merge(std::span<const Function>(both), scratch, [](auto...) {}), invalid_input);
    Function out;
    const std::vector<float> one{1.0f}, bad{1.0f, std::nanf("")};
    const std::vector<Function> same{f, f};
    EXPECT_THROW(interpolate(out, std::span<const float>(one), std::span<const Function>(same), scratch),
                 invalid_input);
    EXPECT_THROW(interpolate(out, std::span<const float>(bad), std::span<const Function>(same), scratch),
                 invalid_input);
}

/// What `call` is refused with.
template <class Call>
std::string refusal(Call call) {
    try {
        call();
    } catch (const invalid_input& error) { return error.what(); }
    return "";
}

TEST(PiecewiseConstant, IsValidatedAgainstItsTree) {
    //          6
    //        /   \         leaves 0 1 3 4
    //       2     5
    using Tree = ClusterTree;
    const Tree tree({Tree::leaf_word(0), Tree::leaf_word(1), 0, Tree::leaf_word(2), Tree::leaf_word(3), 3, 0});
    const auto said = [&](std::vector<std::uint32_t> nodes, std::vector<float> values) {
        Function f;
        return refusal([&] { assign<float>(tree, nodes, values, f); });
    };
    const auto contains = [](const std::string& text, const char* part) {
        return text.find(part) != std::string::npos && text.find('\n') == std::string::npos;
    };
    EXPECT_EQ(said({2, 5}, {1, 2}), "");
    EXPECT_EQ(said({6}, {1}), "");
    EXPECT_TRUE(contains(said({2, 5}, {1}), "2 nodes, but 1 values"));
    EXPECT_TRUE(contains(said({5, 2}, {1, 2}), "piece 0, node 5: leaves out leaf node 0"));
    EXPECT_TRUE(contains(said({2, 2}, {1, 2}), "piece 1, node 2: nodes of a cut have to ascend"));
    EXPECT_TRUE(contains(said({2, 6}, {1, 2}), "piece 1, node 6: is above the piece before"));
    EXPECT_TRUE(contains(said({2, 4}, {1, 2}), "piece 1, node 4: leaves out leaf node 3"));
    EXPECT_TRUE(contains(said({2, 3}, {1, 2}), "covers 3 of the tree's 4 leaves"));
    EXPECT_TRUE(contains(said({2, 9}, {1, 2}), "the tree has only 7 nodes"));
    EXPECT_TRUE(contains(said({2, 5}, {1, std::nanf("")}), "piece 1, node 5: the value is not finite"));
    Function wrong;
    wrong.append({2, 3}, 1.0f);
    wrong.append({5, 4}, 1.0f);
    EXPECT_TRUE(contains(refusal([&] { validate(tree, wrong); }), "piece 0, node 2: is said to end at leaf 3, not 2"));
    Random random(1);
    const ClusterTree other = random_tree(random, 9);
    Function f;
    assign<float>(tree, std::vector<std::uint32_t>{2, 5}, std::vector<float>{1, 2}, f);
    EXPECT_NE(refusal([&] { validate(other, f); }), "");
}

TEST(Merge, LeavesNoHalfFunctionBehind) {
    Random random(41);
    const ClusterTree tree = random_tree(random, 12), other = random_tree(random, 13);
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        if (tree.is_leaf(n)) leaves.push_back(n);
    }
    std::vector<float> values(leaves.size(), 1.0f);
    Function f, out;
    assign<float>(tree, leaves, values, f);
    // Arguments that do not belong together are noticed before.
    out = f;
    const Function foreign = random_piecewise(random, other);
    EXPECT_THROW(product(out, f, foreign), invalid_input);
    EXPECT_THROW(assign<float>(tree, leaves, std::span(values).first(3), out), invalid_input);
    EXPECT_EQ(out.size(), f.size());
    // The last value is none.
    values.back() = std::nanf("");
    EXPECT_THROW(assign<float>(tree, leaves, values, out), invalid_input);
    EXPECT_TRUE(out.empty());
    int calls = 0;
    const auto tires = [&](float a) { return ++calls < 5 ? a : throw invalid_input("tired"); };
    EXPECT_THROW(merged(out, tires, f), invalid_input);
    EXPECT_TRUE(out.empty());
}

}  // namespace
}  // namespace lightcuts::test
