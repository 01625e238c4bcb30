#pragma once

#include <span>
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
};

/// All methods that are compared, besides the exhaustive sum, which is the reference.
std::span<const ReportMethod> report_methods();

}  // namespace benchmark
