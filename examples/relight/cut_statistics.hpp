#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace relight {

/// What cuts cost, and how far off they are.
struct CutStatistics {
    std::size_t sites = 0;
    std::size_t pieces = 0;  ///< of all cuts
    std::size_t largest = 0;
    std::uint64_t rays = 0;
    double squared_error = 0.0;  ///< of what is stored, summed over all rays
    double squares = 0.0;        ///< of what was seen, likewise
    double seconds = 0.0;        ///< of all threads together
    double ray_seconds = 0.0;    ///< of these, in the ray tracer

    double mean_size() const { return sites > 0 ? static_cast<double>(pieces) / static_cast<double>(sites) : 0.0; }
    double rms() const { return rays > 0 ? std::sqrt(squared_error / static_cast<double>(rays)) : 0.0; }
    /// L2 error over the L2 norm.
    double relative_error() const { return squares > 0.0 ? std::sqrt(squared_error / squares) : 0.0; }
};

}  // namespace relight
