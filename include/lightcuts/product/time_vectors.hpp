#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "../core/assertion.hpp"
#include "../core/invalid_input.hpp"
#include "../core/spectrum.hpp"
#include "../tree/cluster_tree.hpp"

namespace lightcuts {

/// What each node of a binary tree amounts to at each of T instants, of leaves that exist at one instant each: the sum
/// over the leaves below [Multidimensional Lightcuts 2006, section 3.2]. Only instants at which a node has something
/// are stored: a node of few leaves has a sparse vector, one of very many a dense one. memory: 2 bytes and a spectrum
/// for each instant of a node; N leaves at random instants have less than N (2 + log2(min(N, T))) of them.
template <Spectrum S>
class TimeVectors {
public:
    using node_index = ClusterTree::node_index;

    static constexpr std::uint32_t max_instants = 1u << 16;

    /// Builds the vectors anew, in the storage of those before. `instant_of(item)`: the instant of a leaf's item;
    /// `value_of(item)`: what it amounts to, a spectrum. pre: the tree is binary.
    /// throws: invalid_input naming the item whose instant is not below `instants`, or if there are more than 65,536
    /// instants. cost: O(stored instants).
    template <std::invocable<std::uint32_t> InstantOf, std::invocable<std::uint32_t> ValueOf>
    void build(const ClusterTree& tree, std::uint32_t instants, const InstantOf& instant_of, const ValueOf& value_of) {
        LIGHTCUTS_ASSERT(tree.is_binary());
        if (instants < 1 || instants > max_instants) {
            LIGHTCUTS_THROW(invalid_input("instants: " + std::to_string(instants) + " is not in 1 to 65536"));
        }
        instants_ = instants;
        begin_.clear();
        instant_.clear();
        value_.clear();
        begin_.push_back(0);
        for (node_index n = 0; n < tree.size(); ++n) {
            if (tree.is_leaf(n)) {
                const std::uint32_t item = tree.item(n);
                const std::uint32_t t = instant_of(item);
                if (t >= instants) {
                    LIGHTCUTS_THROW(invalid_input("item " + std::to_string(item) + ": instant " + std::to_string(t) +
                                                  " is not below " + std::to_string(instants)));
                }
                append(t, value_of(item));
            } else {
                merge(tree.left(n), tree.right(n));
            }
            if (value_.size() > (std::numeric_limits<std::uint32_t>::max)()) {
                LIGHTCUTS_THROW(invalid_input("time vectors: more than 2^32 instants of nodes"));
            }
            begin_.push_back(static_cast<std::uint32_t>(value_.size()));
        }
    }

    /// Gives back storage that is not used.
    void shrink_to_fit() {
        begin_.shrink_to_fit();
        instant_.shrink_to_fit();
        value_.shrink_to_fit();
    }

    /// The number of instants at which node n has something.
    std::size_t count(node_index n) const { return begin_[n + 1] - begin_[n]; }
    /// What node n amounts to at an instant.
    S at(node_index n, std::uint32_t instant) const {
        const std::size_t i = find(n, instant);
        return i == none ? black<S>() : value_[i];
    }
    std::size_t memory_bytes() const {
        return begin_.capacity() * sizeof(std::uint32_t) + instant_.capacity() * sizeof(std::uint16_t) +
               value_.capacity() * sizeof(S);
    }

    /// Calls `f(instant, value)`, in ascending order, for each instant at which node n has something.
    template <class F>
    void for_each(node_index n, const F& f) const {
        for (std::size_t i = begin_[n]; i < begin_[n + 1]; ++i) f(std::uint32_t{instant_[i]}, value_[i]);
    }
    /// Calls `f(value)` with what node n amounts to at an instant, if it has something then.
    template <class F>
    void if_any(node_index n, std::uint32_t instant, const F& f) const {
        const std::size_t i = find(n, instant);
        if (i != none) f(value_[i]);
    }

private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    void append(std::uint32_t instant, const S& value) {
        instant_.push_back(static_cast<std::uint16_t>(instant));
        value_.push_back(value);
    }

    /// Appends the sum of the vectors of two nodes.
    void merge(node_index a, node_index b) {
        std::size_t i = begin_[a], j = begin_[b];
        const std::size_t end_i = begin_[a + 1], end_j = begin_[b + 1];
        while (i < end_i || j < end_j) {
            if (j == end_j || (i < end_i && instant_[i] < instant_[j])) {
                append(instant_[i], S(value_[i]));
                ++i;
            } else if (i == end_i || instant_[j] < instant_[i]) {
                append(instant_[j], S(value_[j]));
                ++j;
            } else {
                append(instant_[i], finite(S(value_[i] + value_[j])));
                ++i;
                ++j;
            }
        }
    }

    /// Where node n's value at an instant is; `none` if it has nothing then.
    std::size_t find(node_index n, std::uint32_t instant) const {
        const std::size_t first = begin_[n], last = begin_[n + 1];
        if (last - first == instants_) return first + instant;  // dense
        const auto from = instant_.begin() + static_cast<std::ptrdiff_t>(first);
        const auto to = instant_.begin() + static_cast<std::ptrdiff_t>(last);
        const auto at = std::lower_bound(from, to, instant);
        return at != to && *at == instant ? static_cast<std::size_t>(at - instant_.begin()) : none;
    }

    std::uint32_t instants_ = 1;
    std::vector<std::uint32_t> begin_;  ///< of each node's part of the arrays below; one more at the end
    std::vector<std::uint16_t> instant_;
    std::vector<S> value_;
};

namespace detail {

/// Calls `f(instant, a, b)`, in ascending order, for each instant at which both nodes have something; a and b are what
/// they amount to. cost: the instants of the sparser one, each a search in the other.
template <Spectrum A, Spectrum B, class F>
void for_each_common(const TimeVectors<A>& a, ClusterTree::node_index of_a, const TimeVectors<B>& b,
                     ClusterTree::node_index of_b, const F& f) {
    if (a.count(of_a) <= b.count(of_b)) {
        a.for_each(of_a, [&](std::uint32_t t, const A& x) { b.if_any(of_b, t, [&](const B& y) { f(t, x, y); }); });
    } else {
        b.for_each(of_b, [&](std::uint32_t t, const B& y) { a.if_any(of_a, t, [&](const A& x) { f(t, x, y); }); });
    }
}

/// Time vectors of intensities, and of how many lights there are.
template <Spectrum S>
struct CountedTimeVectors : TimeVectors<S> {
    TimeVectors<float> counts;

    std::size_t memory_bytes() const { return TimeVectors<S>::memory_bytes() + counts.memory_bytes(); }
};

}  // namespace detail

}  // namespace lightcuts
