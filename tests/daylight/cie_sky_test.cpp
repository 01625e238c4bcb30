#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <daylight/cie_sky.hpp>
#include <daylight/hourly_sky.hpp>
#include <glm/geometric.hpp>
#include <render/refusal.hpp>

namespace {

using namespace daylighting;
using ::testing::HasSubstr;

constexpr double pi = std::numbers::pi;

glm::dvec3 at(double elevation, double azimuth) {
    const double up = elevation * pi / 180.0, turn = azimuth * pi / 180.0;
    return {std::cos(up) * std::sin(turn), std::cos(up) * std::cos(turn), std::sin(up)};
}
const glm::dvec3 zenith(0.0, 0.0, 1.0);

/// The illuminance of level ground under a sky, in units of its luminance, by rings of even width.
double relative_illuminance(const SkyShape& shape, const glm::dvec3& sun) {
    constexpr int rings = 400, sectors = 400;
    double sum = 0.0;
    for (int i = 0; i < rings; ++i) {
        const double up = 90.0 * (i + 0.5) / rings, radians = up * pi / 180.0;
        for (int k = 0; k < sectors; ++k) {
            sum += shape.luminance(at(up, 360.0 * k / sectors), sun) * std::sin(radians) * std::cos(radians);
        }
    }
    return sum * (pi / 2.0 / rings) * (2.0 * pi / sectors);
}

/// The standard names each sky by its groups: I to VI of gradations, 1 to 6 of indicatrices.
constexpr std::array<std::pair<int, int>, 15> groups = {{{1, 1},
                                                         {1, 2},
                                                         {2, 1},
                                                         {2, 2},
                                                         {3, 1},
                                                         {3, 2},
                                                         {3, 3},
                                                         {3, 4},
                                                         {4, 2},
                                                         {4, 3},
                                                         {4, 4},
                                                         {5, 4},
                                                         {5, 5},
                                                         {6, 5},
                                                         {6, 6}}};

double gradation(int group, double z) {
    constexpr double a[] = {4.0, 1.1, 0.0, -1.0, -1.0, -1.0}, b[] = {-0.7, -0.8, -1.0, -0.55, -0.32, -0.15};
    return 1.0 + a[group - 1] * std::exp(b[group - 1] / std::cos(z));
}
double indicatrix(int group, double x) {
    constexpr double c[] = {0.0, 2.0, 5.0, 10.0, 16.0, 24.0}, d[] = {-1.0, -1.5, -2.5, -3.0, -3.0, -2.8},
                     e[] = {0.0, 0.15, 0.3, 0.45, 0.3, 0.15};
    return 1.0 + c[group - 1] * (std::exp(d[group - 1] * x) - std::exp(d[group - 1] * pi / 2.0)) +
           e[group - 1] * std::pow(std::cos(x), 2.0);
}

TEST(CieSky, has_the_standards_luminance_over_that_of_the_zenith) {
    for (int type = 1; type <= 15; ++type) {
        const SkyShape sky = cie_sky(type);
        const auto [g, i] = groups[static_cast<std::size_t>(type - 1)];
        for (const double elevation : {0.0, 5.0, 35.0, 70.0, 90.0}) {
            const glm::dvec3 sun = at(elevation, 140.0);
            for (const double height : {2.0, 15.0, 42.0, 80.0}) {
                for (const double azimuth : {0.0, 77.0, 140.0, 320.0}) {
                    const glm::dvec3 direction = at(height, azimuth);
                    const double x = std::acos(std::min(1.0, glm::dot(direction, sun)));
                    const double expected = indicatrix(i, x) * gradation(g, (90.0 - height) * pi / 180.0) /
                                            (indicatrix(i, (90.0 - elevation) * pi / 180.0) * gradation(g, 0.0));
                    EXPECT_NEAR(sky.luminance(direction, sun) / sky.luminance(zenith, sun), expected, 1e-9 * expected)
                        << type << " " << elevation << " " << height << " " << azimuth;
                }
            }
        }
    }
}

TEST(CieSky, is_its_gradation_alone_at_right_angles_to_the_sun) {
    const glm::dvec3 sun = at(30.0, 0.0);
    for (int type = 1; type <= 15; ++type) {
        const SkyShape sky = cie_sky(type);
        const double expected = gradation(groups[static_cast<std::size_t>(type - 1)].first, pi / 6.0);
        EXPECT_NEAR(sky.luminance(at(60.0, 180.0), sun), expected, 1e-12) << type;
    }
}

TEST(CieSky, of_type_5_is_even) {
    const SkyShape sky = cie_sky(5);
    for (const double elevation : {-10.0, 0.0, 45.0, 90.0}) {
        for (const double height : {0.1, 10.0, 60.0, 90.0}) {
            EXPECT_EQ(sky.luminance(at(height, 33.0), at(elevation, 200.0)), 1.0);
        }
    }
    EXPECT_NEAR(relative_illuminance(sky, zenith), pi, 1e-4);
}

TEST(CieSky, of_type_16_is_the_traditional_overcast_sky_and_type_1_is_near_it) {
    const SkyShape traditional = cie_sky(16), general = cie_sky(1);
    double farthest = 0.0;
    for (double height = 0.0; height <= 90.0; height += 0.25) {
        const glm::dvec3 direction = at(height, 120.0), sun = at(20.0, 120.0);
        const double expected = (1.0 + 2.0 * direction.z) / 3.0;
        EXPECT_NEAR(traditional.luminance(direction, sun) / traditional.luminance(zenith, sun), expected, 1e-12);
        farthest = std::max(farthest,
                            std::abs(general.luminance(direction, sun) / general.luminance(zenith, sun) - expected));
    }
    EXPECT_NEAR(farthest, 0.0915, 1e-4);
    // The horizon has 1 / (1 + 4 exp(-0.7)) of the zenith's luminance, not a third.
    EXPECT_NEAR(general.luminance(at(1e-9, 0.0), zenith) / general.luminance(zenith, zenith),
                1.0 / (1.0 + 4.0 * std::exp(-0.7)), 1e-9);
    // Its illuminance is known: 7 pi / 9 of the zenith's luminance.
    EXPECT_NEAR(relative_illuminance(traditional, zenith), 3.0 * 7.0 * pi / 9.0, 1e-4);
}

TEST(CieSky, is_finite_and_not_negative_wherever_the_sun_is) {
    for (int type = 1; type <= cie_sky_count; ++type) {
        for (const double elevation : {-90.0, -18.0, 0.0, 1e-9, 45.0, 90.0}) {
            for (const double height : {0.0, 1e-9, 1.0, 45.0, 90.0}) {
                for (const double azimuth : {0.0, 90.0, 180.0}) {
                    const double l = cie_sky(type).luminance(at(height, azimuth), at(elevation, 0.0));
                    EXPECT_TRUE(std::isfinite(l) && l >= 0.0) << type << " " << elevation << " " << height;
                }
            }
        }
    }
}

TEST(CieSky, of_no_type_is_refused) {
    for (const int type : {-1, 0, 17}) {
        EXPECT_THAT(refusal([&] { cie_sky(type); }), HasSubstr("the CIE has no standard sky"));
    }
}

TEST(CieSky, is_scaled_to_the_weathers_illuminance) {
    // Each direction's luminance against that which a finer rule for the illuminance of level ground gives.
    const DirectionTree directions = make_direction_tree(16384);
    Weather weather;
    weather.place = {48.0, 0.0, 0.0};
    weather.hours.push_back({2001, 3, 21, 10, 5.0, 600.0, 130.0});
    const Setting setting{.up = UpAxis::z};
    SkyBlock block(directions, setting);
    const std::vector<LitHour> perez = lit_hours(weather, directions, setting);
    for (int type = 1; type <= cie_sky_count; ++type) {
        const std::vector<LitHour> hours = lit_hours(weather, directions, setting, type);
        ASSERT_EQ(hours.size(), 1u);
        EXPECT_EQ(hours[0].diffuse_illuminance, perez[0].diffuse_illuminance);
        EXPECT_EQ(hours[0].direct_illuminance, perez[0].direct_illuminance);
        block.fill(hours);
        const SkyShape sky = cie_sky(type);
        const double scale = hours[0].diffuse_illuminance / relative_illuminance(sky, hours[0].sun);
        for (std::size_t i = 0; i < directions.size(); i += 97) {
            const glm::dvec3 d(directions.directions[i]);
            if (!(d.z > 0.0)) continue;
            const double expected = scale * sky.luminance(d, hours[0].sun);
            EXPECT_NEAR(static_cast<double>(block.light()[i][0]) / directions.solid_angle(), expected, 1e-3 * expected)
                << type;
        }
    }
}

}  // namespace
