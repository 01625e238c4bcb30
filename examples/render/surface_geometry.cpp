#include "surface_geometry.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace render {

namespace {

/// Distance of a ray's origin from its surface: some thirty roundings of a coordinate as large as any that the
/// intersection was computed from.
constexpr float offset_per_coordinate = 4e-6f;

float largest(const glm::vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

glm::vec3 mirrored(const glm::vec3& direction, const glm::vec3& normal) {
    return direction - 2.0f * glm::dot(direction, normal) * normal;
}

/// `normal` bent by the least that turns it to the viewer: smooth vertex normals may face away near silhouettes.
glm::vec3 bend_to_viewer(const glm::vec3& normal, const glm::vec3& to_viewer) {
    constexpr float smallest_cosine = 1e-3f;
    const float cosine = glm::dot(normal, to_viewer);
    if (cosine >= smallest_cosine) return normal;
    return glm::normalize(normal + (smallest_cosine - cosine) * to_viewer);
}

}  // namespace

glm::vec3 SurfaceGeometry::leave(const glm::vec3& direction) const {
    const float side = glm::dot(direction, geometric_normal) < 0.0f ? -offset : offset;
    return position + side * geometric_normal;
}

glm::vec3 SurfaceGeometry::reflect(const glm::vec3& direction) const {
    const glm::vec3 reflected = mirrored(direction, shading_normal);
    return glm::dot(reflected, geometric_normal) > 0.0f ? reflected : mirrored(direction, geometric_normal);
}

SurfaceGeometry surface_at(const Scene& scene, const Hit& hit, const glm::vec3& origin, const glm::vec3& direction) {
    const glm::uvec3 t = scene.triangles[hit.triangle];
    const glm::dvec3 a(scene.positions[t.x]);
    const glm::dvec3 b(scene.positions[t.y]);
    const glm::dvec3 c(scene.positions[t.z]);
    const double u = static_cast<double>(hit.u);
    const double v = static_cast<double>(hit.v);

    SurfaceGeometry s;
    s.position = glm::vec3((1.0 - u - v) * a + u * b + v * c);
    s.offset = offset_per_coordinate *
               std::max({largest(glm::vec3(a)), largest(glm::vec3(b)), largest(glm::vec3(c)), largest(origin)});
    const glm::dvec3 cross = glm::cross(b - a, c - a);
    const double length = glm::length(cross);
    const glm::vec3 face = length > 0.0 ? glm::vec3(cross / length) : -direction;
    s.front = glm::dot(face, direction) <= 0.0f;
    s.geometric_normal = s.front ? face : -face;
    s.shading_normal = s.geometric_normal;
    if (!scene.normals.empty()) {
        const glm::vec3& na = scene.normals[t.x];
        const glm::vec3& nb = scene.normals[t.y];
        const glm::vec3& nc = scene.normals[t.z];
        const glm::vec3 zero(0.0f);
        const glm::vec3 smooth = (1.0f - hit.u - hit.v) * na + hit.u * nb + hit.v * nc;
        const float size = glm::length(smooth);
        if (na != zero && nb != zero && nc != zero && size > 1e-6f) {
            const glm::vec3 unit = smooth / size;
            const bool above = glm::dot(unit, s.geometric_normal) >= 0.0f;
            s.shading_normal = bend_to_viewer(above ? unit : -unit, -direction);
        }
    }
    return s;
}

}  // namespace render
