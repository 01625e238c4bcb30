#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/measurement.hpp"

namespace benchmark {

/// Errors below are not told apart: on logarithmic scales they count as this one.
inline constexpr double smallest_error = 1e-4;

/// One setting of a method.
struct Effort {
    double seconds = 0;
    double error = 0;
};

/// The least error that a method reaches in `seconds`: log-log interpolation between settings, of which those that
/// are beaten by a faster one are left out. Past the slowest setting the error is that setting's; none if even the
/// fastest takes longer. pre: seconds > 0; all times > 0.
std::optional<double> error_at(std::vector<Effort> settings, double seconds);

/// The time in which a method reaches `error`, interpolated likewise. Where its fastest setting is better already,
/// that setting's time; none if no setting is as good. pre: error > 0; all times > 0.
std::optional<double> time_of(std::vector<Effort> settings, double error);

/// Lightcuts against all other methods, in the time in which lightcuts reach a relative RMSE of 2 %.
struct EqualTime {
    /// An error of lightcuts, and the least that any other method reaches in the same time.
    struct Figure {
        double lightcuts = 0;
        std::optional<double> best_other;  ///< none: all others take longer
        std::string other;                 ///< whose it is
        std::optional<double> ratio() const;
    };

    std::string curve;  ///< which lightcuts
    double seconds = 0;
    double exhaustive_seconds = 0;
    bool reached = true;  ///< false: the error stays above 2 %; the best setting stands in
    Figure relative_rmse;
    Figure p999_relative;
    Figure p999_step;
};

/// One row for each curve of lightcuts.
std::vector<EqualTime> equal_times(const SceneMeasurement& scene);

}  // namespace benchmark
