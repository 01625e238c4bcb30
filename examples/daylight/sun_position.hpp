#pragma once

#include <glm/vec3.hpp>

namespace daylighting {

/// A moment in a place's own time, which knows no summer time.
struct LocalTime {
    int year = 2001;
    int month = 1;      ///< 1 to 12
    int day = 1;        ///< 1 to 31
    double hour = 0.0;  ///< since midnight; may be below 0, or 24 and more
};

/// Where on earth, and by which clock.
struct Place {
    double latitude = 0.0;   ///< degrees north
    double longitude = 0.0;  ///< degrees east
    double time_zone = 0.0;  ///< hours that its clock is ahead of UTC
};

/// Days since the year began, from 1.
int day_of_year(int year, int month, int day);

/// The unit vector towards the center of the sun: x to the east, y to the north, z upwards. To 0.01 degrees from 1950
/// to 2050 [The Astronomical Almanac's formulas of low precision]; the air does not bend it, which near the horizon
/// lifts the real sun by half a degree.
glm::dvec3 towards_sun(const Place& place, const LocalTime& time);

}  // namespace daylighting
