#include "visibility.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace daylighting {
namespace {

float lift_of(const render::Scene& scene) {
    float largest = 0.0f;
    for (const glm::vec3& p : scene.positions) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return 0x1p-20f * largest;
}

}  // namespace

RayStarts::RayStarts(const render::Scene& scene) : origin_(scene.origin), lift_(lift_of(scene)) {}

VisibilityTracer::VisibilityTracer(const render::Scene& scene, const render::RayScene& rays,
                                   const DirectionTree& directions)
    : rays_(rays), directions_(directions), starts_(scene) {}

void VisibilityTracer::trace(const Sensor& sensor, const Facing& facing, std::vector<float>& visibility,
                             Scratch& scratch) const {
    visibility.assign(directions_.size(), 0.0f);
    // In the order of the leaves, so that the rays of a stream are neighbors.
    scratch.clear();
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        if (facing.cosines()[i] > 0.0f) scratch.add(static_cast<std::uint32_t>(i), directions_.directions[i]);
    }
    scratch.trace(rays_, starts_(sensor));
    for (std::size_t i = 0; i < scratch.places.size(); ++i) visibility[scratch.places[i]] = scratch.shares[i];
}

}  // namespace daylighting
