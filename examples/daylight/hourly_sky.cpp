#include "hourly_sky.hpp"

#include <cmath>
#include <numbers>

#include <lightcuts/core/assertion.hpp>

namespace daylighting {
namespace {

/// `v` of a scene that is turned clockwise, seen from above, as it lies under the sky; and back with `turned` negated.
glm::dvec3 turn(const glm::dvec3& v, double turned) {
    const double angle = turned * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
    return {c * v.x + s * v.y, c * v.y - s * v.x, v.z};
}

}  // namespace

std::vector<LitHour> lit_hours(const Weather& weather, const DirectionTree& directions, const Setting& setting) {
    std::vector<LitHour> result;
    for (std::size_t i = 0; i < weather.hours.size(); ++i) {
        const WeatherHour& hour = weather.hours[i];
        LitHour lit;
        lit.hour = i;
        lit.sky = AllWeatherSky({.towards_sun = towards_sun(weather.place, hour.middle()),
                                 .direct_normal = hour.direct_normal,
                                 .diffuse_horizontal = hour.diffuse_horizontal,
                                 .dew_point = hour.dew_point,
                                 .day_of_year = day_of_year(hour.year, hour.month, hour.day)});
        if (!(lit.sky.diffuse_illuminance() > 0.0) && !lit.has_sun()) continue;
        const glm::dvec3 in_scene = from_compass(turn(lit.sky.towards_sun(), -setting.turned), setting.up);
        lit.towards_sun = glm::vec3(in_scene);
        if (lit.has_sun()) lit.sun_place = directions.nearest(lit.towards_sun);
        result.push_back(lit);
    }
    return result;
}

SkyBlock::SkyBlock(const DirectionTree& directions, const Setting& setting)
    : directions_(directions), setting_(setting), light_(directions.size()), luminances_(directions.size()) {
    compass_.reserve(directions.size());
    for (const glm::vec3& d : directions.directions) {
        compass_.push_back(turn(to_compass(glm::dvec3(d), setting.up), setting.turned));
    }
}

void SkyBlock::fill(std::span<const LitHour> hours) {
    LIGHTCUTS_ASSERT(hours.size() <= block_hours);
    const double solid_angle = directions_.solid_angle();
    for (std::size_t h = 0; h < block_hours; ++h) {
        if (h >= hours.size()) {
            for (HourValues& light : light_) light[h] = 0.0f;
            continue;
        }
        const AllWeatherSky& sky = hours[h].sky;
        double level = 0.0;
        for (std::size_t i = 0; i < compass_.size(); ++i) {
            luminances_[i] = compass_[i].z > 0.0 ? sky.relative_luminance(compass_[i]) : 0.0;
            level += luminances_[i] * compass_[i].z;
        }
        const double scale = level > 0.0 ? sky.diffuse_illuminance() / level : 0.0;
        const double on_ground = sky.diffuse_illuminance() +
                                 sky.direct_illuminance() * std::max(0.0, sky.towards_sun().z);
        const double ground = setting_.ground_albedo * std::numbers::inv_pi * on_ground * solid_angle;
        for (std::size_t i = 0; i < compass_.size(); ++i) {
            light_[i][h] = static_cast<float>(compass_[i].z > 0.0 ? luminances_[i] * scale : ground);
        }
    }
}

}  // namespace daylighting
