#pragma once

#include <vector>

#include <lightcuts/adapt/embree.hpp>
#include <lightcuts/visibility/query.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/scene.hpp>

#include "facing.hpp"
#include "sensors.hpp"

namespace daylighting {

/// By how much, along a sensor's normal, rays start above what it may lie on. cost: O(vertices)
float sensor_lift(const render::Scene& scene);

/// Asks the ray tracer how much light comes to a sensor from each direction. threads: may be asked by many at once,
/// each with a scratch.
class VisibilityTracer {
public:
    struct Scratch {
        std::vector<lightcuts::VisibilityQuery> queries;
        std::vector<float> answers;
    };

    /// Refers to all of these.
    VisibilityTracer(const render::Scene& scene, const render::RayScene& rays, const DirectionTree& directions);

    /// The share of light that arrives from each direction, 0 to 1, the mean of its channels; 0 behind the sensor's
    /// plane. cost: a ray each direction before it; in streams where surfaces are opaque.
    void trace(const Sensor& sensor, const Facing& facing, std::vector<float>& visibility, Scratch& scratch) const;

private:
    const render::Scene& scene_;
    const render::RayScene& rays_;
    const DirectionTree& directions_;
    float lift_;
};

}  // namespace daylighting
