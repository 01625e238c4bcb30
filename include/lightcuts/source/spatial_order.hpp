#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace lightcuts::detail {

/// The bits of x, each followed by two zeros. pre: x < 2^20
constexpr std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | (x << 32)) & 0x001f00000000ffffu;
    x = (x | (x << 16)) & 0x001f0000ff0000ffu;
    x = (x | (x << 8)) & 0x100f00f00f00f00fu;
    x = (x | (x << 4)) & 0x10c30c30c30c30c3u;
    return (x | (x << 2)) & 0x1249249249249249u;
}

/// One of the six directions along the axes: the one nearest to `normal`.
inline std::uint64_t facing_of(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * static_cast<std::uint64_t>(axis) + (normal[axis] < 0.0 ? 1u : 0u);
}

/// A place on a surface.
struct OrientedPlace {
    glm::dvec3 position;
    glm::dvec3 normal;  ///< of any length
};

/// An order of places in which consecutive ones face alike and lie close together: the six directions of facing, and
/// for each the Morton order in a cube from `low` on, of side `size` > 0, that holds all. Places of one cell stay in
/// their order. cost: O(N log N)
inline std::vector<std::uint32_t> spatial_order(std::span<const OrientedPlace> places, const glm::dvec3& low,
                                                double size) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
    keys.reserve(places.size());
    for (const OrientedPlace& place : places) {
        std::uint64_t key = facing_of(place.normal) << 60;
        for (int i = 0; i < 3; ++i) {
            const double cell = std::clamp((place.position[i] - low[i]) / size * 0x1p20, 0.0, 0x1p20 - 1.0);
            key |= spread_bits(static_cast<std::uint64_t>(cell)) << i;
        }
        keys.emplace_back(key, static_cast<std::uint32_t>(keys.size()));
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order;
    order.reserve(keys.size());
    for (const auto& key : keys) order.push_back(key.second);
    return order;
}

}  // namespace lightcuts::detail
