#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../light/oriented.hpp"
#include "spatial_order.hpp"
#include "triangle_pieces.hpp"

namespace lightcuts {

namespace detail {

/// One of the six directions along the axes: the one nearest to `normal`.
inline std::size_t facing_of(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * static_cast<std::size_t>(axis) + (normal[axis] < 0.0 ? 1u : 0u);
}

/// Not unit, away from the side that shines.
template <EmissiveMesh E>
glm::dvec3 normal_of(const E& emitter, const TrianglePiece<emitter_spectrum<E>>& piece) {
    const glm::dvec3 cross = facet_of(emitter, piece.triangle).cross();
    return piece.back ? -cross : cross;
}

/// The order of pieces in which consecutive ones face alike and lie close together.
template <EmissiveMesh E>
std::vector<std::uint32_t> compact_order(const E& emitter,
                                         const std::vector<TrianglePiece<emitter_spectrum<E>>>& pieces) {
    std::array<std::vector<std::uint32_t>, 6> groups;
    std::vector<glm::dvec3> middles;
    middles.reserve(pieces.size());
    for (const auto& piece : pieces) {
        groups[facing_of(normal_of(emitter, piece))].push_back(static_cast<std::uint32_t>(middles.size()));
        middles.push_back(facet_of(emitter, piece.triangle).at(piece.middle()));
    }
    SpatialOrder order(middles);
    for (auto& group : groups) {
        if (!group.empty()) order.append(group);
    }
    return order.indices();
}

/// Pieces are this much smaller than a light's share, so that a share is a compact patch.
inline constexpr double pieces_per_light = 4.0;
/// Least number of pieces of a textured emitter.
inline constexpr double least_textured_pieces = 4096.0;

}  // namespace detail

/// `count` oriented lights of equal power (sum of channels) that stand for a diffuse emitter: its surface is cut into
/// `count` compact patches of equal power, and each becomes one light at a point drawn from it, not at its middle: rows
/// of lights would show in the shadows of straight edges. Lights are dense where radiance is high and evenly spread
/// where it is constant. All lights together emit what the emitter does, channel by channel: pi x the sum of
/// intensities is the flux pi x radiance x area. A textured emitter's is found from at least 16 x 4096 points of it.
///
/// throws: invalid_input if no triangle has an area or all are black, or naming the triangle with a corner or radiance
/// that is not finite or a negative radiance. cost: O((T + count) log(T + count))
template <EmissiveMesh E, Sampler Sequence = ScrambledSobol>
std::vector<OrientedPointLight<emitter_spectrum<E>>> area_lights(const E& emitter, std::size_t count,
                                                                 const Sequence& sampler = {}) {
    using S = emitter_spectrum<E>;
    const double wanted = detail::pieces_per_light * static_cast<double>(std::max<std::size_t>(count, 1));
    const auto pieces = detail::cut_sides(emitter, 1.0 / wanted,
                                          1.0 / (std::max)(wanted, detail::least_textured_pieces));
    double power = 0.0;
    for (const auto& piece : pieces) power += piece.area * channel_sum(piece.radiance);
    if (!(power > 0.0)) LIGHTCUTS_THROW(invalid_input("emitter: all its triangles are black"));
    std::vector<OrientedPointLight<S>> lights;
    if (count == 0) return lights;

    detail::EqualPowerStrata<std::uint32_t, S, Sequence> patches(power, count, sampler);
    for (const std::uint32_t i : detail::compact_order(emitter, pieces)) {
        const auto& piece = pieces[i];
        patches.add(i, piece.area * channel_sum(piece.radiance), piece.radiance, piece.area);
    }
    lights.reserve(count);
    for (const auto& patch : patches.finish()) {
        const auto& piece = pieces[patch.piece];
        const double across = static_cast<double>(sampler(static_cast<std::uint32_t>(lights.size()), 1));
        const glm::dvec3 point = detail::facet_of(emitter, piece.triangle).at(piece.at(patch.fraction, across));
        const glm::dvec3 axis = glm::normalize(detail::normal_of(emitter, piece));
        lights.push_back({glm::vec3(point), glm::vec3(axis), patch.power, {}});
    }
    return lights;
}

}  // namespace lightcuts
