#pragma once

#include <string>

#include "report/report.hpp"

namespace benchmark {

/// The report as one HTML page that needs no other file: the comparison at equal time; for each scene plots, pictures
/// of all methods at about the time that lightcuts take at their usual error ratio, and all figures.
std::string to_html(const Report& report);

}  // namespace benchmark
