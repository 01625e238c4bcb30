#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/moments.hpp>
#include <lightcuts/piecewise/piecewise_constant.hpp>
#include <render/lights/background.hpp>

#include "directions.hpp"
#include "nearest_direction.hpp"

namespace relight {

/// A map of the light from around, split among directions: any rotation of it by a pass over its pixels.
class SplitMap {
public:
    /// `name`: of the map, for messages. throws: invalid_input as lightcuts::environment_lights does.
    SplitMap(const render::Picture& map, float scale, std::size_t directions, const std::string& name);

    /// Fills `power`, by direction: the sum of radiance x solid angle over the pixels that are nearest to it, where the
    /// map is rotated by so many degrees, counter-clockwise about +y seen from above. Nothing of the map is lost: a
    /// pixel as bright as the sun is in one direction, wherever that is.
    void turn(double degrees, const NearestDirection& nearest, std::vector<glm::vec3>& power) const;

private:
    int width_ = 0;
    int height_ = 0;
    std::vector<glm::vec3> power_;  ///< by pixel, of parts of those of the map or of several together
};

struct IlluminationOptions {
    std::size_t size = 256;        ///< most pieces of the cut
    double cluster_angle = 15.0;   ///< degrees: the BRDF is evaluated once in a cluster of this radius, or smaller
    double relative_error = 0.01;  ///< refined by error to this share of all light, then by value
};

/// Light from directions, with its mean at every cluster of them. The cut only says how finely to look.
class Illumination {
public:
    /// A cluster as it lights a surface.
    struct Light {
        glm::vec3 direction{0.0f};
        float radius = 0.0f;
        glm::vec3 power{0.0f};  ///< irradiance of a surface that faces it
        float unused = 0.0f;    ///< so that none lies in two lines of the cache
    };

    /// Refers to `directions`.
    explicit Illumination(const Directions& directions) : directions_(directions) {}

    /// `power`: by direction. Clusters of a radius above `cluster_angle` are refined first, then by error, then by
    /// value [Cut merging 2008, section 3.2], up to the size. throws: invalid_input for power that is not finite.
    void set(std::span<const glm::vec3> power, const IlluminationOptions& options);

    const Directions& directions() const { return directions_; }
    const lightcuts::PiecewiseConstant<glm::vec3>& cut() const { return cut_; }
    const Light& light(std::uint32_t node) const { return lights_[node]; }

private:
    const Directions& directions_;
    std::vector<lightcuts::Moments<3>> moments_;
    lightcuts::OrderedApproximation<glm::vec3> approximation_;
    lightcuts::PiecewiseConstant<glm::vec3> cut_;
    std::vector<Light> lights_;
};

}  // namespace relight
