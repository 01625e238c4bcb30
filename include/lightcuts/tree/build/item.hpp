#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include <glm/vec3.hpp>

#include "../../core/invalid_input.hpp"
#include "../../core/vector.hpp"
#include "../cluster_tree.hpp"

namespace lightcuts {

/// What builders read of an item without direction: an omni light, or a directional light whose direction stands
/// for its position. pre: finite; weight > 0 (in `build_item` also 0).
struct PointItem {
    glm::vec3 position;
    float weight;  ///< of a light its intensity, as the sum of channels
};

/// What builders read of an item with a direction. pre: finite; |axis| = 1 (in `build_item` any vector); weight > 0
/// (in `build_item` also 0).
struct OrientedItem {
    glm::vec3 position;
    glm::vec3 axis;
    float weight;
};

namespace detail {

template <class Item>
concept HasAxis = requires(const Item& i) {
    i.axis;
};

/// throws: invalid_input if a tree cannot hold so many items.
inline void check_count(std::size_t items) {
    if (items > ClusterTree::max_items) {
        LIGHTCUTS_THROW(invalid_input("a cluster tree holds at most " + std::to_string(ClusterTree::max_items) +
                                      " items, not " + std::to_string(items)));
    }
}

/// throws: invalid_input naming the first item that a builder cannot use. cost: one pass.
template <class Item>
void check_items(std::span<const Item> items) {
    check_count(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Item& item = items[i];
        const auto refuse = [i](const char* what) {
            LIGHTCUTS_THROW(invalid_input("item " + std::to_string(i) + ": " + what));
        };
        if (!is_finite(item.position)) refuse("the position is not finite");
        if (!(item.weight > 0.0f && item.weight <= (std::numeric_limits<float>::max)())) {
            refuse("the weight is not positive and finite; leave out lights that are dark");
        }
        if constexpr (HasAxis<Item>) {
            const glm::vec3& a = item.axis;
            if (!(std::abs(a.x * a.x + a.y * a.y + a.z * a.z - 1.0f) <= 1e-4f)) refuse("the axis is not a unit vector");
        }
    }
}

/// throws: invalid_input if `length`, what a builder's option gives in world units, is no length.
inline void check_direction_length(const std::optional<double>& length) {
    if (length && !(*length >= 0 && *length <= static_cast<double>((std::numeric_limits<float>::max)()))) {
        LIGHTCUTS_THROW(invalid_input("direction_length: a length in world units, 0 or more, is needed"));
    }
}

}  // namespace detail

}  // namespace lightcuts
