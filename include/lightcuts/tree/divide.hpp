#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "../core/executor.hpp"
#include "binned.hpp"
#include "cluster_tree.hpp"
#include "item.hpp"
#include "longest_axis.hpp"
#include "progress.hpp"
#include "record.hpp"

namespace lightcuts {

namespace detail {

/// Writes the tree of a set straight into post-order: n items take 2n-1 words, the left part's come first, so
/// parts can be written independently of each other.
template <class Record, class Splitter>
class Divider {
public:
    Divider(const Splitter& splitter, std::span<std::uint32_t> words)
        : splitter_(splitter), words_(words), max_depth_(2 * static_cast<unsigned>(std::bit_width(words.size())) + 16) {
    }

    /// Writes the root of a part. pre: at least 2 records.
    Halves<Record> split(const Part<Record>& part) const {
        words_[part.first_node + 2 * part.records.size() - 2] = part.first_node;
        // Sets made to be peeled one by one must not make the tree, or the stack, deep.
        Halves<Record> halves = part.depth < max_depth_ ? splitter_.split(part) : LongestAxis{}.split(part);
        halves.left.first_node = part.first_node;
        halves.right.first_node = part.first_node + static_cast<std::uint32_t>(2 * halves.left.records.size() - 1);
        halves.left.depth = halves.right.depth = part.depth + 1;
        return halves;
    }

    void build(const Part<Record>& part) const {
        const std::uint32_t first = part.first_node;
        if (part.records.size() == 1) {
            write_leaf(first, part.records[0]);
        } else if (part.records.size() == 2) {
            write_leaf(first, part.records[0]);
            write_leaf(first + 1, part.records[1]);
            words_[first + 2] = first;
        } else {
            const Halves<Record> halves = split(part);
            build(halves.left);
            build(halves.right);
        }
    }

private:
    void write_leaf(std::uint32_t node, const Record& r) const { words_[node] = ClusterTree::leaf_word(r.item()); }

    const Splitter& splitter_;
    std::span<std::uint32_t> words_;
    unsigned max_depth_;
};

template <class Item, class Splitter, class E, class P>
ClusterTree divide(std::span<const Item> items, const Splitter& splitter, const E& execute, P& progress) {
    check_items(items);
    if (items.empty()) return {};
    using Record = record_of<Item>;
    const auto storage = make_records(items);
    const std::span<Record> records(storage.get(), items.size());
    std::vector<std::uint32_t> words(2 * items.size() - 1);
    const Divider<Record, Splitter> divider(splitter, words);

    // Step 1: split level by level down to parts of a fixed size, whatever the number of threads.
    const std::size_t grain = std::max<std::size_t>(items.size() / 128, 4096);
    std::vector<Part<Record>> coarse, fine;
    const auto file = [&](const Part<Record>& part) { (part.records.size() > grain ? coarse : fine).push_back(part); };
    file({records, Bounds<Record>::none()});
    while (!coarse.empty()) {
        std::vector<Halves<Record>> halves(coarse.size());
        execute(coarse.size(), [&](std::size_t i) { halves[i] = divider.split(coarse[i]); });
        coarse.clear();
        for (const Halves<Record>& h : halves) {
            file(h.left);
            file(h.right);
        }
    }
    // Step 2: each part is a task of its own.
    execute(fine.size(), [&](std::size_t i) {
        divider.build(fine[i]);
        progress(fine[i].records.size());
    });
    return ClusterTree(std::move(words));
}

}  // namespace detail

/// Builds a tree from the top down: `splitter` divides a set in two until single items remain.
/// The tree does not depend on the executor. Its depth is at most 3 log2 N + 20; for coincident items ceil(log2 N).
/// throws: invalid_input naming the item: position not finite, weight not positive, axis not of unit length; or too
/// many items. cost: O(N log N); temporary memory of 20 (oriented: 32) bytes an item besides the tree's 8.
template <class Splitter = Binned, Executor E = Sequential, Progress P = NoProgress>
ClusterTree divide(std::span<const PointItem> items, Splitter splitter = {}, const E& execute = {}, P progress = {}) {
    return detail::divide(items, splitter, execute, progress);
}

/// Likewise for items with an axis.
template <class Splitter = Binned, Executor E = Sequential, Progress P = NoProgress>
ClusterTree divide(std::span<const OrientedItem> items, Splitter splitter = {}, const E& execute = {},
                   P progress = {}) {
    return detail::divide(items, splitter, execute, progress);
}

}  // namespace lightcuts
