#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "../core/invalid_input.hpp"
#include "../core/rounding.hpp"
#include "merge.hpp"
#include "moments.hpp"
#include "piecewise_constant.hpp"

namespace lightcuts {

/// A sum over leaves, and by how much it may be off: not an estimate of that, but an upper bound in the face of all
/// rounding.
struct BoundedSum {
    double value = 0.0;
    double error_bound = 0.0;
};

/// A function whose mean at every node of the tree is at hand: it is looked up at the nodes of a merge and exact there,
/// with a smaller error than any cut of it. One channel. Refers to the moments.
template <int Channels>
class WholeTree {
public:
    explicit WholeTree(const std::vector<Moments<Channels>>& moments, int channel = 0)
        : moments_(&moments), channel_(channel) {}
    WholeTree(std::vector<Moments<Channels>>&&, int = 0) = delete;

    /// Number of leaves of the tree.
    std::uint32_t leaf_count() const {
        return moments_->empty() ? 0 : static_cast<std::uint32_t>(moments_->back().leaves);
    }
    double mean(std::uint32_t node) const { return (*moments_)[node].mean[static_cast<std::size_t>(channel_)]; }
    Deviation deviation(std::uint32_t node) const { return (*moments_)[node].deviation_from(mean(node), channel_); }

private:
    const std::vector<Moments<Channels>>* moments_;
    int channel_;
};

namespace detail {

/// The product of bounds, where 0 x infinity = 0, and which is zero only if one of them is: what underflows is less
/// than the floor.
constexpr double product_floor = 0x1p-960;
inline double times(double a, double b) { return a == 0.0 || b == 0.0 ? 0.0 : larger(a * b, product_floor); }
inline double times(double a, double b, double c) {
    if (a == 0.0 || b == 0.0 || c == 0.0) return 0.0;
    // The least by the largest first: where that underflows, the third is too small to bring it back above the floor.
    if (a < b) std::swap(a, b);
    if (b < c) std::swap(b, c);
    if (a < b) std::swap(a, b);
    return larger(a * c * b, product_floor);
}

/// What is known of a function f over neighboring leaves from the pieces that stand for it there.
class Spread {
public:
    /// A piece of value v. `deviation`: of f from v.
    void add(double leaves, double v, const Deviation& deviation) {
        if (pieces_ == 0.0) {
            shift_ = v;
            first_norm_ = static_cast<double>(deviation.norm);
        }
        const double d = v - shift_, offset = static_cast<double>(deviation.offset);
        pieces_ += 1.0;
        leaves_ += leaves;
        differs_ |= d != 0.0;
        first_ += leaves * d;
        second_ += leaves * d * d;
        within_ += static_cast<double>(deviation.norm) * static_cast<double>(deviation.norm);
        offsets_ += leaves * offset;
        squared_offsets_ += leaves * offset * offset;
        if (std::abs(v) > largest_) largest_ = std::abs(v);
    }
    void clear() { *this = {}; }

    double pieces() const { return pieces_; }
    /// A constant near the mean of the pieces' values.
    double center() const { return pieces_ > 1.0 ? shift_ + first_ / leaves_ : shift_; }
    /// At least sqrt(sum over the leaves of (f - center)^2).
    double norm() const {
        if (pieces_ == 1.0) return first_norm_;
        const double inflation = sum_inflation(4.0 * pieces_);
        // Of the pieces' values. d and the sums are rounded, by amounts that are small beside `second_` and the values.
        const double slack = 4.0 * unit_roundoff * largest_;
        double between = second_ - first_ / leaves_ * first_;
        if (!std::isfinite(between)) between = second_;
        between = (std::max)(0.0, between) + (inflation - 1.0) * 4.0 * second_;
        // Squares of small differences vanish.
        const double vanished = differs_ ? 0x1p-500 : 0.0;
        const double root = (std::sqrt(between) + (slack + vanished) * std::sqrt(leaves_)) * inflation;
        // What is left within a piece has a mean that only rounding keeps from zero.
        return std::sqrt((within_ + root * root + 2.0 * root * std::sqrt(squared_offsets_)) * inflation) * inflation;
    }
    /// At least |sum over the leaves of (f - value of the piece)|.
    double offset() const { return offsets_ * sum_inflation(4.0 * pieces_); }

private:
    double pieces_ = 0.0, leaves_ = 0.0, shift_ = 0.0, first_norm_ = 0.0, largest_ = 0.0;
    double first_ = 0.0, second_ = 0.0;  ///< sums over the leaves of v - shift, and of its square
    double within_ = 0.0;                ///< sum of the squared deviations
    double offsets_ = 0.0, squared_offsets_ = 0.0;
    bool differs_ = false;  ///< the values, from each other
};

/// The sum of products over leaves where at least one of two factors is constant on each run of leaves that `close`
/// ends [Cut merging 2008, Eq. 7-8, corrected]. On such a run K, with f = F + r, where F is what the pieces say,
///   sum fg - FG = sum_K r_f (g - c) + c sum_K r_f + F_K sum_K r_g, so |error| <= S_f(K) S_g(K) + offsets.
/// S_g(K) is about the mean over K of the *pieces* of g: about their own means it would be too small, since what was
/// multiplied is the value of a piece that reaches beyond the product's nodes.
class PairError {
public:
    Spread f, g;

    /// Ends a run; returns the bound of its error.
    double close() {
        const double bound = times(f.norm(), g.norm()) + times(std::abs(f.center()), g.offset()) +
                             times(std::abs(g.center()), f.offset());
        f.clear();
        g.clear();
        return bound * (1.0 + 16.0 * unit_roundoff);
    }
};

/// Where one function stands in a merge that bounds errors.
template <DeviatingFunction F>
class FactorCursor {
public:
    explicit FactorCursor(const F& f) : pieces_(f.pieces()), f_(f) {
        if (!f.has_deviations()) {
            LIGHTCUTS_THROW(invalid_input("bounded_product: a function has no deviations; approximate it with them"));
        }
    }
    std::uint64_t key() const { return pieces_[at_].key(); }
    /// The value on `node`, the innermost of all.
    double value(std::uint32_t) const { return static_cast<double>(f_.values()[at_]); }
    Deviation deviation(std::uint32_t) const { return f_.deviation(at_); }
    double leaves(std::uint32_t) const {
        return pieces_[at_].leaf_end() - (at_ == 0 ? 0 : pieces_[at_ - 1].leaf_end());
    }
    /// Where the current piece ends.
    std::uint32_t end() const { return pieces_[at_].leaf_end(); }
    bool ends_at(std::uint32_t leaf) const { return end() == leaf; }
    void advance() {
        if (at_ + 1 < pieces_.size()) ++at_;
    }

private:
    std::span<const Piece> pieces_;
    const F& f_;
    std::size_t at_ = 0;
};

/// A whole tree is a function with a piece for each node of the merge.
template <int Channels>
class TreeCursor {
public:
    explicit TreeCursor(const WholeTree<Channels>& f) : f_(f) {}
    std::uint64_t key() const { return (std::numeric_limits<std::uint64_t>::max)(); }
    double value(std::uint32_t node) const { return f_.mean(node); }
    Deviation deviation(std::uint32_t node) const { return f_.deviation(node); }
    double leaves(std::uint32_t merged_leaves) const { return merged_leaves; }
    /// Before any other: never the coarsest.
    std::uint32_t end() const { return 0; }
    bool ends_at(std::uint32_t) const { return true; }
    void advance() {}

private:
    const WholeTree<Channels>& f_;
};

template <DeviatingFunction F>
FactorCursor<F> cursor_of(const F& f) {
    return FactorCursor<F>(f);
}
template <int Channels>
TreeCursor<Channels> cursor_of(const WholeTree<Channels>& f) {
    return TreeCursor<Channels>(f);
}

/// Sums up products and the rounding of doing so.
class ProductSum {
public:
    /// leaves x a x b.
    void add(double leaves, double a, double b) { add_term(a != 0.0 && b != 0.0, leaves * a * b); }
    /// leaves x v x a x b, |v| <= 1: last, so that it makes nothing of what underflowed before.
    void add(double leaves, double v, double a, double b) {
        add_term(v != 0.0 && a != 0.0 && b != 0.0, a * b * v * leaves);
    }
    void add_error(double bound) { error_ += bound; }
    BoundedSum result() const {
        // Each term has up to three products.
        const double rounding = magnitude_ * 2.0 * (terms_ + 8.0) * unit_roundoff;
        // What underflows is less than the least number, times the leaves, each.
        const double underflow = may_underflow_ ? terms_ * 0x1p-1000 : 0.0;
        return {sum_, error_ * sum_inflation(terms_) + rounding + underflow};
    }

private:
    void add_term(bool is_something, double term) {
        sum_ += term;
        magnitude_ += std::abs(term);
        terms_ += 1.0;
        may_underflow_ |= is_something;
    }

    double sum_ = 0.0, magnitude_ = 0.0, error_ = 0.0, terms_ = 0.0;
    bool may_underflow_ = false;
};

template <class F>
inline constexpr bool is_whole_tree = false;
template <int Channels>
inline constexpr bool is_whole_tree<WholeTree<Channels>> = true;

template <int Channels>
std::uint32_t leaf_count_of(const WholeTree<Channels>& f) {
    return f.leaf_count();
}

}  // namespace detail

/// A factor of a product whose error is bounded: a function with deviations, or a whole tree of means.
template <class F>
concept BoundedFactor = DeviatingFunction<F> || detail::is_whole_tree<F>;

namespace detail {

/// Says what is missing of the factors of a product.
template <class First, class... Other>
constexpr void require_bounded() {
    static_assert(
        DeviatingFunction<First> && (BoundedFactor<Other> && ...),
        "bounded_product takes functions with scalar values and deviations, and a WholeTree in all places but the "
        "first; of several channels take a PiecewiseChannel each");
}

}  // namespace detail

/// The sum over the leaves of f g and a bound of its error, in one pass over the cut of `f` and of `g`, or a whole
/// tree.
///
/// On each maximal node K of the coarser of the two cuts |error| <= S_f(K) S_g(K), where S_f(K)^2 is the sum over the
/// leaves of (f - mean over K)^2. That of the finer function comes from its own pieces m in K:
/// S_g(K)^2 <= sum of S_g(m)^2 + |m| (g_m - mean over K)^2. [Cut merging 2008, Eq. 8] has the deviations over the
/// nodes of the union instead, which is no bound where the value of a function comes from a node above. With a whole
/// tree every node of the other's cut is such a K, and its own deviation is exact.
/// pre: functions of one tree. throws: invalid_input if they have different numbers of leaves, or one has no
/// deviations. cost: O(pieces); allocates nothing.
template <class F, class G>
BoundedSum bounded_product(const F& f, const G& g) {
    detail::require_bounded<F, G>();
    const std::uint32_t leaf_count = detail::common_leaf_count({detail::leaf_count_of(f), detail::leaf_count_of(g)});
    if (leaf_count == 0) return {};
    detail::ProductSum sum;
    auto a = detail::cursor_of(f);
    auto b = detail::cursor_of(g);
    detail::PairError pair;
    std::uint32_t first = 0;
    while (first < leaf_count) {
        const std::uint64_t key = detail::smaller_key(a.key(), b.key());
        const auto node = static_cast<std::uint32_t>(key), end = static_cast<std::uint32_t>(key >> 32);
        const std::uint32_t leaves = end - first;
        sum.add(leaves, a.value(node), b.value(node));
        const bool a_ends = a.ends_at(end), b_ends = b.ends_at(end);
        if (a_ends) {
            pair.f.add(a.leaves(leaves), a.value(node), a.deviation(node));
            a.advance();
        }
        if (b_ends) {
            pair.g.add(b.leaves(leaves), b.value(node), b.deviation(node));
            b.advance();
        }
        if (a_ends && b_ends) sum.add_error(pair.close());
        first = end;
    }
    return sum.result();
}

/// The sum over the leaves of v f g and a bound of its error, in one pass: v is in [0, 1], as a visibility is; f and g
/// may be anything.
///
/// On each maximal node K of the coarsest cut, with x, y, z the means of v, f, g over it and e_fg the bound of the two
/// factors f g there, from its own maximal nodes: where v is constant on K,
///   |error| <= |x| e_fg + |y| S_v S_g + |z| S_v S_f + min(max(x, 1 - x), S_v) S_f S_g;
/// where f is, with w = min(1, x + min(max(x, 1 - x), S_v)) >= |v|,
///   |error| <= w S_f S_g + |z| S_v S_f + |y| e_vg, and likewise where g is.
/// The last term of the first line stands for the third moment, which [Cut merging 2008, Eq. 9] leaves out.
/// pre: functions of one tree, 0 <= v <= 1. throws: as of two. cost: O(pieces); allocates nothing.
template <class V, class F, class G>
BoundedSum bounded_product(const V& v, const F& f, const G& g) {
    detail::require_bounded<V, F, G>();
    const std::uint32_t leaf_count = detail::common_leaf_count(
        {detail::leaf_count_of(v), detail::leaf_count_of(f), detail::leaf_count_of(g)});
    if (leaf_count == 0) return {};
    detail::ProductSum sum;
    auto a = detail::cursor_of(v);
    auto b = detail::cursor_of(f);
    auto c = detail::cursor_of(g);
    // Over the current node of the coarsest cut: which that is, the three functions there, and the other two together.
    enum class Coarsest { visibility, second, third };
    const auto find_coarsest = [&] {
        if (a.end() >= b.end() && a.end() >= c.end()) return Coarsest::visibility;
        return b.end() >= c.end() ? Coarsest::second : Coarsest::third;
    };
    Coarsest coarsest = find_coarsest();
    detail::Spread of_v, of_f, of_g;
    detail::PairError others;
    double others_error = 0.0;
    const auto close = [&] {
        using detail::times;
        const double mean = of_v.center();
        const double x = std::abs(mean), y = std::abs(of_f.center()), z = std::abs(of_g.center());
        const double s_v = of_v.norm(), s_f = of_f.norm(), s_g = of_g.norm();
        const double away = (std::min)((std::max)(x, std::abs(1.0 - mean)) * (1.0 + 8.0 * unit_roundoff),
                                       s_v);               // >= |v - x|
        const double largest = (std::min)(1.0, x + away);  // >= |v|
        double bound = 0.0;
        switch (coarsest) {
            case Coarsest::visibility:
                bound = times(x, others_error) + times(y, s_v, s_g) + times(z, s_v, s_f) + times(away, s_f, s_g);
                break;
            case Coarsest::second:
                bound = times(largest, s_f, s_g) + times(z, s_v, s_f) + times(y, others_error);
                break;
            case Coarsest::third: bound = times(largest, s_f, s_g) + times(y, s_v, s_g) + times(z, others_error); break;
        }
        bound += 2.0 * (times(y, z, of_v.offset()) + times(x, z, of_f.offset()) + times(x, y, of_g.offset()));
        sum.add_error(bound * (1.0 + 64.0 * unit_roundoff));
        of_v.clear();
        of_f.clear();
        of_g.clear();
        others_error = 0.0;
    };
    std::uint32_t first = 0;
    while (first < leaf_count) {
        const std::uint64_t key = detail::smaller_key(a.key(), detail::smaller_key(b.key(), c.key()));
        const auto node = static_cast<std::uint32_t>(key), end = static_cast<std::uint32_t>(key >> 32);
        const std::uint32_t leaves = end - first;
        sum.add(leaves, a.value(node), b.value(node), c.value(node));
        const bool a_ends = a.ends_at(end), b_ends = b.ends_at(end), c_ends = c.ends_at(end);
        const auto pass = [&](auto& cursor, detail::Spread& own, detail::Spread* among_others) {
            const double value = cursor.value(node), n = cursor.leaves(leaves);
            const Deviation deviation = cursor.deviation(node);
            own.add(n, value, deviation);
            if (among_others != nullptr) among_others->add(n, value, deviation);
            cursor.advance();
        };
        // The first and the second of the other two.
        if (a_ends) pass(a, of_v, coarsest == Coarsest::visibility ? nullptr : &others.f);
        if (b_ends) {
            pass(b, of_f,
                 coarsest == Coarsest::second       ? nullptr
                 : coarsest == Coarsest::visibility ? &others.f
                                                    : &others.g);
        }
        if (c_ends) pass(c, of_g, coarsest == Coarsest::third ? nullptr : &others.g);
        const bool others_end = (a_ends || coarsest == Coarsest::visibility) &&
                                (b_ends || coarsest == Coarsest::second) && (c_ends || coarsest == Coarsest::third);
        if (others_end) others_error = (others_error + others.close()) * (1.0 + 2.0 * unit_roundoff);
        if (a_ends && b_ends && c_ends) {
            close();
            coarsest = find_coarsest();
        }
        first = end;
    }
    return sum.result();
}

}  // namespace lightcuts
