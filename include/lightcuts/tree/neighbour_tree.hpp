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

#include "cluster_block.hpp"
#include "cluster_size.hpp"
#include "kd_order.hpp"

namespace lightcuts::detail {

/// Finds the nearest neighbour of clusters [BOUNDS of the union's size over the clusters of a subtree].
///
/// Clusters occupy slots; slot s is lane s % 8 of block s / 8, blocks are the lanes of the next level's, up to one.
/// Bounds are computed in float with a margin; whatever they do not exclude is measured in double.
template <bool Oriented>
class NeighbourTree {
public:
    static constexpr std::size_t fan = KdOrder<Oriented>::fan;
    static constexpr std::uint32_t none = 0xffff'ffffu;

    struct Neighbour {
        std::uint32_t slot = none;
        Rank rank{std::numeric_limits<double>::infinity(), 0, 0, 0};
    };

    /// `clusters` are referred to, in kd order; merged ones must be announced by replace() and erase().
    NeighbourTree(std::span<const Cluster<Oriented>> clusters, double direction, double per_weight)
        : clusters_(clusters), direction_(direction), per_weight_(per_weight) {
        std::size_t count = clusters.size();
        do {
            first_block_.push_back(blocks_.size());
            const std::size_t blocks = (count + fan - 1) / fan;
            blocks_.resize(blocks_.size() + blocks);
            count = blocks;
        } while (count > 1);
        for (std::size_t s = 0; s < clusters.size(); ++s) replace(static_cast<std::uint32_t>(s));
        for (std::size_t s = clusters.size(); s % fan != 0; ++s) blocks_[s / fan].clear(s % fan);
        count = clusters.size();
        for (std::size_t level = 1; level < first_block_.size(); ++level) {
            count = (count + fan - 1) / fan;
            for (std::size_t n = 0; n < count; ++n) {
                enclose(blocks_[first_block_[level - 1] + n], blocks_[first_block_[level] + n / fan], n % fan);
            }
            for (std::size_t n = count; n % fan != 0; ++n) blocks_[first_block_[level] + n / fan].clear(n % fan);
        }
    }

    /// The cluster of `slot` has changed; it contains the previous one.
    void replace(std::uint32_t slot) {
        const Cluster<Oriented>& c = clusters_[slot];
        Block<Oriented>& block = blocks_[slot / fan];
        const std::size_t j = slot % fan;
        for (std::size_t a = 0; a < 3; ++a) {
            block.least_hi[a][j] = c.hi[a];
            block.most_lo[a][j] = c.lo[a];
        }
        block.weight[j] = Probe<Oriented>::float_weight(c.weight * per_weight_);
        if constexpr (Oriented) {
            const std::array<float, 3> axis = unit_axis(c);
            for (std::size_t a = 0; a < 3; ++a) block.axis[a][j] = axis[a];
            block.sin[j] = static_cast<float>(c.half.sin);
            block.cos[j] = static_cast<float>(c.half.cos);
        }
    }

    void erase(std::uint32_t slot) { blocks_[slot / fan].clear(slot % fan); }

    /// The neighbour of least rank of the cluster in `slot`, if it is less than `best`; else `best`.
    Neighbour nearest(std::uint32_t slot, Neighbour best) const {
        Search search(*this, slot, best);
        std::size_t lane = slot % fan, block = slot / fan;
        search.scan(block, lane);
        for (std::size_t level = 1; level < first_block_.size(); ++level) {
            lane = block % fan;
            block = block / fan;
            search.visit(level, block, lane);
        }
        return search.best;
    }

private:
    struct Search {
        const NeighbourTree& tree;
        const Cluster<Oriented>& cluster;
        Probe<Oriented> probe;
        Neighbour best;
        float threshold;  ///< bounds above it exclude

        Search(const NeighbourTree& t, std::uint32_t slot, const Neighbour& b)
            : tree(t), cluster(t.clusters_[slot]), probe(cluster, t.per_weight_, t.direction_), best(b) {
            set_threshold();
        }

        /// Allows for relative rounding errors of bounds, and for denormals. Finite, so that it excludes empty lanes.
        void set_threshold() {
            threshold = static_cast<float>(std::min(best.rank.size * tree.per_weight_ * (1 + 4e-6) + 1e-36, 1e38));
        }

        using Lanes = typename Block<Oriented>::Lanes;

        /// The lanes whose bounds are within the threshold, as bits. Without unpredictable branches.
        unsigned within(const Lanes& bounds) const {
            unsigned lanes = 0;
            for (std::size_t j = 0; j < fan; ++j) lanes |= static_cast<unsigned>(bounds[j] <= threshold) << j;
            return lanes;
        }

        void scan(std::size_t block, std::size_t skip) {
            Lanes bounds;
            if (!probe.bound(tree.blocks_[block], threshold, bounds)) return;
            for (unsigned lanes = within(bounds) & ~(1u << skip); lanes != 0; lanes &= lanes - 1) {
                const auto j = static_cast<std::size_t>(std::countr_zero(lanes));
                if (bounds[j] <= threshold) consider(static_cast<std::uint32_t>(block * fan + j));
            }
        }

        void consider(std::uint32_t s) {
            const Rank r = rank<Oriented>(cluster, tree.clusters_[s], tree.direction_);
            if (r < best.rank) {
                best = {s, r};
                set_threshold();
            }
        }

        void visit(std::size_t level, std::size_t block, std::size_t skip) {
            Lanes bounds;
            if (!probe.bound(tree.blocks_[tree.first_block_[level] + block], threshold, bounds)) return;
            unsigned lanes = within(bounds) & ~(1u << skip);
            while (lanes != 0) {
                auto j = static_cast<std::size_t>(std::countr_zero(lanes));
                for (unsigned rest = lanes & (lanes - 1); rest != 0; rest &= rest - 1) {
                    const auto k = static_cast<std::size_t>(std::countr_zero(rest));
                    j = bounds[k] < bounds[j] ? k : j;
                }
                lanes &= ~(1u << j);
                if (!(bounds[j] <= threshold)) return;
                if (level == 1) {
                    scan(block * fan + j, fan);
                } else {
                    visit(level - 1, block * fan + j, fan);
                }
            }
        }
    };

    /// Makes lane j of `parent` the node of all lanes of `child`.
    static void enclose(const Block<Oriented>& child, Block<Oriented>& parent, std::size_t j) {
        for (std::size_t a = 0; a < 3; ++a) {
            parent.least_hi[a][j] = *std::min_element(child.least_hi[a].begin(), child.least_hi[a].end());
            parent.most_lo[a][j] = *std::max_element(child.most_lo[a].begin(), child.most_lo[a].end());
        }
        parent.weight[j] = *std::min_element(child.weight.begin(), child.weight.end());
        if constexpr (Oriented) {
            std::array<float, 3> axis{};
            for (std::size_t a = 0; a < 3; ++a) {
                for (std::size_t k = 0; k < fan; ++k) axis[a] += child.axis[a][k];
            }
            const float length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
            constexpr float quarter = 0.5f * std::numbers::pi_v<float>;
            float around = 0;
            if (length > 1e-3f) {
                for (float& a : axis) a /= length;
                for (std::size_t k = 0; k < fan; ++k) {
                    if (std::isinf(child.weight[k])) continue;
                    const float x = axis[0] - child.axis[0][k], y = axis[1] - child.axis[1][k],
                                z = axis[2] - child.axis[2][k];
                    const float half = 0.5f * std::sqrt(x * x + y * y + z * z);
                    const float within = child.sin[k] < 0 ? std::atan2(-child.sin[k], child.cos[k]) : 0;
                    around = std::max(around, std::asin(std::min(half, 1.0f)) + within);
                }
                around += 1e-6f;
            } else {
                around = quarter;
            }
            around = std::min(around, quarter);
            for (std::size_t a = 0; a < 3; ++a) parent.axis[a][j] = axis[a];
            parent.sin[j] = around > 1e-6f ? -std::sin(around) : 0.0f;
            parent.cos[j] = std::cos(around);
        }
    }

    std::span<const Cluster<Oriented>> clusters_;
    double direction_;
    double per_weight_;
    std::vector<std::size_t> first_block_;  ///< of each level
    std::vector<Block<Oriented>> blocks_;
};

}  // namespace lightcuts::detail
