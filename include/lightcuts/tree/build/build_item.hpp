#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "item.hpp"
#include "normalized_space.hpp"

namespace lightcuts {

/// What top-down builders see of an item: a point of 3 or 6 dimensions and a weight, in a `NormalizedSpace` and laid
/// out for vector instructions. `build_item` makes one.
template <std::size_t Dimensions>
struct BuildItem;

/// A position. 20 bytes.
template <>
struct BuildItem<3> {
    static constexpr std::size_t lanes = 4;
    static constexpr std::array<std::size_t, 3> axes{0, 1, 2};  ///< the lanes along which a set can be split

    float lane[lanes];  ///< x, y, z, weight
    std::uint32_t index;

    /// What the leaf of the tree is called.
    std::uint32_t item() const { return index; }
    void set_item(std::uint32_t i) { index = i; }
    /// At least the smallest normal float.
    float weight() const { return lane[3]; }
};

/// A position and a direction, or any three more coordinates. 32 bytes.
template <>
struct BuildItem<6> {
    static constexpr std::size_t lanes = 8;
    static constexpr std::array<std::size_t, 6> axes{0, 1, 2, 4, 5, 6};  ///< the lanes along which a set can be split

    /// x, y, z, weight, then the direction; the last holds the item's bits: item < max_items, so they are never NaN.
    float lane[lanes];

    /// What the leaf of the tree is called.
    std::uint32_t item() const { return std::bit_cast<std::uint32_t>(lane[7]); }
    void set_item(std::uint32_t i) { lane[7] = std::bit_cast<float>(i); }
    /// At least the smallest normal float.
    float weight() const { return lane[3]; }
};

namespace detail {

template <class Built, class Item>
Built positioned(const Item& item, std::uint32_t index, const NormalizedSpace& space) {
    Built built;
    const auto position = space.position(item.position);
    std::copy(position.begin(), position.end(), built.lane);
    // Splitters compare products of weights and lengths, which zeros would make all alike.
    built.lane[3] = (std::max)(static_cast<float>(space.weight(item.weight)), (std::numeric_limits<float>::min)());
    built.set_item(index);
    return built;
}

}  // namespace detail

/// The point of three dimensions that `item` is in `space`; `index` is what its leaf is called.
/// pre: what it becomes in the space is at most 1e18, see `NormalizedSpace`; weight >= 0; index < max_items.
inline BuildItem<3> build_item(const PointItem& item, std::uint32_t index, const NormalizedSpace& space) {
    return detail::positioned<BuildItem<3>>(item, index, space);
}

/// The point of six dimensions that `item` is in `space`. Its axis may be any three coordinates, of any length; they
/// stay as they are, and splitters say how much they count beside positions.
/// pre: position, axis and weight are at most 1e18 in the space; weight >= 0; index < max_items.
inline BuildItem<6> build_item(const OrientedItem& item, std::uint32_t index, const NormalizedSpace& space) {
    auto built = detail::positioned<BuildItem<6>>(item, index, space);
    built.lane[4] = item.axis.x;
    built.lane[5] = item.axis.y;
    built.lane[6] = item.axis.z;
    return built;
}

}  // namespace lightcuts
