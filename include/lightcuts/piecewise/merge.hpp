#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "../core/invalid_input.hpp"
#include "piece.hpp"
#include "piecewise_constant.hpp"

namespace lightcuts {

namespace detail {

[[noreturn, gnu::noinline]] inline void refuse_merge(std::size_t a, std::size_t b) {
    LIGHTCUTS_THROW(invalid_input("merge: functions over " + std::to_string(a) + " and " + std::to_string(b) +
                                  " leaves; take functions on one tree"));
}

/// Number of leaves of the tree that a function is over.
template <PiecewiseFunction F>
std::uint32_t leaf_count_of(const F& f) {
    const std::span<const Piece> pieces = f.pieces();
    return pieces.empty() ? 0 : pieces.back().leaf_end();
}

/// The number of leaves that functions have in common. throws: invalid_input if they have different ones.
inline std::uint32_t common_leaf_count(std::initializer_list<std::uint32_t> leaf_counts) {
    const std::uint32_t first = *leaf_counts.begin();
    for (const std::uint32_t other : leaf_counts) {
        if (other != first) refuse_merge(first, other);
    }
    return first;
}

constexpr std::uint64_t smaller_key(std::uint64_t a, std::uint64_t b) { return a < b ? a : b; }

/// The leaf at which a function's last piece begins.
template <PiecewiseFunction F>
std::uint32_t last_begin(const F& f) {
    const std::span<const Piece> pieces = f.pieces();
    return pieces.size() > 1 ? pieces[pieces.size() - 2].leaf_end() : 0;
}

template <class Op, std::size_t... k, PiecewiseFunction... F>
[[gnu::always_inline]] inline void merge(Op& op, std::index_sequence<k...>, const F&... functions) {
    constexpr std::size_t count = sizeof...(F);
    const std::uint32_t leaf_count = common_leaf_count({leaf_count_of(functions)...});
    if (leaf_count == 0) return;
    const std::array<std::span<const Piece>, count> all{functions.pieces()...};
    const std::array<const Piece*, count> pieces{all[k].data()...};
    const std::tuple<decltype(functions.values())...> values(functions.values()...);

    // Every function's piece at the current leaf: they lie within each other, and that of the smallest key is the
    // innermost. All that end with it give way to their next. No branch depends on which these are: that would be
    // mispredicted half of the time.
    std::array<std::size_t, count> at{};
    std::array<std::uint64_t, count> key{pieces[k]->key()...};
    std::uint32_t first = 0;
    const auto visit = [&] {
        std::uint64_t innermost = key[0];
        ((innermost = smaller_key(key[k], innermost)), ...);
        const auto end = static_cast<std::uint32_t>(innermost >> 32);
        op(static_cast<std::uint32_t>(innermost), end - first, std::get<k>(values)[at[k]]...);
        first = end;
        return innermost | 0xffff'ffffu;  // keys up to this one end here
    };
    if constexpr (count <= 4) {
        // Few functions fit into registers with their next pieces, so that no step waits for memory. It has to end
        // where a function's last piece begins.
        std::uint32_t bound = leaf_count;
        ((bound = (std::min)(bound, last_begin(functions))), ...);
        if (bound > 0) {
            std::array<std::uint64_t, count> next{pieces[k][1].key()...};
            for (;;) {
                const std::uint64_t last = visit();
                ((at[k] += key[k] <= last ? 1u : 0u), ...);
                ((key[k] ^= (key[k] ^ next[k]) & (std::uint64_t{0} - (key[k] <= last ? 1u : 0u))), ...);
                if (first >= bound) break;
                ((next[k] = pieces[k][at[k] + 1].key()), ...);
            }
        }
    }
    while (first < leaf_count) {
        const std::uint64_t last = visit();
        if (first == leaf_count) return;
        ((at[k] += key[k] <= last ? 1u : 0u, key[k] = pieces[k][at[k]].key()), ...);
    }
}

}  // namespace detail

/// Calls `op(node, leaves, value of the first, value of the second, ...)` for each node of the union of the functions'
/// cuts that has none of it below: from left to right, the nodes of the coarsest cut on which all are constant
/// [Cut merging 2008, section 3.2]. `leaves`: the number of leaves below `node`. The functions may have different
/// types, and trees any number of children. Fold by what `op` captures, stream to where you like, or see `merged`.
/// pre: the functions are valid and of one tree. throws: invalid_input if they have different numbers of leaves.
/// cost: O(N) a call; at most one call a piece of all functions; allocates nothing.
template <class Op, PiecewiseFunction... F>
    requires(sizeof...(F) >= 1)
void merge(Op&& op, const F&... functions) {
    static_assert(
        requires(std::uint32_t n) { op(n, n, functions.values()[0]...); },
        "merge calls op(node, leaves, a value of each function): take two numbers and as many values as functions");
    detail::merge(op, std::index_sequence_for<F...>{}, functions...);
}

/// Storage of a merge of any number of functions; keep one a thread.
template <class V>
struct MergeScratch {
    std::vector<const Piece*> next;  ///< of each function, its piece at the current leaf
    std::vector<const V*> next_value;
    std::vector<std::uint64_t> keys;  ///< of these pieces
    std::vector<V> values;
};

/// As `merge` above, of any number of functions, all of one type: calls `op(node, leaves, values)`, the last a
/// `std::span` in the order of the functions.
/// pre: the functions are valid and of one tree. throws: invalid_input if there are none, or if they have different
/// numbers of leaves. cost: O(N) a call; allocates nothing once the scratch is warm.
template <PiecewiseFunction F, class Op>
    requires std::invocable<Op&, std::uint32_t, std::uint32_t, std::span<const piecewise_value_of<F>>> &&
        requires(const F& f) {
        { f.values().data() } -> std::convertible_to<const piecewise_value_of<F>*>;
        requires detail::LastingElements<decltype(f.values())>;
    }
void merge(std::span<const F> functions, MergeScratch<piecewise_value_of<F>>& scratch, Op&& op) {
    if (functions.empty()) LIGHTCUTS_THROW(invalid_input("merge: no functions; give one at least"));
    const std::uint32_t leaf_count = detail::leaf_count_of(functions[0]);
    scratch.next.clear();
    scratch.next_value.clear();
    scratch.keys.clear();
    scratch.values.clear();
    for (const F& f : functions) {
        if (detail::leaf_count_of(f) != leaf_count) detail::refuse_merge(leaf_count, detail::leaf_count_of(f));
        if (leaf_count == 0) continue;
        const std::span<const Piece> pieces = f.pieces();
        scratch.next.push_back(pieces.data());
        scratch.next_value.push_back(f.values().data());
        scratch.keys.push_back(pieces[0].key());
        scratch.values.push_back(f.values()[0]);
    }
    if (leaf_count == 0) return;
    std::uint32_t first = 0;
    for (;;) {
        std::uint64_t innermost = (std::numeric_limits<std::uint64_t>::max)();
        for (const std::uint64_t key : scratch.keys) innermost = detail::smaller_key(key, innermost);
        const auto end = static_cast<std::uint32_t>(innermost >> 32);
        op(static_cast<std::uint32_t>(innermost), end - first, std::span<const piecewise_value_of<F>>(scratch.values));
        if (end == leaf_count) return;
        for (std::size_t k = 0; k < functions.size(); ++k) {
            const std::size_t step = static_cast<std::uint32_t>(scratch.keys[k] >> 32) == end ? 1 : 0;
            scratch.next[k] += step;
            scratch.next_value[k] += step;
            scratch.keys[k] = scratch.next[k]->key();
            scratch.values[k] = *scratch.next_value[k];
        }
        first = end;
    }
}

/// Makes `out` the function f(values of the others), on the union of their cuts. It has no deviations.
/// pre: as `merge`; `out` is none of the functions. throws: as `merge`. cost: as `merge`; allocates nothing if `out`
/// has room.
template <class V, class Op, PiecewiseFunction... F>
    requires(sizeof...(F) >= 1)
void merged(PiecewiseConstant<V>& out, Op&& op, const F&... functions) {
    static_assert(std::invocable<Op&, const piecewise_value_of<F>&...>,
                  "merged calls op(a value of each function): take as many values as functions");
    detail::common_leaf_count({detail::leaf_count_of(functions)...});
    detail::Filling filling(out);
    std::uint32_t end = 0;
    merge(
        [&](std::uint32_t node, std::uint32_t leaves, const auto&... values) {
            end += leaves;
            out.append({node, end}, op(values...));
        },
        functions...);
    filling.finish();
}

}  // namespace lightcuts
