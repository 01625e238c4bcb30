#include "visibility.hpp"

#include <algorithm>
#include <cmath>

namespace daylighting {

float sensor_lift(const render::Scene& scene) {
    float largest = 0.0f;
    for (const glm::vec3& p : scene.positions) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return 0x1p-20f * largest;
}

VisibilityTracer::VisibilityTracer(const render::Scene& scene, const render::RayScene& rays,
                                   const DirectionTree& directions)
    : scene_(scene), rays_(rays), directions_(directions), lift_(sensor_lift(scene)) {}

void VisibilityTracer::trace(const Sensor& sensor, const Facing& facing, std::vector<float>& visibility,
                             Scratch& scratch) const {
    const glm::vec3 from = glm::vec3(sensor.position - scene_.origin) + lift_ * sensor.normal;
    visibility.assign(directions_.size(), 0.0f);
    if (rays_.transmissive()) {
        for (std::size_t i = 0; i < directions_.size(); ++i) {
            if (!(facing.cosines()[i] > 0.0f)) continue;
            const glm::vec3 share = rays_.to_infinity(from, directions_.directions[i]);
            visibility[i] = (share.r + share.g + share.b) * (1.0f / 3.0f);
        }
        return;
    }
    // In the order of the leaves, so that the rays of a stream are neighbors.
    scratch.queries.clear();
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        if (!(facing.cosines()[i] > 0.0f)) continue;
        scratch.queries.push_back({.from = from,
                                   .receiver = 0,
                                   .to = directions_.directions[i],
                                   .light = static_cast<std::uint32_t>(i),
                                   .kind = 0,
                                   .distant = true});
    }
    scratch.answers.resize(scratch.queries.size());
    lightcuts::EmbreeOracle(rays_.embree_scene()).many(scratch.queries, scratch.answers);
    for (std::size_t i = 0; i < scratch.queries.size(); ++i) {
        visibility[scratch.queries[i].light] = scratch.answers[i];
    }
}

}  // namespace daylighting
