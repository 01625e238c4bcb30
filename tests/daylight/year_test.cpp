#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <daylight/annual.hpp>
#include <daylight/sensor_cuts.hpp>
#include <daylight/sun_rays.hpp>
#include <daylight/visibility.hpp>
#include <daylight/year.hpp>

#include "daylight/rooms.hpp"

namespace {

using namespace daylighting;

Weather week() { return read_epw(std::string(LIGHTCUTS_TEST_DIRECTORY) + "/daylight/week.epw"); }

/// Sensors in a room with the cuts and the visibility of each.
struct Traced {
    DirectionTree directions = make_direction_tree(8192);
    SensorSet sensors;
    std::vector<SensorCuts> cuts;
    std::vector<std::vector<float>> visibility;

    Traced(const render::Scene& scene, std::vector<Sensor> all, double error) {
        sensors.sensors = std::move(all);
        const render::RayScene rays(scene);
        const VisibilityTracer tracer(scene, rays, directions);
        VisibilityTracer::Scratch scratch;
        CutMaker maker;
        for (const Sensor& sensor : sensors.sensors) {
            const Facing facing(directions, sensor.normal);
            visibility.emplace_back();
            tracer.trace(sensor, facing, visibility.back(), scratch);
            cuts.emplace_back();
            maker.make(directions, facing, visibility.back(), error, cuts.back());
        }
    }
    CutMatrix matrix() const {
        return CutMatrix(sensors.sensors, [this](std::size_t i, auto& out) { out = cuts[i].sky; });
    }
};

TEST(Year, gives_an_open_level_sensor_what_the_weather_says) {
    const Weather weather = week();
    Room field = open_field();
    const Traced traced(field.scene(), {{{0, 0, 0}, {0, 1, 0}}}, 0.1);
    const std::vector<LitHour> hours = lit_hours(weather, traced.directions, {});
    ASSERT_GT(hours.size(), 80u);
    Illuminances lux = sky_light(traced.matrix(), traced.directions, hours, {});
    for (std::size_t h = 0; h < hours.size(); ++h) {
        EXPECT_NEAR(lux.of(0)[h], hours[h].diffuse_illuminance, 2e-5 * hours[h].diffuse_illuminance);
    }
    const double sunny = SunList(hours).add(traced.cuts[0].sun, traced.sensors.sensors[0].normal, weather, lux.of(0));
    double bright = 0.0;
    for (std::size_t h = 0; h < hours.size(); ++h) {
        const double all = hours[h].diffuse_illuminance + hours[h].direct_illuminance * std::max(0.0, hours[h].sun.z);
        EXPECT_NEAR(lux.of(0)[h], all, 3e-5 * all);
        bright += hours[h].has_sun() && weather.hours[hours[h].hour].direct_normal >= 120.0 ? 1.0 : 0.0;
    }
    EXPECT_EQ(sunny, bright);
    EXPECT_GT(sunny, 10.0);
}

TEST(Year, agrees_with_the_sum_over_all_directions) {
    const Weather weather = week();
    Room shed = open_shed();
    std::vector<Sensor> sensors;
    for (double x = -2.4; x < 2.5; x += 1.2) {
        sensors.push_back({{x, 0, 0}, {0, 1, 0}});
        sensors.push_back({{x, 0.5, 2}, {0, 0, 1}});
    }
    for (const double error : {0.0, 0.1, 0.3}) {
        const Traced traced(shed.scene(), sensors, error);
        const Setting setting{.up = UpAxis::y, .turned = 20.0, .ground_albedo = 0.3};
        const std::vector<LitHour> hours = lit_hours(weather, traced.directions, setting);
        const Illuminances lux = sky_light(traced.matrix(), traced.directions, hours, setting);
        SkyBlock block(traced.directions, setting);
        double squared = 0.0, all = 0.0;
        for (std::size_t first = 0; first < hours.size(); first += block_hours) {
            const std::size_t count = std::min(block_hours, hours.size() - first);
            block.fill(std::span(hours).subspan(first, count));
            for (std::size_t s = 0; s < sensors.size(); ++s) {
                const Facing facing(traced.directions, sensors[s].normal);
                for (std::size_t h = 0; h < count; ++h) {
                    double sum = 0.0;
                    for (std::size_t i = 0; i < traced.directions.size(); ++i) {
                        sum += static_cast<double>(traced.visibility[s][i] * facing.cosines()[i] * block.light()[i][h]);
                    }
                    const double off = static_cast<double>(lux.of(s)[first + h]) - sum;
                    squared += off * off;
                    all += sum * sum;
                }
            }
        }
        EXPECT_LT(std::sqrt(squared / all), error == 0.0 ? 1e-5 : 0.1 * error) << error;
    }
}

TEST(Year, puts_the_sun_where_it_is_seen) {
    // A window to the south that is a slit: the sun comes in about noon, and only then.
    Weather weather = week();
    for (WeatherHour& hour : weather.hours) hour.direct_normal = 800.0;
    Room room = open_field();
    room.quad({-500, -1, 1}, {-0.2f, -1, 1}, {-0.2f, 500, 1}, {-500, 500, 1});
    room.quad({0.2f, -1, 1}, {500, -1, 1}, {500, 500, 1}, {0.2f, 500, 1});
    const Traced traced(room.scene(), {{{0, 0, 0}, {0, 1, 0}}}, 0.1);
    const std::vector<LitHour> hours = lit_hours(weather, traced.directions, {});
    std::vector<float> lux(hours.size(), 0.0f);
    SunList(hours).add(traced.cuts[0].sun, {0, 1, 0}, weather, lux);
    for (std::size_t h = 0; h < hours.size(); ++h) {
        const glm::vec3 sun = hours[h].towards_sun;
        // The slit leaves 11 degrees of azimuth to either side free; directions are a degree and a half apart.
        const float azimuth = std::abs(std::atan2(sun.x, sun.z));
        if (std::abs(sun.z) < 0.05f || (sun.z > 0.0f && azimuth > 0.16f && azimuth < 0.235f)) continue;
        const bool seen = (sun.z > 0.0f && azimuth < 0.2f) || sun.z <= 0.0f;
        EXPECT_EQ(lux[h] > 0.0f, seen && hours[h].has_sun()) << sun.x << " " << sun.y << " " << sun.z;
    }
}

TEST(SunRays, are_exact_where_the_nearest_direction_is_not) {
    // The same slit by rays: at every azimuth but those within rounding of its edges.
    Weather weather = week();
    for (WeatherHour& hour : weather.hours) hour.direct_normal = 800.0;
    Room room = open_field();
    room.quad({-500, -1, 1}, {-0.2f, -1, 1}, {-0.2f, 500, 1}, {-500, 500, 1});
    room.quad({0.2f, -1, 1}, {500, -1, 1}, {500, 500, 1}, {0.2f, 500, 1});
    const Sensor sensor{{0, 0, 0}, {0, 1, 0}};
    const DirectionTree directions = make_direction_tree(64);
    const std::vector<LitHour> hours = lit_hours(weather, directions, {});
    const render::RayScene rays(room.scene());
    const SunRays suns(room.scene(), rays, hours);
    SunRays::Scratch scratch;
    std::vector<float> lux(hours.size(), 0.0f);
    const double shining = suns.add(sensor, weather, lux, scratch);
    double expected = 0.0;
    for (std::size_t h = 0; h < hours.size(); ++h) {
        const glm::vec3 sun = hours[h].towards_sun;
        const bool seen = hours[h].has_sun() && (sun.z <= 0.0f || std::abs(sun.x) < 0.2f * sun.z);
        const double all = hours[h].direct_illuminance * static_cast<double>(sun.y);
        EXPECT_NEAR(lux[h], seen ? all : 0.0, 1e-4 * std::abs(all)) << sun.x << " " << sun.z;
        expected += seen ? 1.0 : 0.0;
    }
    EXPECT_EQ(shining, expected);
    EXPECT_GT(shining, 5.0);
}

TEST(Year, does_not_depend_on_Threads) {
    const Weather weather = week();
    Room shed = open_shed();
    const Traced traced(shed.scene(), {{{0, 0, 0}, {0, 1, 0}}, {{1, 0, 1}, {0, 0, 1}}}, 0.1);
    const std::vector<LitHour> hours = lit_hours(weather, traced.directions, {});
    const auto lux = [&](int threads) {
        tbb::task_arena arena(threads);
        return arena.execute([&] { return sky_light(traced.matrix(), traced.directions, hours, {}).lux; });
    };
    EXPECT_EQ(lux(1), lux(2));
    EXPECT_EQ(lux(1), lux(4));
}

TEST(AnnualFigures, count_hours_of_use) {
    Weather weather;
    for (int day = 1; day <= 2; ++day) {
        for (int hour = 1; hour <= 24; ++hour) weather.hours.push_back({2001, 6, day, hour});
    }
    // Lit from 9 to 15 o'clock.
    std::vector<LitHour> hours;
    for (std::size_t h = 0; h < weather.hours.size(); ++h) {
        if (weather.hours[h].hour < 10 || weather.hours[h].hour > 15) continue;
        hours.emplace_back();
        hours.back().hour = h;
    }
    ASSERT_EQ(hours.size(), 12u);
    const std::vector<float> lux = {50, 100, 300, 2000, 3000, 5000, 99, 299, 301, 2001, 3001, 0};
    const AnnualFigures f = annual_figures(weather, hours, lux, {8, 18}, 300.0, 7.0);
    EXPECT_NEAR(f.mean, (50 + 100 + 300 + 2000 + 3000 + 5000 + 99 + 299 + 301 + 2001 + 3001) / 20.0, 1e-9);
    EXPECT_NEAR(f.autonomy, 7.0 / 20.0, 1e-12);
    EXPECT_NEAR(f.useful_to_2000, 5.0 / 20.0, 1e-12);
    EXPECT_NEAR(f.useful_to_3000, 7.0 / 20.0, 1e-12);
    EXPECT_NEAR(f.too_dark, (3.0 + 8.0) / 20.0, 1e-12);
    EXPECT_NEAR(f.too_bright, 2.0 / 20.0, 1e-12);
    EXPECT_NEAR(f.too_dark + f.useful_to_3000 + f.too_bright, 1.0, 1e-12);
    EXPECT_EQ(f.sun_hours, 7.0);
    const AnnualFigures noon = annual_figures(weather, hours, lux, {12, 13}, 300.0, 0.0);
    EXPECT_NEAR(noon.autonomy, 1.0, 1e-12);
}

}  // namespace
