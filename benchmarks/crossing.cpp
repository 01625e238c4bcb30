#include "crossing.hpp"

#include <cmath>
#include <cstddef>

namespace benchmark {

double crossing(const std::vector<double>& lights, const std::vector<double>& ratios) {
    for (std::size_t i = 1; i < lights.size(); ++i) {
        if (ratios[i - 1] >= 1.0 || ratios[i] < 1.0) continue;
        const double share = -std::log(ratios[i - 1]) / std::log(ratios[i] / ratios[i - 1]);
        return lights[i - 1] * std::pow(lights[i] / lights[i - 1], share);
    }
    return 0.0;
}

}  // namespace benchmark
