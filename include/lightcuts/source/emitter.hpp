#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "../core/spectrum.hpp"
#include "../core/vector.hpp"

namespace lightcuts {

/// A diffuse emitter made of triangles a, b, c, which shines on the side from which they run counter-clockwise.
/// - `triangle_count()`
/// - `corner(t, k)`: the corner k (0, 1, 2) of triangle t
/// - `radiance(t, uv)`: W/(m^2 sr), at the point a + u (b - a) + v (c - a)
/// - `two_sided(t)`, if there: true if the triangle shines on both sides
/// - `is_textured(t)`, if there: false if its radiance is the same everywhere. Without it textures are expected.
///
/// See `BoundedEmissiveMesh` for what finds the light of small bright spots.
template <class E>
concept EmissiveMesh = requires(const E& emitter, std::uint32_t t, int k, glm::vec2 uv) {
    { emitter.triangle_count() } -> std::convertible_to<std::size_t>;
    { emitter.corner(t, k) } -> Vector3;
    { emitter.radiance(t, uv) } -> std::convertible_to<std::remove_cvref_t<decltype(emitter.radiance(t, uv))>>;
    requires Spectrum<std::remove_cvref_t<decltype(emitter.radiance(t, uv))>>;
};

/// The spectrum in which an emitter states its radiance.
template <EmissiveMesh E>
using emitter_spectrum = std::remove_cvref_t<decltype(std::declval<const E&>().radiance(std::uint32_t{}, glm::vec2()))>;

/// Bounds of radiance, channel by channel.
template <Spectrum S = glm::vec3>
struct RadianceRange {
    S low = black<S>();
    S high = black<S>();
};

/// Corners of a part of a triangle, as (u, v) in a + u (b - a) + v (c - a).
using PieceCorners = std::array<glm::vec2, 3>;

/// An emitter whose textures tell of any part of a triangle how dark and how bright it is at most, so that its light is
/// found however small the spots are that it comes from.
/// - `radiance_range(t, corners)`: a `RadianceRange` of `radiance(t, uv)` over that part, finite and not negative; the
///   tighter, the fewer cuts
/// - `edge_to_cut(t, corners)`, if there: the corner (0, 1, 2) at which the edge begins whose middle a cut should go
///   through to learn most, as the one that passes the most texels; a `std::size_t`, or an optional one. The longest
///   edge in space where that is empty or not there
template <class E>
concept BoundedEmissiveMesh = EmissiveMesh<E> && requires(const E& emitter, std::uint32_t t, PieceCorners corners) {
    { emitter.radiance_range(t, corners) } -> std::convertible_to<RadianceRange<emitter_spectrum<E>>>;
};

/// A triangle that emits `radiance`, W/(m^2 sr), on the side from which its corners run counter-clockwise.
template <Spectrum S = glm::vec3>
struct EmissiveTriangle {
    glm::vec3 a, b, c;
    S radiance = black<S>();
    bool two_sided = false;
};

/// Triangles of one radiance each: an `EmissiveMesh`.
template <Spectrum S = glm::vec3>
class EmissiveTriangles {
public:
    explicit EmissiveTriangles(std::span<const EmissiveTriangle<S>> triangles) : triangles_(triangles) {}

    std::size_t triangle_count() const { return triangles_.size(); }
    const glm::vec3& corner(std::uint32_t t, int k) const {
        const auto& triangle = triangles_[t];
        return k == 0 ? triangle.a : k == 1 ? triangle.b : triangle.c;
    }
    const S& radiance(std::uint32_t t, const glm::vec2&) const { return triangles_[t].radiance; }
    bool two_sided(std::uint32_t t) const { return triangles_[t].two_sided; }
    static constexpr bool is_textured(std::uint32_t) { return false; }

private:
    std::span<const EmissiveTriangle<S>> triangles_;
};

/// Triangles whose radiance is `texture(t, uv)`, whatever they state themselves: an `EmissiveMesh`.
template <Spectrum S, std::invocable<std::uint32_t, glm::vec2> Texture>
class TexturedTriangles : public EmissiveTriangles<S> {
public:
    TexturedTriangles(std::span<const EmissiveTriangle<S>> triangles, Texture texture)
        : EmissiveTriangles<S>(triangles), texture_(std::move(texture)) {}

    S radiance(std::uint32_t t, const glm::vec2& uv) const { return texture_(t, uv); }
    static constexpr bool is_textured(std::uint32_t) { return true; }

private:
    Texture texture_;
};

}  // namespace lightcuts
