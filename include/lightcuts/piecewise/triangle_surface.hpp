#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/invalid_input.hpp"

namespace lightcuts::detail {

/// A triangle with what lies at its edges; edge k is opposite corner k and leads from corner k + 1 to corner k + 2.
struct SurfaceTriangle {
    static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);

    std::array<glm::dvec3, 3> corners;
    glm::dvec3 normal{0.0};  ///< unit, of the side from which the corners run counter-clockwise; 0 if there is no area
    double area = 0.0;       ///< 0 if it is too thin for a normal
    std::uint32_t part = none;                              ///< connected part of the surface that it belongs to
    double side = 1.0;                                      ///< -1: its winding is opposed to that of its part
    std::array<std::uint32_t, 3> across{none, none, none};  ///< neighbor at each edge
    std::array<std::uint8_t, 3> across_edge{};              ///< which of the neighbor's edges that is
    std::array<bool, 3> is_opposed{};                       ///< the neighbor winds the other way

    glm::dvec3 at(const std::array<double, 3>& weights) const {
        return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
    }
    glm::dvec3 edge_begin(std::size_t k) const { return corners[(k + 1) % 3]; }
    glm::dvec3 edge_end(std::size_t k) const { return corners[(k + 2) % 3]; }
    /// Unit, in the plane, at a right angle to edge k. pre: area > 0.
    glm::dvec3 outwards(std::size_t k) const { return glm::normalize(glm::cross(edge_end(k) - edge_begin(k), normal)); }
};

/// A triangle mesh as a surface on which one can walk: corners in one place are one vertex, and two triangles with two
/// vertices in common are neighbors if the surface turns by less than 60 degrees there. Of several at an edge those are
/// that continue each other most smoothly; at an edge of more than 16 none. Triangles without an area are no part of
/// it.
class TriangleSurface {
public:
    /// `corners(i, k)`: of triangle i, a glm::dvec3.
    /// throws: invalid_input naming the triangle with a corner that is not finite. cost: O(N log N).
    template <class Corners>
    TriangleSurface(std::size_t count, const Corners& corners) : triangles_(count) {
        for (std::size_t i = 0; i < count; ++i) {
            SurfaceTriangle& t = triangles_[i];
            for (std::size_t k = 0; k < 3; ++k) {
                t.corners[k] = corners(i, k);
                for (int axis = 0; axis < 3; ++axis) {
                    // Beyond the largest float products of four could overflow.
                    if (!(std::abs(t.corners[k][axis]) <= static_cast<double>((std::numeric_limits<float>::max)()))) {
                        LIGHTCUTS_THROW(
                            invalid_input("triangle " + std::to_string(i) + ": a corner is not finite; leave it out"));
                    }
                    // -0 and 0 are one place.
                    t.corners[k][axis] += 0.0;
                }
            }
            measure(t);
        }
        connect(edges());
        find_parts();
    }

    std::size_t size() const { return triangles_.size(); }
    std::uint32_t part_count() const { return part_count_; }
    const SurfaceTriangle& operator[](std::size_t i) const { return triangles_[i]; }

private:
    struct Edge {
        std::uint64_t vertices;  ///< the smaller number above the larger
        std::uint32_t triangle;
        std::uint8_t edge;
        bool ascends;  ///< from the smaller vertex to the larger
    };

    static void measure(SurfaceTriangle& t) {
        const glm::dvec3 b = t.corners[1] - t.corners[0], c = t.corners[2] - t.corners[0], a = c - b;
        const glm::dvec3 cross = glm::cross(b, c);
        const double doubled = glm::length(cross);
        const double longest2 = (std::max)({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
        // What is thinner has a normal of rounding errors.
        if (!(doubled > 1e-12 * longest2)) return;
        t.area = 0.5 * doubled;
        t.normal = cross / doubled;
    }

    /// The edges of all triangles with an area, those of equal vertices one after another.
    std::vector<Edge> edges() const {
        struct Corner {
            glm::dvec3 place;
            std::uint32_t index;
        };
        std::vector<Corner> corners;
        corners.reserve(3 * triangles_.size());
        for (std::size_t i = 0; i < 3 * triangles_.size(); ++i) {
            corners.push_back({triangles_[i / 3].corners[i % 3], static_cast<std::uint32_t>(i)});
        }
        const auto key = [](const glm::dvec3& p) { return std::array{p.x, p.y, p.z}; };
        std::sort(corners.begin(), corners.end(), [&](const Corner& a, const Corner& b) {
            return std::pair(key(a.place), a.index) < std::pair(key(b.place), b.index);
        });
        std::vector<std::uint32_t> vertex_of(corners.size());
        std::uint32_t vertex = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (i > 0 && corners[i].place != corners[i - 1].place) ++vertex;
            vertex_of[corners[i].index] = vertex;
        }
        std::vector<Edge> result;
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            if (!(triangles_[t].area > 0.0)) continue;
            for (std::uint8_t k = 0; k < 3; ++k) {
                const std::uint64_t a = vertex_of[3 * t + (k + 1u) % 3], b = vertex_of[3 * t + (k + 2u) % 3];
                result.push_back({(std::min)(a, b) << 32 | (std::max)(a, b), t, k, a < b});
            }
        }
        std::sort(result.begin(), result.end(), [](const Edge& a, const Edge& b) {
            return std::pair(a.vertices, a.triangle) < std::pair(b.vertices, b.triangle);
        });
        return result;
    }

    void connect(const std::vector<Edge>& edges) {
        constexpr std::size_t most = 16;
        constexpr double least_smoothness = 0.5;
        struct Pair {
            double smoothness;
            std::size_t a, b;
        };
        std::vector<Pair> pairs;
        for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
            while (end < edges.size() && edges[end].vertices == edges[begin].vertices) ++end;
            if (end - begin > most) continue;
            pairs.clear();
            for (std::size_t a = begin; a < end; ++a) {
                for (std::size_t b = a + 1; b < end; ++b) {
                    const double cosine = glm::dot(triangles_[edges[a].triangle].normal,
                                                   triangles_[edges[b].triangle].normal);
                    const double smoothness = edges[a].ascends == edges[b].ascends ? -cosine : cosine;
                    if (smoothness > least_smoothness) pairs.push_back({smoothness, a, b});
                }
            }
            std::stable_sort(pairs.begin(), pairs.end(),
                             [](const Pair& x, const Pair& y) { return x.smoothness > y.smoothness; });
            for (const Pair& pair : pairs) {
                const Edge &a = edges[pair.a], &b = edges[pair.b];
                if (triangles_[a.triangle].across[a.edge] != SurfaceTriangle::none) continue;
                if (triangles_[b.triangle].across[b.edge] != SurfaceTriangle::none) continue;
                for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
                    SurfaceTriangle& t = triangles_[from.triangle];
                    t.across[from.edge] = to.triangle;
                    t.across_edge[from.edge] = to.edge;
                    t.is_opposed[from.edge] = a.ascends == b.ascends;
                }
            }
        }
    }

    void find_parts() {
        std::vector<std::uint32_t> open;
        for (std::uint32_t first = 0; first < triangles_.size(); ++first) {
            if (triangles_[first].part != SurfaceTriangle::none || !(triangles_[first].area > 0.0)) continue;
            triangles_[first].part = part_count_;
            open.push_back(first);
            while (!open.empty()) {
                const SurfaceTriangle& t = triangles_[open.back()];
                open.pop_back();
                for (std::size_t k = 0; k < 3; ++k) {
                    if (t.across[k] == SurfaceTriangle::none) continue;
                    SurfaceTriangle& next = triangles_[t.across[k]];
                    if (next.part != SurfaceTriangle::none) continue;
                    next.part = part_count_;
                    next.side = t.is_opposed[k] ? -t.side : t.side;
                    open.push_back(t.across[k]);
                }
            }
            ++part_count_;
        }
    }

    std::vector<SurfaceTriangle> triangles_;
    std::uint32_t part_count_ = 0;
};

/// A place on a surface.
struct SurfacePlace {
    std::uint32_t triangle = 0;
    std::array<double, 3> weights{1.0, 0.0, 0.0};  ///< of its corners, >= 0, with the sum 1
};

/// Moves `place` by the vector `way` along the surface: straight on within a triangle, turned about the edge into the
/// next one, and along the edge where there is none. After 64 edges it stops. cost: O(edges).
inline void walk(const TriangleSurface& surface, SurfacePlace& place, glm::dvec3 way) {
    for (int crossed = 0; crossed < 64; ++crossed) {
        const SurfaceTriangle& t = surface[place.triangle];
        const glm::dvec3 b = t.corners[1] - t.corners[0], c = t.corners[2] - t.corners[0];
        const double doubled = 2.0 * t.area;
        const double to_b = glm::dot(glm::cross(way, c), t.normal) / doubled;
        const double to_c = glm::dot(glm::cross(b, way), t.normal) / doubled;
        const std::array<double, 3> rates{-to_b - to_c, to_b, to_c};
        double share = 1.0;
        std::size_t edge = 3;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!(place.weights[k] + rates[k] < 0.0)) continue;
            const double until = place.weights[k] / -rates[k];
            if (until < share) {
                share = until;
                edge = k;
            }
        }
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            double& weight = place.weights[k];
            weight = k == edge ? 0.0 : (std::max)(0.0, weight + share * rates[k]);
            sum += weight;
        }
        for (double& weight : place.weights) weight /= sum;
        if (edge == 3) return;
        way *= 1.0 - share;
        const glm::dvec3 outwards = t.outwards(edge);
        const double across = glm::dot(way, outwards);
        way -= across * outwards;
        if (t.across[edge] == SurfaceTriangle::none) continue;
        const SurfaceTriangle& next = surface[t.across[edge]];
        const std::size_t entered = t.across_edge[edge];
        way -= across * next.outwards(entered);
        // Of two that wind alike, one runs along their edge from its end.
        std::array<double, 3> weights{};
        const std::size_t begin = (entered + (t.is_opposed[edge] ? 1u : 2u)) % 3, end = 3 - entered - begin;
        weights[begin] = place.weights[(edge + 1) % 3];
        weights[end] = place.weights[(edge + 2) % 3];
        place = {t.across[edge], weights};
    }
}

}  // namespace lightcuts::detail
