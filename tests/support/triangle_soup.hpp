#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "random.hpp"

namespace lightcuts::test {

using Corners = std::array<glm::vec3, 3>;

/// Triangles by the shapes that they make up, and brute-force rays among them, in double.
class TriangleSoup {
public:
    std::vector<Corners> triangles;

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        triangles.push_back({glm::vec3(a), glm::vec3(b), glm::vec3(c)});
    }
    /// A parallelogram of n x m pairs of triangles; each pair's diagonal and order of corners by chance.
    void add_sheet(Random& random, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, int n, int m,
                   double bumps = 0.0) {
        const glm::dvec3 up = glm::normalize(glm::cross(u, v));
        std::vector<glm::dvec3> points;
        for (int i = 0; i <= n; ++i) {
            for (int k = 0; k <= m; ++k) {
                points.push_back(corner + u * (i / double(n)) + v * (k / double(m)) +
                                 up * random.between(-bumps, bumps));
            }
        }
        const auto at = [&](int i, int k) { return points[static_cast<std::size_t>(i * (m + 1) + k)]; };
        for (int i = 0; i < n; ++i) {
            for (int k = 0; k < m; ++k) {
                const glm::dvec3 a = at(i, k), b = at(i + 1, k), c = at(i + 1, k + 1), d = at(i, k + 1);
                const bool first = random.chance(0.5);
                add_turned(random, a, b, first ? c : d);
                add_turned(random, first ? a : b, c, d);
            }
        }
    }
    /// A closed box.
    void add_box(Random& random, const glm::dvec3& lo, const glm::dvec3& hi, int n) {
        const glm::dvec3 e = hi - lo;
        const glm::dvec3 x(e.x, 0, 0), y(0, e.y, 0), z(0, 0, e.z);
        add_sheet(random, lo, x, y, n, n);
        add_sheet(random, lo + z, x, y, n, n);
        add_sheet(random, lo, y, z, n, n);
        add_sheet(random, lo + x, y, z, n, n);
        add_sheet(random, lo, x, z, n, n);
        add_sheet(random, lo + y, x, z, n, n);
    }

    /// Triangles that the segment from `from` to `from + way` meets, nearest first; `way` may be long.
    std::vector<std::uint32_t> hits(const glm::dvec3& from, const glm::dvec3& way) const {
        std::vector<std::pair<double, std::uint32_t>> found;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const double t = crossing(triangles[i], from, way);
            if (t >= 0.0 && t <= 1.0) found.emplace_back(t, static_cast<std::uint32_t>(i));
        }
        std::sort(found.begin(), found.end());
        std::vector<std::uint32_t> order;
        for (const auto& [t, i] : found) order.push_back(i);
        return order;
    }
    /// Where a line meets a triangle, in units of `way`; -1 if it does not. Edges belong to it.
    static double crossing(const Corners& c, const glm::dvec3& from, const glm::dvec3& way) {
        const glm::dvec3 a = glm::dvec3(c[0]) - from, b = glm::dvec3(c[1]) - from, d = glm::dvec3(c[2]) - from;
        const double u = glm::dot(glm::cross(a, b), way), v = glm::dot(glm::cross(b, d), way),
                     w = glm::dot(glm::cross(d, a), way);
        if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) || u + v + w == 0.0) return -1.0;
        const glm::dvec3 normal = glm::cross(b - a, d - a);
        const double t = glm::dot(normal, a) / glm::dot(normal, way);
        return t >= 0.0 ? t : -1.0;
    }

private:
    void add_turned(Random& random, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const std::array<glm::dvec3, 3> corners{a, b, c};
        const std::size_t first = random.below(3);
        if (random.chance(0.5)) {
            add(corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]);
        } else {
            add(corners[first], corners[(first + 2) % 3], corners[(first + 1) % 3]);
        }
    }
};

}  // namespace lightcuts::test
