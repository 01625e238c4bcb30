#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <daylight/all_weather_sky.hpp>
#include <daylight/hourly_sky.hpp>
#include <glm/geometric.hpp>

namespace {

using namespace daylighting;

glm::dvec3 at(double elevation, double azimuth) {
    const double up = elevation * std::numbers::pi / 180.0, turn = azimuth * std::numbers::pi / 180.0;
    return {std::cos(up) * std::sin(turn), std::cos(up) * std::cos(turn), std::sin(up)};
}

AllWeatherSky sky_of(double elevation, double direct, double diffuse) {
    return AllWeatherSky({.towards_sun = at(elevation, 180.0),
                          .direct_normal = direct,
                          .diffuse_horizontal = diffuse,
                          .dew_point = 11.0,
                          .day_of_year = 80});
}

double luminance(const AllWeatherSky& sky, const glm::dvec3& direction) {
    return sky.shape().luminance(direction, sky.towards_sun());
}

LitHour hour_of(const AllWeatherSky& sky) {
    return {.sun = sky.towards_sun(),
            .direct_illuminance = sky.direct_illuminance(),
            .diffuse_illuminance = sky.diffuse_illuminance(),
            .shape = sky.shape()};
}

TEST(AllWeatherSky, is_that_of_the_formulas_worked_out_by_hand) {
    // Sun at 60 degrees: Z = pi/6. 800 and 100 W/m^2 on day 80.
    const AllWeatherSky sky = sky_of(60.0, 800.0, 100.0);
    const double z = std::numbers::pi / 6.0, cubed = 1.041 * z * z * z;
    EXPECT_NEAR(sky.clearness(), (9.0 + cubed) / (1.0 + cubed), 1e-12);
    EXPECT_NEAR(sky.clearness(), 7.95995, 1e-4);
    EXPECT_NEAR(sky.brightness(), 100.0 * 1.1533 / (1367.0 * 1.00806), 1e-4);
    // The last row of the tables.
    const double water = std::exp(0.07 * 11.0 - 0.075), delta = sky.brightness();
    EXPECT_NEAR(sky.diffuse_illuminance(),
                100.0 * (152.23 + 0.35 * water - 45.27 * std::cos(z) - 7.98 * std::log(delta)), 1e-6);
    EXPECT_NEAR(sky.direct_illuminance(),
                800.0 * (101.18 + 1.58 * water - 1.10 * std::exp(5.73 * z - 5.0) - 8.29 * delta), 1e-6);
    const double a = -1.05 + 0.0289 * z + delta * (0.426 + 0.359 * z);
    const double b = -0.325 + 0.1156 * z + delta * (0.7781 + 0.0025 * z);
    const double c = 31.0625 - 14.5 * z + delta * (-46.1148 + 55.375 * z);
    const double d = -7.2312 + 0.405 * z + delta * (13.35 + 0.6234 * z);
    const double e = 1.5 - 0.6426 * z + delta * (1.8564 + 0.5636 * z);
    EXPECT_NEAR(luminance(sky, {0.0, 0.0, 1.0}),
                (1.0 + a * std::exp(b)) * (1.0 + c * std::exp(d * z) + e * std::cos(z) * std::cos(z)), 1e-9);
}

TEST(AllWeatherSky, overcast_is_brightest_in_the_zenith_and_the_same_all_around) {
    const AllWeatherSky sky = sky_of(40.0, 0.0, 150.0);
    EXPECT_EQ(sky.clearness(), 1.0);
    EXPECT_EQ(sky.direct_illuminance(), 0.0);
    const double zenith = luminance(sky, {0.0, 0.0, 1.0});
    double low = 1e9, high = 0.0;
    for (int azimuth = 0; azimuth < 360; azimuth += 15) {
        const double l = luminance(sky, at(15.0, azimuth));
        low = std::min(low, l);
        high = std::max(high, l);
    }
    // CIE's overcast sky has 2 at 15 degrees: 3 / (1 + 2 sin 15).
    EXPECT_GT(zenith / high, 1.2);
    EXPECT_LT(zenith / low, 2.6);
    EXPECT_LT(high / low, 1.5);
}

TEST(AllWeatherSky, clear_is_brightest_about_the_sun) {
    const AllWeatherSky sky = sky_of(40.0, 850.0, 90.0);
    EXPECT_GT(sky.clearness(), 6.2);
    const double at_sun = luminance(sky, at(40.0, 180.0));
    EXPECT_GT(at_sun, 5.0 * luminance(sky, at(40.0, 0.0)));
    EXPECT_GT(at_sun, 5.0 * luminance(sky, {0.0, 0.0, 1.0}));
}

TEST(AllWeatherSky, is_finite_and_not_negative_whatever_is_measured) {
    for (const double elevation : {-20.0, -0.1, 0.0, 0.5, 5.0, 30.0, 60.0, 89.0, 90.0}) {
        for (const double direct : {0.0, 1.0, 100.0, 1100.0}) {
            for (const double diffuse : {0.0, 0.01, 1.0, 50.0, 500.0, 900.0}) {
                const AllWeatherSky sky = sky_of(elevation, direct, diffuse);
                EXPECT_TRUE(std::isfinite(sky.direct_illuminance()) && sky.direct_illuminance() >= 0.0);
                EXPECT_TRUE(std::isfinite(sky.diffuse_illuminance()) && sky.diffuse_illuminance() >= 0.0);
                EXPECT_TRUE(elevation > 0.0 || sky.direct_illuminance() == 0.0);
                for (const double height : {0.01, 3.0, 20.0, 50.0, 90.0}) {
                    for (const double turn : {0.0, 90.0, 180.0}) {
                        const double l = luminance(sky, at(height, turn));
                        EXPECT_TRUE(std::isfinite(l) && l >= 0.0) << elevation << " " << direct << " " << diffuse;
                    }
                }
            }
        }
    }
}

TEST(SkyBlock, has_the_illuminance_that_the_weather_says) {
    const DirectionTree directions = make_direction_tree(4096);
    const std::vector<LitHour> hours = {hour_of(sky_of(30.0, 0.0, 120.0)), hour_of(sky_of(50.0, 700.0, 150.0)),
                                        hour_of(sky_of(-2.0, 0.0, 3.0))};
    for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
        const Setting setting{.up = up, .turned = 33.0, .ground_albedo = 0.25};
        SkyBlock block(directions, setting);
        block.fill(hours);
        for (std::size_t h = 0; h < block_hours; ++h) {
            double above = 0.0, below = 0.0;
            for (std::size_t i = 0; i < directions.size(); ++i) {
                const double height = to_compass(directions.directions[i], up).z;
                (height > 0.0 ? above : below) += std::abs(height) * block.light()[i][h];
            }
            const double expected = h < hours.size() ? hours[h].diffuse_illuminance : 0.0;
            EXPECT_NEAR(above, expected, 1e-5 * expected);
            if (h >= hours.size()) continue;
            const double sun = hours[h].direct_illuminance * std::max(0.0, hours[h].sun.z);
            EXPECT_NEAR(below, 0.25 * (expected + sun), 2e-3 * (expected + sun));
        }
    }
}

TEST(SkyBlock, turns_with_the_scene) {
    // A scene whose north points east sees a sun in the south to its right, which is east in its own axes.
    const DirectionTree directions = make_direction_tree(4096);
    Weather weather;
    weather.place = {48.0, 0.0, 0.0};
    weather.hours.push_back({2001, 3, 21, 13, 5.0, 700.0, 100.0});
    const auto straight = lit_hours(weather, directions, {.up = UpAxis::y, .turned = 0.0});
    const auto turned = lit_hours(weather, directions, {.up = UpAxis::y, .turned = 90.0});
    EXPECT_GT(straight.at(0).towards_sun.z, 0.6f);
    EXPECT_GT(turned.at(0).towards_sun.x, 0.6f);
    SkyBlock block(directions, {.up = UpAxis::y, .turned = 90.0});
    block.fill(turned);
    std::size_t brightest = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        if (block.light()[i][0] > block.light()[brightest][0]) brightest = i;
    }
    EXPECT_GT(glm::dot(directions.directions[brightest], turned[0].towards_sun), 0.9f);
    EXPECT_EQ(turned[0].sun_place, directions.nearest(turned[0].towards_sun));
}

}  // namespace
