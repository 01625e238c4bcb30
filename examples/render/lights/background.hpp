#pragma once

#include <optional>

#include <glm/vec3.hpp>
#include <lightcuts/source/environment.hpp>
#include <lightcuts/source/sun_sky.hpp>

#include "io/picture.hpp"

namespace render {

/// A latitude-longitude map of radiance around the scene.
struct Environment {
    using Map = lightcuts::EnvironmentMap<lightcuts::RowMajorPixels<glm::vec3>>;

    Picture picture;
    float scale = 1.0f;     ///< of the radiance
    float rotation = 0.0f;  ///< degrees, counter-clockwise about +y seen from above

    /// A view of this object.
    Map map() const {
        const auto width = static_cast<std::uint32_t>(picture.width);
        return Map(width, static_cast<std::uint32_t>(picture.height), {picture.pixels.data(), width}, scale, rotation);
    }
};

/// What is seen where there is no surface; black if it is empty.
struct Background {
    std::optional<Environment> environment;
    std::optional<lightcuts::SunSky> daylight;

    /// Radiance from `direction`, a unit vector.
    glm::vec3 radiance(const glm::vec3& direction) const {
        glm::vec3 sum(0.0f);
        if (environment) sum += environment->map().radiance(glm::dvec3(direction));
        if (daylight) sum += daylight->radiance(glm::dvec3(direction));
        return sum;
    }
};

}  // namespace render
