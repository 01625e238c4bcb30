#pragma once

#include "report/measurement.hpp"
#include "report/plot.hpp"

namespace benchmark {

/// What a plot has along its axes.
enum class PlotCost { seconds, shadow_rays };
enum class PlotError { relative_rmse, p999_relative, p999_step };

Plot plot_of(const SceneMeasurement& scene, PlotCost cost, PlotError error);

}  // namespace benchmark
