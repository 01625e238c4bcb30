#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "scenes/shapes.hpp"

namespace render {
namespace {

constexpr float two_pi = 2.0f * std::numbers::pi_v<float>;

float turn(int i, int segments) { return two_pi * static_cast<float>(i) / static_cast<float>(segments); }

/// Outward normal of the profile's edge from a to b, which runs upwards along the outside.
glm::vec2 edge_normal(const glm::vec2& a, const glm::vec2& b) {
    const glm::vec2 d = b - a;
    return d == glm::vec2(0.0f) ? d : glm::normalize(glm::vec2(d.y, -d.x));
}

/// Any unit vector at right angles to the unit vector `v`.
glm::vec3 across(const glm::vec3& v) {
    const glm::vec3 other = std::abs(v.y) < 0.9f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
    return glm::normalize(glm::cross(v, other));
}

}  // namespace

std::vector<glm::vec2> smooth_profile(std::span<const glm::vec2> points, int steps) {
    std::vector<glm::vec2> result;
    const auto at = [&](std::size_t i, std::size_t offset) {
        const std::size_t j = i + offset;  // one to the right of the index meant
        return points[j == 0 ? 0 : std::min(j - 1, points.size() - 1)];
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const std::array p{at(i, 0), at(i, 1), at(i, 2), at(i, 3)};
        for (int s = 0; s < steps; ++s) {
            const float t = static_cast<float>(s) / static_cast<float>(steps);
            const glm::vec2 q = 0.5f * (2.0f * p[1] + t * (p[2] - p[0]) +
                                        t * t * (2.0f * p[0] - 5.0f * p[1] + 4.0f * p[2] - p[3]) +
                                        t * t * t * (3.0f * p[1] - p[0] - 3.0f * p[2] + p[3]));
            result.emplace_back(std::max(q.x, 0.001f), q.y);
        }
    }
    result.push_back(points.back());
    return result;
}

void Modeller::lathe(std::span<const glm::vec2> profile, int segments) {
    float radius = 0.0f;
    float low = profile.front().y;
    float high = low;
    std::vector<std::uint32_t> rings;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const glm::vec2 p = profile[i];
        radius = std::max(radius, p.x);
        low = std::min(low, p.y);
        high = std::max(high, p.y);
        const glm::vec2 before = i > 0 ? edge_normal(profile[i - 1], p) : glm::vec2(0.0f);
        const glm::vec2 after = i + 1 < profile.size() ? edge_normal(p, profile[i + 1]) : glm::vec2(0.0f);
        const glm::vec2 n = before + after;
        rings.push_back(static_cast<std::uint32_t>(scene.positions.size()));
        for (int s = 0; s <= segments; ++s) {
            const float angle = turn(s % segments, segments);
            vertex({p.x * std::cos(angle), p.y, -p.x * std::sin(angle)},
                   {n.x * std::cos(angle), n.y, -n.x * std::sin(angle)});
        }
    }
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        if (profile[i] == profile[i + 1]) continue;
        for (std::uint32_t s = 0; s < static_cast<std::uint32_t>(segments); ++s) {
            const std::uint32_t a = rings[i] + s;
            const std::uint32_t b = rings[i + 1] + s;
            if (profile[i].x > 0.0f) triangle(a, a + 1, b + 1);
            if (profile[i + 1].x > 0.0f) triangle(a, b + 1, b);
        }
    }
    add_solid({-radius, low, -radius}, {radius, high, radius}, profile);
}

void Modeller::sleeve(std::span<const glm::vec3> points, int around) {
    const auto columns = static_cast<std::size_t>(around);
    const std::size_t rings = points.size() / columns;
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    const auto at = [&](std::size_t ring, std::size_t column) { return points[ring * columns + column % columns]; };
    for (std::size_t i = 0; i < rings; ++i) {
        for (std::size_t s = 0; s < columns; ++s) {
            const glm::vec3 along = at(i, s + 1) - at(i, s + columns - 1);
            const glm::vec3 up = at(std::min(i + 1, rings - 1), s) - at(i > 0 ? i - 1 : 0, s);
            vertex(at(i, s), glm::cross(along, up));
        }
    }
    for (std::size_t i = 0; i + 1 < rings; ++i) {
        for (std::size_t s = 0; s < columns; ++s) {
            const auto index = [&](std::size_t ring, std::size_t column) {
                return first + static_cast<std::uint32_t>(ring * columns + column % columns);
            };
            triangle(index(i, s), index(i, s + 1), index(i + 1, s + 1));
            triangle(index(i, s), index(i + 1, s + 1), index(i + 1, s));
        }
    }
}

void Modeller::sphere(const glm::vec3& center, float radius, int segments) {
    std::vector<glm::vec2> profile;
    const int rings = segments / 2;
    for (int i = 0; i <= rings; ++i) {
        const float angle = 0.5f * turn(i, rings);
        const bool pole = i == 0 || i == rings;
        profile.emplace_back(pole ? 0.0f : radius * std::sin(angle), -radius * std::cos(angle));
    }
    const glm::mat4 outer = place;
    place = glm::translate(place, center);
    lathe(profile, segments);
    place = outer;
}

void Modeller::cylinder(const glm::vec3& base, float radius, float height, int segments) {
    const std::array<glm::vec2, 6> profile{
        {{0.0f, 0.0f}, {radius, 0.0f}, {radius, 0.0f}, {radius, height}, {radius, height}, {0.0f, height}}};
    const glm::mat4 outer = place;
    place = glm::translate(place, base);
    lathe(profile, segments);
    place = outer;
}

void Modeller::tube(std::span<const glm::vec3> path, float radius, int segments, bool closed) {
    const auto count = path.size();
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    const auto around = static_cast<std::uint32_t>(segments);
    glm::vec3 side(0.0f);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3& next = path[i + 1 < count ? i + 1 : closed ? 0 : i];
        const glm::vec3& last = path[i > 0 ? i - 1 : closed ? count - 1 : 0];
        const glm::vec3 along = glm::normalize(next - last);
        // Carry the frame along the path, so that it does not twist.
        side = i == 0 ? across(along) : glm::normalize(side - glm::dot(side, along) * along);
        const glm::vec3 up = glm::cross(along, side);
        for (int s = 0; s < segments; ++s) {
            const float angle = turn(s, segments);
            const glm::vec3 n = std::cos(angle) * side + std::sin(angle) * up;
            vertex(path[i] + radius * n, n);
        }
    }
    const std::size_t links = closed ? count : count - 1;
    for (std::size_t i = 0; i < links; ++i) {
        const std::uint32_t a = first + static_cast<std::uint32_t>(i) * around;
        const std::uint32_t b = first + static_cast<std::uint32_t>((i + 1) % count) * around;
        // The carried frame does not close exactly on a ring: join each vertex to the nearest of the first circle.
        std::uint32_t shift = 0;
        if (i + 1 == count) {
            const auto distance = [&](std::uint32_t s) {
                return glm::distance(scene.positions[a], scene.positions[b + s]);
            };
            for (std::uint32_t s = 1; s < around; ++s) shift = distance(s) < distance(shift) ? s : shift;
        }
        for (std::uint32_t s = 0; s < around; ++s) {
            const std::uint32_t t = (s + 1) % around;
            triangle(a + s, a + t, b + (t + shift) % around);
            triangle(a + s, b + (t + shift) % around, b + (s + shift) % around);
        }
    }
}

void Modeller::blade(const glm::vec3& root, const glm::vec3& tip, float width, float droop, int segments) {
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    const glm::vec3 side = glm::normalize(glm::cross(tip - root, glm::vec3(0.0f, 1.0f, 0.0f)));
    const auto center = [&](float t) { return root + t * (tip - root) - glm::vec3(0.0f, droop * t * t, 0.0f); };
    for (int i = 0; i <= segments; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(segments);
        const glm::vec3 along = center(t + 0.01f) - center(t - 0.01f);
        const glm::vec3 normal = glm::normalize(glm::cross(side, along));
        // Widest below the middle, pointed at the end.
        const float half = i == segments
                               ? 0.0f
                               : 0.5f * width * std::sin(std::numbers::pi_v<float> * std::sqrt(0.03f + 0.97f * t));
        vertex(center(t) - half * side, normal);
        if (i < segments) vertex(center(t) + half * side, normal);
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(segments); ++i) {
        const std::uint32_t a = first + 2 * i;
        const bool last = i + 1 == static_cast<std::uint32_t>(segments);
        triangle(a, a + 1, a + 2);
        if (!last) triangle(a + 1, a + 3, a + 2);
    }
}

}  // namespace render
