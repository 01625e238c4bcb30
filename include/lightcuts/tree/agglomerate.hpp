#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../core/assertion.hpp"
#include "../core/executor.hpp"
#include "../core/invalid_input.hpp"
#include "cluster_size.hpp"
#include "cluster_tree.hpp"
#include "coincident.hpp"
#include "frame.hpp"
#include "item.hpp"
#include "kd_order.hpp"
#include "merges.hpp"
#include "neighbour_tree.hpp"
#include "progress.hpp"

namespace lightcuts {
namespace detail {

/// Greedy merging by chains of nearest neighbours.
///
/// The order of merging (Rank) is strictly monotone: a pair ranks before every other pair of clusters that contain
/// it. So two clusters that are each other's nearest neighbours remain so until the greedy method merges them,
/// whatever it merges before, and may be merged at once. From any cluster, stepping to the nearest neighbour again
/// and again leads to such a pair, because ranks fall along the way. There is no heap, what is compared lies close
/// together in memory, and the tree does not depend on where chains start.
/// [For trees of triangles: Walter et al. 2008, "Fast agglomerative clustering for rendering".]
template <bool Oriented>
class Agglomerator {
public:
    template <class Item>
    Agglomerator(std::span<const Item> items, double direction) : merges_(items.size()), direction_(direction) {
        const Frame frame = Frame::of(items);
        float least = (std::numeric_limits<float>::max)(), most = 0;
        clusters_.reserve(items.size());
        nodes_.reserve(items.size());
        for (std::size_t i = 0; i < items.size(); ++i) {
            const auto index = static_cast<std::uint32_t>(i);
            clusters_.push_back(cluster_of<Oriented>(items[i], index, frame));
            nodes_.push_back(index);
            least = (std::min)(least, items[i].weight);
            most = (std::max)(most, items[i].weight);
        }
        // Bounds are floats: weights have the most room for spread around 1.
        per_weight_ = std::sqrt(static_cast<double>(most) / static_cast<double>(least));
        links_.resize(items.size());
        moved_.assign(items.size(), none);
    }

    template <class E, class P>
    ClusterTree build(const E& execute, P& progress) {
        const std::size_t items = clusters_.size();
        merge_coincident(clusters_, [this](std::uint32_t a, std::uint32_t b) { join(a, b); });
        compact();
        std::size_t reported = items - clusters_.size();
        progress(reported);
        while (clusters_.size() > 1) {
            sweep(execute);
            progress(items - clusters_.size() - reported);
            reported = items - clusters_.size();
        }
        progress(1);
        return merges_.tree();
    }

private:
    static constexpr std::uint32_t none = 0xffff'ffffu;

    /// A cluster's nearest neighbour when last sought: still its nearest neighbour as long as it exists.
    struct Link {
        std::uint32_t slot = none;
        std::uint32_t node = none;  ///< of the cluster that was in the slot then
    };

    /// Merges slot b into slot a.
    void join(std::uint32_t a, std::uint32_t b) {
        const bool ordered = clusters_[a].id < clusters_[b].id;
        nodes_[a] = merges_.join(ordered ? nodes_[a] : nodes_[b], ordered ? nodes_[b] : nodes_[a]);
        clusters_[a] = merge(clusters_[a], clusters_[b]);
        links_[a] = {};
        moved_[b] = a;
    }

    /// The slot of the cluster that has swallowed the one which was in `slot`.
    std::uint32_t home(std::uint32_t slot) const {
        while (moved_[slot] != none) slot = moved_[slot];
        return slot;
    }

    /// Makes the link of a cluster valid.
    void find_neighbour(const NeighbourTree<Oriented>& tree, std::uint32_t slot) {
        Link& link = links_[slot];
        Neighbour best;
        if (link.slot != none) {
            const std::uint32_t h = home(link.slot);
            if (nodes_[h] == link.node) return;
            // The neighbour has been swallowed: whatever swallowed it is a good candidate.
            LIGHTCUTS_ASSERT(h != slot);
            best = {h, rank(clusters_[slot], clusters_[h], direction_)};
        }
        best = tree.nearest(slot, best);
        link = {best.slot, nodes_[best.slot]};
    }

    /// Follows the chain from each cluster in turn to a pair, and merges it. Halves the number of clusters.
    template <class E>
    void sweep(const E& execute) {
        reorder();
        NeighbourTree<Oriented> tree(clusters_, direction_, per_weight_);
        const auto count = static_cast<std::uint32_t>(clusters_.size());
        if constexpr (!std::same_as<E, Sequential>) {
            // Threads seek all neighbours first. It takes more searches than seeking them when needed, below.
            constexpr std::uint32_t grain = 256;
            execute((count + grain - 1) / grain, [&](std::size_t task) {
                const auto first = static_cast<std::uint32_t>(task) * grain;
                for (std::uint32_t s = first; s < (std::min)(first + grain, count); ++s) find_neighbour(tree, s);
            });
        }
        std::uint32_t left = count;
        for (std::uint32_t s = 0; s < count && left > 1; ++s) {
            if (moved_[s] != none) continue;
            std::uint32_t a = s;
            find_neighbour(tree, a);
            std::uint32_t b = links_[a].slot;
            find_neighbour(tree, b);
            for (std::uint32_t steps = 0; links_[b].slot != a; ++steps) {
                LIGHTCUTS_ASSERT(steps < left);
                a = b;
                b = links_[a].slot;
                find_neighbour(tree, b);
            }
            join(a, b);
            tree.replace(a);
            tree.erase(b);
            --left;
        }
        compact();
    }

    /// Removes the slots of swallowed clusters.
    void compact() {
        std::vector<std::uint32_t> place(clusters_.size());
        std::uint32_t left = 0;
        for (std::size_t s = 0; s < clusters_.size(); ++s) {
            if (moved_[s] == none) place[s] = left++;
        }
        for (std::uint32_t s = 0; s < clusters_.size(); ++s) {
            if (moved_[s] != none) continue;
            Link link = links_[s];
            if (link.slot != none) link.slot = place[home(link.slot)];
            clusters_[place[s]] = clusters_[s];
            nodes_[place[s]] = nodes_[s];
            links_[place[s]] = link;
        }
        clusters_.resize(left);
        nodes_.resize(left);
        links_.resize(left);
        moved_.assign(left, none);
    }

    /// Sorts the slots for the neighbour tree.
    void reorder() {
        const std::vector<std::uint32_t> order = KdOrder<Oriented>::of(clusters_, direction_);
        std::vector<std::uint32_t> place(order.size());
        for (std::size_t s = 0; s < order.size(); ++s) place[order[s]] = static_cast<std::uint32_t>(s);
        for (Link& link : links_) {
            if (link.slot != none) link.slot = place[link.slot];
        }
        const auto permute = [&order](auto& values) {
            std::remove_reference_t<decltype(values)> sorted;
            sorted.reserve(values.size());
            for (const std::uint32_t s : order) sorted.push_back(values[s]);
            values.swap(sorted);
        };
        permute(clusters_);
        permute(nodes_);
        permute(links_);
    }

    // By slot:
    std::vector<Cluster<Oriented>> clusters_;
    std::vector<std::uint32_t> nodes_;
    std::vector<Link> links_;
    std::vector<std::uint32_t> moved_;  ///< the slot that has swallowed this one's cluster, or none

    Merges merges_;
    double direction_;
    double per_weight_;
};

template <class Item, class E, class P>
ClusterTree agglomerate(std::span<const Item> items, const ClusterSize& size, const E& execute, P& progress) {
    if (!(size.direction >= 0 && size.direction <= 1e6)) {
        LIGHTCUTS_THROW(invalid_input("ClusterSize: the weight of directions must lie between 0 and 1e6 diagonals"));
    }
    check_items(items);
    if (items.empty()) return {};
    if constexpr (HasAxis<Item>) {
        const auto differs = [&](const Item& i) { return !(i.axis == items[0].axis); };
        if (size.direction > 0 && std::any_of(items.begin(), items.end(), differs)) {
            return Agglomerator<true>(items, size.direction).build(execute, progress);
        }
    }
    return Agglomerator<false>(items, 0).build(execute, progress);
}

}  // namespace detail

/// Builds a tree from the bottom up: merges the two clusters whose union is smallest until one is left, exactly as the
/// greedy method of the papers does [Walter et al. 2005, Section 4]. Ties: see `ClusterSize`.
/// The left child of a node is the one with the smallest item. The tree does not depend on the executor.
/// throws: invalid_input naming the item: position not finite, weight not positive, axis not of unit length; or too
/// many items; or `size.direction` out of range.
/// cost: about O(N log N), several times that of `divide`; up to 300 bytes of temporary memory an item.
template <Executor E = Sequential, Progress P = NoProgress>
ClusterTree agglomerate(std::span<const PointItem> items, const ClusterSize& size = {}, const E& execute = {},
                        P progress = {}) {
    return detail::agglomerate(items, size, execute, progress);
}

/// Likewise for items with an axis.
template <Executor E = Sequential, Progress P = NoProgress>
ClusterTree agglomerate(std::span<const OrientedItem> items, const ClusterSize& size = {}, const E& execute = {},
                        P progress = {}) {
    return detail::agglomerate(items, size, execute, progress);
}

}  // namespace lightcuts
