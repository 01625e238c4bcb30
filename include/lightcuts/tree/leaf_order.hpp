#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "cluster_tree.hpp"

namespace lightcuts {

/// A tree whose items are numbered from left to right, and which items these were.
struct LeafOrder {
    ClusterTree tree;                  ///< the item of leaf i from the left is i
    std::vector<std::uint32_t> items;  ///< of leaf i, in the tree before
};

/// Numbers the items of `tree` anew, as its leaves stand: items below one node then are neighbors in memory.
/// cost: O(N).
inline LeafOrder in_leaf_order(const ClusterTree& tree) {
    LeafOrder result;
    result.items.reserve(tree.item_count());
    std::vector<std::uint32_t> words = tree.words();
    for (ClusterTree::node_index n = 0; n < tree.size(); ++n) {
        if (!tree.is_leaf(n)) continue;
        words[n] = ClusterTree::leaf_word(static_cast<std::uint32_t>(result.items.size()));
        result.items.push_back(tree.item(n));
    }
    result.tree = ClusterTree(std::move(words));
    return result;
}

}  // namespace lightcuts
