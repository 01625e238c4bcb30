#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "report/report.hpp"

namespace benchmark {

/// A header, and a row for each setting, the exhaustive sum included. What is not finite is empty.
std::string to_csv(const Report& report);

/// The figures and the comparison at equal time. What is not finite is null.
nlohmann::ordered_json to_json(const Report& report);

}  // namespace benchmark
