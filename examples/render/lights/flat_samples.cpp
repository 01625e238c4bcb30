#include "lights/flat_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "triangle.hpp"

namespace render {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Vertices this much of the surface's extent off its plane still count as in it.
constexpr double flatness = 1e-5;
/// Points tried per point wanted, before the surface counts as too sparse in its rectangle.
constexpr std::size_t most_tries = 64;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// A rectangle in space: origin, unit sides x and y, lengths.
struct Rectangle {
    dvec3 origin{0.0};
    dvec3 x{0.0};
    dvec3 y{0.0};
    double width = 0;
    double height = 0;

    dvec2 local(const dvec3& p) const { return {glm::dot(p - origin, x), glm::dot(p - origin, y)}; }
};

/// The common normal of triangles in one plane that face one way.
std::optional<dvec3> common_normal(const Scene& scene, std::span<const std::uint32_t> triangles) {
    dvec3 sum(0.0);
    dvec3 low(std::numeric_limits<double>::max());
    dvec3 high(-low);
    for (const std::uint32_t t : triangles) {
        const auto [a, b, c] = Triangle(scene, t);
        sum += glm::cross(b - a, c - a);
        low = glm::min(low, glm::min(a, glm::min(b, c)));
        high = glm::max(high, glm::max(a, glm::max(b, c)));
    }
    if (!(glm::length(sum) > 0.0)) return std::nullopt;
    const dvec3 normal = glm::normalize(sum);
    const dvec3 anchor = Triangle(scene, triangles.front()).a;
    const double tolerance = flatness * glm::length(high - low);
    for (const std::uint32_t t : triangles) {
        const Triangle triangle(scene, t);
        if (glm::dot(triangle.cross(), normal) <= 0.0) return std::nullopt;
        for (const dvec3& p : {triangle.a, triangle.b, triangle.c}) {
            if (std::abs(glm::dot(p - anchor, normal)) > tolerance) return std::nullopt;
        }
    }
    return normal;
}

/// Corners of the convex hull, counter-clockwise [Andrew 1979].
std::vector<dvec2> convex_hull(std::vector<dvec2> points) {
    std::sort(points.begin(), points.end(),
              [](const dvec2& a, const dvec2& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
    std::vector<dvec2> hull;
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

/// The bounding rectangle in the frame (x, normal cross x), where x is a direction in the plane.
Rectangle bounds(const std::vector<dvec3>& points, const dvec3& x, const dvec3& normal) {
    Rectangle r;
    r.x = x;
    r.y = glm::cross(normal, x);
    dvec2 low(std::numeric_limits<double>::max());
    dvec2 high(-low);
    for (const dvec3& p : points) {
        const dvec2 q = r.local(p);
        low = glm::min(low, q);
        high = glm::max(high, q);
    }
    r.origin = low.x * r.x + low.y * r.y + glm::dot(points.front(), normal) * normal;
    r.width = high.x - low.x;
    r.height = high.y - low.y;
    return r;
}

/// The smallest bounding rectangle; among equals always the same one: long side first, then by direction in space.
Rectangle smallest_rectangle(const Scene& scene, std::span<const std::uint32_t> triangles, const dvec3& normal) {
    const dvec3 across = std::abs(normal.x) < 0.5 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
    const dvec3 s = glm::normalize(across - glm::dot(across, normal) * normal);
    const dvec3 t = glm::cross(normal, s);
    const double offset = glm::dot(Triangle(scene, triangles.front()).a, normal);
    std::vector<dvec2> projected;
    for (const std::uint32_t triangle : triangles) {
        const auto [a, b, c] = Triangle(scene, triangle);
        for (const dvec3& p : {a, b, c}) projected.emplace_back(glm::dot(p, s), glm::dot(p, t));
    }
    std::vector<dvec3> hull;
    for (const dvec2& p : convex_hull(std::move(projected))) hull.push_back(p.x * s + p.y * t + offset * normal);

    std::vector<Rectangle> candidates;
    double smallest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const dvec3 edge = glm::normalize(hull[(i + 1) % hull.size()] - hull[i]);
        const dvec3 turned = glm::cross(normal, edge);
        for (const dvec3& x : {edge, turned, -edge, -turned}) {
            const Rectangle r = bounds(hull, x, normal);
            if (r.height > r.width * (1.0 + flatness)) continue;
            candidates.push_back(r);
            smallest = std::min(smallest, r.width * r.height);
        }
    }
    const auto direction = [](const Rectangle& r) {
        const auto rounded = [](double v) { return std::llround(1e4 * v); };
        return std::tuple(rounded(r.x.x), rounded(r.x.y), rounded(r.x.z));
    };
    std::erase_if(candidates, [&](const Rectangle& r) { return r.width * r.height > smallest * (1.0 + 1e-4); });
    return *std::max_element(candidates.begin(), candidates.end(),
                             [&](const Rectangle& a, const Rectangle& b) { return direction(a) < direction(b); });
}

}  // namespace

std::vector<AreaSample> spread_on_flat(const Scene& scene, std::span<const std::uint32_t> triangles,
                                       std::size_t count) {
    const std::optional<dvec3> normal = common_normal(scene, triangles);
    if (!normal) return {};
    const Rectangle rectangle = smallest_rectangle(scene, triangles, *normal);
    std::vector<std::array<dvec2, 3>> local;
    for (const std::uint32_t t : triangles) {
        const auto [a, b, c] = Triangle(scene, t);
        local.push_back({rectangle.local(a), rectangle.local(b), rectangle.local(c)});
    }
    const double slack = -1e-12 * rectangle.width * rectangle.width;
    const auto find_triangle = [&](const dvec2& p) -> std::optional<std::size_t> {
        for (std::size_t i = 0; i < local.size(); ++i) {
            const auto& [a, b, c] = local[i];
            if (cross(b - a, p - a) >= slack && cross(c - b, p - b) >= slack && cross(a - c, p - c) >= slack) return i;
        }
        return std::nullopt;
    };

    // The additive recurrence of the plastic number [Roberts 2018] from the center: even for any count.
    constexpr double step_x = 0.7548776662466927;
    constexpr double step_y = 0.5698402909980532;
    std::vector<AreaSample> samples;
    for (std::size_t i = 0; samples.size() < count; ++i) {
        if (i >= most_tries * count) return {};
        const double x = 0.5 + step_x * static_cast<double>(i);
        const double y = 0.5 + step_y * static_cast<double>(i);
        const dvec2 p((x - std::floor(x)) * rectangle.width, (y - std::floor(y)) * rectangle.height);
        const std::optional<std::size_t> found = find_triangle(p);
        if (!found) continue;
        samples.push_back({glm::vec3(rectangle.origin + p.x * rectangle.x + p.y * rectangle.y), glm::vec3(*normal),
                           triangles[*found]});
    }
    return samples;
}

}  // namespace render
