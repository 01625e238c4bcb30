#pragma once

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lightcuts {

/// Orthonormal axes of which z is given [Duff et al. 2017].
struct Basis {
    glm::dvec3 x, y, z;

    /// pre: `axis` is a unit vector
    explicit Basis(const glm::dvec3& axis) : z(axis) {
        const double sign = std::copysign(1.0, axis.z);
        const double a = -1.0 / (sign + axis.z), b = axis.x * axis.y * a;
        x = {1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x};
        y = {b, sign + axis.y * axis.y * a, -axis.y};
    }

    /// The vector whose coordinates along x, y and z are those of `v`.
    glm::dvec3 out(const glm::dvec3& v) const { return v.x * x + v.y * y + v.z * z; }
    /// The coordinates of `v` along x, y and z.
    glm::dvec3 in(const glm::dvec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
};

/// The unit vector whose angle to +z has the cosine `cosine`, at the azimuth `turn`, in full circles from +x towards
/// +y.
inline glm::dvec3 around_z(double cosine, double turn) {
    const double sine = std::sqrt(std::fmax(0.0, 1.0 - cosine * cosine)), angle = 2.0 * std::numbers::pi * turn;
    return {sine * std::cos(angle), sine * std::sin(angle), cosine};
}

}  // namespace lightcuts
