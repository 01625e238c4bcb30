#include "sun_rays.hpp"

#include <glm/geometric.hpp>

#include "year.hpp"

namespace daylighting {

SunRays::SunRays(const render::Scene& scene, const render::RayScene& rays, std::span<const LitHour> hours)
    : rays_(rays), hours_(hours), starts_(scene) {}

double SunRays::add(const Sensor& sensor, const Weather& weather, std::span<float> lux, Scratch& scratch) const {
    scratch.clear();
    for (std::size_t h = 0; h < hours_.size(); ++h) {
        const glm::vec3& sun = hours_[h].towards_sun;
        if (hours_[h].has_sun() && glm::dot(sensor.normal, sun) > 0.0f) {
            scratch.add(static_cast<std::uint32_t>(h), sun);
        }
    }
    scratch.trace(rays_, starts_(sensor));
    double shining = 0.0;
    for (std::size_t i = 0; i < scratch.places.size(); ++i) {
        const std::uint32_t h = scratch.places[i];
        shining += add_sun(hours_[h], sensor.normal, scratch.shares[i], weather, lux[h]);
    }
    return shining;
}

}  // namespace daylighting
