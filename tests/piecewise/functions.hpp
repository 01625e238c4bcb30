#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/piecewise_constant.hpp>
#include <lightcuts/tree/cluster_tree.hpp>
#include "support/random.hpp"

namespace lightcuts::test {

/// A random tree over `leaves` items in their order, each inner node of which has 2 to `most_children` children.
inline ClusterTree random_tree(Random& random, std::uint32_t leaves, std::uint32_t most_children = 2) {
    std::vector<std::uint32_t> words;
    const auto build = [&](const auto& self, std::uint32_t begin, std::uint32_t end) -> void {
        if (end - begin == 1) {
            words.push_back(ClusterTree::leaf_word(begin));
            return;
        }
        const auto first = static_cast<std::uint32_t>(words.size());
        const auto most = std::min(end - begin, most_children);
        const auto children = 2 + static_cast<std::uint32_t>(random.below(most - 1));
        for (std::uint32_t c = children; c > 0; --c) {
            const std::uint32_t left = end - begin;
            const std::uint32_t size = c == 1 ? left
                                              : 1 + static_cast<std::uint32_t>(
                                                        random.below(std::min(left - c + 1, 2 * left / c)));
            self(self, begin, begin + size);
            begin += size;
        }
        words.push_back(first);
    };
    if (leaves > 0) build(build, 0, leaves);
    return ClusterTree(std::move(words));
}

/// The nodes of a random cut: each node is kept with a probability, else its children's are.
inline std::vector<std::uint32_t> random_cut(Random& random, const ClusterTree& tree, double keep) {
    std::vector<std::uint32_t> nodes;
    for (auto n = static_cast<std::int64_t>(tree.size()) - 1; n >= 0;) {
        const auto node = static_cast<std::uint32_t>(n);
        if (tree.is_leaf(node) || random.chance(keep)) {
            nodes.insert(nodes.begin(), node);
            n = std::int64_t{tree.left_leaf(node)} - 1;
        } else {
            --n;
        }
    }
    return nodes;
}

/// The means of a function below the nodes of a cut, with deviations.
template <class V>
PiecewiseConstant<V> means_on(const ClusterTree& tree, const std::vector<MomentsOf<V>>& moments,
                              const std::vector<std::uint32_t>& nodes) {
    std::vector<V> values;
    for (const std::uint32_t n : nodes) values.push_back(moments[n].template value<V>());
    PiecewiseConstant<V> result;
    assign<V>(tree, nodes, values, result);
    detail::append_deviations<V>(moments, result);
    return result;
}

/// Functions over leaves of which bounds may trip.
enum class Kind { uniform, steps, heavy_tailed, binary, nearly_constant, spikes };
constexpr Kind all_kinds[]{Kind::uniform, Kind::steps,           Kind::heavy_tailed,
                           Kind::binary,  Kind::nearly_constant, Kind::spikes};

inline std::vector<float> random_function(Random& random, std::uint32_t leaves, Kind kind) {
    std::vector<float> values;
    float level = random.real(-2.0, 2.0);
    for (std::uint32_t i = 0; i < leaves; ++i) {
        if (random.chance(0.1)) level = random.real(-2.0, 2.0);
        switch (kind) {
            case Kind::uniform: values.push_back(random.real(0.0, 1.0)); break;
            case Kind::steps: values.push_back(level); break;
            case Kind::heavy_tailed: values.push_back(static_cast<float>(random.decades(-3.0, 6.0))); break;
            case Kind::binary: values.push_back(level > 0.0f ? 1.0f : 0.0f); break;
            case Kind::nearly_constant: values.push_back(1000.0f + random.real(-1e-3, 1e-3)); break;
            case Kind::spikes: values.push_back(random.chance(0.05) ? 1e6f : random.chance(0.05) ? -1e6f : 0.0f); break;
        }
    }
    return values;
}

/// The value of `f` at each leaf, from left to right.
template <class F>
auto at_leaves(const F& f) {
    std::vector<piecewise_value_of<F>> values;
    for (std::size_t i = 0; i < f.pieces().size(); ++i) {
        while (values.size() < f.pieces()[i].leaf_end()) values.push_back(f.values()[i]);
    }
    return values;
}

}  // namespace lightcuts::test
