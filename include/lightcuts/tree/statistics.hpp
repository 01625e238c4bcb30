#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../core/box.hpp"
#include "../core/cone.hpp"
#include "build/item.hpp"
#include "build/normalized_space.hpp"
#include "cluster_tree.hpp"
#include "summary.hpp"

namespace lightcuts {

/// How good a tree is, before any image is made.
struct TreeStatistics {
    std::size_t depth_max = 0;  ///< edges from the root to the deepest leaf
    double depth_mean = 0;      ///< over the leaves
    /// Sum over the inner nodes of the papers' cluster metric I (alpha^2 + c^2 (1 - cos beta)^2), c = 1 for items with
    /// an axis, in units of (largest weight) x (diagonal of all items' box)^2. Smaller is better.
    double cost = 0;
};

namespace detail {

/// The number of edges from the root to each node.
inline std::vector<std::uint32_t> depths(const ClusterTree& tree) {
    std::vector<std::uint32_t> depth(tree.size(), 0);
    for (std::size_t k = tree.size(); k-- > 0;) {
        const auto n = static_cast<ClusterTree::node_index>(k);
        if (!tree.is_leaf(n))
            tree.for_each_child(n, [&](ClusterTree::node_index child) { depth[child] = depth[n] + 1; });
    }
    return depth;
}

template <class Item>
TreeStatistics statistics(const ClusterTree& tree, std::span<const Item> items) {
    TreeStatistics result;
    if (tree.empty()) return result;
    const std::vector<std::uint32_t> depth = depths(tree);
    struct Summary {
        Box box;
        double weight;
        Cone cone;
    };
    const NormalizedSpace space = NormalizedSpace::of(items);
    const auto summaries = summarize(
        tree,
        [&](std::uint32_t i) {
            Summary s{box_of(items[i].position), space.weight(items[i].weight), Cone{}};
            if constexpr (HasAxis<Item>) s.cone = cone_of(items[i].axis);
            return s;
        },
        [](const Summary& a, const Summary& b) {
            Summary s{merge(a.box, b.box), a.weight + b.weight, Cone{}};
            if constexpr (HasAxis<Item>) s.cone = merge(a.cone, b.cone);
            return s;
        });
    for (ClusterTree::node_index n = 0; n < tree.size(); ++n) {
        if (tree.is_leaf(n)) {
            result.depth_max = std::max<std::size_t>(result.depth_max, depth[n]);
            result.depth_mean += depth[n];
            continue;
        }
        double size = diagonal2(summaries[n].box) * space.per_length * space.per_length;
        if constexpr (HasAxis<Item>) size += one_minus_cos(summaries[n].cone) * one_minus_cos(summaries[n].cone);
        result.cost += summaries[n].weight * size;
    }
    result.depth_mean /= static_cast<double>(tree.item_count());
    return result;
}

}  // namespace detail

/// Depth and cost of a tree of items without direction. pre: a valid tree of these items. cost: O(N).
inline TreeStatistics statistics(const ClusterTree& tree, std::span<const PointItem> items) {
    return detail::statistics(tree, items);
}
/// Depth and cost of a tree of items with an axis. pre: a valid tree of these items. cost: O(N).
inline TreeStatistics statistics(const ClusterTree& tree, std::span<const OrientedItem> items) {
    return detail::statistics(tree, items);
}

}  // namespace lightcuts
