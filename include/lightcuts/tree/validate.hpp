#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "../core/invalid_input.hpp"
#include "cluster_tree.hpp"

namespace lightcuts {

/// Checks that `tree` is a post-order tree in which no item occurs twice and all are below `tree.item_bound()`; as long
/// as that is their number, every item occurs exactly once.
/// throws: invalid_input naming the first node that is wrong. cost: O(item_bound).
inline void validate(const ClusterTree& tree) {
    const auto refuse = [](std::size_t node, const std::string& what) {
        LIGHTCUTS_THROW(invalid_input("cluster tree, node " + std::to_string(node) + ": " + what));
    };
    const std::vector<std::uint32_t>& words = tree.words();
    if (words.empty()) return;
    if (words.size() % 2 == 0) {
        LIGHTCUTS_THROW(invalid_input("cluster tree: a binary tree has an odd number of nodes, not " +
                                      std::to_string(words.size())));
    }
    std::vector<bool> seen(tree.item_bound(), false);
    std::vector<std::uint32_t> first_leaves;  // of the complete subtrees so far, left to right
    for (ClusterTree::node_index n = 0; n < words.size(); ++n) {
        if (tree.is_leaf(n)) {
            const std::uint32_t item = tree.item(n);
            if (item >= seen.size()) refuse(n, "item " + std::to_string(item) + " is out of range");
            if (seen[item]) refuse(n, "item " + std::to_string(item) + " occurs twice");
            seen[item] = true;
            first_leaves.push_back(n);
        } else {
            if (first_leaves.size() < 2) refuse(n, "an inner node needs two complete subtrees before it");
            first_leaves.pop_back();
            if (words[n] != first_leaves.back()) {
                refuse(n, "its first leaf is node " + std::to_string(first_leaves.back()) + ", not " +
                              std::to_string(words[n]));
            }
        }
    }
    if (first_leaves.size() != 1) refuse(words.size() - 1, "the last node is not the root of all others");
}

/// Checks `tree` and, of every inner node, what `agrees(summary, left, right)` says of its summary and its children's.
/// throws: invalid_input naming the first node that is wrong. cost: O(N).
template <class T, class Agrees>
void validate(const ClusterTree& tree, const std::vector<T>& summaries, Agrees&& agrees) {
    validate(tree);
    if (summaries.size() != tree.size()) {
        LIGHTCUTS_THROW(invalid_input("cluster tree: " + std::to_string(tree.size()) + " nodes, but " +
                                      std::to_string(summaries.size()) + " summaries"));
    }
    for (ClusterTree::node_index n = 0; n < tree.size(); ++n) {
        if (!tree.is_leaf(n) && !agrees(summaries[n], summaries[tree.left(n)], summaries[tree.right(n)])) {
            LIGHTCUTS_THROW(
                invalid_input("cluster tree, node " + std::to_string(n) + ": its summary disagrees with its children"));
        }
    }
}

}  // namespace lightcuts
