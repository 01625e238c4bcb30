#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "annual.hpp"

namespace daylighting {

/// What is written of a year. Each file is the old one or a whole new one. throws of all: invalid_input naming the file
/// if it cannot be written.

/// A line each hour of the weather: month, day, the hour's end, and the illuminance of each sensor in lux.
void write_hourly(const std::filesystem::path& path, const Weather& weather, std::span<const LitHour> hours,
                  const Illuminances& lux);

/// The same as a matrix that Radiance's rmtxop reads: a row each sensor, a column each hour, one component, lux.
void write_matrix(const std::filesystem::path& path, const Weather& weather, std::span<const LitHour> hours,
                  const Illuminances& lux);

/// A line each sensor: where it is, and its figures; an empty field for hours of sun that are not known. `target`: for
/// the name of a column.
void write_annual(const std::filesystem::path& path, const SensorSet& sensors, std::span<const AnnualFigures> figures,
                  double target);

/// The figures that can be shown as a picture: autonomy, useful, sun, mean.
const std::vector<std::string>& figure_names();

/// A picture of a grid in false colors, north at the top, its cells squares: black is 0, white is 1 for shares and the
/// largest value of all sensors for `sun` and `mean`. Returns what white is. pre: `figure` is one of figure_names().
/// throws: also if the sensors are no grid.
double write_picture(const std::filesystem::path& path, const SensorSet& sensors,
                     std::span<const AnnualFigures> figures, const std::string& figure);

}  // namespace daylighting
