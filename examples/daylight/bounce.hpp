#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <render/rays/ray_scene.hpp>
#include <render/scene.hpp>

#include "sensors.hpp"
#include "year.hpp"

namespace daylighting {

/// Light that surfaces reflect to sensors, once and evenly to all sides: points on these surfaces, which are sensors
/// themselves, and of each sensor by which share of which points' illuminance it is lit.
struct Bounce {
    struct Link {
        std::uint32_t point = 0;
        float share = 0.0f;
    };

    std::vector<Sensor> points;
    std::vector<std::size_t> ends;  ///< of each sensor's links in `links`
    std::vector<Link> links;

    std::span<const Link> of(std::size_t sensor) const {
        const std::size_t begin = sensor == 0 ? 0 : ends[sensor - 1];
        return std::span(links).subspan(begin, ends[sensor] - begin);
    }
};

/// Which surfaces light sensors.
struct BounceSettings {
    double spacing = 0.5;       ///< of points, in units of the scene; wider as surfaces are farther away
    std::uint32_t rays = 2048;  ///< from each sensor, in proportion to the cosine
};

/// Finds the surfaces by rays from the sensors. Rays go on through what lets light pass, tinted; emitters and mirrors
/// count by their diffuse reflectance. What is hit within a cell as wide as the spacing, facing about the same way, is
/// one point. Normals of points are those of the axes, or one of 128 others. The same for any number of threads.
/// throws: invalid_input if there would be too many points. threads: all of the calling arena.
Bounce find_bounce(const render::Scene& scene, const render::RayScene& rays, std::span<const Sensor> sensors,
                   const BounceSettings& settings);

/// Adds to the illuminances of the first sensors what they get of the points, which follow them in `lux`.
/// threads: all of the calling arena.
void add_bounce(const Bounce& bounce, Illuminances& lux);

}  // namespace daylighting
