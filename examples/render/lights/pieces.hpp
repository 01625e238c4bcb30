#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lights/area_samples.hpp"
#include "scene.hpp"
#include "triangle.hpp"

namespace render {

/// Part of a triangle, as barycentric coordinates (u, v) of its corners: sums of powers of 1/2, exact in float.
struct Piece {
    std::array<glm::vec2, 3> corners{};
    std::uint32_t triangle = 0;
    double area = 0;

    /// Of numbers in [0, 1], evenly over the piece.
    glm::dvec2 at(double along, double across) const {
        const double s = std::sqrt(along);
        const double t = s * across;
        return (1.0 - s) * glm::dvec2(corners[0]) + (s - t) * glm::dvec2(corners[1]) + t * glm::dvec2(corners[2]);
    }
};

/// Pieces of a surface are this much smaller than the share of it for which a point stands, so that a share is a
/// compact patch.
inline constexpr double pieces_per_point = 4.0;

/// A number in [0, 1) for point `i` of a sequence that is spread evenly wherever it ends: multiples of the golden
/// ratio.
inline double golden_fraction(std::size_t i) {
    const double turn = 0.6180339887498949 * static_cast<double>(i);
    return turn - std::floor(turn);
}

/// The two parts of `piece`, cut from the middle of the edge that begins at corner `edge`.
std::array<Piece, 2> halves(const Piece& piece, std::size_t edge);

/// The corner at which the longest edge in space begins.
std::size_t longest_edge(const Triangle& triangle, const Piece& piece);

/// `triangles` in pieces no larger than `share` of their area, without those of no area.
std::vector<Piece> cut_into_pieces(const Scene& scene, std::span<const std::uint32_t> triangles, double share);

/// Places along a space-filling curve through a surface, so that neighbors on the curve are neighbors in space that
/// face about one way.
class SpaceCurve {
public:
    /// `scene` must outlive this object.
    SpaceCurve(const Scene& scene, std::span<const std::uint32_t> triangles);

    std::uint64_t order(const Piece& piece) const;

    /// `pieces` along the curve; equal places stay in their order.
    template <class P>
    std::vector<P> sorted(const std::vector<P>& pieces) const {
        std::vector<std::pair<std::uint64_t, std::size_t>> places;
        places.reserve(pieces.size());
        for (std::size_t i = 0; i < pieces.size(); ++i) places.emplace_back(order(pieces[i]), i);
        std::sort(places.begin(), places.end());
        std::vector<P> result;
        result.reserve(pieces.size());
        for (const auto& [place, i] : places) result.push_back(pieces[i]);
        return result;
    }

private:
    const Scene& scene_;
    glm::dvec3 low_;
    double extent_ = 0;
};

/// The sample at barycentric `place` of `triangle`.
AreaSample sample_at(const Scene& scene, std::uint32_t triangle, const glm::dvec2& place);

}  // namespace render
