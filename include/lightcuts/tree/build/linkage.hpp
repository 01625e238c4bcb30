#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../cluster_tree.hpp"

namespace lightcuts::detail {

/// The merges of a bottom-up builder, and the tree they make. Items are nodes 0 .. N-1, merges are nodes from N on.
class Linkage {
public:
    /// pre: items > 0.
    explicit Linkage(std::size_t items) : items_(items) { children_.reserve(items - 1); }

    /// Joins two nodes; returns the new one.
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
        // Nodes are made after their children: from the last one down, each hands out its children's places.
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
            const auto [left, right] = children_[m];
            const std::uint32_t first = first_nodes[m];
            words[first + 2 * counts[m] - 2] = first;
            place(left, first);
            place(right, first + 2 * count(left) - 1);
        }
        return ClusterTree(std::move(words));
    }

private:
    std::size_t items_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> children_;
};

}  // namespace lightcuts::detail
