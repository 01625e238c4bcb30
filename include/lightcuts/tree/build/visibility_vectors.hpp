#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "../../core/executor.hpp"
#include "../../core/invalid_input.hpp"
#include "../cluster_tree.hpp"

namespace lightcuts {

/// The nodes of a cut of `count` clusters of as equal size as the tree has them, or of all leaves if there are fewer.
/// Largest first; of equal ones the later. pre: a binary tree. cost: O(count log count).
inline std::vector<std::uint32_t> even_clusters(const ClusterTree& tree, std::size_t count) {
    std::vector<std::pair<std::size_t, std::uint32_t>> heap;
    if (!tree.empty()) heap.push_back({tree.leaf_count(tree.root()), tree.root()});
    while (!heap.empty() && heap.size() < count && heap.front().first > 1) {
        std::pop_heap(heap.begin(), heap.end());
        const std::uint32_t n = heap.back().second;
        heap.pop_back();
        for (const std::uint32_t child : {tree.left(n), tree.right(n)}) {
            heap.push_back({tree.leaf_count(child), child});
            std::push_heap(heap.begin(), heap.end());
        }
    }
    std::vector<std::uint32_t> nodes;
    nodes.reserve(heap.size());
    for (const auto& [leaves, n] : heap) nodes.push_back(n);
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

/// Of each light the mean visibility from the vertices of each cluster, for `DataDriven` [Cut merging 2008,
/// section 3.4]. `vertices`: a tree over the vertices, of which `clusters` is a cut; the paper takes 1024, by
/// `TwoCenters` and `even_clusters`. `visibility(vertex, light)`: in [0, 1]; called once a pair, from the executor's
/// threads. shapes: light i has the clusters.size() numbers from i x clusters.size() on. cost: vertices x lights calls
/// of `visibility`.
template <class Visibility, Executor E = Sequential>
    requires requires(const Visibility& v, std::uint32_t i) {
        { v(i, i) } -> std::convertible_to<float>;
    }
std::vector<float> visibility_vectors(const ClusterTree& vertices, std::span<const std::uint32_t> clusters,
                                      std::size_t lights, const Visibility& visibility, const E& execute = {}) {
    std::vector<float> vectors(lights * clusters.size(), 0.0f);
    execute(lights, [&](std::size_t light) {
        for (std::size_t k = 0; k < clusters.size(); ++k) {
            double sum = 0.0, count = 0.0;
            for (std::uint32_t n = vertices.left_leaf(clusters[k]); n <= clusters[k]; ++n) {
                if (!vertices.is_leaf(n)) continue;
                sum += static_cast<double>(visibility(vertices.item(n), static_cast<std::uint32_t>(light)));
                count += 1.0;
            }
            vectors[light * clusters.size() + k] = static_cast<float>(sum / count);
        }
    });
    return vectors;
}

}  // namespace lightcuts
