#include "surfaces/surface_geometry.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "motion.hpp"
#include "surfaces/surface_colors.hpp"
#include "triangle.hpp"

namespace render {

namespace {

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

/// The interpolated vertex normal, on the side of `face`; that itself where there is none.
glm::vec3 smooth_normal(const Scene& scene, const Hit& hit, const glm::vec3& face) {
    if (scene.normals.empty()) return face;
    const auto [na, nb, nc] = normals_at(scene, hit.triangle, hit.time);
    const glm::vec3 zero(0.0f);
    const glm::vec3 smooth = (1.0f - hit.u - hit.v) * na + hit.u * nb + hit.v * nc;
    const float size = glm::length(smooth);
    if (na == zero || nb == zero || nc == zero || !(size > 1e-6f)) return face;
    return (glm::dot(smooth, face) >= 0.0f ? 1.0f : -1.0f) / size * smooth;
}

/// In which direction u grows on the surface, and v upwards: of the vertices' tangents, or else of the triangle's uvs.
/// False if neither says it.
bool find_tangents(const Scene& scene, const Hit& hit, const Triangle& face, const TextureUse& use,
                   const glm::vec3& normal, glm::vec3& along_u, glm::vec3& up_v) {
    const glm::uvec3 t = scene.triangles[hit.triangle];
    glm::vec3 tangent(0.0f);
    float side = 1.0f;
    if (!scene.tangents.empty()) {
        const auto [ta, tb, tc] = tangents_at(scene, hit.triangle, hit.time);
        const glm::vec4 mean = (1.0f - hit.u - hit.v) * ta + hit.u * tb + hit.v * tc;
        tangent = glm::vec3(mean);
        side = mean.w < 0.0f ? -1.0f : 1.0f;
    }
    if (tangent == glm::vec3(0.0f)) {
        if (use.uv_set >= scene.uv_sets.size() || scene.uv_sets[use.uv_set].empty()) return false;
        const std::vector<glm::vec2>& uvs = scene.uv_sets[use.uv_set];
        const glm::dvec2 ab(uvs[t.y] - uvs[t.x]);
        const glm::dvec2 ac(uvs[t.z] - uvs[t.x]);
        const double area = ab.x * ac.y - ab.y * ac.x;
        const glm::dvec3 by_u = (face.b - face.a) * ac.y - (face.c - face.a) * ab.y;
        if (!(glm::length(by_u) > 0.0) || area == 0.0) return false;
        tangent = glm::vec3(glm::normalize(by_u) * (area < 0.0 ? -1.0 : 1.0));
        // v runs downwards, so that where u x v leads along the normal, upwards is the other side.
        side = area < 0.0 ? 1.0f : -1.0f;
    }
    const glm::vec3 across = tangent - glm::dot(tangent, normal) * normal;
    const float length = glm::length(across);
    if (!(length > 0.0f)) return false;
    along_u = across / length;
    up_v = side * glm::cross(normal, along_u);
    return true;
}

/// `normal` bent by the material's normal map.
glm::vec3 mapped_normal(const Scene& scene, const Hit& hit, const Triangle& face, const Material& material,
                        const glm::vec3& normal) {
    glm::vec3 along_u(0.0f);
    glm::vec3 up_v(0.0f);
    if (!find_tangents(scene, hit, face, material.normal_texture, normal, along_u, up_v)) return normal;
    const glm::vec3 texel(texel_at(scene, material.normal_texture, hit.triangle, hit.u, hit.v));
    const glm::vec3 local = (2.0f * texel - 1.0f) * glm::vec3(material.normal_scale, material.normal_scale, 1.0f);
    const glm::vec3 bent = local.x * along_u + local.y * up_v + local.z * normal;
    const float length = glm::length(bent);
    return length > 0.0f && local.z > 0.0f ? bent / length : normal;
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

SurfaceGeometry surface_at(const Scene& scene, const Hit& hit, const glm::vec3& direction) {
    const Triangle face = triangle_at(scene, hit.triangle, hit.time);
    const glm::dvec3 position = face.at(static_cast<double>(hit.u), static_cast<double>(hit.v));

    SurfaceGeometry s;
    s.position = glm::vec3(position);
    s.offset = ray_offset(face, position);
    const glm::dvec3 cross = face.cross();
    const double length = glm::length(cross);
    const glm::vec3 normal = length > 0.0 ? glm::vec3(cross / length) : -direction;
    s.front = glm::dot(normal, direction) <= 0.0f;
    const float side = s.front ? 1.0f : -1.0f;
    s.geometric_normal = side * normal;
    s.shading_normal = s.geometric_normal;
    const Material& material = scene.materials[scene.triangle_material[hit.triangle]];
    if (scene.normals.empty() && !material.normal_texture.is_there()) return s;

    glm::vec3 smooth = smooth_normal(scene, hit, normal);
    if (material.normal_texture.is_there()) smooth = mapped_normal(scene, hit, face, material, smooth);
    if (smooth != normal) {
        // A map may bend it below the surface.
        const glm::vec3 towards_viewer = side * smooth;
        const bool above = glm::dot(towards_viewer, s.geometric_normal) > 0.0f;
        s.shading_normal = bend_to_viewer(above ? towards_viewer : s.geometric_normal, -direction);
    }
    return s;
}

}  // namespace render
