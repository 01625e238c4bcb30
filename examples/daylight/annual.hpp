#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "hourly_sky.hpp"
#include "year.hpp"

namespace daylighting {

/// Hours of the day in which a room is used, every day alike.
struct Occupancy {
    int from = 8;  ///< o'clock
    int to = 18;
};

/// What a year brings to a sensor. Shares are of the hours in which the room is used, 0 to 1.
struct AnnualFigures {
    double mean = 0.0;            ///< illuminance over these hours, lux
    double autonomy = 0.0;        ///< daylight autonomy: at least so much light as is asked for
    double useful_to_2000 = 0.0;  ///< useful daylight illuminance: 100 to 2,000 lux
    double useful_to_3000 = 0.0;  ///< 100 to 3,000 lux
    double too_dark = 0.0;        ///< below 100 lux
    double too_bright = 0.0;      ///< above 3,000 lux
    /// In which the sun shines on the sensor, whether the room is used or not; none if suns are not known.
    std::optional<double> sun_hours;
};

/// The figures of one sensor. `lux`: one each lit hour. `target`: what the daylight autonomy asks for, lux.
AnnualFigures annual_figures(const Weather& weather, std::span<const LitHour> hours, std::span<const float> lux,
                             const Occupancy& occupancy, double target, std::optional<double> sun_hours);

}  // namespace daylighting
