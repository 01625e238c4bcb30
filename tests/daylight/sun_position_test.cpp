#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <daylight/sun_position.hpp>
#include <glm/geometric.hpp>

namespace {

using namespace daylighting;

constexpr double degrees = 180.0 / std::numbers::pi;

double elevation(const glm::dvec3& sun) { return std::asin(sun.z) * degrees; }
double azimuth(const glm::dvec3& sun) { return std::fmod(std::atan2(sun.x, sun.y) * degrees + 360.0, 360.0); }

TEST(SunPosition, is_that_of_the_published_example) {
    // Reda and Andreas, Solar position algorithm, 2003, appendix A.5: zenith 50.11162, azimuth 194.34024 degrees. The
    // air bends its light by 0.0168 degrees there, which they add.
    const glm::dvec3 sun = towards_sun({39.742476, -105.1786, -7.0}, {2003, 10, 17, 12.0 + 30.5 / 60.0});
    EXPECT_NEAR(90.0 - elevation(sun), 50.11162 + 0.0168, 0.015);
    EXPECT_NEAR(azimuth(sun), 194.34024, 0.02);
    EXPECT_NEAR(glm::length(sun), 1.0, 1e-12);
}

TEST(SunPosition, is_over_the_equator_at_an_equinox) {
    // The equinox of March 2000 was at 7:35 UTC on the 20th.
    const glm::dvec3 at_pole = towards_sun({90.0, 0.0, 0.0}, {2000, 3, 20, 7.0 + 35.0 / 60.0});
    EXPECT_NEAR(elevation(at_pole), 0.0, 0.01);
    // And stood over the tropic of Cancer at the solstice, at 1:48 UTC on the 21st of June.
    const glm::dvec3 in_june = towards_sun({90.0, 0.0, 0.0}, {2000, 6, 21, 1.8});
    EXPECT_NEAR(elevation(in_june), 23.438, 0.01);
}

TEST(SunPosition, goes_from_east_by_the_nearer_pole_side_to_west) {
    for (const double latitude : {48.0, -33.0}) {
        const Place place{latitude, 0.0, 0.0};
        EXPECT_GT(towards_sun(place, {2001, 3, 21, 9.0}).x, 0.3);
        EXPECT_LT(towards_sun(place, {2001, 3, 21, 15.0}).x, -0.3);
        const double noon_north = towards_sun(place, {2001, 3, 21, 12.0}).y;
        EXPECT_EQ(noon_north > 0.0, latitude < 0.0);
        EXPECT_LT(towards_sun(place, {2001, 3, 21, 0.0}).z, -0.5);
    }
}

TEST(SunPosition, knows_clocks_and_leap_years) {
    const LocalTime utc{2004, 3, 1, 10.0}, japan{2004, 3, 1, 19.0};
    EXPECT_NEAR(glm::distance(towards_sun({35.0, 139.0, 0.0}, utc), towards_sun({35.0, 139.0, 9.0}, japan)), 0.0,
                1e-12);
    // A moment has one sun, whatever the day is called.
    EXPECT_NEAR(glm::distance(towards_sun({35.0, 0.0, 0.0}, {2004, 2, 29, 24.0}),
                              towards_sun({35.0, 0.0, 0.0}, {2004, 3, 1, 0.0})),
                0.0, 1e-9);
    EXPECT_EQ(day_of_year(2004, 3, 1), 61);
    EXPECT_EQ(day_of_year(2100, 3, 1), 60);
    EXPECT_EQ(day_of_year(2000, 12, 31), 366);
}

}  // namespace
