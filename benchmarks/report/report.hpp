#pragma once

#include <vector>

#include "report/machine.hpp"
#include "report/measurement.hpp"

namespace benchmark {

/// All figures of a run.
struct Report {
    Machine machine;
    MeasurementOptions options;
    std::vector<SceneMeasurement> scenes;
};

}  // namespace benchmark
