#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene.hpp"

namespace render {

/// The largest of a vector's coordinates, without their signs.
inline double largest_coordinate(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// A scene's triangle in doubles.
struct Triangle {
    glm::dvec3 a, b, c;

    /// Of positions in floats or doubles.
    template <class Positions>
    Triangle(const Positions& positions, const glm::uvec3& corners)
        : a(positions[corners.x]), b(positions[corners.y]), c(positions[corners.z]) {}
    Triangle(const Scene& scene, const glm::uvec3& corners) : Triangle(scene.positions, corners) {}
    Triangle(const Scene& scene, std::uint32_t triangle) : Triangle(scene, scene.triangles[triangle]) {}

    /// The point of barycentric coordinates (1 - u - v, u, v).
    glm::dvec3 at(double u, double v) const { return (1.0 - u - v) * a + u * b + v * c; }
    glm::dvec3 at(const glm::dvec2& uv) const { return a + uv.x * (b - a) + uv.y * (c - a); }

    /// Along the normal, of the side from which the corners run counter-clockwise; twice the area long.
    glm::dvec3 cross() const { return glm::cross(b - a, c - a); }
    double area() const { return 0.5 * glm::length(cross()); }

    /// How far the farthest corner is from `p`, along an axis.
    double reach(const glm::dvec3& p) const {
        return std::max({largest_coordinate(a - p), largest_coordinate(b - p), largest_coordinate(c - p)});
    }
    /// The largest number that a point `p` of the triangle is computed from: its coordinates, and how far the corners
    /// are from it.
    double scale_at(const glm::dvec3& p) const { return std::max(largest_coordinate(p), reach(p)); }
};

/// Distance from their surface at which rays begin, as a share of `Triangle::scale_at`: some thirty steps of a float.
inline constexpr double ray_offset_share = 4e-6;

inline float ray_offset(const Triangle& triangle, const glm::dvec3& p) {
    return static_cast<float>(ray_offset_share) * static_cast<float>(triangle.scale_at(p));
}

}  // namespace render
