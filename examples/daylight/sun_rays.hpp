#pragma once

#include <span>

#include <render/rays/ray_scene.hpp>
#include <render/scene.hpp>

#include "hourly_sky.hpp"
#include "sensors.hpp"
#include "visibility.hpp"

namespace daylighting {

/// Suns by a ray each to the center of their discs: exact where the direction nearest to a sun is up to a degree off.
/// threads: may be asked by many at once, each with a scratch.
class SunRays {
public:
    using Scratch = SensorRays;

    /// Refers to `rays` and `hours`.
    SunRays(const render::Scene& scene, const render::RayScene& rays, std::span<const LitHour> hours);

    /// As SunList::add. cost: a ray each hour in which the sun is before the sensor.
    double add(const Sensor& sensor, const Weather& weather, std::span<float> lux, Scratch& scratch) const;

private:
    const render::RayScene& rays_;
    std::span<const LitHour> hours_;
    RayStarts starts_;
};

}  // namespace daylighting
