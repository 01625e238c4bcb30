#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "../core/invalid_input.hpp"
#include "../tree/cluster_tree.hpp"
#include "../tree/validate.hpp"
#include "bytes.hpp"

namespace lightcuts {

namespace detail {
inline constexpr char tree_magic[] = "LCUTTREE";
inline constexpr FileKind tree_kind{"tree file", tree_magic, 1};
/// For summaries, which are stored as they are in memory.
inline std::uint32_t native_order() {
    const std::byte mark[4] = {std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}};
    std::uint32_t order = 0;
    std::memcpy(&order, mark, sizeof order);
    return order;
}
}  // namespace detail

/// What is stored in a tree file without summaries.
struct NoSummary {};

/// A tree that was read from a file, and what its nodes know.
template <class T>
struct SavedTree {
    ClusterTree tree;
    std::vector<T> summaries;  ///< tree.size(), or none
};

/// The bytes of a tree file: a tree and of each node a summary, as `summarize` makes them: boxes, moments, your own.
/// They are stored as they are in memory, so that files with summaries are read on machines of the same byte order and
/// layout alone. `tag` says what they are, by a number of your own, so that others are not taken for them.
/// shapes: `summaries` has tree.size() entries. throws: invalid_input otherwise. cost: O(N).
template <class T>
    requires std::is_trivially_copyable_v<T> std::vector<std::byte> tree_file(const ClusterTree& tree,
                                                                              std::span<const T> summaries,
                                                                              std::uint64_t tag = 0) {
        if (summaries.size() != tree.size()) {
            LIGHTCUTS_THROW(invalid_input("tree file: " + std::to_string(tree.size()) + " nodes, but " +
                                          std::to_string(summaries.size()) + " summaries"));
        }
        const std::size_t record = std::is_same_v<T, NoSummary> ? 0 : sizeof(T);
        std::vector<std::byte> bytes(detail::file_header_size);
        bytes.reserve(bytes.size() + 48 + tree.size() * (4 + record));
        detail::ByteWriter out(bytes);
        out.put(static_cast<std::uint64_t>(tree.size()));
        out.put(static_cast<std::uint64_t>(tree.item_bound()));
        out.put(static_cast<std::uint64_t>(record));
        out.put(tag);
        out.put(detail::native_order());
        for (const std::uint32_t word : tree.words()) out.put(word);
        const auto raw = std::as_bytes(summaries);
        if (record > 0) bytes.insert(bytes.end(), raw.begin(), raw.end());
        detail::seal(bytes, bytes.size() - detail::file_header_size, detail::tree_kind);
        return bytes;
    }

/// The bytes of a tree file without summaries. cost: O(N).
inline std::vector<std::byte> tree_file(const ClusterTree& tree) {
    const std::vector<NoSummary> none(tree.size());
    return tree_file(tree, std::span<const NoSummary>(none));
}

/// Reads a tree file. The tree is valid, whatever the bytes were; what summaries say is not checked.
/// throws: invalid_input, one line, if the bytes are of another kind, version, size, byte order or tag, cut short or
/// damaged. cost: O(N).
template <class T = NoSummary>
    requires std::is_trivially_copyable_v<T> && std::default_initializable<T> SavedTree<T> read_tree(
        std::span<const std::byte> bytes, std::uint64_t tag = 0) {
        const std::size_t record = std::is_same_v<T, NoSummary> ? 0 : sizeof(T);
        detail::SealedReader in(bytes, detail::tree_kind);
        const auto nodes = in.number<std::uint64_t>();
        const auto item_bound = in.number<std::uint64_t>();
        const auto stored_record = in.number<std::uint64_t>();
        const auto stored_tag = in.number<std::uint64_t>();
        const auto order = in.number<std::uint32_t>();
        if (nodes >= 2 * ClusterTree::max_items || item_bound > ClusterTree::max_items || stored_record > (1u << 20)) {
            in.refuse("is damaged: its numbers are too large");
        }
        const std::uint64_t payload = nodes * (4 + stored_record);  // below 2^52
        if (in.left() != payload) {
            in.refuse(in.left() < payload
                          ? "is cut short: " + std::to_string(payload - in.left()) + " bytes are missing"
                          : "has " + std::to_string(in.left() - payload) + " bytes too many");
        }
        in.check(bytes.size() - detail::file_header_size);
        if (stored_record != record || stored_tag != tag) {
            in.refuse("has summaries of " + std::to_string(stored_record) + " bytes and tag " +
                      std::to_string(stored_tag) + ", not of " + std::to_string(record) + " and " +
                      std::to_string(tag));
        }
        if (record > 0 && order != detail::native_order()) {
            in.refuse("has summaries of a machine of another byte order; write it anew");
        }
        std::vector<std::uint32_t> words(static_cast<std::size_t>(nodes));
        const std::span<const std::byte> stored = in.take(4 * words.size());
        for (std::size_t i = 0; i < words.size(); ++i) words[i] = detail::load<std::uint32_t>(stored.data() + 4 * i);
        SavedTree<T> result{ClusterTree(std::move(words), static_cast<std::size_t>(item_bound)), {}};
        validate(result.tree);
        if (record > 0) {
            result.summaries.resize(result.tree.size());
            const std::span<const std::byte> raw = in.take(record * result.tree.size());
            if (!raw.empty()) std::memcpy(static_cast<void*>(result.summaries.data()), raw.data(), raw.size());
        }
        return result;
    }

}  // namespace lightcuts
