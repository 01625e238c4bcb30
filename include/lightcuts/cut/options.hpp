#pragma once

#include <cstddef>
#include <cstdint>

#include "clamp.hpp"

namespace lightcuts {

/// When a lightcut is fine enough, and what may be clamped.
struct LightcutOptions {
    /// Every cluster's error bound is at most this fraction of the estimated total, in every channel. 0.02 is the
    /// least change that people see. It bounds each cluster, not their sum.
    float error_ratio = 0.02f;
    /// Most clusters in a cut; 0: unlimited. Reached in dark places, where the total is small. Never below the
    /// number of trees.
    std::size_t max_cut = 1000;
    /// If no more lights than this are lit, in all trees together, the cut starts with each of them and is exact: to
    /// bound clusters of so few takes longer than to trace the shadow rays that it saves. 0 turns it off, as does a
    /// BoundedOracle: lower it where a shadow ray costs microseconds.
    std::size_t exhaustive_below = 256;
    /// Radiance that the viewer's eye is adapted to. A tenth of it is added to the total before bounds are compared
    /// with it, so that darkness is not refined beyond what such an eye sees [Multidimensional Lightcuts 2006, Eq. 15].
    float adaptation = 0.0f;
    /// Seed of the choice among several representatives of a cluster.
    std::uint64_t seed = 1;
    /// A round splits clusters whose priority is at least this fraction of the largest finite one: 1 splits one at a
    /// time, the papers' order; 0.1 makes a tenth of the rounds for under one per cent more clusters.
    double round_fraction = 0.1;
    /// Limits what lights whose kind is a ClampableLight add. Off by default.
    ClampingOptions clamp{};
};

}  // namespace lightcuts
