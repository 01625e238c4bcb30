#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "../../core/random.hpp"
#include "cluster_size.hpp"

namespace lightcuts::detail {

template <bool Oriented>
bool coincide(const BuildCluster<Oriented>& a, const BuildCluster<Oriented>& b) {
    if constexpr (Oriented) {
        if (!(a.cone.axis == b.cone.axis)) return false;
    }
    return a.lo == b.lo;
}

/// Calls `join(a, b)`, a < b, for the merges of size zero, in the greedy order: the two coincident clusters with the
/// fewest items (then the smallest ids) first. The joined cluster takes slot a, slot b is left empty.
/// pre: single items, in the order of their ids. cost: O(N), and O(M log M) for M coincident ones.
template <bool Oriented, class Join>
void merge_coincident(const std::vector<BuildCluster<Oriented>>& clusters, Join&& join) {
    constexpr std::uint32_t none = 0xffff'ffffu;
    // Step 1: chain equal items through a hash table.
    const auto hash = [](const BuildCluster<Oriented>& c) {
        const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
        std::uint64_t h = hash_keys(bits(c.lo[0]) << 32 | bits(c.lo[1]), bits(c.lo[2]));
        if constexpr (Oriented) {
            h = hash_keys(h, bits(c.cone.axis.x) << 32 | bits(c.cone.axis.y), bits(c.cone.axis.z));
        }
        return h;
    };
    std::vector<std::uint32_t> table(std::bit_ceil(2 * clusters.size()), none);
    std::vector<std::uint32_t> next(clusters.size(), none);
    std::vector<std::size_t> shared;  // entries of the table with more than one item
    for (std::size_t s = clusters.size(); s-- > 0;) {
        std::size_t h = hash(clusters[s]) & (table.size() - 1);
        while (table[h] != none && !coincide(clusters[table[h]], clusters[s])) h = (h + 1) & (table.size() - 1);
        if (table[h] != none && next[table[h]] == none) shared.push_back(h);
        next[s] = table[h];
        table[h] = static_cast<std::uint32_t>(s);
    }
    // Step 2: merge each chain.
    using Entry = std::pair<std::uint32_t, std::uint32_t>;  // count, slot
    for (const std::size_t h : shared) {
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        for (std::uint32_t s = table[h]; s != none; s = next[s]) queue.push({1, s});
        while (queue.size() > 1) {
            const auto [count_a, a] = queue.top();
            queue.pop();
            const auto [count_b, b] = queue.top();
            queue.pop();
            join((std::min)(a, b), (std::max)(a, b));
            queue.push({count_a + count_b, (std::min)(a, b)});
        }
    }
}

}  // namespace lightcuts::detail
