#pragma once

#include <vector>

namespace benchmark {

/// The number of lights at which `ratios` of another method's time to that of lightcuts pass 1, log-linear between
/// neighbors; 0: nowhere.
double crossing(const std::vector<double>& lights, const std::vector<double>& ratios);

}  // namespace benchmark
