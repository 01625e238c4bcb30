#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "../core/invalid_input.hpp"
#include "emitter.hpp"

namespace lightcuts::detail {

/// A triangle in space, in double.
struct Facet {
    glm::dvec3 a, b, c;

    glm::dvec3 at(const glm::dvec2& uv) const { return a + uv.x * (b - a) + uv.y * (c - a); }
    glm::dvec3 cross() const { return glm::cross(b - a, c - a); }
};

template <EmissiveMesh E>
Facet facet_of(const E& emitter, std::uint32_t t) {
    const auto corner = [&](int k) { return glm::dvec3(to_vec3(emitter.corner(t, k))); };
    return {corner(0), corner(1), corner(2)};
}

template <EmissiveMesh E>
bool is_two_sided(const E& emitter, std::uint32_t t) {
    if constexpr (requires { emitter.two_sided(t); }) return emitter.two_sided(t);
    return false;
}

template <EmissiveMesh E>
bool is_textured(const E& emitter, std::uint32_t t) {
    if constexpr (requires { emitter.is_textured(t); }) return emitter.is_textured(t);
    return true;
}

/// Part of one side of a triangle.
template <Spectrum S>
struct TrianglePiece {
    PieceCorners corners;  ///< uv: sums of powers of 1/2, exact in float
    std::uint32_t triangle;
    bool back;
    double area;
    S radiance;                               ///< mean
    glm::vec2 lit{1.0f / 3.0f, 1.0f / 3.0f};  ///< uv of a point that shines, if the mean is not black

    double power() const { return area * channel_sum(radiance); }
    glm::dvec2 middle() const {
        return (glm::dvec2(corners[0]) + glm::dvec2(corners[1]) + glm::dvec2(corners[2])) / 3.0;
    }
    /// Uniform over the piece for (x, y) uniform in the unit square; x orders it from corner 0 on.
    glm::dvec2 at(double x, double y) const {
        const double s = std::sqrt(x);
        return (1.0 - s) * glm::dvec2(corners[0]) + s * (1.0 - y) * glm::dvec2(corners[1]) +
               s * y * glm::dvec2(corners[2]);
    }
    /// False if corners of its parts might not be exact in float.
    bool can_be_halved() const {
        constexpr float smallest = 0x1p-21f;
        const auto& [a, b, c] = corners;
        const glm::vec2 extent = (glm::max)(a, (glm::max)(b, c)) - (glm::min)(a, (glm::min)(b, c));
        return extent.x > smallest || extent.y > smallest;
    }
    /// Its parts, cut from the middle of the edge that begins at corner `edge`.
    std::array<TrianglePiece, 2> halves(std::size_t edge) const {
        const glm::vec2 a = corners[edge], b = corners[(edge + 1) % 3], c = corners[(edge + 2) % 3];
        const glm::vec2 halfway = 0.5f * (a + b);
        std::array<TrianglePiece, 2> parts{*this, *this};
        parts[0].corners = {a, halfway, c};
        parts[1].corners = {halfway, b, c};
        parts[0].area = parts[1].area = 0.5 * area;
        return parts;
    }
};

/// The corner at which the edge begins that is longest in space.
inline std::size_t longest_edge(const Facet& facet, const PieceCorners& corners) {
    std::size_t from = 0;
    double longest = -1.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double length = glm::distance(facet.at(corners[i]), facet.at(corners[(i + 1) % 3]));
        if (length > longest) {
            longest = length;
            from = i;
        }
    }
    return from;
}

/// throws: invalid_input naming the triangle
template <Spectrum S>
void validate_radiance(const S& radiance, std::uint32_t triangle) {
    for (int i = 0; i < channels_of<S>; ++i) {
        const float c = channel(radiance, i);
        if (!(c >= 0.0f && c - c == 0.0f)) {
            LIGHTCUTS_THROW(invalid_input("emitter, triangle " + std::to_string(triangle) + ": radiance " +
                                          std::to_string(c) + (c < 0.0f ? " is negative" : " is not finite")));
        }
    }
}

/// The sides of the triangles of `emitter` that have an area, whole, with the radiance of those without a texture.
/// throws: invalid_input naming the triangle
template <EmissiveMesh E>
std::vector<TrianglePiece<emitter_spectrum<E>>> sides_of(const E& emitter) {
    std::vector<TrianglePiece<emitter_spectrum<E>>> sides;
    const std::size_t count = emitter.triangle_count();
    for (std::uint32_t t = 0; t < count; ++t) {
        const Facet facet = facet_of(emitter, t);
        const double area = 0.5 * glm::length(facet.cross());
        if (!(area - area == 0.0)) {
            LIGHTCUTS_THROW(invalid_input("emitter, triangle " + std::to_string(t) + ": a corner is not finite"));
        }
        if (!(area > 0.0)) continue;
        TrianglePiece<emitter_spectrum<E>> side{
            {glm::vec2(0.0f), {1.0f, 0.0f}, {0.0f, 1.0f}}, t, false, area, black<emitter_spectrum<E>>()};
        if (!is_textured(emitter, t)) {
            side.radiance = emitter.radiance(t, glm::vec2(1.0f / 3.0f));
            validate_radiance(side.radiance, t);
        }
        sides.push_back(side);
        side.back = true;
        if (is_two_sided(emitter, t)) sides.push_back(side);
    }
    return sides;
}

/// Appends `whole`, cut at the middle of its longest edge until `is_small(piece)`.
template <EmissiveMesh E, class IsSmall>
void cut_until(const E& emitter, const TrianglePiece<emitter_spectrum<E>>& whole, IsSmall&& is_small,
               std::vector<TrianglePiece<emitter_spectrum<E>>>& out) {
    const Facet facet = facet_of(emitter, whole.triangle);
    std::vector<TrianglePiece<emitter_spectrum<E>>> open{whole};
    while (!open.empty()) {
        const auto piece = open.back();
        open.pop_back();
        if (is_small(piece) || !piece.can_be_halved()) {
            out.push_back(piece);
        } else {
            for (const auto& half : piece.halves(longest_edge(facet, piece.corners))) open.push_back(half);
        }
    }
}

}  // namespace lightcuts::detail
