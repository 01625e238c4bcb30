#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace render {

/// Consecutive vertices of a scene that move while the shutter is open, given at `steps` times, equally far apart, from
/// its opening to its closing; in between they move along straight lines. Lists go step by step, `count` vertices each.
struct MovingVertices {
    std::uint32_t first = 0;  ///< in the scene
    std::uint32_t count = 0;
    std::uint32_t steps = 2;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   ///< empty iff the scene's are
    std::vector<glm::vec4> tangents;  ///< likewise

    bool contains(std::uint32_t vertex) const { return vertex >= first && vertex - first < count; }
};

/// A part of a scene that turns about an axis and moves along a line, both evenly; the scene shows where it is at
/// second 0 of its clock.
struct RigidMotion {
    std::uint32_t first_vertex = 0;
    std::uint32_t vertex_count = 0;
    glm::dvec3 center{0.0};          ///< a point of the axis, at second 0, in the scene's coordinates
    glm::dvec3 axis{0.0, 1.0, 0.0};  ///< unit
    double turn = 0.0;               ///< radians a second, counter-clockwise seen from where the axis points to
    glm::dvec3 velocity{0.0};        ///< a second
    std::uint32_t first_sphere = 0;  ///< of the spherical lights that move with it, each with no other part
    std::uint32_t sphere_count = 0;
};

}  // namespace render
