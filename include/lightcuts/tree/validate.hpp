#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "../core/invalid_input.hpp"
#include "cluster_tree.hpp"

namespace lightcuts {

namespace detail {

/// The first leaf whose item one before it has, too; the number of nodes if there is none. cost: O(N log N).
inline std::size_t first_repeated(const ClusterTree& tree) {
    std::vector<std::uint64_t> by_item;  // in the upper half, the node in the lower
    for (ClusterTree::node_index n = 0; n < tree.size(); ++n) {
        if (tree.is_leaf(n)) by_item.push_back(std::uint64_t{tree.item(n)} << 32 | n);
    }
    std::sort(by_item.begin(), by_item.end());
    std::size_t first = tree.size();
    for (std::size_t i = 1; i < by_item.size(); ++i) {
        if (by_item[i] >> 32 == by_item[i - 1] >> 32) {
            first = (std::min)(first, static_cast<std::size_t>(by_item[i] & 0xffff'ffffu));
        }
    }
    return first;
}

}  // namespace detail

/// Checks that `tree` is a post-order tree, each inner node of which has two children or more, in which no item occurs
/// twice and all are below `tree.item_bound()`; as long as that is their number, every item occurs exactly once.
/// throws: invalid_input naming the first node that is wrong. cost: O(N), or O(N log N) where item_bound is far above.
/// memory: O(N).
inline void validate(const ClusterTree& tree) {
    const auto refuse = [](std::size_t node, const std::string& what) {
        LIGHTCUTS_THROW(invalid_input("cluster tree, node " + std::to_string(node) + ": " + what));
    };
    const std::vector<std::uint32_t>& words = tree.words();
    if (words.empty()) return;
    // A bit an item takes no more memory than the tree, unless most items are left out.
    const bool few_are_left_out = tree.item_bound() <= 32 * words.size();
    std::vector<bool> seen(few_are_left_out ? tree.item_bound() : 0, false);
    const std::size_t repeated = few_are_left_out ? words.size() : detail::first_repeated(tree);
    std::vector<std::uint32_t> first_leaves;  // of the complete subtrees so far, left to right
    for (ClusterTree::node_index n = 0; n < words.size(); ++n) {
        if (tree.is_leaf(n)) {
            const std::uint32_t item = tree.item(n);
            if (item >= tree.item_bound()) refuse(n, "item " + std::to_string(item) + " is out of range");
            if (few_are_left_out ? seen[item] : n == repeated) {
                refuse(n, "item " + std::to_string(item) + " occurs twice");
            }
            if (few_are_left_out) seen[item] = true;
            first_leaves.push_back(n);
        } else {
            if (first_leaves.size() < 2) refuse(n, "an inner node needs two complete subtrees before it");
            // Its children are the complete subtrees from its first leaf on.
            std::size_t children = 0;
            ClusterTree::node_index first = n;
            for (; !first_leaves.empty() && words[n] <= first_leaves.back(); ++children) {
                first = first_leaves.back();
                first_leaves.pop_back();
            }
            const auto refuse_first = [&](const char* what) {
                refuse(n, "its first leaf is said to be node " + std::to_string(words[n]) + ", which " + what);
            };
            if (first != words[n]) refuse_first("is not that of a complete subtree");
            if (children < 2) refuse_first("leaves it one child");
            first_leaves.push_back(first);
        }
    }
    if (first_leaves.size() != 1) refuse(words.size() - 1, "the last node is not the root of all others");
}

/// Checks `tree` and, of every inner node, what `agrees` says of its summary and its children's: of any number of
/// children `agrees(summary, children)`, a span from the first to the last, or of two `agrees(summary, left, right)`.
/// throws: invalid_input naming the first node that is wrong, or if `agrees` asks for two children and the tree is not
/// binary. cost: O(N).
template <class T, class Agrees>
void validate(const ClusterTree& tree, const std::vector<T>& summaries, Agrees&& agrees) {
    constexpr bool takes_two = std::predicate<Agrees&, const T&, const T&, const T&>;
    validate(tree);
    if (summaries.size() != tree.size()) {
        LIGHTCUTS_THROW(invalid_input("cluster tree: " + std::to_string(tree.size()) + " nodes, but " +
                                      std::to_string(summaries.size()) + " summaries"));
    }
    if (takes_two && !tree.is_binary())
        LIGHTCUTS_THROW(invalid_input("cluster tree: not every inner node has two children"));
    std::vector<T> children;
    const auto good = [&](ClusterTree::node_index n) {
        if constexpr (takes_two) {
            return agrees(summaries[n], summaries[tree.left(n)], summaries[tree.right(n)]);
        } else {
            children.clear();
            tree.for_each_child(n, [&](ClusterTree::node_index child) { children.push_back(summaries[child]); });
            std::reverse(children.begin(), children.end());
            return agrees(summaries[n], std::span<const T>(children));
        }
    };
    for (ClusterTree::node_index n = 0; n < tree.size(); ++n) {
        if (!tree.is_leaf(n) && !good(n)) {
            LIGHTCUTS_THROW(
                invalid_input("cluster tree, node " + std::to_string(n) + ": its summary disagrees with its children"));
        }
    }
}

}  // namespace lightcuts
