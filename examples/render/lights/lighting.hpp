#pragma once

#include <cstdint>
#include <optional>

#include <lightcuts/source/sun_sky.hpp>

#include "io/picture.hpp"

namespace render {

/// How a scene is meant to be lit, beyond the lights in it, where the command line does not say otherwise.
struct Lighting {
    std::optional<Picture> environment;  ///< latitude-longitude map of radiance around it
    std::optional<lightcuts::SunPosition> sun;
    /// Albedo of the ground below the horizon, under sun and sky: 0 for a scene that stands on ground of its own, which
    /// hides all light from there.
    std::optional<float> ground;
    std::uint32_t indirect = 0;  ///< about so many virtual lights
    /// Most radiance that one of these adds at a point; empty: a share of the point's total, see `--clamp`.
    std::optional<float> clamp;
};

}  // namespace render
