#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cluster_size.hpp"

namespace lightcuts::detail {

/// Sorts clusters into the order of a kd-tree whose nodes have `fan` children: every aligned run of fan^k clusters is
/// a node. Nodes are halved along the longest axis of their box at a fixed index, so coincident clusters do no harm.
template <bool Oriented>
class KdOrder {
public:
    static constexpr std::size_t fan = 8;
    static constexpr std::size_t axis_count = Oriented ? 6 : 3;

    struct Key {
        std::array<float, axis_count> coordinate;
        std::uint32_t slot;
    };

    /// The slots of `clusters` in that order. cost: O(N log N).
    static std::vector<Key> of(std::span<const Cluster<Oriented>> clusters, double direction) {
        std::vector<Key> keys(clusters.size());
        for (std::size_t s = 0; s < clusters.size(); ++s) {
            const Cluster<Oriented>& c = clusters[s];
            for (std::size_t a = 0; a < 3; ++a) keys[s].coordinate[a] = 0.5f * (c.lo[a] + c.hi[a]);
            if constexpr (Oriented) {
                for (std::size_t a = 0; a < 3; ++a) {
                    keys[s].coordinate[3 + a] = c.cone.axis[static_cast<glm::vec3::length_type>(a)];
                }
            }
            keys[s].slot = static_cast<std::uint32_t>(s);
        }
        order(keys, static_cast<float>(direction));
        return keys;
    }

private:
    static void order(std::span<Key> keys, float direction) {
        if (keys.size() <= fan) return;
        std::array<float, axis_count> lo = keys[0].coordinate, hi = lo;
        for (const Key& k : keys) {
            for (std::size_t a = 0; a < axis_count; ++a) {
                lo[a] = std::min(lo[a], k.coordinate[a]);
                hi[a] = std::max(hi[a], k.coordinate[a]);
            }
        }
        std::size_t longest = 0;
        float length = -1;
        for (std::size_t a = 0; a < axis_count; ++a) {
            const float e = hi[a] - lo[a];
            const float l = a < 3 ? e : 0.125f * direction * e * e;  // 1 - cos of a pair e apart is e^2 / 8
            if (l > length) {
                length = l;
                longest = a;
            }
        }
        std::size_t child = fan;
        while (child * fan < keys.size()) child *= fan;
        const std::size_t children = (keys.size() + child - 1) / child;
        const std::size_t left = (children + 1) / 2 * child;
        std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(left), keys.end(),
                         [longest](const Key& a, const Key& b) { return a.coordinate[longest] < b.coordinate[longest]; });
        order(keys.first(left), direction);
        order(keys.subspan(left), direction);
    }
};

}  // namespace lightcuts::detail
