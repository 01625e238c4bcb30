#include "sky_shape.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace daylighting {

double SkyShape::luminance(const glm::dvec3& direction, const glm::dvec3& towards_sun) const {
    const double cosine = std::clamp(glm::dot(direction, towards_sun), -1.0, 1.0);
    const double gradation = 1.0 + a * std::exp(b / std::max(direction.z, 1e-4)) + s * direction.z;
    return std::max(0.0, gradation * (base + c * std::exp(d * std::acos(cosine)) + e * cosine * cosine));
}

}  // namespace daylighting
