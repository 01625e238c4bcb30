#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "../core/executor.hpp"
#include "../core/random.hpp"
#include "cluster_size.hpp"
#include "cluster_tree.hpp"
#include "item.hpp"
#include "kd_order.hpp"
#include "neighbour_tree.hpp"
#include "record.hpp"

namespace lightcuts {
namespace detail {

/// The merges of a greedy builder, and the tree they make.
class Merges {
public:
    explicit Merges(std::size_t items) : items_(items) { children_.reserve(items - 1); }

    /// Joins two nodes (items are nodes 0 .. N-1); returns the new node.
    std::uint32_t join(std::uint32_t left, std::uint32_t right) {
        children_.push_back({left, right});
        return static_cast<std::uint32_t>(items_ + children_.size() - 1);
    }

    /// pre: N-1 merges. cost: O(N).
    ClusterTree tree() const {
        std::vector<std::uint32_t> words(2 * items_ - 1);
        std::vector<std::uint32_t> counts(children_.size());
        const auto count = [&](std::uint32_t n) { return n < items_ ? 1 : counts[n - items_]; };
        for (std::size_t m = 0; m < children_.size(); ++m) {
            counts[m] = count(children_[m].first) + count(children_[m].second);
        }
        // A node is made after its children: from the last one down, parents hand out the places of their children.
        std::vector<std::uint32_t> first_nodes(children_.size(), 0);
        const auto place = [&](std::uint32_t n, std::uint32_t first) {
            if (n < items_) {
                words[first] = ClusterTree::leaf_word(n);
            } else {
                first_nodes[n - items_] = first;
            }
        };
        if (children_.empty()) place(0, 0);
        for (std::size_t m = children_.size(); m-- > 0;) {
            const std::uint32_t first = first_nodes[m];
            words[first + 2 * counts[m] - 2] = first;
            place(children_[m].first, first);
            place(children_[m].second, first + 2 * count(children_[m].first) - 1);
        }
        return ClusterTree(std::move(words));
    }

private:
    std::size_t items_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> children_;
};

/// Greedy merging by chains of nearest neighbours.
///
/// The order of merging (Rank) is strictly monotone: a pair ranks before every pair of clusters that contain it. So
/// two clusters which are each other's nearest neighbours stay so until the greedy method merges them, whatever it
/// merges before, and may be merged at once. Following nearest neighbours from any cluster leads to such a pair: ranks
/// fall along the way [Walter et al. 2008, "Fast agglomerative clustering for rendering", there for trees of
/// triangles]. No heap, and neighbours stay in the cache.
template <bool Oriented>
class Agglomerator {
public:
    template <class Item>
    Agglomerator(std::span<const Item> items, double direction) : merges_(items.size()), direction_(direction) {
        const Frame frame = Frame::of(items);
        float least = std::numeric_limits<float>::max(), most = 0;
        clusters_.reserve(items.size());
        for (std::size_t i = 0; i < items.size(); ++i) {
            clusters_.push_back(cluster_of<Oriented>(items[i], static_cast<std::uint32_t>(i), frame));
            nodes_.push_back(static_cast<std::uint32_t>(i));
            least = std::min(least, items[i].weight);
            most = std::max(most, items[i].weight);
        }
        // The bounds' weights are floats: their range is used best around the middle.
        per_weight_ = std::sqrt(static_cast<double>(most) / static_cast<double>(least));
        neighbours_.resize(items.size());
    }

    template <class E>
    ClusterTree build(const E& execute) {
        merge_coincident();
        while (clusters_.size() > 1) sweep(execute);
        return merges_.tree();
    }

    std::size_t queries = 0;

private:
    using Neighbours = NeighbourTree<Oriented>;

    /// A cluster's nearest neighbour when last searched.
    struct Link {
        std::uint32_t slot = Neighbours::none;
        std::uint32_t node = 0;  ///< of the cluster that was in the slot then
        double size = 0;
    };

    /// Coincident clusters have size 0 and come first in the greedy order, fewest items first.
    void merge_coincident() {
        // Step 1: chain equal items through a hash table.
        const std::size_t n = clusters_.size();
        std::vector<std::uint32_t> table(std::bit_ceil(2 * n), Neighbours::none), next(n, Neighbours::none);
        bool any = false;
        for (std::size_t s = n; s-- > 0;) {
            std::size_t h = hash(clusters_[s]) & (table.size() - 1);
            while (table[h] != Neighbours::none && !coincide(clusters_[table[h]], clusters_[s])) {
                h = (h + 1) & (table.size() - 1);
            }
            if (table[h] != Neighbours::none) any = true;
            next[s] = table[h];
            table[h] = static_cast<std::uint32_t>(s);
        }
        if (!any) return;
        // Step 2: merge each chain, the two with the fewest items (then the smallest ids) first.
        using Entry = std::pair<std::uint32_t, std::uint32_t>;  // count, slot: of equal items slots are ordered as ids
        std::vector<bool> dead(n, false);
        for (const std::uint32_t head : table) {
            if (head == Neighbours::none || next[head] == Neighbours::none) continue;
            std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
            for (std::uint32_t s = head; s != Neighbours::none; s = next[s]) queue.push({clusters_[s].count, s});
            while (queue.size() > 1) {
                const std::uint32_t a = queue.top().second;
                queue.pop();
                const std::uint32_t b = queue.top().second;
                queue.pop();
                const std::uint32_t s = std::min(a, b);
                join(s, std::max(a, b));
                dead[std::max(a, b)] = true;
                queue.push({clusters_[s].count, s});
            }
        }
        compact([&](std::size_t s) { return !dead[s]; });
    }

    static bool coincide(const Cluster<Oriented>& a, const Cluster<Oriented>& b) {
        if constexpr (Oriented) {
            if (!(a.cone.axis == b.cone.axis)) return false;
        }
        return a.lo == b.lo;
    }

    static std::uint64_t hash(const Cluster<Oriented>& c) {
        const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
        const auto two = [&](float x, float y) { return std::uint64_t{bits(x)} << 32 | bits(y); };
        std::uint64_t h = hash_keys(two(c.lo[0], c.lo[1]), bits(c.lo[2]));
        if constexpr (Oriented) h = hash_keys(h, two(c.cone.axis.x, c.cone.axis.y), bits(c.cone.axis.z));
        return h;
    }

    template <class Alive>
    void compact(Alive&& alive) {
        std::size_t count = 0;
        for (std::size_t s = 0; s < clusters_.size(); ++s) {
            if (!alive(s)) continue;
            clusters_[count] = clusters_[s];
            nodes_[count] = nodes_[s];
            ++count;
        }
        clusters_.resize(count);
        nodes_.resize(count);
    }

    /// Merges slot b into slot a.
    void join(std::uint32_t a, std::uint32_t b) {
        const bool ordered = clusters_[a].id < clusters_[b].id;
        nodes_[a] = merges_.join(ordered ? nodes_[a] : nodes_[b], ordered ? nodes_[b] : nodes_[a]);
        clusters_[a] = merge(clusters_[a], clusters_[b]);
    }

    /// Follows the chain from every cluster in turn to a pair and merges it: at least halves their number.
    template <class E>
    void sweep(const E&) {
        reorder();
        Neighbours tree(clusters_, direction_, per_weight_);
        const std::size_t n = clusters_.size();
        std::vector<std::uint32_t> moved(n, Neighbours::none);  // where a merged cluster went
        const auto home = [&](std::uint32_t s) {
            while (moved[s] != Neighbours::none) s = moved[s];
            return s;
        };
        const auto update = [&](std::uint32_t s) {
            Link& link = neighbours_[s];
            typename Neighbours::Neighbour best;
            if (link.slot != Neighbours::none) {
                if (nodes_[link.slot] == link.node && moved[link.slot] == Neighbours::none) return;
                const std::uint32_t h = home(link.slot);
                if (h != s) best = {h, rank(clusters_[s], clusters_[h], direction_)};
            }
            ++queries;
            best = tree.nearest(s, best);
            link = {best.slot, nodes_[best.slot], best.rank.size};
        };
        std::size_t count = n;
        for (std::uint32_t s = 0; s < n && count > 1; ++s) {
            if (moved[s] != Neighbours::none) continue;
            std::uint32_t a = s;
            update(a);
            for (;;) {
                const std::uint32_t b = neighbours_[a].slot;
                update(b);
                if (neighbours_[b].slot == a) {
                    join(a, b);
                    moved[b] = a;
                    tree.replace(a);
                    tree.erase(b);
                    neighbours_[a] = {};
                    --count;
                    break;
                }
                a = b;
            }
        }
        // Links follow their clusters.
        std::vector<std::uint32_t> place(n);
        std::uint32_t p = 0;
        for (std::size_t s = 0; s < n; ++s) place[s] = moved[s] == Neighbours::none ? p++ : 0;
        for (std::size_t s = 0; s < n; ++s) {
            if (moved[s] != Neighbours::none) continue;
            Link link = neighbours_[s];
            if (link.slot != Neighbours::none) {
                const std::uint32_t h = home(link.slot);
                if (h == s) link = {};
                else {
                    link.node = h == link.slot ? link.node : Neighbours::none;
                    link.slot = place[h];
                }
            }
            neighbours_[place[s]] = link;
        }
        compact([&](std::size_t s) { return moved[s] == Neighbours::none; });
        neighbours_.resize(clusters_.size());
    }

    void reorder() {
        const auto keys = KdOrder<Oriented>::of(clusters_, direction_);
        const std::size_t n = keys.size();
        std::vector<Cluster<Oriented>> clusters(n);
        std::vector<std::uint32_t> nodes(n), place(n);
        std::vector<Link> links(n);
        for (std::size_t s = 0; s < n; ++s) place[keys[s].slot] = static_cast<std::uint32_t>(s);
        for (std::size_t s = 0; s < n; ++s) {
            clusters[s] = clusters_[keys[s].slot];
            nodes[s] = nodes_[keys[s].slot];
            links[s] = neighbours_[keys[s].slot];
            if (links[s].slot != Neighbours::none) links[s].slot = place[links[s].slot];
        }
        clusters_.swap(clusters);
        nodes_.swap(nodes);
        neighbours_.swap(links);
    }

    std::vector<Cluster<Oriented>> clusters_;  ///< by slot
    std::vector<std::uint32_t> nodes_;         ///< likewise
    std::vector<Link> neighbours_;             ///< likewise
    Merges merges_;
    double direction_;
    double per_weight_;
};

}  // namespace detail

inline std::size_t debug_queries = 0;
template <Executor E = Sequential>
ClusterTree agglomerate(std::span<const PointItem> items, const E& execute = {}) {
    detail::check_items(items);
    if (items.empty()) return {};
    detail::Agglomerator<false> b(items, 0);
    auto t = b.build(execute);
    debug_queries = b.queries;
    return t;
}

template <Executor E = Sequential>
ClusterTree agglomerate(std::span<const OrientedItem> items, ClusterSize size = {}, const E& execute = {}) {
    detail::check_items(items);
    if (items.empty()) return {};
    const bool same = size.direction == 0 || std::all_of(items.begin(), items.end(), [&](const OrientedItem& i) { return i.axis == items[0].axis; });
    if (same) {
        detail::Agglomerator<false> b(items, 0);
        auto t = b.build(execute);
        debug_queries = b.queries;
        return t;
    }
    detail::Agglomerator<true> b(items, size.direction);
    auto t = b.build(execute);
    debug_queries = b.queries;
    return t;
}

}  // namespace lightcuts
