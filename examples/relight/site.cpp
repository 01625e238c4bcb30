#include "site.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <unordered_map>

#include <glm/geometric.hpp>
#include <render/triangle.hpp>

namespace relight {

namespace {

/// Triangles within this of the mean of those at a vertex belong to one smooth surface.
constexpr double smooth_cosine = std::numbers::sqrt2 / 2.0;
/// By how much of the way to the middle of its triangles a site lies inside of them.
constexpr double inset = 0.01;

struct Corner {
    std::uint32_t triangle;
    int corner;
};

/// Corners in one place, of about one direction.
struct Group {
    std::vector<Corner> corners;
    glm::dvec3 normal{0.0};  ///< sum
};

glm::dvec3 unit_normal(const render::Scene& scene, std::uint32_t triangle) {
    const glm::dvec3 cross = render::Triangle(scene, triangle).cross();
    const double length = glm::length(cross);
    return length > 0.0 ? cross / length : glm::dvec3(0.0);
}

std::array<std::uint32_t, 3> place_of(const glm::vec3& position) {
    // Adding 0 turns -0 into 0: both are one place.
    return {std::bit_cast<std::uint32_t>(position.x + 0.0f), std::bit_cast<std::uint32_t>(position.y + 0.0f),
            std::bit_cast<std::uint32_t>(position.z + 0.0f)};
}

struct PlaceHash {
    std::size_t operator()(const std::array<std::uint32_t, 3>& place) const {
        std::uint64_t state = 0;
        for (const std::uint32_t word : place) {
            state = (state ^ word) * 0x9e3779b97f4a7c15u;
            state ^= state >> 29;
        }
        return static_cast<std::size_t>(state);
    }
};

Site site_of(const render::Scene& scene, const Group& group) {
    const Corner& first = group.corners.front();
    const glm::dvec3 place(scene.positions[scene.triangles[first.triangle][first.corner]]);
    const double length = glm::length(group.normal);
    const glm::dvec3 normal = length > 0.0 ? group.normal / length : glm::dvec3(0.0, 1.0, 0.0);

    glm::dvec3 middle(0.0);
    double least_cosine = 1.0;
    float offset = 0.0f;
    for (const Corner& corner : group.corners) {
        const render::Triangle triangle(scene, corner.triangle);
        middle += (triangle.a + triangle.b + triangle.c) / (3.0 * static_cast<double>(group.corners.size()));
        least_cosine = std::min(least_cosine, glm::dot(normal, unit_normal(scene, corner.triangle)));
        offset = std::max(offset, render::ray_offset(triangle, place));
    }
    // Along the surface, so that a site on a ridge is not inside of the body; in a groove it is lifted off the floor.
    glm::dvec3 inwards = middle - place;
    inwards -= glm::dot(inwards, normal) * normal;
    const glm::dvec3 moved = place + inset * inwards;
    double above = 0.0, below = 0.0;
    for (const Corner& corner : group.corners) {
        const glm::dvec3 own = unit_normal(scene, corner.triangle);
        const double slope = glm::dot(own, normal);
        if (!(slope > 0.1)) continue;
        const double depth = glm::dot(place - moved, own) / slope;
        above = std::max(above, depth);
        below = std::max(below, -depth);
    }
    Site site;
    site.normal = glm::vec3(normal);
    site.front = glm::vec3(moved + (above + static_cast<double>(offset)) * normal);
    site.back = glm::vec3(moved - (below + static_cast<double>(offset)) * normal);
    const double cosine = std::clamp(least_cosine, 0.0, 1.0);
    site.horizon = static_cast<float>(-std::sqrt(1.0 - cosine * cosine) - 1e-6);
    return site;
}

}  // namespace

Sites sites_of(const render::Scene& scene) {
    std::unordered_map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>, PlaceHash> at_place;
    std::vector<Group> groups;
    Sites result;
    result.of_triangle.resize(scene.triangles.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const glm::dvec3 normal = unit_normal(scene, t);
        for (int k = 0; k < 3; ++k) {
            std::vector<std::uint32_t>& here = at_place[place_of(scene.positions[scene.triangles[t][k]])];
            const auto own = std::find_if(here.begin(), here.end(), [&](std::uint32_t g) {
                return glm::dot(groups[g].normal, normal) >= smooth_cosine * glm::length(groups[g].normal);
            });
            std::uint32_t group = 0;
            if (own != here.end()) {
                group = *own;
            } else {
                group = static_cast<std::uint32_t>(groups.size());
                groups.emplace_back();
                here.push_back(group);
            }
            groups[group].corners.push_back({t, k});
            groups[group].normal += normal;
            result.of_triangle[t][k] = group;
        }
    }
    result.sites.reserve(groups.size());
    for (const Group& group : groups) result.sites.push_back(site_of(scene, group));
    return result;
}

bool shows_back(const Sites& sites, const render::SurfacePoint& point) {
    const Site& corner = sites.sites[sites.of_triangle[point.triangle].x];
    return glm::dot(corner.normal, point.geometric_normal) < 0.0f;
}

}  // namespace relight
