#include "lights/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "triangle.hpp"

namespace render {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Cuts `whole` at the middle of its longest edge until no piece is larger than `largest`.
void cut(const Triangle& triangle, const Piece& whole, double largest, std::vector<Piece>& out) {
    std::vector<Piece> open{whole};
    while (!open.empty()) {
        const Piece piece = open.back();
        open.pop_back();
        if (piece.area <= largest) {
            out.push_back(piece);
            continue;
        }
        for (const Piece& half : halves(piece, longest_edge(triangle, piece))) open.push_back(half);
    }
}

/// The bits of x, each followed by two zeros. pre: x < 2^20.
std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | (x << 32)) & 0x001f00000000ffffu;
    x = (x | (x << 16)) & 0x001f0000ff0000ffu;
    x = (x | (x << 8)) & 0x100f00f00f00f00fu;
    x = (x | (x << 4)) & 0x10c30c30c30c30c3u;
    return (x | (x << 2)) & 0x1249249249249249u;
}

/// Place along the curve: one of six directions of facing, then Morton order in the box from `low` of size `extent`.
std::uint64_t curve_order(const dvec3& p, const dvec3& normal, const dvec3& low, double extent) {
    const dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto facing = static_cast<std::uint64_t>(2 * axis + (normal[axis] < 0.0 ? 1 : 0));
    std::uint64_t code = 0;
    for (int i = 0; i < 3; ++i) {
        const double cell = std::clamp((p[i] - low[i]) / extent * 1048576.0, 0.0, 1048575.0);
        code |= spread_bits(static_cast<std::uint64_t>(cell)) << i;
    }
    return facing << 60 | code;
}

}  // namespace

std::array<Piece, 2> halves(const Piece& piece, std::size_t edge) {
    const glm::vec2 a = piece.corners[edge];
    const glm::vec2 b = piece.corners[(edge + 1) % 3];
    const glm::vec2 c = piece.corners[(edge + 2) % 3];
    const glm::vec2 middle = 0.5f * (a + b);
    std::array<Piece, 2> result{piece, piece};
    result[0].corners = {a, middle, c};
    result[1].corners = {middle, b, c};
    for (Piece& half : result) half.area = 0.5 * piece.area;
    return result;
}

std::size_t longest_edge(const Triangle& triangle, const Piece& piece) {
    std::size_t from = 0;
    double longest = -1.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const dvec2 begin(piece.corners[i]);
        const dvec2 end(piece.corners[(i + 1) % 3]);
        const double length = glm::length(triangle.at(end) - triangle.at(begin));
        if (length > longest) {
            longest = length;
            from = i;
        }
    }
    return from;
}

std::vector<Piece> cut_into_pieces(const Scene& scene, std::span<const std::uint32_t> triangles, double share) {
    const double total = area_of(scene, triangles);
    std::vector<Piece> pieces;
    for (const std::uint32_t t : triangles) {
        const Triangle triangle(scene, t);
        Piece whole;
        whole.corners = {glm::vec2(0.0f, 0.0f), glm::vec2(1.0f, 0.0f), glm::vec2(0.0f, 1.0f)};
        whole.triangle = t;
        whole.area = triangle.area();
        if (whole.area > 0.0) cut(triangle, whole, share * total, pieces);
    }
    return pieces;
}

SpaceCurve::SpaceCurve(const Scene& scene, std::span<const std::uint32_t> triangles)
    : scene_(scene), low_(std::numeric_limits<double>::max()) {
    dvec3 high(-low_);
    for (const std::uint32_t t : triangles) {
        const Triangle f(scene, t);
        low_ = glm::min(low_, glm::min(f.a, glm::min(f.b, f.c)));
        high = glm::max(high, glm::max(f.a, glm::max(f.b, f.c)));
    }
    extent_ = std::max({high.x - low_.x, high.y - low_.y, high.z - low_.z, 1e-300});
}

std::uint64_t SpaceCurve::order(const Piece& piece) const {
    const Triangle triangle(scene_, piece.triangle);
    const auto& c = piece.corners;
    const dvec3 middle = triangle.at((dvec2(c[0]) + dvec2(c[1]) + dvec2(c[2])) / 3.0);
    return curve_order(middle, triangle.cross(), low_, extent_);
}

AreaSample sample_at(const Scene& scene, std::uint32_t triangle, const glm::dvec2& place) {
    const Triangle f(scene, triangle);
    AreaSample sample;
    sample.position = glm::vec3(f.at(place));
    sample.normal = glm::vec3(glm::normalize(f.cross()));
    sample.triangle = triangle;
    return sample;
}

}  // namespace render
