#pragma once

#include <vector>

#include "options.hpp"

namespace benchmark {

/// A method of the renderer with one parameter that trades error against time: a curve of the report.
struct ReportMethod {
    const char* name;       ///< as in the legend
    const char* method;     ///< `--method`
    const char* parameter;  ///< what is varied
    void (*set)(render::Options&, double value);
    std::vector<double> values;  ///< from fast to slow
    bool sums_pixels = false;    ///< differs from others only where a pixel has several gather points
};

/// All methods that are compared for a scene of these options, besides the exhaustive sum, which is the reference.
std::vector<const ReportMethod*> report_methods(const render::Options& scene);

}  // namespace benchmark
