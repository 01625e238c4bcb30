#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cluster_size.hpp"

namespace lightcuts::detail {

/// The order in which a kd-tree whose nodes have `fan` children lists clusters: every aligned run of fan^k of them is
/// a node. Nodes are halved along the longest axis of their box at a fixed index, so coincident clusters do no harm.
template <bool Oriented>
class KdOrder {
public:
    static constexpr std::size_t fan = 8;

    /// Indices into `clusters`. cost: O(N log N).
    static std::vector<std::uint32_t> of(std::span<const BuildCluster<Oriented>> clusters, double direction) {
        std::vector<Key> keys(clusters.size());
        for (std::size_t s = 0; s < clusters.size(); ++s) {
            const BuildCluster<Oriented>& c = clusters[s];
            for (std::size_t a = 0; a < 3; ++a) keys[s].coordinate[a] = 0.5f * (c.lo[a] + c.hi[a]);
            if constexpr (Oriented) {
                const std::array<float, 3> axis = unit_axis(c);
                std::copy(axis.begin(), axis.end(), keys[s].coordinate.begin() + 3);
            }
            keys[s].index = static_cast<std::uint32_t>(s);
        }
        sort(keys, static_cast<float>(direction));
        std::vector<std::uint32_t> order(keys.size());
        for (std::size_t s = 0; s < keys.size(); ++s) order[s] = keys[s].index;
        return order;
    }

private:
    static constexpr std::size_t axis_count = Oriented ? 6 : 3;

    struct Key {
        std::array<float, axis_count> coordinate;
        std::uint32_t index;
    };

    static void sort(std::span<Key> keys, float direction) {
        if (keys.size() <= fan) return;
        const std::size_t axis = longest_axis(keys, direction);
        std::size_t child = fan;
        while (child * fan < keys.size()) child *= fan;
        const std::size_t children = (keys.size() + child - 1) / child;
        const std::size_t left = (children + 1) / 2 * child;
        std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(left), keys.end(),
                         [axis](const Key& a, const Key& b) { return a.coordinate[axis] < b.coordinate[axis]; });
        sort(keys.first(left), direction);
        sort(keys.subspan(left), direction);
    }

    static std::size_t longest_axis(std::span<const Key> keys, float direction) {
        std::array<float, axis_count> lo = keys[0].coordinate, hi = lo;
        for (const Key& k : keys) {
            for (std::size_t a = 0; a < axis_count; ++a) {
                lo[a] = (std::min)(lo[a], k.coordinate[a]);
                hi[a] = (std::max)(hi[a], k.coordinate[a]);
            }
        }
        std::size_t longest = 0;
        float length = -1;
        for (std::size_t a = 0; a < axis_count; ++a) {
            const float e = hi[a] - lo[a];
            const float l = a < 3 ? e : 0.125f * direction * e * e;  // c (1 - cos beta) of two axes e apart
            if (l > length) {
                length = l;
                longest = a;
            }
        }
        return longest;
    }
};

}  // namespace lightcuts::detail
