#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sun_position.hpp"

namespace daylighting {

/// What a weather file says of one hour, as means over it.
struct WeatherHour {
    int year = 0;
    int month = 0;  ///< 1 to 12
    int day = 0;
    int hour = 0;                     ///< 1 to 24: the hour that ends then
    double dew_point = 0.0;           ///< degrees Celsius
    double direct_normal = 0.0;       ///< W/m^2
    double diffuse_horizontal = 0.0;  ///< W/m^2

    /// Its middle.
    LocalTime middle() const { return {year, month, day, hour - 0.5}; }
};

/// The hours of a year, or of a shorter period, without a gap.
struct Weather {
    std::string city;
    Place place;
    std::vector<WeatherHour> hours;
};

/// The hours of a year from the first of January on, without any weather: of 8,760 hours, or of 8,784 with a leap day.
/// throws: invalid_input if there are other than so many.
Weather calendar_year(std::size_t hours);

/// Reads an EnergyPlus weather file (EPW): its place, and of each hour of its data period the sun's and the sky's
/// irradiance and the dew point. A dew point that is missing becomes 11 degrees.
/// throws: invalid_input, one line naming the file and the line: a header that is not there; more or less than one
/// record an hour; hours missing, doubled or out of order; fields missing, not numbers, or marked as missing.
/// `path`: for messages.
Weather epw_weather(std::string_view text, const std::filesystem::path& path);

/// The same of a file. throws: as `epw_weather`, and if it cannot be read.
Weather read_epw(const std::filesystem::path& path);

}  // namespace daylighting
