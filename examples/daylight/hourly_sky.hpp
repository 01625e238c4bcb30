#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "all_weather_sky.hpp"
#include "direction_tree.hpp"
#include "sensors.hpp"
#include "weather.hpp"

namespace daylighting {

/// How a scene lies under the sky.
struct Setting {
    UpAxis up = UpAxis::y;
    double turned = 0.0;         ///< degrees by which its north is turned from true north towards the east
    double ground_albedo = 0.2;  ///< share of the light that ground reflects, which lies below the horizon everywhere
};

/// An hour with light.
struct LitHour {
    std::size_t hour = 0;  ///< in the weather's list
    AllWeatherSky sky{SkyConditions{}};
    glm::vec3 towards_sun{0.0f, 1.0f, 0.0f};  ///< in the scene's axes
    std::uint32_t sun_place = 0;              ///< of the direction nearest to the sun's

    bool has_sun() const { return sky.direct_illuminance() > 0.0; }
};

/// The hours of `weather` that have any light, in their order. cost: a pass over the directions an hour
std::vector<LitHour> lit_hours(const Weather& weather, const DirectionTree& directions, const Setting& setting);

/// Hours that are handled at once.
inline constexpr std::size_t block_hours = 16;
using HourValues = std::array<float, block_hours>;

/// The light of up to 16 skies from each direction: luminance x solid angle, lux on a plane that faces it. Suns are not
/// in it. What comes from all directions above the horizon has on level ground exactly the illuminance that the weather
/// says, but for rounding.
class SkyBlock {
public:
    /// Refers to `directions`.
    SkyBlock(const DirectionTree& directions, const Setting& setting);

    /// Makes it that of these hours; 0 for those that are missing to 16. cost: two exponentials a direction and hour
    void fill(std::span<const LitHour> hours);

    /// Of each direction, in the order of places.
    const std::vector<HourValues>& light() const { return light_; }

private:
    const DirectionTree& directions_;
    Setting setting_;
    std::vector<glm::dvec3> compass_;  ///< the directions: east, north, up
    std::vector<HourValues> light_;
    std::vector<double> luminances_;  ///< of one hour
};

}  // namespace daylighting
