#pragma once

#include <cmath>
#include <cstddef>

namespace lightcuts::test {

/// Mean and spread of a stream of numbers [Welford 1962].
class Mean {
public:
    void add(double x) {
        ++count_;
        const double off = x - mean_;
        mean_ += off / static_cast<double>(count_);
        squares_ += off * (x - mean_);
    }
    double value() const { return mean_; }
    double deviation() const { return std::sqrt(squares_ / static_cast<double>(count_ - 1)); }
    /// How many standard errors the mean lies from `truth`; 0 if both agree within rounding.
    double standard_errors_from(double truth) const {
        const double off = std::fabs(mean_ - truth);
        if (off <= 1e-6 * std::fabs(truth)) return 0.0;
        return off / (deviation() / std::sqrt(static_cast<double>(count_)));
    }

private:
    std::size_t count_ = 0;
    double mean_ = 0.0;
    double squares_ = 0.0;
};

/// A mean of many independent numbers is farther from the truth than this, in standard errors, with a chance of 1e-6.
inline constexpr double one_in_a_million = 4.892;

/// What a chi-square of `freedom` degrees exceeds with a chance of 1e-6 [Wilson and Hilferty 1931].
inline double chi_square_limit(std::size_t freedom) {
    const double k = static_cast<double>(freedom);
    const double t = 1.0 - 2.0 / (9.0 * k) + 4.753 * std::sqrt(2.0 / (9.0 * k));
    return k * t * t * t;
}

}  // namespace lightcuts::test
