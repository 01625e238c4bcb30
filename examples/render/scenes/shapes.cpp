#include "scenes/shapes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace render {
namespace {

/// Even-odd rule in the half-plane (radius, height).
bool inside_profile(const std::vector<glm::vec2>& profile, const glm::vec2& p) {
    bool inside = false;
    for (std::size_t i = 0, j = profile.size() - 1; i < profile.size(); j = i++) {
        const glm::vec2& a = profile[i];
        const glm::vec2& b = profile[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
    }
    return inside;
}

}  // namespace

bool Solid::contains(const glm::vec3& p) const {
    const auto between = [](const glm::vec3& v, const glm::vec3& from, const glm::vec3& to) {
        return v.x > from.x && v.x < to.x && v.y > from.y && v.y < to.y && v.z > from.z && v.z < to.z;
    };
    if (!between(p, world_low, world_high)) return false;
    const glm::vec3 local(to_local * glm::vec4(p, 1.0f));
    if (profile.empty()) return between(local, low, high);
    return inside_profile(profile, {glm::length(glm::vec2(local.x, local.z)), local.y});
}

std::uint32_t Modeller::paint(std::string name, const glm::vec3& color, float roughness, float metallic) {
    Material m;
    m.name = std::move(name);
    m.base_color = color;
    m.roughness = roughness;
    m.metallic = metallic;
    // Matt paint is Lambert's; only what shines needs a glossy lobe.
    constexpr float matt = 0.35f;
    if (metallic == 0.0f && roughness >= matt) m.model = Material::Model::phong;
    scene.materials.push_back(std::move(m));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void Modeller::stand(const glm::vec3& p, float degrees) {
    place = glm::rotate(glm::translate(glm::mat4(1.0f), p), glm::radians(degrees), glm::vec3(0.0f, 1.0f, 0.0f));
}

std::uint32_t Modeller::vertex(const glm::vec3& p, const glm::vec3& normal) {
    scene.positions.emplace_back(place * glm::vec4(p, 1.0f));
    const glm::vec3 n = glm::transpose(glm::inverse(glm::mat3(place))) * normal;
    scene.normals.push_back(normal == glm::vec3(0.0f) ? normal : glm::normalize(n));
    return static_cast<std::uint32_t>(scene.positions.size() - 1);
}

void Modeller::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    scene.triangles.emplace_back(a, b, c);
    scene.triangle_material.push_back(material);
}

void Modeller::add_solid(const glm::vec3& low, const glm::vec3& high, std::span<const glm::vec2> profile) {
    Solid solid;
    solid.to_local = glm::inverse(place);
    solid.low = low;
    solid.high = high;
    solid.profile.assign(profile.begin(), profile.end());
    solid.world_low = glm::vec3(std::numeric_limits<float>::max());
    solid.world_high = -solid.world_low;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                               (i & 4) != 0 ? high.z : low.z);
        const glm::vec3 world(place * glm::vec4(corner, 1.0f));
        solid.world_low = glm::min(solid.world_low, world);
        solid.world_high = glm::max(solid.world_high, world);
    }
    solids.push_back(std::move(solid));
}

void Modeller::facet(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (const glm::vec3& corner : {a, b, c}) vertex(corner, glm::vec3(0.0f));
    triangle(first, first + 1, first + 2);
}

void Modeller::quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, int cells_u, int cells_v) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (int j = 0; j <= cells_v; ++j) {
        for (int i = 0; i <= cells_u; ++i) {
            vertex(corner + u * (static_cast<float>(i) / static_cast<float>(cells_u)) +
                       v * (static_cast<float>(j) / static_cast<float>(cells_v)),
                   glm::vec3(0.0f));
        }
    }
    const auto row = static_cast<std::uint32_t>(cells_u + 1);
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(cells_v); ++j) {
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(cells_u); ++i) {
            const std::uint32_t a = first + j * row + i;
            triangle(a, a + 1, a + row + 1);
            triangle(a, a + row + 1, a + row);
        }
    }
}

void Modeller::box(const glm::vec3& low, const glm::vec3& high) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (int i = 0; i < 8; ++i) {
        vertex({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z},
               glm::vec3(0.0f));
    }
    constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& [a, b, c, d] : faces) {
        triangle(first + a, first + b, first + c);
        triangle(first + a, first + c, first + d);
    }
    add_solid(low, high, {});
}

bool Modeller::is_free(const glm::vec3& p, float margin) const {
    const auto hits = [&](const Solid& solid) {
        const glm::vec3 low = solid.world_low - margin;
        const glm::vec3 high = solid.world_high + margin;
        if (p.x < low.x || p.y < low.y || p.z < low.z || p.x > high.x || p.y > high.y || p.z > high.z) return false;
        if (solid.contains(p)) return true;
        for (int axis = 0; axis < 3 && margin > 0.0f; ++axis) {
            glm::vec3 step(0.0f);
            step[axis] = margin;
            if (solid.contains(p + step) || solid.contains(p - step)) return true;
        }
        return false;
    };
    return std::none_of(solids.begin(), solids.end(), hits);
}

}  // namespace render
