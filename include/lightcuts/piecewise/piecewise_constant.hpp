#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "../core/assertion.hpp"
#include "../core/invalid_input.hpp"
#include "../tree/cluster_tree.hpp"
#include "deviation.hpp"
#include "piece.hpp"
#include "value.hpp"

namespace lightcuts {

namespace detail {

/// The elements of what a function returns so are there still when it is gone.
template <class R>
concept LastingElements = std::is_lvalue_reference_v<R> || std::ranges::borrowed_range<R>;

}  // namespace detail

/// A function over the leaves of a tree that is constant below each node of a cut, which is a set of nodes such that
/// every leaf has exactly one of them above it [Cut merging 2008, section 3.2].
///
/// - `pieces()`: the nodes of the cut in ascending order, as a contiguous range that the function holds: a reference to
///   one, or a borrowed one, as a span is.
/// - `values()`: what can be indexed by a piece's place in that order and gives the value there.
template <class F>
concept PiecewiseFunction = requires(const F& f, std::size_t i) {
    { f.pieces() } -> std::convertible_to<std::span<const Piece>>;
    requires detail::LastingElements<decltype(f.pieces())>;
    f.values()[i];
};

namespace detail {

/// Says what is missing where a call takes anything.
template <class... F>
constexpr void require_functions() {
    static_assert((PiecewiseFunction<F> && ...),
                  "a function on a tree needs pieces() const, a contiguous range of Piece that it holds, and values() "
                  "const, which can be indexed by a piece's place");
}

}  // namespace detail

/// The type of a function's values.
template <PiecewiseFunction F>
using piecewise_value_of = std::remove_cvref_t<decltype(std::declval<const F&>().values()[0])>;

/// A function with scalar values that are means of another, and what is known of how far that is from them:
/// `deviation(i)` of piece i, if `has_deviations()`.
template <class F>
concept DeviatingFunction = PiecewiseFunction<F> && std::floating_point<piecewise_value_of<F>> &&
    requires(const F& f, std::size_t i) {
    { f.has_deviations() } -> std::convertible_to<bool>;
    { f.deviation(i) } -> std::same_as<Deviation>;
};

/// A piecewise-constant function that owns its storage: 8 bytes and a value a piece, and 8 bytes a channel more where
/// deviations are kept. Fill it by an approximation, by a merge, from a file, or by `append`. What fills one anew and
/// throws leaves it empty, or as it was: never half of it.
/// The tree is not referred to: `validate` checks that a function is one over a given tree.
template <class V>
class PiecewiseConstant {
public:
    using value_type = V;

    static constexpr int channels = [] {
        if constexpr (PiecewiseValue<V>) return channels_of<V>;
        return 1;
    }();

    /// Removes all pieces; storage stays.
    void clear() {
        pieces_.clear();
        values_.clear();
        deviations_.clear();
    }
    void reserve(std::size_t pieces) {
        pieces_.reserve(pieces);
        values_.reserve(pieces);
    }
    /// Appends a piece. pre: it follows the one before, see `Piece`; or precedes it, and `reverse` follows.
    void append(const Piece& piece, const V& value) {
        pieces_.push_back(piece);
        values_.push_back(value);
    }
    /// Turns the order of the pieces about. pre: no deviations yet.
    void reverse() {
        LIGHTCUTS_ASSERT(deviations_.empty());
        std::reverse(pieces_.begin(), pieces_.end());
        std::reverse(values_.begin(), values_.end());
    }
    /// Appends the deviation of the next channel: of the first piece channel by channel, then of the second.
    void append_deviation(const Deviation& deviation) { deviations_.push_back(deviation); }

    std::size_t size() const { return pieces_.size(); }
    bool empty() const { return pieces_.empty(); }
    /// Number of leaves of the tree.
    std::uint32_t leaf_count() const { return pieces_.empty() ? 0 : pieces_.back().leaf_end(); }
    std::span<const Piece> pieces() const { return pieces_; }
    std::span<const V> values() const { return values_; }
    std::span<V> values() { return values_; }

    bool has_deviations() const { return !pieces_.empty() && deviations_.size() == pieces_.size() * channel_count; }
    /// pre: has_deviations(), i < size().
    Deviation deviation(std::size_t i, int channel = 0) const {
        LIGHTCUTS_ASSERT(has_deviations());
        return deviations_[i * channel_count + static_cast<std::size_t>(channel)];
    }
    void clear_deviations() { deviations_.clear(); }

    /// Number of leaves below piece i.
    std::uint32_t leaves(std::size_t i) const {
        return pieces_[i].leaf_end() - (i == 0 ? 0 : pieces_[i - 1].leaf_end());
    }
    std::size_t memory_bytes() const {
        return pieces_.capacity() * sizeof(Piece) + values_.capacity() * sizeof(V) +
               deviations_.capacity() * sizeof(Deviation);
    }

private:
    static constexpr auto channel_count = static_cast<std::size_t>(channels);

    std::vector<Piece> pieces_;
    std::vector<V> values_;
    std::vector<Deviation> deviations_;  ///< none, or one a channel of each piece
};

/// One channel of a function of several, which is itself one with scalar values and deviations. Refers to it.
template <PiecewiseValue V>
class PiecewiseChannel {
public:
    /// pre: 0 <= channel < channels_of<V>.
    PiecewiseChannel(const PiecewiseConstant<V>& function, int channel) : values_{&function, channel} {}
    PiecewiseChannel(PiecewiseConstant<V>&&, int) = delete;

    std::span<const Piece> pieces() const { return values_.function->pieces(); }
    auto values() const { return values_; }
    bool has_deviations() const { return values_.function->has_deviations(); }
    Deviation deviation(std::size_t i) const { return values_.function->deviation(i, values_.channel); }

private:
    struct Values {
        const PiecewiseConstant<V>* function;
        int channel;
        double operator[](std::size_t i) const { return value_channel(function->values()[i], channel); }
    };
    Values values_;
};

namespace detail {

inline constexpr std::size_t no_cut_index = static_cast<std::size_t>(-1);

/// `cut`: which one of a file.
[[noreturn]] inline void refuse_piece(std::size_t i, std::uint32_t node, const std::string& what,
                                      std::size_t cut = no_cut_index) {
    LIGHTCUTS_THROW(invalid_input("cut" + (cut == no_cut_index ? std::string() : " " + std::to_string(cut)) +
                                  ", piece " + std::to_string(i) + ", node " + std::to_string(node) + ": " + what));
}

/// Counts leaves of a tree along a cut.
class CutWalk {
public:
    explicit CutWalk(const ClusterTree& tree, std::size_t cut = no_cut_index) : tree_(tree), cut_(cut) {}

    /// The piece of `node`, the next one of the cut.
    /// throws: invalid_input if no cut goes on so. cost: O(1), in trees that are not binary O(nodes passed).
    Piece next(std::size_t i, std::uint32_t node) {
        if (node >= tree_.size()) {
            refuse(i, node, "the tree has only " + std::to_string(tree_.size()) + " nodes; a cut of another");
        }
        if (i > 0 && node <= last_) refuse(i, node, "nodes of a cut have to ascend; sort them");
        const std::uint32_t first = tree_.left_leaf(node);
        if (i > 0 && first <= last_) refuse(i, node, "is above the piece before; take one of the two");
        // Between a complete subtree and the next leaf there are but nodes above it.
        for (std::uint32_t n = i > 0 ? last_ + 1 : 0; n < first; ++n) {
            if (tree_.is_leaf(n)) refuse(i, node, "leaves out leaf node " + std::to_string(n));
        }
        last_ = node;
        leaf_end_ += static_cast<std::uint32_t>(tree_.leaf_count(node));
        return {node, leaf_end_};
    }
    /// throws: invalid_input if leaves are left. `pieces`: their number.
    void finish(std::size_t pieces) const {
        if (leaf_end_ != tree_.item_count()) {
            LIGHTCUTS_THROW(invalid_input(
                "cut" + (cut_ == no_cut_index ? std::string() : " " + std::to_string(cut_)) + " of " +
                std::to_string(pieces) + " pieces: covers " + std::to_string(leaf_end_) + " of the tree's " +
                std::to_string(tree_.item_count()) + " leaves; it is cut short, or another's"));
        }
    }

private:
    [[noreturn]] void refuse(std::size_t i, std::uint32_t node, const std::string& what) const {
        refuse_piece(i, node, what, cut_);
    }

    const ClusterTree& tree_;
    std::size_t cut_;
    std::uint32_t last_ = 0;
    std::uint32_t leaf_end_ = 0;
};

/// Clears a function that is to be filled, and once more unless it was.
template <class V>
class Filling {
public:
    explicit Filling(PiecewiseConstant<V>& out) : out_(&out) { out.clear(); }
    Filling(const Filling&) = delete;
    Filling& operator=(const Filling&) = delete;
    ~Filling() {
        if (out_ != nullptr) out_->clear();
    }
    void finish() { out_ = nullptr; }

private:
    PiecewiseConstant<V>* out_;
};

template <class V>
void check_finite(std::size_t i, const Piece& piece, const V& value) {
    if constexpr (PiecewiseValue<V>) {
        for (int c = 0; c < channels_of<V>; ++c) {
            if (!std::isfinite(value_channel(value, c))) refuse_piece(i, piece.node(), "the value is not finite");
        }
    }
}

}  // namespace detail

/// Checks that `f` is a function over the leaves of `tree`: its nodes ascend, every leaf has exactly one of them above
/// it, pieces count their leaves rightly, values are finite. pre: `tree` is valid.
/// throws: invalid_input naming the first piece that is wrong. cost: O(size), in trees that are not binary O(N).
template <PiecewiseFunction F>
void validate(const ClusterTree& tree, const F& f) {
    const std::span<const Piece> pieces = f.pieces();
    detail::CutWalk walk(tree);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece expected = walk.next(i, pieces[i].node());
        if (pieces[i] != expected) {
            detail::refuse_piece(i, pieces[i].node(),
                                 "is said to end at leaf " + std::to_string(pieces[i].leaf_end()) + ", not " +
                                     std::to_string(expected.leaf_end()) + "; a cut of another tree");
        }
        detail::check_finite(i, pieces[i], f.values()[i]);
    }
    walk.finish(pieces.size());
}

/// Makes `out` the function that has `values[i]` below `nodes[i]`.
/// throws: invalid_input naming the first piece that is wrong: a node of another tree, not in ascending order, above
/// another or with leaves left out before it; a value that is not finite; or if the lists differ in length.
/// cost: as `validate`.
template <class V>
void assign(const ClusterTree& tree, std::span<const std::uint32_t> nodes, std::span<const V> values,
            PiecewiseConstant<V>& out) {
    if (nodes.size() != values.size()) {
        LIGHTCUTS_THROW(invalid_input("cut: " + std::to_string(nodes.size()) + " nodes, but " +
                                      std::to_string(values.size()) + " values"));
    }
    detail::Filling filling(out);
    detail::CutWalk walk(tree);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Piece piece = walk.next(i, nodes[i]);
        detail::check_finite(i, piece, values[i]);
        out.append(piece, values[i]);
    }
    walk.finish(nodes.size());
    filling.finish();
}

}  // namespace lightcuts
