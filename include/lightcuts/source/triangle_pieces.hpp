#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "../core/invalid_input.hpp"
#include "emitter.hpp"
#include "equal_power_strata.hpp"

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
    std::array<glm::vec2, 3> corners;  ///< uv: sums of powers of 1/2, exact in float
    std::uint32_t triangle;
    bool back;
    double area;
    S radiance;  ///< mean

    glm::dvec2 middle() const {
        return (glm::dvec2(corners[0]) + glm::dvec2(corners[1]) + glm::dvec2(corners[2])) / 3.0;
    }
    /// Uniform over the piece for (x, y) uniform in the unit square; x orders it from corner 0 on.
    glm::dvec2 at(double x, double y) const {
        const double s = std::sqrt(x);
        return (1.0 - s) * glm::dvec2(corners[0]) + s * (1.0 - y) * glm::dvec2(corners[1]) +
               s * y * glm::dvec2(corners[2]);
    }
};

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

/// Mean over a piece by a rule of sixteen points: the middles of its sixteenths.
template <EmissiveMesh E>
emitter_spectrum<E> mean_radiance(const E& emitter, const TrianglePiece<emitter_spectrum<E>>& piece) {
    const auto& [a, b, c] = piece.corners;
    const glm::vec2 along = 0.25f * (b - a), up = 0.25f * (c - a), third = (along + up) / 3.0f;
    SpectrumSum<emitter_spectrum<E>> sum;
    const auto take = [&](const glm::vec2& uv) {
        const auto radiance = emitter.radiance(piece.triangle, uv);
        validate_radiance(radiance, piece.triangle);
        sum.add(radiance, 1.0 / 16.0);
    };
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4 - i; ++j) {
            const glm::vec2 corner = a + along * static_cast<float>(i) + up * static_cast<float>(j);
            take(corner + third);
            if (i + j < 3) take(corner + 2.0f * third);
        }
    }
    return sum.value();
}

/// Appends the halves of `piece`, cut at the middle of its longest edge.
template <Spectrum S>
void halve(const Facet& facet, const TrianglePiece<S>& piece, std::vector<TrianglePiece<S>>& out) {
    std::size_t from = 0;
    double longest = -1.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double length = glm::distance(facet.at(piece.corners[i]), facet.at(piece.corners[(i + 1) % 3]));
        if (length > longest) {
            longest = length;
            from = i;
        }
    }
    const glm::vec2 a = piece.corners[from], b = piece.corners[(from + 1) % 3], c = piece.corners[(from + 2) % 3];
    const glm::vec2 middle = 0.5f * (a + b);
    TrianglePiece<S> half = piece;
    half.area = 0.5 * piece.area;
    half.corners = {a, middle, c};
    out.push_back(half);
    half.corners = {middle, b, c};
    out.push_back(half);
}

/// The sides of the triangles of `emitter` that shine, whole. throws: invalid_input naming the triangle
template <EmissiveMesh E>
std::vector<TrianglePiece<emitter_spectrum<E>>> shining_sides(const E& emitter) {
    std::vector<TrianglePiece<emitter_spectrum<E>>> sides;
    const std::size_t count = emitter.triangle_count();
    for (std::uint32_t t = 0; t < count; ++t) {
        const Facet facet = facet_of(emitter, t);
        const double area = 0.5 * glm::length(facet.cross());
        if (!(area - area == 0.0)) {
            LIGHTCUTS_THROW(invalid_input("emitter, triangle " + std::to_string(t) + ": a corner is not finite"));
        }
        if (!(area > 0.0)) continue;
        TrianglePiece<emitter_spectrum<E>> side{{glm::vec2(0.0f), {1.0f, 0.0f}, {0.0f, 1.0f}}, t, false, area, {}};
        if (!is_textured(emitter, t)) {
            side.radiance = emitter.radiance(t, glm::vec2(1.0f / 3.0f));
            validate_radiance(side.radiance, t);
        }
        sides.push_back(side);
        side.back = true;
        if (is_two_sided(emitter, t)) sides.push_back(side);
    }
    if (sides.empty()) {
        LIGHTCUTS_THROW(invalid_input("emitter: its " + std::to_string(count) + " triangles have no area"));
    }
    return sides;
}

/// Cuts the sides of an emitter: no piece has more than `share` of the power, none of a textured triangle more than
/// `textured_share` of the area; over each the radiance counts as constant.
template <EmissiveMesh E>
std::vector<TrianglePiece<emitter_spectrum<E>>> cut_sides(const E& emitter, double share, double textured_share) {
    using Piece = TrianglePiece<emitter_spectrum<E>>;
    const std::vector<Piece> sides = shining_sides(emitter);
    double area = 0.0;
    for (const Piece& side : sides) area += side.area;

    const auto cut = [&](std::span<const Piece> wholes, auto&& is_small, std::vector<Piece>& out) {
        std::vector<Piece> open;
        for (const Piece& whole : wholes) {
            const Facet facet = facet_of(emitter, whole.triangle);
            open.push_back(whole);
            while (!open.empty()) {
                const Piece piece = open.back();
                open.pop_back();
                if (is_small(piece)) {
                    out.push_back(piece);
                } else {
                    halve(facet, piece, open);
                }
            }
        }
    };
    std::vector<Piece> even;
    cut(
        sides, [&](const Piece& p) { return !is_textured(emitter, p.triangle) || p.area <= textured_share * area; },
        even);
    double power = 0.0;
    for (Piece& piece : even) {
        if (is_textured(emitter, piece.triangle)) piece.radiance = mean_radiance(emitter, piece);
        power += piece.area * channel_sum(piece.radiance);
    }
    std::vector<Piece> pieces;
    cut(
        even, [&](const Piece& p) { return p.area * channel_sum(p.radiance) <= share * power; }, pieces);
    return pieces;
}

}  // namespace lightcuts::detail
