#pragma once

#include <cmath>

namespace benchmark {

/// Squares of errors and of what they are errors of.
struct ErrorSum {
    double squared = 0.0, reference = 0.0;

    void add(double value, double exact) {
        squared += (value - exact) * (value - exact);
        reference += exact * exact;
    }
    double relative() const { return std::sqrt(squared / reference); }
};

}  // namespace benchmark
