#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <glm/vec3.hpp>

#include "../core/invalid_input.hpp"
#include "../core/vector.hpp"

namespace lightcuts {

/// Opaque triangles that know which of them share an edge: what proofs that lights are hidden walk over. Corners are
/// one vertex if their coordinates are equal as floats, to which they are rounded, and only then: give the numbers that
/// your ray tracer has. Leave out triangles that let light through, or parts of
/// it: glass, masks, foliage of images with holes. The order of corners does not matter: triangles block from both
/// sides. memory: 24 bytes a triangle and 12 a vertex.
class OccluderMesh {
public:
    using Index = std::uint32_t;

    /// A triangle's edge: 3 x triangle + number of the corner that it starts from.
    using HalfEdge = std::uint32_t;

    static constexpr Index no_triangle = (std::numeric_limits<Index>::max)();

    /// No triangles.
    OccluderMesh() = default;

    /// `corners_of(i)`: the three corners of triangle `i`, something to index whose elements have x, y and z, such as
    /// std::array<glm::vec3, 3>. It is called once for each.
    /// throws: invalid_input naming the first triangle with a corner that is not finite; or if there are more
    /// than 1.4e9 triangles. cost: O(N log N); temporary memory of 48 bytes a triangle.
    template <std::invocable<std::size_t> CornersOf>
    OccluderMesh(std::size_t count, const CornersOf& corners_of) {
        if (count > (std::numeric_limits<Index>::max)() / 3) {
            LIGHTCUTS_THROW(invalid_input("occluders: " + std::to_string(count) + " triangles are too many"));
        }
        weld(count, corners_of);
        link();
    }

    std::size_t size() const { return corners_.size() / 3; }
    bool empty() const { return corners_.empty(); }
    std::size_t vertex_count() const { return vertices_.size(); }

    /// Where an edge starts, and where it ends.
    const glm::vec3& start(HalfEdge e) const { return vertices_[corners_[e]]; }
    const glm::vec3& end(HalfEdge e) const { return start(next_of_triangle(e)); }
    /// The corners of a triangle.
    std::array<glm::vec3, 3> corners(Index triangle) const {
        return {start(3 * triangle), start(3 * triangle + 1), start(3 * triangle + 2)};
    }

    static Index triangle_of(HalfEdge e) { return e / 3; }
    /// The triangle's edge that starts where `e` ends.
    static HalfEdge next_of_triangle(HalfEdge e) { return e % 3 == 2 ? e - 2 : e + 1; }

    /// Another triangle's edge between the same vertices, in either direction: all that share them form a ring. An edge
    /// that is its own neighbor is a border.
    HalfEdge neighbor(HalfEdge e) const { return neighbors_[e]; }
    /// True if two neighbors run the same way.
    bool run_alike(HalfEdge a, HalfEdge b) const { return corners_[a] == corners_[b]; }

    /// The largest absolute value of a coordinate.
    double reach() const { return reach_; }

    std::size_t memory_bytes() const {
        return vertices_.capacity() * sizeof(glm::vec3) + (corners_.capacity() + neighbors_.capacity()) * sizeof(Index);
    }

private:
    struct Corner {
        glm::vec3 place;
        std::uint32_t number;
    };
    /// An edge by its vertices, the lower one first.
    struct Edge {
        Index low;
        Index high;
        HalfEdge number;
    };

    template <class CornersOf>
    void weld(std::size_t count, const CornersOf& corners_of) {
        std::vector<Corner> all;
        all.reserve(3 * count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto& corners = corners_of(i);
            for (std::size_t k = 0; k < 3; ++k) {
                // The sum with zero makes -0 and 0 one place.
                const glm::vec3 place = to_vec3(corners[k]) + 0.0f;
                if (!is_finite(place)) {
                    LIGHTCUTS_THROW(
                        invalid_input("occluders: triangle " + std::to_string(i) + " has a corner that is not finite"));
                }
                for (int axis = 0; axis < 3; ++axis) {
                    const double distance = static_cast<double>(place[axis] < 0.0f ? -place[axis] : place[axis]);
                    reach_ = distance > reach_ ? distance : reach_;
                }
                all.push_back({place, static_cast<std::uint32_t>(all.size())});
            }
        }
        std::sort(all.begin(), all.end(), [](const Corner& a, const Corner& b) {
            return std::tie(a.place.x, a.place.y, a.place.z, a.number) <
                   std::tie(b.place.x, b.place.y, b.place.z, b.number);
        });
        corners_.resize(all.size());
        std::size_t places = 0;
        for (std::size_t i = 0; i < all.size(); ++i) places += i == 0 || all[i].place != all[i - 1].place ? 1u : 0u;
        vertices_.reserve(places);
        for (const Corner& c : all) {
            if (vertices_.empty() || c.place != vertices_.back()) vertices_.push_back(c.place);
            corners_[c.number] = static_cast<Index>(vertices_.size() - 1);
        }
    }

    void link() {
        std::vector<Edge> edges(corners_.size());
        for (HalfEdge e = 0; e < edges.size(); ++e) {
            const Index a = corners_[e], b = corners_[next_of_triangle(e)];
            edges[e] = {a < b ? a : b, a < b ? b : a, e};
        }
        std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
            return std::tie(a.low, a.high, a.number) < std::tie(b.low, b.high, b.number);
        });
        neighbors_.resize(edges.size());
        for (std::size_t first = 0; first < edges.size();) {
            std::size_t last = first + 1;
            const auto is_alike = [&](const Edge& e) {
                return e.low == edges[first].low && e.high == edges[first].high;
            };
            while (last < edges.size() && is_alike(edges[last])) ++last;
            for (std::size_t i = first; i < last; ++i) {
                neighbors_[edges[i].number] = edges[i + 1 < last ? i + 1 : first].number;
            }
            first = last;
        }
    }

    std::vector<glm::vec3> vertices_;
    std::vector<Index> corners_;       ///< of half-edge e: where it starts
    std::vector<HalfEdge> neighbors_;  ///< the next in the ring
    double reach_ = 0.0;
};

}  // namespace lightcuts
