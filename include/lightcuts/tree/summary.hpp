#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "cluster_tree.hpp"

namespace lightcuts {

/// Recomputes what every node of `tree` knows, bottom-up: `leaf(item)` for a leaf, above it `merge(left, right)` of its
/// two children's summaries, or of more children merge(first, merge(second, ... last)).
/// shapes: `summaries` has tree.size() entries, in node order. cost: one pass, O(N).
template <class T, std::invocable<std::uint32_t> Leaf, class Merge>
    requires std::invocable<Merge&, const T&, const T&>
void refit(const ClusterTree& tree, std::vector<T>& summaries, Leaf&& leaf, Merge&& merge) {
    summaries.resize(tree.size());
    for (ClusterTree::node_index n = 0; n < tree.size(); ++n) {
        if (tree.is_leaf(n)) {
            summaries[n] = leaf(tree.item(n));
            continue;
        }
        const ClusterTree::node_index first = tree.left_leaf(n);
        ClusterTree::node_index child = tree.left(n);
        summaries[n] = merge(summaries[child], summaries[tree.right(n)]);
        while (tree.left_leaf(child) != first) {
            child = tree.left_leaf(child) - 1;
            summaries[n] = merge(summaries[child], summaries[n]);
        }
    }
}

/// What every node of `tree` knows, as one array in node order; see `refit`.
/// A summary can be anything: a box, a link mask, a user's own statistics.
template <std::invocable<std::uint32_t> Leaf, class Merge>
auto summarize(const ClusterTree& tree, Leaf&& leaf, Merge&& merge) {
    std::vector<std::remove_cvref_t<std::invoke_result_t<Leaf&, std::uint32_t>>> summaries;
    refit(tree, summaries, leaf, merge);
    return summaries;
}

}  // namespace lightcuts
