#include "hourly_sky.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <lightcuts/core/assertion.hpp>

#include "all_weather_sky.hpp"
#include "cie_sky.hpp"
#include "reinhart_patches.hpp"

namespace daylighting {
namespace {

/// `v` of a scene that is turned clockwise, seen from above, as it lies under the sky; and back with `turned` negated.
glm::dvec3 turn(const glm::dvec3& v, double turned) {
    const double angle = turned * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
    return {c * v.x + s * v.y, c * v.y - s * v.x, v.z};
}

/// Hour `i` of `weather` with its sun.
LitHour hour_of(const Weather& weather, std::size_t i, const Setting& setting) {
    const WeatherHour& hour = weather.hours[i];
    const AllWeatherSky sky({.towards_sun = towards_sun(weather.place, hour.middle()),
                             .direct_normal = hour.direct_normal,
                             .diffuse_horizontal = hour.diffuse_horizontal,
                             .dew_point = hour.dew_point,
                             .day_of_year = day_of_year(hour.year, hour.month, hour.day)});
    return {.hour = i,
            .sun = sky.towards_sun(),
            .direct_illuminance = sky.direct_illuminance(),
            .diffuse_illuminance = sky.diffuse_illuminance(),
            .shape = sky.shape(),
            .towards_sun = glm::vec3(from_compass(turn(sky.towards_sun(), -setting.turned), setting.up))};
}

/// Appends `hour` to `hours` if it has any light.
void add(LitHour hour, const DirectionTree& directions, std::vector<LitHour>& hours) {
    if (!(hour.diffuse_illuminance > 0.0) && !hour.has_sun()) return;
    if (hour.has_sun()) hour.sun_place = directions.nearest(hour.towards_sun);
    hours.push_back(hour);
}

}  // namespace

std::vector<LitHour> lit_hours(const Weather& weather, const DirectionTree& directions, const Setting& setting,
                               std::optional<int> cie_type) {
    std::vector<LitHour> result;
    std::optional<SkyShape> shape;
    if (cie_type) shape = cie_sky(*cie_type);
    for (std::size_t i = 0; i < weather.hours.size(); ++i) {
        LitHour hour = hour_of(weather, i, setting);
        if (shape) hour.shape = *shape;
        add(hour, directions, result);
    }
    return result;
}

std::vector<LitHour> lit_hours(const SkyMatrix& skies, const Weather& weather, const DirectionTree& directions,
                               const Setting& setting) {
    LIGHTCUTS_ASSERT(skies.hours == weather.hours.size());
    const ReinhartPatches patches(skies.division);
    std::vector<LitHour> result;
    for (std::size_t i = 0; i < weather.hours.size(); ++i) {
        LitHour hour = hour_of(weather, i, setting);
        hour.patches = skies.of(i);
        hour.diffuse_illuminance = 0.0;
        for (std::size_t p = 1; p < patches.size(); ++p) {
            hour.diffuse_illuminance += static_cast<double>(hour.patches[p]) * patches.projected(p);
        }
        add(hour, directions, result);
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
        const LitHour& hour = hours[h];
        double ground = 0.0;
        if (hour.patches.empty()) {
            for (std::size_t i = 0; i < compass_.size(); ++i) {
                luminances_[i] = compass_[i].z > 0.0 ? hour.shape.luminance(compass_[i], hour.sun) : 0.0;
            }
            const double on_ground = hour.diffuse_illuminance + hour.direct_illuminance * std::max(0.0, hour.sun.z);
            ground = setting_.ground_albedo * std::numbers::inv_pi * on_ground * solid_angle;
        } else {
            if (!patch_light_) {
                patch_light_.emplace(ReinhartPatches(*ReinhartPatches::division_of(hour.patches.size())), compass_);
            }
            patch_light_->spread(hour.patches, luminances_);
            ground = static_cast<double>(hour.patches[0]) * solid_angle;
        }
        // A sky's shape is given by its illuminance. Patches have the light that they have: scaling all of them would
        // let a bright one by the horizon, where few directions say how it lights the ground, change the whole sky.
        double scale = 1.0;
        if (hour.patches.empty()) {
            double level = 0.0;
            for (std::size_t i = 0; i < compass_.size(); ++i) level += luminances_[i] * std::max(0.0, compass_[i].z);
            scale = level > 0.0 ? hour.diffuse_illuminance / level : 0.0;
        }
        for (std::size_t i = 0; i < compass_.size(); ++i) {
            light_[i][h] = static_cast<float>(compass_[i].z > 0.0 ? luminances_[i] * scale : ground);
        }
    }
}

}  // namespace daylighting
