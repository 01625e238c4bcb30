#pragma once

#include <nlohmann/json.hpp>

namespace benchmark {

/// Cuts against Haar wavelets, spherical harmonics and patches of the sky: terms at equal error, errors and times of
/// sums of products of two at equal terms, and triple products by all but harmonics. Prints tables. `runs`: medians are
/// over this odd number.
nlohmann::json function_peers(int runs);

}  // namespace benchmark
