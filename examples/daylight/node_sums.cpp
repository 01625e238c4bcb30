#include "node_sums.hpp"

#include <lightcuts/core/vectorized.hpp>

namespace daylighting {

LIGHTCUTS_VECTORIZED void node_sums(const lightcuts::ClusterTree& tree, const std::vector<float>& cosines,
                                    const std::vector<HourValues>& light, std::vector<HourValues>& sums) {
    sums.resize(tree.size());
    const std::uint32_t nodes = static_cast<std::uint32_t>(tree.size());
    std::size_t place = 0;  // leaves come in the order of their places
    for (std::uint32_t n = 0; n < nodes; ++n) {
        float* const to = sums[n].data();
        if (tree.is_leaf(n)) {
            const float cosine = cosines[place];
            const float* const from = light[place].data();
            for (std::size_t h = 0; h < block_hours; ++h) to[h] = cosine * from[h];
            ++place;
        } else {
            const float* const a = sums[tree.left(n)].data();
            const float* const b = sums[tree.right(n)].data();
            for (std::size_t h = 0; h < block_hours; ++h) to[h] = a[h] + b[h];
        }
    }
}

LIGHTCUTS_VECTORIZED HourValues product(std::span<const CutEntry> cut, const std::vector<HourValues>& sums) {
    HourValues total{};
    for (const CutEntry& entry : cut) {
        const float* const from = sums[entry.node].data();
        for (std::size_t h = 0; h < block_hours; ++h) total[h] += entry.value * from[h];
    }
    return total;
}

}  // namespace daylighting
