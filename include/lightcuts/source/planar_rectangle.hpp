#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "triangle_pieces.hpp"

namespace lightcuts::detail {

/// Corners this much of a surface's extent off its plane still count as in it.
inline constexpr double flatness = 1e-5;

inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// A rectangle in space: origin, unit sides x and y, lengths.
struct PlanarRectangle {
    glm::dvec3 origin{0.0};
    glm::dvec3 x{0.0};
    glm::dvec3 y{0.0};
    double width = 0;
    double height = 0;

    glm::dvec2 local(const glm::dvec3& p) const { return {glm::dot(p - origin, x), glm::dot(p - origin, y)}; }
    glm::dvec3 at(const glm::dvec2& p) const { return origin + p.x * x + p.y * y; }
};

/// The common normal of triangles in one plane that face one way.
inline std::optional<glm::dvec3> common_normal(std::span<const Facet> facets) {
    glm::dvec3 sum(0.0);
    glm::dvec3 low((std::numeric_limits<double>::max)());
    glm::dvec3 high(-low);
    for (const Facet& f : facets) {
        sum += f.cross();
        low = (glm::min)(low, (glm::min)(f.a, (glm::min)(f.b, f.c)));
        high = (glm::max)(high, (glm::max)(f.a, (glm::max)(f.b, f.c)));
    }
    if (!(glm::length(sum) > 0.0)) return std::nullopt;
    const glm::dvec3 normal = glm::normalize(sum);
    const double tolerance = flatness * glm::length(high - low);
    for (const Facet& f : facets) {
        if (!(glm::dot(f.cross(), normal) > 0.0)) return std::nullopt;
        for (const glm::dvec3& p : {f.a, f.b, f.c}) {
            if (std::fabs(glm::dot(p - facets.front().a, normal)) > tolerance) return std::nullopt;
        }
    }
    return normal;
}

/// Corners of the convex hull, counter-clockwise [Andrew 1979]. cost: O(N log N)
inline std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
    std::sort(points.begin(), points.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
    std::vector<glm::dvec2> hull;
    const auto add_chain = [&](const auto& begin, const auto& end) {
        const std::size_t start = hull.size();
        for (auto p = begin; p != end; ++p) {
            while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0.0) {
                hull.pop_back();
            }
            hull.push_back(*p);
        }
        hull.pop_back();  // begins the other chain
    };
    add_chain(points.begin(), points.end());
    add_chain(points.rbegin(), points.rend());
    return hull;
}

/// The bounding rectangle of points in a plane in the frame (x, normal cross x), where x is a direction in the plane.
inline PlanarRectangle bounding_rectangle(std::span<const glm::dvec3> points, const glm::dvec3& x,
                                          const glm::dvec3& normal) {
    PlanarRectangle r;
    r.x = x;
    r.y = glm::cross(normal, x);
    glm::dvec2 low((std::numeric_limits<double>::max)());
    glm::dvec2 high(-low);
    for (const glm::dvec3& p : points) {
        const glm::dvec2 q = r.local(p);
        low = (glm::min)(low, q);
        high = (glm::max)(high, q);
    }
    r.origin = low.x * r.x + low.y * r.y + glm::dot(points.front(), normal) * normal;
    r.width = high.x - low.x;
    r.height = high.y - low.y;
    return r;
}

/// The smallest rectangle around triangles in the plane of `normal`; among equals always the same one, by directions in
/// space: it depends on their outline alone. Its longer side is x. cost: O(N log N + H^2) for H corners of their hull
inline PlanarRectangle smallest_rectangle(std::span<const Facet> facets, const glm::dvec3& normal) {
    const glm::dvec3 across = std::fabs(normal.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 s = glm::normalize(across - glm::dot(across, normal) * normal);
    const glm::dvec3 t = glm::cross(normal, s);
    const double offset = glm::dot(facets.front().a, normal);
    std::vector<glm::dvec2> projected;
    projected.reserve(3 * facets.size());
    for (const Facet& f : facets) {
        for (const glm::dvec3& p : {f.a, f.b, f.c}) projected.emplace_back(glm::dot(p, s), glm::dot(p, t));
    }
    std::vector<glm::dvec3> hull;
    for (const glm::dvec2& p : convex_hull(std::move(projected))) hull.push_back(p.x * s + p.y * t + offset * normal);

    std::vector<PlanarRectangle> candidates;
    double smallest = (std::numeric_limits<double>::max)();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const glm::dvec3 edge = glm::normalize(hull[(i + 1) % hull.size()] - hull[i]);
        const glm::dvec3 turned = glm::cross(normal, edge);
        for (const glm::dvec3& x : {edge, turned, -edge, -turned}) {
            const PlanarRectangle r = bounding_rectangle(hull, x, normal);
            if (r.height > r.width * (1.0 + flatness)) continue;
            candidates.push_back(r);
            smallest = (std::min)(smallest, r.width * r.height);
        }
    }
    const auto direction = [](const PlanarRectangle& r) {
        const auto rounded = [](double v) { return std::llround(1e4 * v); };
        return std::tuple(rounded(r.x.x), rounded(r.x.y), rounded(r.x.z));
    };
    std::erase_if(candidates, [&](const PlanarRectangle& r) { return r.width * r.height > smallest * (1.0 + 1e-4); });
    return *std::max_element(
        candidates.begin(), candidates.end(),
        [&](const PlanarRectangle& a, const PlanarRectangle& b) { return direction(a) < direction(b); });
}

}  // namespace lightcuts::detail
