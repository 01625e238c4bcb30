#include "sun_rays.hpp"

#include <glm/geometric.hpp>
#include <lightcuts/adapt/embree.hpp>

#include "visibility.hpp"
#include "year.hpp"

namespace daylighting {

SunRays::SunRays(const render::Scene& scene, const render::RayScene& rays, std::span<const LitHour> hours)
    : scene_(scene), rays_(rays), hours_(hours), lift_(sensor_lift(scene)) {}

double SunRays::add(const Sensor& sensor, const Weather& weather, std::span<float> lux, Scratch& scratch) const {
    const glm::vec3 from = glm::vec3(sensor.position - scene_.origin) + lift_ * sensor.normal;
    scratch.queries.clear();
    for (std::size_t h = 0; h < hours_.size(); ++h) {
        const glm::vec3& sun = hours_[h].towards_sun;
        if (!hours_[h].has_sun() || !(glm::dot(sensor.normal, sun) > 0.0f)) continue;
        scratch.queries.push_back({.from = from,
                                   .receiver = 0,
                                   .to = sun,
                                   .light = static_cast<std::uint32_t>(h),
                                   .kind = 0,
                                   .distant = true});
    }
    scratch.answers.resize(scratch.queries.size());
    if (rays_.transmissive()) {
        for (std::size_t i = 0; i < scratch.queries.size(); ++i) {
            const glm::vec3 share = rays_.to_infinity(from, scratch.queries[i].to);
            scratch.answers[i] = (share.r + share.g + share.b) * (1.0f / 3.0f);
        }
    } else {
        lightcuts::EmbreeOracle(rays_.embree_scene()).many(scratch.queries, scratch.answers);
    }
    double shining = 0.0;
    for (std::size_t i = 0; i < scratch.queries.size(); ++i) {
        const std::uint32_t h = scratch.queries[i].light;
        shining += add_sun(hours_[h], sensor.normal, scratch.answers[i], weather, lux[h]);
    }
    return shining;
}

}  // namespace daylighting
