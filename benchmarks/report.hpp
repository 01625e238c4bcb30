#pragma once

#include <vector>

#include "machine.hpp"
#include "report_measurement.hpp"

namespace benchmark {

/// All figures of a run.
struct Report {
    Machine machine;
    MeasurementOptions options;
    std::vector<SceneMeasurement> scenes;
};

}  // namespace benchmark
