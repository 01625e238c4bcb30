#pragma once

#include <cmath>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "../light/light.hpp"
#include "../tree/light_cluster.hpp"

namespace lightcuts {

/// A cluster's lights as a receiver sees them: the box of their offsets, or of the directions towards distant lights,
/// and how near they are. Widened by the float rounding of the directions that materials are given, so that bounds over
/// the box hold for what `evaluate` returns; zeros stay zeros.
struct ClusterView {
    OffsetBox box;
    double distance2;         ///< lower bound of the squared distance; 0 if the box touches the receiver
    double inverse_distance;  ///< 1 / sqrt(distance2), infinite if that is 0
};

/// pre: `cluster` holds a light.
template <Light L>
ClusterView view_of(const LightCluster<L>& cluster, const glm::vec3& point) {
    const glm::dvec3 origin = DirectionalLight<L> ? glm::dvec3(0.0) : glm::dvec3(point);
    glm::dvec3 lo = glm::dvec3(cluster.box.lo) - origin;
    glm::dvec3 hi = glm::dvec3(cluster.box.hi) - origin;
    constexpr double r = 16.0 * 0x1p-24;
    lo -= r * glm::dvec3(std::fabs(lo.x), std::fabs(lo.y), std::fabs(lo.z));
    hi += r * glm::dvec3(std::fabs(hi.x), std::fabs(hi.y), std::fabs(hi.z));
    ClusterView view;
    view.box = {lo, hi};
    view.distance2 = min_distance2(view.box);
    view.inverse_distance = 1.0 / std::sqrt(view.distance2);
    return view;
}

}  // namespace lightcuts
