#include "sun_position.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace daylighting {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

bool is_leap(int year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }

/// Days from noon of the first of January 2000 to midnight at the start of a day.
double days_since_2000(int year, int month, int day) {
    const int before = year - 1;
    const int leap_days = before / 4 - before / 100 + before / 400 - (1999 / 4 - 1999 / 100 + 1999 / 400);
    return 365.0 * (year - 2000) + leap_days + day_of_year(year, month, day) - 1 - 0.5;
}

}  // namespace

int day_of_year(int year, int month, int day) {
    constexpr std::array<int, 12> before = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
    return before[static_cast<std::size_t>(month - 1)] + day + (month > 2 && is_leap(year) ? 1 : 0);
}

glm::dvec3 towards_sun(const Place& place, const LocalTime& time) {
    const double universal = time.hour - place.time_zone;
    const double n = days_since_2000(time.year, time.month, time.day) + universal / 24.0;
    const double mean_longitude = 280.460 + 0.9856474 * n;
    const double anomaly = (357.528 + 0.9856003 * n) * degree;
    const double longitude = (mean_longitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2.0 * anomaly)) * degree;
    const double obliquity = (23.439 - 0.0000004 * n) * degree;
    const double ascension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
    const double sine = std::sin(obliquity) * std::sin(longitude), cosine = std::sqrt(1.0 - sine * sine);

    // Sidereal time turns with the days from noon; hours are 15 degrees.
    const double sidereal = (18.697374558 + 24.06570982441908 * n) * 15.0 + place.longitude;
    const double turned = sidereal * degree - ascension;
    const double north = place.latitude * degree;
    return {-cosine * std::sin(turned), sine * std::cos(north) - cosine * std::cos(turned) * std::sin(north),
            sine * std::sin(north) + cosine * std::cos(turned) * std::cos(north)};
}

}  // namespace daylighting
