#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "../../core/assertion.hpp"
#include "../../core/executor.hpp"
#include "../../core/invalid_input.hpp"
#include "../cluster_tree.hpp"
#include "binned.hpp"
#include "build_item.hpp"
#include "build_range.hpp"
#include "item.hpp"
#include "longest_axis.hpp"
#include "normalized_space.hpp"
#include "progress.hpp"
#include "splitter.hpp"

namespace lightcuts {

namespace detail {

/// Writes the tree of a set straight into post-order: n items take 2n-1 words, the left part's come first, so
/// parts can be written independently of each other.
template <std::size_t Dimensions, Splitter<Dimensions> S>
class Divider {
public:
    using Range = BuildRange<Dimensions>;

    Divider(const S& splitter, const NormalizedSpace& space, std::span<std::uint32_t> words)
        : splitter_(splitter), space_(space), words_(words),
          max_depth_(2 * static_cast<unsigned>(std::bit_width(words.size())) + 16) {}

    /// Writes the root of a range whose subtree begins at `first`. pre: at least 2 items.
    Split<Dimensions> split(const Range& range, std::uint32_t first, unsigned depth) const {
        const std::size_t items = range.items.size();
        words_[first + 2 * items - 2] = first;
        // Sets of which a splitter takes off one item at a time must not make the tree, or the stack, deep.
        Split<Dimensions> split = depth < max_depth_ ? splitter_.split(range, space_)
                                                     : LongestAxis{}.split(range, space_);
        LIGHTCUTS_ASSERT(!split.left.items.empty() && !split.right.items.empty());
        LIGHTCUTS_ASSERT(split.left.items.data() == range.items.data() &&
                         split.right.items.data() == range.items.data() + split.left.items.size() &&
                         split.left.items.size() + split.right.items.size() == items);
        return split;
    }

    /// Where the right subtree begins.
    static std::uint32_t first_right(const Split<Dimensions>& split, std::uint32_t first) {
        return first + static_cast<std::uint32_t>(2 * split.left.items.size() - 1);
    }

    /// Writes the subtree of a range.
    void build(const Range& range, std::uint32_t first, unsigned depth) const {
        const std::span<const BuildItem<Dimensions>> items = range.items;
        if (items.size() == 1) {
            write_leaf(first, items[0]);
        } else if (items.size() == 2) {
            write_leaf(first, items[0]);
            write_leaf(first + 1, items[1]);
            words_[first + 2] = first;
        } else {
            const Split<Dimensions> halves = split(range, first, depth);
            build(halves.left, first, depth + 1);
            build(halves.right, first_right(halves, first), depth + 1);
        }
    }

private:
    void write_leaf(std::uint32_t node, const BuildItem<Dimensions>& i) const {
        words_[node] = ClusterTree::leaf_word(i.item());
    }

    const S& splitter_;
    const NormalizedSpace& space_;
    std::span<std::uint32_t> words_;
    unsigned max_depth_;
};

}  // namespace detail

/// What `divide_into` needs besides the items and the tree; keep one a thread. Once it has served a build of as many
/// items, and the tree one of as many nodes, neither allocates; a splitter may.
template <std::size_t Dimensions>
struct DivideScratch {
    /// A range, and where its subtree goes.
    struct Part {
        BuildRange<Dimensions> range;
        std::uint32_t first_node = 0;  ///< in post-order
        unsigned depth = 0;
    };

    std::vector<Part> parents;              ///< being split, all of one depth
    std::vector<Part> coarse;               ///< still to split
    std::vector<Split<Dimensions>> halves;  ///< of the parents
    std::vector<Part> fine;                 ///< each a task of its own
};

/// Builds a tree from the top down in the caller's storage: `splitter` divides a set in two until single items remain.
/// `items`: made by `build_item` in `space`; reordered. `tree`: replaced; its storage is used.
/// The tree does not depend on the executor. Its depth is at most 3 log2 N + 20; for coincident items ceil(log2 N).
/// pre: as `build_item`. throws: invalid_input if there are too many items, the splitter's `direction_length` is
/// negative or not finite, or its `check` throws. cost: O(N log N) and what the splitter takes; allocates nothing but
/// that once scratch and tree are warm.
template <std::size_t Dimensions, Splitter<Dimensions> S, Executor E = Sequential, Progress P = NoProgress>
void divide_into(std::span<BuildItem<Dimensions>> items, const S& splitter, const NormalizedSpace& space,
                 DivideScratch<Dimensions>& scratch, ClusterTree& tree, const E& execute = {}, P&& progress = {}) {
    using Part = typename DivideScratch<Dimensions>::Part;
    detail::check_count(items.size());
    if constexpr (requires { detail::check_direction_length(splitter.direction_length); }) {
        detail::check_direction_length(splitter.direction_length);
    }
    if constexpr (requires { splitter.check(); }) splitter.check();
    std::vector<std::uint32_t> words = std::move(tree).release();
    words.resize(items.empty() ? 0 : 2 * items.size() - 1);
    const detail::Divider<Dimensions, S> divider(splitter, space, words);

    // Step 1: split level by level down to parts of a fixed size, whatever the number of threads.
    const std::size_t grain = std::max<std::size_t>(items.size() / 128, 4096);
    scratch.coarse.clear();
    scratch.fine.clear();
    const auto file = [&](const Part& part) {
        if (!part.range.items.empty())
            (part.range.items.size() > grain ? scratch.coarse : scratch.fine).push_back(part);
    };
    file({{items}});
    while (!scratch.coarse.empty()) {
        scratch.halves.resize(scratch.coarse.size());
        execute(scratch.coarse.size(), [&](std::size_t i) {
            const Part& part = scratch.coarse[i];
            scratch.halves[i] = divider.split(part.range, part.first_node, part.depth);
        });
        scratch.parents.swap(scratch.coarse);
        scratch.coarse.clear();
        for (std::size_t i = 0; i < scratch.parents.size(); ++i) {
            const Part& parent = scratch.parents[i];
            const Split<Dimensions>& halves = scratch.halves[i];
            file({halves.left, parent.first_node, parent.depth + 1});
            file({halves.right, divider.first_right(halves, parent.first_node), parent.depth + 1});
        }
    }
    // Step 2: each part is a task of its own.
    execute(scratch.fine.size(), [&](std::size_t i) {
        const Part& part = scratch.fine[i];
        divider.build(part.range, part.first_node, part.depth);
        progress(part.range.items.size());
    });
    tree = ClusterTree(std::move(words));
}

namespace detail {

template <class Item, class S, class E, class P>
ClusterTree divide(std::span<const Item> items, const S& splitter, const E& execute, P& progress) {
    using Built = decltype(build_item(items[0], 0, NormalizedSpace{}));
    check_items(items);
    const NormalizedSpace space = NormalizedSpace::of(items);
    const std::unique_ptr<Built[]> storage(new Built[items.size()]);  // not initialized
    for (std::size_t i = 0; i < items.size(); ++i) {
        storage[i] = build_item(items[i], static_cast<std::uint32_t>(i), space);
    }
    DivideScratch<HasAxis<Item> ? 6 : 3> scratch;
    ClusterTree tree;
    divide_into(std::span(storage.get(), items.size()), splitter, space, scratch, tree, execute, progress);
    return tree;
}

}  // namespace detail

/// Builds a tree of items without direction from the top down: `splitter` divides a set in two until single items
/// remain. The tree does not depend on the executor. Its depth is at most 3 log2 N + 20; for coincident items
/// ceil(log2 N). See `divide_into` for a build in storage that is kept.
/// throws: invalid_input naming the item: position not finite, weight not positive; or too many items; or as the
/// splitter's `check`. cost: O(N log N); temporary memory of 20 bytes an item besides the tree's 8 and the splitter's.
template <Splitter<3> S = Binned, Executor E = Sequential, Progress P = NoProgress>
ClusterTree divide(std::span<const PointItem> items, const S& splitter = {}, const E& execute = {}, P progress = {}) {
    return detail::divide(items, splitter, execute, progress);
}

/// Builds a tree of items with an axis from the top down: `splitter` divides a set in two until single items remain.
/// The tree does not depend on the executor. Its depth is at most 3 log2 N + 20; for coincident items ceil(log2 N).
/// See `divide_into` for a build in storage that is kept, or of six coordinates that are no unit axes.
/// throws: invalid_input naming the item: position not finite, weight not positive, axis not of unit length; or too
/// many items; or if the splitter's `direction_length` is negative or not finite, or as its `check`.
/// cost: O(N log N); temporary memory of 32 bytes an item besides the tree's 8 and the splitter's.
template <Splitter<6> S = Binned, Executor E = Sequential, Progress P = NoProgress>
ClusterTree divide(std::span<const OrientedItem> items, const S& splitter = {}, const E& execute = {},
                   P progress = {}) {
    return detail::divide(items, splitter, execute, progress);
}

}  // namespace lightcuts
