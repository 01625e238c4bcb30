#include <lightcuts/tree/cluster_tree.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/tree/statistics.hpp>
#include <lightcuts/tree/summary.hpp>
#include <lightcuts/tree/validate.hpp>
#include "support/random.hpp"

namespace {

using namespace lightcuts;
using lightcuts::test::Random;
using node_index = ClusterTree::node_index;

/// A tree as pointers have it, to compare with.
struct Plain {
    std::vector<Plain> children;
    std::uint32_t item = 0;
    node_index node = 0;  ///< in post-order

    bool is_leaf() const { return children.empty(); }
};

/// A random tree of `leaves` leaves, each inner node of which has 2 to `most` children. Items are in no order.
Plain random_tree(Random& random, std::size_t leaves, std::size_t most, std::vector<std::uint32_t>& items) {
    Plain tree;
    if (leaves == 1) {
        tree.item = items.back();
        items.pop_back();
        return tree;
    }
    const std::size_t count = 2 + random.below(std::min(most, leaves) - 1);
    for (std::size_t c = 0; c < count; ++c) {
        const std::size_t spare = leaves - (count - c) + 1;  // each of the other children needs one
        const std::size_t share = c + 1 == count ? leaves : 1 + random.below(spare);
        tree.children.push_back(random_tree(random, share, most, items));
        leaves -= share;
    }
    return tree;
}

void write(Plain& tree, std::vector<std::uint32_t>& words) {
    const auto first = static_cast<node_index>(words.size());
    for (Plain& child : tree.children) write(child, words);
    tree.node = static_cast<node_index>(words.size());
    words.push_back(tree.is_leaf() ? ClusterTree::leaf_word(tree.item) : first);
}

void for_each_node(const Plain& tree, const std::function<void(const Plain&)>& f) {
    for (const Plain& child : tree.children) for_each_node(child, f);
    f(tree);
}

std::size_t leaves_of(const Plain& tree) {
    std::size_t count = tree.is_leaf() ? 1 : 0;
    for (const Plain& child : tree.children) count += leaves_of(child);
    return count;
}

/// The items below a node, in order.
std::vector<std::uint32_t> items_of(const Plain& tree) {
    std::vector<std::uint32_t> items;
    for_each_node(tree, [&](const Plain& node) {
        if (node.is_leaf()) items.push_back(node.item);
    });
    return items;
}

TEST(ClusterTree, OfAnyArityIsThePlainTree) {
    Random random(1);
    for (int round = 0; round < 400; ++round) {
        const std::size_t most = 2 + random.below(6), leaves = 1 + random.below(80), left_out = random.below(3);
        std::vector<std::uint32_t> items(leaves + left_out);
        std::iota(items.begin(), items.end(), 0u);
        for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
        items.resize(leaves);
        Plain plain = random_tree(random, leaves, most, items);
        std::vector<std::uint32_t> words;
        write(plain, words);
        const ClusterTree tree(words, leaves + left_out);
        ASSERT_NO_THROW(validate(tree));
        ASSERT_EQ(tree.item_count(), leaves);
        ASSERT_EQ(tree.item_bound(), leaves + left_out);
        if (left_out == 0) { ASSERT_EQ(ClusterTree(words), tree); }

        bool binary = true;
        for_each_node(plain,
                      [&](const Plain& node) { binary = binary && (node.is_leaf() || node.children.size() == 2); });
        ASSERT_EQ(tree.is_binary(), binary);
        if (most == 2) { ASSERT_TRUE(binary); }

        const auto summaries = summarize(
            tree, [](std::uint32_t item) { return std::vector<std::uint32_t>{item}; },
            [](std::vector<std::uint32_t> a, const std::vector<std::uint32_t>& b) {
                a.insert(a.end(), b.begin(), b.end());
                return a;
            });
        const auto is_union = [](const auto& summary, std::span<const std::vector<std::uint32_t>> children) {
            std::vector<std::uint32_t> all;
            for (const auto& child : children) all.insert(all.end(), child.begin(), child.end());
            return all == summary;
        };
        ASSERT_NO_THROW(validate(tree, summaries, is_union));
        for_each_node(plain, [&](const Plain& node) {
            ASSERT_EQ(tree.is_leaf(node.node), node.is_leaf());
            ASSERT_EQ(tree.leaf_count(node.node), leaves_of(node));
            ASSERT_EQ(summaries[node.node], items_of(node));
            if (node.is_leaf()) {
                ASSERT_EQ(tree.item(node.node), node.item);
                return;
            }
            std::vector<node_index> children;
            tree.for_each_child(node.node, [&](node_index child) { children.push_back(child); });
            std::reverse(children.begin(), children.end());
            ASSERT_EQ(children.size(), node.children.size());
            for (std::size_t c = 0; c < children.size(); ++c) ASSERT_EQ(children[c], node.children[c].node);
            ASSERT_EQ(tree.right(node.node), children.back());
            ASSERT_EQ(tree.left(node.node), children[children.size() - 2]);
            for_each_node(node, [&](const Plain& below) { ASSERT_TRUE(tree.contains(node.node, below.node)); });
        });
    }
}

TEST(ClusterTree, DepthsOfManyChildrenCountEdges) {
    // (0 1 (2 3 4))
    constexpr auto leaf = ClusterTree::leaf_word;
    const std::vector<PointItem> items(5, PointItem{{0, 0, 0}, 1});
    const ClusterTree tree({leaf(0), leaf(1), leaf(2), leaf(3), leaf(4), 2, 0});
    EXPECT_EQ(statistics(tree, items).depth_max, 2u);
    EXPECT_EQ(statistics(tree, items).depth_mean, 8.0 / 5.0);
}

TEST(ClusterTree, GivesItsStorageBack) {
    std::vector<std::uint32_t> words{ClusterTree::leaf_word(0), ClusterTree::leaf_word(1), 0};
    const std::uint32_t* storage = words.data();
    ClusterTree tree(std::move(words));
    words = std::move(tree).release();
    EXPECT_EQ(words.data(), storage);
    EXPECT_EQ(tree, ClusterTree{});  // NOLINT(bugprone-use-after-move): release() promises an empty tree
}

}  // namespace
