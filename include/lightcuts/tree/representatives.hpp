#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../core/assertion.hpp"
#include "../core/invalid_input.hpp"
#include "../core/random.hpp"
#include "cluster_tree.hpp"

namespace lightcuts {

/// The leaves that may represent each node of a binary tree: lights, gather points or whatever else has a weight. A
/// node's representatives are taken from those of its children, each with a probability proportional to the weight on
/// its side, so that a leaf drawn evenly from a node's list represents it with probability leaf weight / node weight
/// (over seeds).
///
/// With one a node [Lightcuts 2005, section 3] the whole image uses the same one. With several [Miksik 2007,
/// section 4] a receiver draws one, which turns a bias that can be seen as bands into noise: a parent has as many as
/// the child with more of them, plus one with probability (fewer / more), up to a limit.
class Representatives {
public:
    using node_index = ClusterTree::node_index;

    Representatives() = default;

    /// Chooses the representatives of all nodes of `tree` as `choose` does, whose arguments and errors are the same,
    /// and keeps no spare storage.
    Representatives(const ClusterTree& tree, std::span<const double> weights, unsigned limit, std::uint64_t seed) {
        choose(tree, weights, limit, seed);
        leaves_.shrink_to_fit();
    }

    /// Chooses representatives anew, in the storage of those before.
    /// `weights[n]`: the weight of node n, which is that of its children together. Where it is 0 each child is as
    /// likely; a child of weight 0 is never chosen beside one that has weight.
    /// `limit`: most representatives a node may have.
    /// `seed`: whatever the choice shall depend on. Sides of a product graph and instants of time get choices of their
    /// own by seeds of their own: `hash_keys(seed, side, instant)`.
    /// pre: the tree is binary; weights finite and >= 0; 1 <= limit <= 32.
    /// throws: invalid_input if there are more than 2^32 representatives.
    /// cost: O(N); 4 bytes a node for one representative, about 4 + 4 * (mean number) for several.
    void choose(const ClusterTree& tree, std::span<const double> weights, unsigned limit, std::uint64_t seed) {
        LIGHTCUTS_ASSERT(tree.is_binary() && weights.size() == tree.size() && limit >= 1 && limit <= 32);
        leaves_.clear();
        begin_.clear();
        if (limit <= 1) {
            choose_one(tree, weights, seed);
        } else {
            choose_several(tree, weights, limit, seed);
        }
    }

    /// The representative of n that the random bits `choice` draw: a leaf in n's subtree.
    node_index draw(node_index n, std::uint64_t choice) const {
        if (begin_.empty()) return leaves_[n];
        const std::span<const node_index> list = of(n);
        return list[static_cast<std::size_t>(uniform01(choice) * static_cast<double>(list.size()))];
    }

    /// All representatives of n, one of which may occur more than once.
    std::span<const node_index> of(node_index n) const {
        if (begin_.empty()) return std::span(leaves_).subspan(n, 1);
        return std::span(leaves_).subspan(begin_[n], begin_[n + 1] - begin_[n]);
    }

    /// True if no node has more than one representative, so that `draw` ignores its choice.
    bool single() const { return begin_.empty(); }

    std::size_t memory_bytes() const {
        return leaves_.capacity() * sizeof(node_index) + begin_.capacity() * sizeof(std::uint32_t);
    }

private:
    /// Whether a number in [0, 1) falls to the left of two weights.
    static bool falls_left(double r, double left, double right) {
        const double sum = left + right;
        return sum > 0 ? r * sum < left : r < 0.5;
    }

    void choose_one(const ClusterTree& tree, std::span<const double> weights, std::uint64_t seed) {
        leaves_.resize(tree.size());
        for (node_index n = 0; n < tree.size(); ++n) {
            if (tree.is_leaf(n)) {
                leaves_[n] = n;
                continue;
            }
            const node_index a = tree.left(n), b = tree.right(n);
            const double r = uniform01(hash_keys(seed, n));
            leaves_[n] = leaves_[falls_left(r, weights[a], weights[b]) ? a : b];
        }
    }

    void choose_several(const ClusterTree& tree, std::span<const double> weights, unsigned limit, std::uint64_t seed) {
        begin_.reserve(tree.size() + 1);
        begin_.push_back(0);
        for (node_index n = 0; n < tree.size(); ++n) {
            if (tree.is_leaf(n)) {
                leaves_.push_back(n);
            } else {
                const node_index a = tree.left(n), b = tree.right(n);
                const std::size_t in_a = begin_[a + 1] - begin_[a], in_b = begin_[b + 1] - begin_[b];
                const std::size_t more = in_a > in_b ? in_a : in_b, fewer = in_a + in_b - more;
                const bool grows = uniform01(hash_keys(seed, n, 1)) * static_cast<double>(more) <
                                   static_cast<double>(fewer);
                const std::size_t count = std::min<std::size_t>(more + (grows ? 1 : 0), limit);
                // Slot k falls to the left child if its stratum lies in the child's share of the weight; within a
                // child the slots go round its list, so that no light is taken twice while another is left.
                const double jitter = uniform01(hash_keys(seed, n, 2));
                std::size_t next_a = hash_keys(seed, n, 3) % in_a, next_b = hash_keys(seed, n, 4) % in_b;
                for (std::size_t k = 0; k < count; ++k) {
                    const double r = (static_cast<double>(k) + jitter) / static_cast<double>(count);
                    if (falls_left(r, weights[a], weights[b])) {
                        leaves_.push_back(leaves_[begin_[a] + next_a]);
                        next_a = (next_a + 1) % in_a;
                    } else {
                        leaves_.push_back(leaves_[begin_[b] + next_b]);
                        next_b = (next_b + 1) % in_b;
                    }
                }
            }
            begin_.push_back(static_cast<std::uint32_t>(leaves_.size()));
        }
        if (leaves_.size() > (std::numeric_limits<std::uint32_t>::max)()) {
            LIGHTCUTS_THROW(
                invalid_input("representatives: so many lights have more than 2^32 of them; ask for fewer a node"));
        }
    }

    std::vector<node_index> leaves_;
    std::vector<std::uint32_t> begin_;  ///< empty with one representative a node
};

}  // namespace lightcuts
