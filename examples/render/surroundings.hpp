#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include <lightcuts/source/sun_sky.hpp>

#include "picture.hpp"
#include "scene.hpp"

namespace render {

/// Reads a Radiance picture (.hdr). throws: invalid_input with the path when it is missing, damaged or cut short.
Picture read_hdr(const std::filesystem::path& path);

/// How a map lights a scene.
struct EnvironmentOptions {
    std::filesystem::path file;  ///< .exr or .hdr
    std::size_t lights = 3000;   ///< 0: it is only seen
    float scale = 1.0f;          ///< of the radiance, > 0
    float rotation = 0.0f;       ///< degrees, counter-clockwise about +y seen from above
    std::uint64_t seed = 1;
};

/// Puts a latitude-longitude map around `scene`: as background, and as distant lights of equal power.
/// throws: invalid_input naming the file, and the pixel that is negative or not finite; also if all are black or the
/// map is not twice as wide as high. The scene is then unchanged.
void add_environment(Scene& scene, const EnvironmentOptions& options);

/// Puts Preetham's sun and clear sky over `scene`: as background, as 64 distant lights for the sun's disc, and as
/// `sky_lights` of equal power for the sky, which is only seen if they are 0.
/// throws: invalid_input if the model does not know that sun
void add_daylight(Scene& scene, const lightcuts::SunPosition& sun, std::size_t sky_lights, std::uint64_t seed);

}  // namespace render
