#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "cluster_size.hpp"
#include "neighbor_block.hpp"

namespace lightcuts::detail {

/// A cluster's neighbor, by slot, and the rank of merging the two.
struct Neighbor {
    std::uint32_t slot = 0xffff'ffffu;
    Rank rank{std::numeric_limits<double>::infinity(), 0, 0, 0};
};

/// Finds nearest neighbors among clusters that are sorted by `KdOrder`.
///
/// Clusters occupy slots. Slot s is lane s % 8 of block s / 8; blocks are the lanes of the next level's blocks, and so
/// on up to a single one. A search climbs from the cluster's own block, whose clusters are close, and descends where
/// the bound of a lane does not exclude it. Bounds are computed in float with a margin; clusters that they do not
/// exclude are ranked in double.
template <bool Oriented>
class NeighborTree {
public:
    static constexpr std::size_t fan = NeighborBlock<Oriented>::lanes;

    /// Refers to `clusters`; merged ones must be announced by `replace` and `erase`. `per_weight` scales weights for
    /// the bounds.
    NeighborTree(std::span<const BuildCluster<Oriented>> clusters, double direction, double per_weight)
        : clusters_(clusters), direction_(direction), per_weight_(per_weight) {
        std::size_t count = clusters.size();
        for (std::size_t blocks = 0; blocks != 1; count = blocks) {
            blocks = (count + fan - 1) / fan;
            first_block_.push_back(blocks_.size());
            blocks_.resize(blocks_.size() + blocks);
        }
        count = clusters.size();
        for (std::size_t s = 0; s < count; ++s) replace(static_cast<std::uint32_t>(s));
        clear_rest(0, count);
        for (std::size_t level = 1; level < first_block_.size(); ++level) {
            count = (count + fan - 1) / fan;
            for (std::size_t n = 0; n < count; ++n) {
                enclose(block(level - 1, n), blocks_[first_block_[level] + n / fan], n % fan);
            }
            clear_rest(level, count);
        }
    }

    /// The cluster of `slot` has changed; it holds the previous one, so the bounds above remain valid.
    void replace(std::uint32_t slot) { blocks_[slot / fan].set(slot % fan, clusters_[slot], per_weight_); }

    void erase(std::uint32_t slot) { blocks_[slot / fan].clear(slot % fan); }

    /// The neighbor of least rank of the cluster in `slot` if it ranks before `best`, else `best`.
    Neighbor nearest(std::uint32_t slot, const Neighbor& best) const {
        Search search(*this, slot, best);
        std::size_t lane = slot % fan, n = slot / fan;
        search.visit(0, n, 1u << lane);
        for (std::size_t level = 1; level < first_block_.size(); ++level) {
            lane = n % fan;
            n = n / fan;
            search.visit(level, n, 1u << lane);
        }
        return search.best;
    }

private:
    struct Search {
        const NeighborTree& tree;
        const BuildCluster<Oriented>& cluster;
        Probe<Oriented> probe;
        Neighbor best;
        float threshold;  ///< bounds above it exclude

        Search(const NeighborTree& t, std::uint32_t slot, const Neighbor& b)
            : tree(t), cluster(t.clusters_[slot]), probe(cluster, t.direction_, t.per_weight_), best(b) {
            set_threshold();
        }

        /// Allows for the bounds' relative rounding errors, and for denormals. Finite: it excludes empty lanes.
        void set_threshold() {
            threshold = static_cast<float>((std::min)(best.rank.size * tree.per_weight_ * (1 + 4e-6) + 1e-36, 1e38));
        }

        /// Visits a block's lanes except those in the set `skip`, the most promising first.
        void visit(std::size_t level, std::size_t n, unsigned skip) {
            typename Probe<Oriented>::Lanes bounds;
            if (!probe.bound(tree.block(level, n), threshold, bounds)) return;
            unsigned lanes = 0;  // a set, made without unpredictable branches
            for (std::size_t j = 0; j < fan; ++j) lanes |= static_cast<unsigned>(bounds[j] <= threshold) << j;
            lanes &= ~skip;
            while (lanes != 0) {
                auto j = static_cast<std::size_t>(std::countr_zero(lanes));
                for (unsigned rest = lanes & (lanes - 1); rest != 0; rest &= rest - 1) {
                    const auto k = static_cast<std::size_t>(std::countr_zero(rest));
                    j = bounds[k] < bounds[j] ? k : j;
                }
                if (!(bounds[j] <= threshold)) return;
                lanes &= ~(1u << j);
                if (level == 0) {
                    consider(static_cast<std::uint32_t>(n * fan + j));
                } else {
                    visit(level - 1, n * fan + j, 0);
                }
            }
        }

        void consider(std::uint32_t slot) {
            const Rank r = rank(cluster, tree.clusters_[slot], tree.direction_);
            if (r < best.rank) {
                best = {slot, r};
                set_threshold();
            }
        }
    };

    const NeighborBlock<Oriented>& block(std::size_t level, std::size_t n) const {
        return blocks_[first_block_[level] + n];
    }

    /// Empties the lanes of a level's last block that hold nothing.
    void clear_rest(std::size_t level, std::size_t count) {
        for (; count % fan != 0; ++count) blocks_[first_block_[level] + count / fan].clear(count % fan);
    }

    std::span<const BuildCluster<Oriented>> clusters_;
    double direction_;
    double per_weight_;
    std::vector<std::size_t> first_block_;  ///< of each level
    std::vector<NeighborBlock<Oriented>> blocks_;
};

}  // namespace lightcuts::detail
