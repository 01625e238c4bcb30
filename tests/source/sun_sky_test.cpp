#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <lightcuts/source/sun_sky.hpp>
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
using std::numbers::pi;

double luminance(const V& rgb) { return 0.2126 * double(rgb.x) + 0.7152 * double(rgb.y) + 0.0722 * double(rgb.z); }

glm::dvec3 direction(double elevation, double azimuth) {
    const double up = elevation * std::numbers::pi / 180.0, around = azimuth * std::numbers::pi / 180.0;
    return {std::sin(around) * std::cos(up), std::sin(up), std::cos(around) * std::cos(up)};
}

glm::dvec3 sum_of(const std::vector<DistantLight<>>& lights) {
    glm::dvec3 sum(0.0);
    for (const auto& l : lights) sum += glm::dvec3(l.intensity);
    return sum;
}

TEST(Daylight, OfTheSunOutsideTheAirIs130000Lux) {
    double y = 0.0;
    for (std::size_t i = 0; i < detail::sun_spectrum.size(); ++i) {
        y += 683.0 * 10.0 * 100.0 * detail::sun_spectrum[i] * detail::color_matching(detail::wavelength_of(i)).y;
    }
    EXPECT_NEAR(y * SunSky::sun_solid_angle, 130e3, 5e3);
}

TEST(Daylight, MatchesEqualEnergyToEqualColors) {
    glm::dvec3 sum(0.0);
    for (int nm = 380; nm <= 750; ++nm) sum += detail::color_matching(nm);
    EXPECT_NEAR(sum.y, 106.86, 0.5);  // the CIE's own sum
    EXPECT_NEAR(sum.x / sum.y, 1.0, 0.01);
    EXPECT_NEAR(sum.z / sum.y, 1.0, 0.01);
    const glm::dvec3 white = detail::rgb_of_xyz({0.95047, 1.0, 1.08883});  // D65
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 1.0, 1e-3);
}

TEST(SunSky, HasTheZenithLuminanceOfThePaper) {
    // Turbidity 3, sun at 45 degrees: chi = (4/9 - 1/40) pi/2 = 0.658863, tan = 0.774788, so
    // Y = (12.1359 - 4.9710) 0.774788 - 0.6465 + 2.4192 = 7.32398 kcd/m^2.
    const SunSky daylight({45.0, 0.0, 3.0});
    EXPECT_NEAR(luminance(daylight.sky_radiance({0.0, 1.0, 0.0})) * SunSky::efficacy, 7324.0, 10.0);
}

TEST(SunSky, HasTheLuminanceDistributionOfThePaper) {
    // Turbidity 3: A to E are -0.9269, -0.6387, 5.2570, -2.2153, 0.1693. The sun stands at 45 degrees, the eye looks 60
    // degrees from the zenith the other way, 105 degrees from the sun.
    const SunSky daylight({45.0, 0.0, 3.0});
    const auto distribution = [](double zenith, double to_sun) {
        const double cosine = std::cos(to_sun);
        return (1.0 - 0.9269 * std::exp(-0.6387 / std::cos(zenith))) *
               (1.0 + 5.2570 * std::exp(-2.2153 * to_sun) + 0.1693 * cosine * cosine);
    };
    const double expected = distribution(pi / 3.0, pi * 105.0 / 180.0) / distribution(0.0, pi / 4.0);
    const double zenith = luminance(daylight.sky_radiance({0.0, 1.0, 0.0}));
    EXPECT_NEAR(luminance(daylight.sky_radiance(direction(30.0, 180.0))) / zenith, expected, 2e-3 * expected);
}

TEST(SunSky, IsAsBrightAsDaylight) {
    const SunSky daylight({60.0, 30.0, 3.0});
    // On the ground: sun 60 to 100 klx, the model's sky 10 to 40 klx.
    const double sun = luminance(daylight.sun_irradiance()) * std::sin(std::numbers::pi / 3.0) * SunSky::efficacy;
    double sky = 0.0;
    for (const auto& l : sky_lights(daylight, 1000)) sky += luminance(l.intensity) * -double(l.direction.y);
    EXPECT_GT(sun, 60e3);
    EXPECT_LT(sun, 100e3);
    EXPECT_GT(sky * SunSky::efficacy, 10e3);
    EXPECT_LT(sky * SunSky::efficacy, 40e3);
    // The disc is brighter than the sky beside it by orders of magnitude.
    EXPECT_GT(luminance(daylight.sun_radiance()), 1e4 * luminance(daylight.sky_radiance(daylight.towards_sun())));
}

TEST(SunSky, StandsWhereItIsAsked) {
    const SunSky daylight({30.0, 90.0, 4.0});
    EXPECT_NEAR(glm::distance(daylight.towards_sun(), glm::dvec3(std::sqrt(0.75), 0.5, 0.0)), 0.0, 1e-12);
    // The sky is brightest at the sun.
    double brightest = 0.0;
    glm::dvec3 there(0.0);
    for (int up = 1; up < 90; ++up) {
        for (int around = 0; around < 360; ++around) {
            const double here = luminance(daylight.sky_radiance(direction(up, around)));
            if (here > brightest) {
                brightest = here;
                there = direction(up, around);
            }
        }
    }
    EXPECT_GT(glm::dot(there, daylight.towards_sun()), std::cos(0.1));
    // Darker away from it, until the far side of the sky.
    double last = brightest;
    for (int angle = 5; angle <= 90; angle += 5) {
        const double here = luminance(daylight.sky_radiance(direction(30.0, 90.0 + angle)));
        EXPECT_LT(here, last) << angle;
        last = here;
    }
    EXPECT_EQ(daylight.sky_radiance(direction(-1.0, 90.0)), V(0.0f));
    EXPECT_EQ(daylight.radiance(daylight.towards_sun()),
              daylight.sky_radiance(daylight.towards_sun()) + daylight.sun_radiance());
    EXPECT_EQ(daylight.radiance(direction(31.0, 90.0)), daylight.sky_radiance(direction(31.0, 90.0)));
}

TEST(SunSky, IsBlueAwayFromTheSunAndReddensTowardsSunset) {
    const SunSky noon({60.0, 0.0, 2.5});
    const V away = noon.sky_radiance(direction(60.0, 180.0));
    EXPECT_GT(away.z, 1.5f * away.x);
    double last = 0.0;
    for (const double elevation : {80.0, 40.0, 20.0, 10.0, 5.0, 2.0}) {
        const V sun = SunSky({elevation, 0.0, 3.0}).sun_radiance();
        EXPECT_GT(double(sun.x) / double(sun.y), last) << elevation;
        last = double(sun.x) / double(sun.y);
    }
}

TEST(SunSky, IsFiniteAndNotNegativeAnywhere) {
    for (double turbidity = 2.0; turbidity <= 10.0; turbidity += 1.0) {
        for (const double elevation : {0.0, 0.1, 5.0, 45.0, 89.9, 90.0}) {
            const SunSky daylight({elevation, 10.0, turbidity});
            std::vector<V> seen{daylight.sun_radiance()};
            for (const double up : {1e-300, 1e-12, 1e-6, 1e-3, 1.0, 30.0, 60.0, 89.0, 90.0}) {
                for (double around = 0.0; around < 360.0; around += 15.0) {
                    seen.push_back(daylight.sky_radiance(direction(up, around)));
                }
            }
            seen.push_back(daylight.sky_radiance(daylight.towards_sun()));
            for (const V& radiance : seen) {
                EXPECT_TRUE(is_finite(radiance)) << turbidity << " " << elevation;
                EXPECT_GE(std::min({radiance.x, radiance.y, radiance.z}), 0.0f);
            }
            EXPECT_EQ(sky_lights(daylight, 50, 16).size(), 50u);
        }
    }
}

TEST(SunLights, CoverTheDiscAndKeepItsPower) {
    for (const double elevation : {3.0, 50.0, 90.0}) {
        const SunSky daylight({elevation, 200.0, 3.0});
        const auto lights = sun_lights(daylight);
        ASSERT_EQ(lights.size(), 64u);
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(sum_of(lights)[i], double(daylight.sun_irradiance()[i]),
                        1e-5 * double(daylight.sun_irradiance()[i]));
        }
        Mean radius2;
        for (const auto& l : lights) {
            const double sine = glm::length(glm::cross(-glm::dvec3(l.direction), daylight.towards_sun()));
            EXPECT_LT(sine, SunSky::sun_radius * 1.0001);
            EXPECT_LT(glm::dot(glm::dvec3(l.direction), daylight.towards_sun()), 0.0);
            radius2.add(sine * sine / (SunSky::sun_radius * SunSky::sun_radius));
        }
        EXPECT_NEAR(radius2.value(), 0.5, 0.02) << "uniform over a disc";
    }
}

TEST(SkyLights, KeepTheSkysPower) {
    const SunSky daylight({25.0, -70.0, 3.0});
    glm::dvec3 truth(0.0);  // midpoints, equal steps of sine and azimuth
    for (int i = 0; i < 400; ++i) {
        for (int j = 0; j < 800; ++j) {
            const double up = std::asin((i + 0.5) / 400.0) * 180.0 / std::numbers::pi;
            truth += glm::dvec3(daylight.sky_radiance(direction(up, j * 0.45))) * (2.0 * std::numbers::pi / 320000.0);
        }
    }
    const auto lights = sky_lights(daylight, 5000);
    ASSERT_EQ(lights.size(), 5000u);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum_of(lights)[i] / truth[i], 1.0, 1e-3);
    for (const auto& l : lights) EXPECT_LT(l.direction.y, 0.0f) << "from above";
}

constexpr V grass(0.1f, 0.3f, 0.05f);

/// Irradiance on a plane with the unit normal.
glm::dvec3 irradiance(const std::vector<DistantLight<>>& lights, const glm::dvec3& normal) {
    glm::dvec3 sum(0.0);
    for (const auto& l : lights) {
        sum += glm::dvec3(l.intensity) * std::max(0.0, -glm::dot(glm::dvec3(l.direction), normal));
    }
    return sum;
}

void expect_near_relative(const glm::dvec3& value, const glm::dvec3& expected, double allowed) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], allowed * expected[c]) << c;
}

TEST(SkyIrradiance, IsTheIntegralOfRadiance) {
    for (const double turbidity : {2.0, 3.0, 10.0}) {
        for (const double elevation : {0.0, 20.0, 90.0}) {
            const SunSky daylight({elevation, 77.0, turbidity});
            glm::dvec3 truth(0.0);  // midpoints of elevation and azimuth
            constexpr int rings = 600, steps = 600;
            for (int i = 0; i < rings; ++i) {
                const double up = 90.0 * (i + 0.5) / rings, radians = up * pi / 180.0;
                for (int j = 0; j < steps; ++j) {
                    truth += glm::dvec3(daylight.sky_radiance(direction(up, 360.0 * (j + 0.5) / steps))) *
                             (std::sin(radians) * std::cos(radians) * (pi / 2 / rings) * (2 * pi / steps));
                }
            }
            SCOPED_TRACE(testing::Message() << turbidity << " " << elevation);
            expect_near_relative(glm::dvec3(daylight.sky_irradiance()), truth, 1.1e-4);
            expect_near_relative(irradiance(sky_lights(daylight, 5000), {0, 1, 0}), truth, 1e-2);
        }
    }
}

TEST(Ground, ReflectsSunAndSky) {
    const SunSky daylight({35.0, 20.0, 3.0}, grass);
    const glm::dvec3 level = glm::dvec3(daylight.sun_irradiance()) * std::sin(35.0 * pi / 180.0) +
                             glm::dvec3(daylight.sky_irradiance());
    expect_near_relative(glm::dvec3(daylight.ground_radiance()), glm::dvec3(grass) * level / pi, 1e-5);
    // It is seen everywhere below the horizon and nowhere above.
    const SunSky bare({35.0, 20.0, 3.0});
    EXPECT_EQ(bare.ground_radiance(), V(0.0f));
    for (double around = 0.0; around < 360.0; around += 40.0) {
        for (const double down : {0.0, 1e-3, 1.0, 40.0, 90.0}) {
            EXPECT_EQ(daylight.radiance(direction(-down, around)), daylight.ground_radiance());
            EXPECT_EQ(bare.radiance(direction(-down, around)), V(0.0f));
            EXPECT_EQ(daylight.sky_radiance(direction(-down, around)), V(0.0f));
        }
        for (const double up : {1e-3, 1.0, 35.0, 90.0}) {
            EXPECT_EQ(daylight.radiance(direction(up, around)), bare.radiance(direction(up, around)));
        }
    }
    EXPECT_GT(bare.radiance(bare.towards_sun()).x, 1000.0f);
}

TEST(GroundLights, AreTheGroundThatIsSeen) {
    const SunSky daylight({35.0, 20.0, 3.0}, grass);
    const glm::dvec3 radiance(daylight.ground_radiance());
    for (const std::size_t count : {1u, 7u, 100u, 5000u}) {
        SCOPED_TRACE(count);
        const auto lights = ground_lights(daylight, count, CenteredSobol{count});
        ASSERT_EQ(lights.size(), count);
        for (const auto& l : lights) {
            EXPECT_GT(l.direction.y, 0.0f) << "from below";
            EXPECT_NEAR(glm::length(l.direction), 1.0f, 1e-6f);
            EXPECT_EQ(l.intensity, lights.front().intensity);
        }
        expect_near_relative(sum_of(lights), radiance * 2.0 * pi, 1e-5);
        expect_near_relative(irradiance(lights, {0, -1, 0}), radiance * pi, 1e-4);
        // A plane that looks up gets the same as without ground.
        EXPECT_EQ(irradiance(lights, {0, 1, 0}), glm::dvec3(0.0));
    }
    // Walls on all sides get half of what a ceiling gets.
    const auto lights = ground_lights(daylight, 1000);
    for (double around = 0.0; around < 360.0; around += 15.0) {
        expect_near_relative(irradiance(lights, direction(0.0, around)), radiance * (pi / 2.0), 0.01);
    }
    EXPECT_TRUE(ground_lights(daylight, 0).empty());
}

TEST(Ground, HasAnAlbedoFromBlackToWhite) {
    const auto refused = [](const V& albedo) {
        try {
            const SunSky daylight({45.0, 0.0, 3.0}, albedo);
        } catch (const invalid_input& e) { return std::string(e.what()); }
        return std::string();
    };
    using testing::HasSubstr;
    EXPECT_EQ(refused(V(1.0f)), "");
    EXPECT_EQ(refused(V(0.0f)), "");
    EXPECT_THAT(refused({0.2f, 1.1f, 0.2f}), HasSubstr("albedo 1.100000 is not in 0 to 1"));
    EXPECT_THAT(refused({-0.1f, 0.2f, 0.2f}), HasSubstr("albedo -0.100000"));
    EXPECT_THAT(refused(V(std::numeric_limits<float>::quiet_NaN())), HasSubstr("albedo"));
}

std::string refusal(const SunPosition& position) {
    try {
        const SunSky daylight(position);
    } catch (const invalid_input& e) { return e.what(); }
    return "";
}

TEST(SunSky, RefusesNightAndStrangeAir) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal({-0.5, 0.0, 3.0}), HasSubstr("elevation -0.500000 is not in 0 to 90"));
    EXPECT_THAT(refusal({91.0, 0.0, 3.0}), HasSubstr("elevation"));
    EXPECT_THAT(refusal({std::numeric_limits<double>::quiet_NaN(), 0.0, 3.0}), HasSubstr("elevation"));
    EXPECT_THAT(refusal({45.0, std::numeric_limits<double>::infinity(), 3.0}), HasSubstr("azimuth"));
    EXPECT_THAT(refusal({45.0, 0.0, 1.0}), HasSubstr("turbidity 1.000000 is not in 2 to 10"));
    EXPECT_EQ(refusal({0.0, 720.0, 10.0}), "");
}

}  // namespace
}  // namespace lightcuts::test
