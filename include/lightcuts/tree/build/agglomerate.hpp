#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../../core/assertion.hpp"
#include "../../core/executor.hpp"
#include "../../core/invalid_input.hpp"
#include "../cluster_tree.hpp"
#include "cluster_size.hpp"
#include "coincident.hpp"
#include "item.hpp"
#include "kd_order.hpp"
#include "linkage.hpp"
#include "neighbor_tree.hpp"
#include "normalized_space.hpp"
#include "progress.hpp"

namespace lightcuts {
namespace detail {

/// Greedy merging by chains of nearest neighbors.
///
/// The order of merging (Rank) is strictly monotone: a pair ranks before every other pair of clusters that contain
/// it. So two clusters that are each other's nearest neighbors remain so until the greedy method merges them,
/// whatever it merges before, and may be merged at once. From any cluster, stepping to the nearest neighbor again
/// and again leads to such a pair, because ranks fall along the way. There is no heap, what is compared lies close
/// together in memory, and the tree does not depend on where chains start.
/// [For trees of triangles: Walter et al. 2008, "Fast agglomerative clustering for rendering".]
template <bool Oriented>
class Agglomerator {
public:
    /// `direction`: c in `space`, at most 1.
    template <class Item>
    Agglomerator(std::span<const Item> items, const NormalizedSpace& space, double direction)
        : linkage_(items.size()), direction_(direction) {
        float least = (std::numeric_limits<float>::max)(), most = 0;
        clusters_.reserve(items.size());
        nodes_.reserve(items.size());
        for (std::size_t i = 0; i < items.size(); ++i) {
            const auto index = static_cast<std::uint32_t>(i);
            clusters_.push_back(cluster_of<Oriented>(items[i], index, space));
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
        return linkage_.tree();
    }

    /// How many steps all chains took: each goes on to a neighbor, which may have to be sought, or merges two
    /// clusters. At most 11 (N - 1): a merge takes two clusters from the chain and drops at most short_chain.
    std::size_t steps() const { return steps_; }

    /// A chain that is longer goes on after a merge.
    static constexpr std::size_t short_chain = 8;

private:
    static constexpr std::uint32_t none = 0xffff'ffffu;

    /// A cluster's nearest neighbor when last sought: still its nearest neighbor as long as it exists.
    struct Link {
        std::uint32_t slot = none;
        std::uint32_t node = none;  ///< of the cluster that was in the slot then
    };

    /// Linkage slot b into slot a.
    void join(std::uint32_t a, std::uint32_t b) {
        const bool ordered = clusters_[a].id < clusters_[b].id;
        nodes_[a] = linkage_.join(ordered ? nodes_[a] : nodes_[b], ordered ? nodes_[b] : nodes_[a]);
        clusters_[a] = merge(clusters_[a], clusters_[b]);
        links_[a] = {};
        moved_[b] = a;
    }

    /// The slot of the cluster that now holds the one which was in `slot`.
    std::uint32_t home(std::uint32_t slot) const {
        while (moved_[slot] != none) slot = moved_[slot];
        return slot;
    }

    /// Makes the link of a cluster valid: seeks its nearest neighbor unless the one known still exists.
    void find_neighbor(const NeighborTree<Oriented>& tree, std::uint32_t slot) {
        Link& link = links_[slot];
        Neighbor best;
        if (link.slot != none) {
            const std::uint32_t h = home(link.slot);
            if (nodes_[h] == link.node) return;
            // The neighbor has been merged: the cluster that holds it is a good candidate.
            LIGHTCUTS_ASSERT(h != slot);
            best = {h, rank(clusters_[slot], clusters_[h], direction_)};
        }
        best = tree.nearest(slot, best);
        link = {best.slot, nodes_[best.slot]};
    }

    /// Follows a chain from each cluster in turn to a pair, and merges it. At least split the number of clusters.
    ///
    /// A long chain goes on after the merge. The rest of a short one is dropped: it is soon walked again, while going
    /// on would merge clusters again and again in one place, where the neighbor tree then excludes little.
    template <class E>
    void sweep(const E& execute) {
        reorder();
        NeighborTree<Oriented> tree(clusters_, direction_, per_weight_);
        const auto count = static_cast<std::uint32_t>(clusters_.size());
        if constexpr (!std::same_as<E, Sequential>) {
            // Threads seek all neighbors first. It takes more searches than seeking them when needed, below.
            constexpr std::uint32_t grain = 256;
            execute((count + grain - 1) / grain, [&](std::size_t task) {
                const auto first = static_cast<std::uint32_t>(task) * grain;
                for (std::uint32_t s = first; s < (std::min)(first + grain, count); ++s) find_neighbor(tree, s);
            });
        }
        std::uint32_t left = count;
        for (std::uint32_t s = 0; s < count && left > 1; ++s) {
            if (moved_[s] != none) continue;
            chain_.assign(1, s);
            bool merged = false;
            while (!merged || chain_.size() > short_chain) {
                const std::uint32_t a = chain_.back();
                find_neighbor(tree, a);
                ++steps_;
                const std::uint32_t b = links_[a].slot;
                if (chain_.size() < 2 || b != chain_[chain_.size() - 2]) {
                    LIGHTCUTS_ASSERT(chain_.size() < left);
                    chain_.push_back(b);
                    continue;
                }
                chain_.resize(chain_.size() - 2);
                join(b, a);
                tree.replace(b);
                tree.erase(a);
                --left;
                merged = true;
            }
        }
        compact();
    }

    /// Removes the slots whose clusters were merged into others.
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

    /// Sorts the slots for the neighbor tree.
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
    std::vector<BuildCluster<Oriented>> clusters_;
    std::vector<std::uint32_t> nodes_;
    std::vector<Link> links_;
    std::vector<std::uint32_t> moved_;  ///< the slot that this one's cluster was merged into, or none

    std::vector<std::uint32_t> chain_;  ///< slots, each but the first the nearest neighbor of the one before
    std::size_t steps_ = 0;

    Linkage linkage_;
    double direction_;
    double per_weight_;
};

template <class Item, class E, class P>
ClusterTree agglomerate(std::span<const Item> items, const ClusterSize& size, const E& execute, P& progress) {
    check_direction_length(size.direction_length);
    check_items(items);
    if (items.empty()) return {};
    if constexpr (HasAxis<Item>) {
        const auto [space, direction] = GreedySpace::of(items, size);
        const auto differs = [&](const Item& i) { return !(i.axis == items[0].axis); };
        if (direction > 0 && std::any_of(items.begin(), items.end(), differs)) {
            return Agglomerator<true>(items, space, direction).build(execute, progress);
        }
        return Agglomerator<false>(items, space, 0).build(execute, progress);
    } else {
        return Agglomerator<false>(items, NormalizedSpace::of(items), 0).build(execute, progress);
    }
}

}  // namespace detail

/// Builds a tree of items without direction from the bottom up: merges the two clusters whose union is smallest until
/// one is left, exactly as the greedy method of the papers does [Walter et al. 2005, Section 4]. Ties: see
/// `ClusterSize`. The left child of a node is the one with the smallest item. The tree does not depend on the executor.
/// throws: invalid_input naming the item: position not finite, weight not positive; or too many items.
/// cost: about O(N log N), several times that of `divide`; up to 200 bytes of temporary memory an item.
template <Executor E = Sequential, Progress P = NoProgress>
ClusterTree agglomerate(std::span<const PointItem> items, const ClusterSize& size = {}, const E& execute = {},
                        P progress = {}) {
    return detail::agglomerate(items, size, execute, progress);
}

/// Builds a tree of items with an axis from the bottom up: merges the two clusters whose union is smallest until one is
/// left, exactly as the greedy method of the papers does [Walter et al. 2005, Section 4]. Ties: see `ClusterSize`.
/// The left child of a node is the one with the smallest item. The tree does not depend on the executor.
/// throws: invalid_input naming the item: position not finite, weight not positive, axis not of unit length; or too
/// many items; or if `size.direction_length` is negative or not finite.
/// cost: about O(N log N), several times that of `divide`; up to 300 bytes of temporary memory an item.
template <Executor E = Sequential, Progress P = NoProgress>
ClusterTree agglomerate(std::span<const OrientedItem> items, const ClusterSize& size = {}, const E& execute = {},
                        P progress = {}) {
    return detail::agglomerate(items, size, execute, progress);
}

}  // namespace lightcuts
