#pragma once

#include <glm/vec3.hpp>

#include "sky_shape.hpp"

namespace daylighting {

/// What a weather station measures of an hour's light.
struct SkyConditions {
    glm::dvec3 towards_sun{0.0, 0.0, 1.0};  ///< unit; z upwards. It may be below the horizon.
    double direct_normal = 0.0;             ///< irradiance of the sun on a plane that faces it, W/m^2
    double diffuse_horizontal = 0.0;        ///< irradiance of the sky on level ground, W/m^2
    double dew_point = 11.0;                ///< degrees Celsius
    int day_of_year = 1;
};

/// The sky over a weather station: overcast, clear, and all in between, as two irradiances tell [Perez, Seals and
/// Michalsky 1993, All-weather model for sky luminance distribution], and the illuminances that go with these
/// irradiances [Perez, Ineichen, Seals, Michalsky and Stewart 1990, Modeling daylight availability].
class AllWeatherSky {
public:
    /// pre: irradiances are finite and not negative.
    explicit AllWeatherSky(const SkyConditions& conditions);

    const glm::dvec3& towards_sun() const { return towards_sun_; }
    /// Illuminance of the sun on a plane that faces it, lux; 0 if it is below the horizon.
    double direct_illuminance() const { return direct_illuminance_; }
    /// Illuminance of the sky on level ground, lux.
    double diffuse_illuminance() const { return diffuse_illuminance_; }
    /// 1 for an overcast sky, above 6 for a clear one [1990, Eq. 1].
    double clearness() const { return clearness_; }
    /// How bright the sky is for the height of the sun [1990, Eq. 2].
    double brightness() const { return brightness_; }

    /// How its luminance is distributed [1993, Eq. 1].
    const SkyShape& shape() const { return shape_; }

private:
    glm::dvec3 towards_sun_;
    double direct_illuminance_ = 0.0;
    double diffuse_illuminance_ = 0.0;
    double clearness_ = 1.0;
    double brightness_ = 0.0;
    SkyShape shape_;
};

}  // namespace daylighting
