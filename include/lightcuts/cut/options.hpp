#pragma once

#include <cstddef>
#include <cstdint>

#include "clamp.hpp"

namespace lightcuts {

struct LightcutOptions {
    /// Every cluster's error bound is at most this fraction of the estimated total, in every channel. 0.02 is the
    /// least change that people see. It bounds each cluster, not their sum.
    float error_ratio = 0.02f;
    /// Most clusters in a cut; 0: unlimited. Reached in dark places, where the total is small. Never below the
    /// number of trees.
    std::size_t max_cut = 1000;
    /// Where no more lights than this are lit, in all trees, cuts start with each of them, exact: at 2 % a cut holds
    /// more than half of so few, and bounds cost more than the shadow rays that they save. 0: never, for oracles so
    /// dear that they do not.
    std::size_t few_lights = 256;
    /// Radiance that the viewer's eye is adapted to. A tenth of it is added to the total before bounds are compared
    /// with it, so that darkness is not refined beyond what such an eye sees [Multidimensional Lightcuts 2006, Eq. 15].
    float adaptation = 0.0f;
    /// Of the choice among several representatives.
    std::uint64_t seed = 1;
    /// See RefinementOptions.
    double round_fraction = 0.1;
    /// Of lights whose kind is a ClampedLight. Off by default.
    ClampOptions clamp{};
};

}  // namespace lightcuts
