#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../core/assertion.hpp"

namespace lightcuts {

/// The topology of a tree over N items, in post-order in one flat array of one word a node. The items are 0 .. N-1, or
/// N of more: the topology of a light tree calls lights by their indices and leaves out those that are dark.
///
///          6            left_leaf(6) = 0
///        /   \          right child of 6 is 5, left child is left_leaf(5)-1 = 2
///       2     5         the subtree of 5 is the range [3, 5]
///      / \   / \        a leaf is its own left_leaf
///     0   1 3   4
///
/// Every subtree is a contiguous range that ends at its root, so ancestor and overlap tests are two comparisons, and
/// a cut is a sorted list of indices. What a node knows (boxes, intensities, ...) lives outside, see `summarize`.
///
/// An inner node has two children or more. The builders of this library make binary trees of 2N-1 nodes, in which
/// `left` and `right` name the children; `for_each_child` visits those of any tree.
/// Immutable once built; safe to share between threads.
class ClusterTree {
public:
    using node_index = std::uint32_t;

    static constexpr std::size_t max_items = std::size_t{1} << 30;

    /// An empty tree.
    ClusterTree() = default;

    /// Takes the words of a post-order array: `leaf_word(item)` for a leaf, else the index of the subtree's first
    /// leaf. pre: the array is a valid tree (`validate` checks). cost: one pass, O(N).
    explicit ClusterTree(std::vector<std::uint32_t> words) : words_(std::move(words)), item_count_(count_leaves()) {
        item_bound_ = item_count_;
    }
    /// Takes the words of a post-order array over some of the items 0 .. item_bound-1: `leaf_word(item)` for a leaf,
    /// else the index of the subtree's first leaf. pre: the array is a valid tree (`validate` checks). cost: one pass,
    /// O(N).
    ClusterTree(std::vector<std::uint32_t> words, std::size_t item_bound)
        : words_(std::move(words)), item_count_(count_leaves()), item_bound_(item_bound) {}

    /// The word of a leaf that holds `item`. pre: item < max_items.
    static constexpr std::uint32_t leaf_word(std::uint32_t item) { return item | leaf_bit; }

    /// Number of nodes: 2N-1 in a binary tree, less in others, 0 in the empty one.
    std::size_t size() const { return words_.size(); }
    bool empty() const { return words_.empty(); }
    /// Number of items, which is that of leaves: N.
    std::size_t item_count() const { return item_count_; }
    /// All items are below it: N, or more if some are left out.
    std::size_t item_bound() const { return item_bound_; }
    /// True if every inner node has two children; so for the empty tree and for a single leaf.
    bool is_binary() const { return words_.size() + 1 >= 2 * item_count_; }

    /// The last node, which is above all others. pre: not empty.
    node_index root() const { return static_cast<node_index>(words_.size() - 1); }

    bool is_leaf(node_index n) const { return (words_[n] & leaf_bit) != 0; }

    /// The item that a leaf holds. pre: is_leaf(n).
    std::uint32_t item(node_index n) const {
        LIGHTCUTS_ASSERT(is_leaf(n));
        return words_[n] & ~leaf_bit;
    }

    /// First node of the subtree of n.
    node_index left_leaf(node_index n) const { return is_leaf(n) ? n : words_[n]; }

    /// The right child of n, or of many children the last. pre: !is_leaf(n).
    node_index right(node_index n) const { return n - 1; }
    /// The left child of n, or of many children the last but one. pre: !is_leaf(n).
    node_index left(node_index n) const { return left_leaf(n - 1) - 1; }

    /// Calls `f(child)` for each child of n, from the last to the first. Each child follows the subtree of the one
    /// before. pre: !is_leaf(n). cost: O(children).
    template <class F>
    void for_each_child(node_index n, F&& f) const {
        LIGHTCUTS_ASSERT(!is_leaf(n));
        const node_index first = words_[n];
        for (node_index end = n; end != first;) {
            const node_index child = end - 1;
            end = left_leaf(child);
            f(child);
        }
    }

    /// Number of items below n (1 for a leaf). cost: O(1) in a binary tree, in others that of a pass over the subtree.
    std::size_t leaf_count(node_index n) const {
        const node_index first = left_leaf(n);
        return is_binary() ? (n - first + 2) / 2 : count_leaves(first, n);
    }

    /// True iff d is n or lies below it.
    bool contains(node_index n, node_index d) const { return left_leaf(n) <= d && d <= n; }

    /// The array: of each leaf `leaf_word(item)`, of each other node the index of its subtree's first leaf.
    const std::vector<std::uint32_t>& words() const { return words_; }

    /// Gives the storage back, for the next tree to be built in; leaves an empty tree.
    std::vector<std::uint32_t> release() && {
        item_count_ = item_bound_ = 0;
        return std::exchange(words_, {});
    }

    friend bool operator==(const ClusterTree&, const ClusterTree&) = default;

private:
    static constexpr std::uint32_t leaf_bit = 0x8000'0000u;

    std::size_t count_leaves() const { return words_.empty() ? 0 : count_leaves(0, root()); }
    /// Among the nodes from `first` to `last`.
    std::size_t count_leaves(node_index first, node_index last) const {
        std::size_t count = 0;
        for (std::size_t n = first; n <= last; ++n) count += words_[n] / leaf_bit;
        return count;
    }

    std::vector<std::uint32_t> words_;
    std::size_t item_count_ = 0;
    std::size_t item_bound_ = 0;
};

}  // namespace lightcuts
