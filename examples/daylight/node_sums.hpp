#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "direction_tree.hpp"
#include "hourly_sky.hpp"

namespace daylighting {

/// A piece of a cut, for a product with node sums.
struct CutEntry {
    std::uint32_t node = 0;
    float value = 0.0f;
};

/// Makes `sums` of each node the sum over the directions below it of `cosine x light`. cost: one pass, O(N)
void node_sums(const lightcuts::ClusterTree& tree, const std::vector<float>& cosines,
               const std::vector<HourValues>& light, std::vector<HourValues>& sums);

/// The sum over the entries of value x node sum: sixteen hours of one sensor. Where all of a factor's node sums are
/// known a cut is a sparse row, and no two cuts have to be merged.
HourValues product(std::span<const CutEntry> cut, const std::vector<HourValues>& sums);

}  // namespace daylighting
