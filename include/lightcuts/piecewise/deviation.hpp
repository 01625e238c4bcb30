#pragma once

#include <cmath>

#include "../core/rounding.hpp"

namespace lightcuts {

/// How far a function is from the value that stands for it below a node. Both numbers are upper bounds.
struct Deviation {
    float norm = 0.0f;    ///< sqrt(sum over the leaves of (f - value)^2); it grows with the number of leaves
    float offset = 0.0f;  ///< |mean of f - value|: zero where the value is the exact mean, else what rounding left
};

namespace detail {

/// What sums of so many rounded terms of one sign may be too small by, as a factor.
constexpr double sum_inflation(double terms) { return 1.0 + (terms + 16.0) * (2.0 * unit_roundoff); }

/// The deviation from `value` of a function of known mean: |exact mean - mean| <= mean_error, and the sum of squares
/// about the exact mean is at most `squared_deviation`.
inline Deviation deviation_from(double value, double mean, double mean_error, double squared_deviation, double leaves) {
    const double offset = (std::abs(value - mean) + mean_error) * (1.0 + 4.0 * unit_roundoff);
    double norm = std::sqrt(squared_deviation + leaves * offset * offset);
    // The square of a tiny offset underflows.
    const double least = std::sqrt(leaves) * offset;
    if (norm < least) norm = least;
    return {round_up(norm * (1.0 + 8.0 * unit_roundoff)), round_up(offset)};
}

}  // namespace detail

}  // namespace lightcuts
