#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/rays/sky_rays.hpp>
#include <render/scene.hpp>

#include "facing.hpp"
#include "sensors.hpp"

namespace daylighting {

/// Where the rays of sensors start, in the coordinates of a scene's rays: along their normals, a little above what they
/// may lie on.
class RayStarts {
public:
    /// cost: O(vertices)
    explicit RayStarts(const render::Scene& scene);

    glm::vec3 operator()(const Sensor& sensor) const {
        return glm::vec3(sensor.position - origin_) + lift_ * sensor.normal;
    }

private:
    glm::dvec3 origin_;
    float lift_;
};

/// Storage of rays from one sensor into some of many directions.
struct SensorRays {
    std::vector<std::uint32_t> places;  ///< of the directions among all
    std::vector<glm::vec3> directions;
    std::vector<float> shares;
    render::SkyRays sky;

    void clear() {
        places.clear();
        directions.clear();
    }
    void add(std::uint32_t place, const glm::vec3& direction) {
        places.push_back(place);
        directions.push_back(direction);
    }
    void trace(const render::RayScene& rays, const glm::vec3& from) {
        shares.resize(directions.size());
        sky.look(rays, from, directions, shares);
    }
};

/// Asks the ray tracer how much light comes to a sensor from each direction. threads: may be asked by many at once,
/// each with a scratch.
class VisibilityTracer {
public:
    using Scratch = SensorRays;

    /// Refers to `rays` and `directions`.
    VisibilityTracer(const render::Scene& scene, const render::RayScene& rays, const DirectionTree& directions);

    /// The share of light that arrives from each direction, 0 to 1, the mean of its channels; 0 behind the sensor's
    /// plane. cost: a ray each direction before it; in streams where surfaces are opaque.
    void trace(const Sensor& sensor, const Facing& facing, std::vector<float>& visibility, Scratch& scratch) const;

private:
    const render::RayScene& rays_;
    const DirectionTree& directions_;
    RayStarts starts_;
};

}  // namespace daylighting
