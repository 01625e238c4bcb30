#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "../core/assertion.hpp"
#include "../core/invalid_input.hpp"
#include "../tree/cluster_tree.hpp"
#include "bytes.hpp"
#include "compact.hpp"
#include "piecewise_constant.hpp"

namespace lightcuts {

namespace detail {
inline constexpr char cut_magic[] = "LCUTCUTS";
inline constexpr FileKind cut_kind{"cut file", cut_magic, 1};
/// Fingerprint, nodes, count, bits, deviations.
inline constexpr std::size_t cut_index_size = 8 + 8 + 8 + 4 + 4;
}  // namespace detail

/// Collects cuts of one tree, thousands if need be, and makes them one file. Refers to no tree.
class CutFileWriter {
public:
    /// cost: O(N), the tree's fingerprint.
    explicit CutFileWriter(const ClusterTree& tree, const CutEncoding& encoding = {})
        : fingerprint_(fingerprint(tree)), nodes_(tree.size()), encoding_(encoding) {}

    const CutEncoding& encoding() const { return encoding_; }
    std::size_t size() const { return ends_.size(); }

    /// Appends a cut. pre: a valid one of the tree. throws: invalid_input as `encode`; then nothing was appended.
    void append(const PiecewiseConstant<float>& f) {
        encode(f, encoding_, records_);
        ends_.push_back(records_.size());
    }
    /// Appends a cut that `encode` made in this encoding, on another thread perhaps.
    void append_encoded(std::span<const std::byte> cut) {
        records_.insert(records_.end(), cut.begin(), cut.end());
        ends_.push_back(records_.size());
    }

    /// The file; see `write_bytes`. cost: one copy.
    std::vector<std::byte> bytes() const {
        std::vector<std::byte> file(detail::file_header_size);
        detail::ByteWriter out(file);
        out.put(fingerprint_);
        out.put(nodes_);
        out.put(static_cast<std::uint64_t>(ends_.size()));
        out.put(static_cast<std::uint32_t>(encoding_.bits));
        out.put(std::uint32_t{encoding_.deviations ? 1u : 0u});
        for (const std::uint64_t end : ends_) out.put(end);
        const std::size_t checked = file.size() - detail::file_header_size;
        file.insert(file.end(), records_.begin(), records_.end());
        detail::seal(file, checked, detail::cut_kind);
        return file;
    }

private:
    std::uint64_t fingerprint_;
    std::uint64_t nodes_;
    CutEncoding encoding_;
    std::vector<std::byte> records_;
    std::vector<std::uint64_t> ends_;  ///< of each cut in `records_`
};

/// Thousands of cuts of one tree in the bytes of a file, which may be mapped: nothing is copied, and cuts that are not
/// read are not touched. Refers to the bytes and to the tree. threads: `read` may be called by many at once.
class CutFile {
public:
    /// throws: invalid_input, one line, if the bytes are of another kind, version, byte order or tree, cut short or
    /// damaged in front of the cuts. cost: O(N + cuts).
    CutFile(std::span<const std::byte> bytes, const ClusterTree& tree) : tree_(&tree) {
        detail::SealedReader in(bytes, detail::cut_kind);
        const auto stored_fingerprint = in.number<std::uint64_t>();
        const auto nodes = in.number<std::uint64_t>();
        const auto count = in.number<std::uint64_t>();
        const auto bits = in.number<std::uint32_t>();
        const auto deviations = in.number<std::uint32_t>();
        if (count > in.left() / 8) in.refuse("is cut short, or damaged: it has no room for the cuts that it counts");
        const auto index_size = static_cast<std::size_t>(8 * count);
        in.check(detail::cut_index_size + index_size);
        if ((bits != 8 && bits != 16 && bits != 32) || deviations > 1) in.refuse("has an encoding that there is not");
        if (nodes != tree.size() || stored_fingerprint != fingerprint(tree)) {
            in.refuse("is of another tree, of " + std::to_string(nodes) + " nodes; this one has " +
                      std::to_string(tree.size()));
        }
        encoding_ = {static_cast<ValueBits>(bits), deviations == 1};
        ends_ = in.take(index_size);
        records_ = in.take(in.left());
        std::uint64_t last = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (end(i) < last) in.refuse("is damaged: cut " + std::to_string(i) + " ends before it begins");
            last = end(i);
        }
        if (last != records_.size()) {
            in.refuse(last > records_.size()
                          ? "is cut short: " + std::to_string(last - records_.size()) + " bytes are missing"
                          : "has " + std::to_string(records_.size() - last) + " bytes too many");
        }
    }

    CutFile(std::span<const std::byte>, ClusterTree&&) = delete;

    std::size_t size() const { return ends_.size() / 8; }
    const CutEncoding& encoding() const { return encoding_; }

    /// Makes `out` cut i. pre: i < size(). throws: invalid_input, one line naming the cut, if it is damaged.
    /// cost: O(its size), in trees that are not binary O(N); allocates nothing if `out` has room.
    void read(std::size_t i, PiecewiseConstant<float>& out) const {
        LIGHTCUTS_ASSERT(i < size());
        const auto begin = static_cast<std::size_t>(i == 0 ? 0 : end(i - 1));
        decode(records_.subspan(begin, static_cast<std::size_t>(end(i)) - begin), encoding_, *tree_, out, i);
    }

private:
    std::uint64_t end(std::size_t i) const { return detail::load<std::uint64_t>(ends_.data() + 8 * i); }

    const ClusterTree* tree_;
    CutEncoding encoding_;
    std::span<const std::byte> ends_;
    std::span<const std::byte> records_;
};

}  // namespace lightcuts
