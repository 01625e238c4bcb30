#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace benchmark {

/// Writes what `measure` returns to `file`, and makes sure beforehand that it can be written: measuring takes long.
/// Returns the exit status of `program`: 1, after a line on stderr, for any exception, and `file` is as it was.
int write_figures(const std::string& program, const std::filesystem::path& file,
                  const std::function<nlohmann::json()>& measure);

/// For options that medians are over.
CLI::Validator odd_number();

}  // namespace benchmark
