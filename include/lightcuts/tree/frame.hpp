#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include <glm/vec3.hpp>

#include "../core/invalid_input.hpp"
#include "../core/vector.hpp"
#include "cluster_tree.hpp"
#include "item.hpp"

namespace lightcuts::detail {

template <class Item>
concept HasAxis = requires(const Item& i) {
    i.axis;
};

/// throws: invalid_input naming the first item that a builder cannot use. cost: one pass.
template <class Item>
void check_items(std::span<const Item> items) {
    if (items.size() > ClusterTree::max_items) {
        LIGHTCUTS_THROW(invalid_input("a cluster tree holds at most " + std::to_string(ClusterTree::max_items) +
                                      " items, not " + std::to_string(items.size())));
    }
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

/// The frame in which builders measure: lengths from the lower corner of all items' box in units of its diagonal,
/// weights in units of the largest. Nothing overflows there.
struct Frame {
    std::array<double, 3> origin{};
    double per_length = 1;  ///< 1 / diagonal; 1 if all items coincide
    double per_weight = 1;

    template <class Item>
    static Frame of(std::span<const Item> items) {
        if (items.empty()) return {};
        constexpr float inf = std::numeric_limits<float>::infinity();
        std::array<float, 3> lo{inf, inf, inf}, hi{-inf, -inf, -inf};
        float weight = 0;
        for (const Item& item : items) {
            const std::array<float, 3> p{item.position.x, item.position.y, item.position.z};
            for (std::size_t a = 0; a < 3; ++a) {
                lo[a] = (std::min)(lo[a], p[a]);
                hi[a] = (std::max)(hi[a], p[a]);
            }
            weight = (std::max)(weight, item.weight);
        }
        Frame frame;
        double diagonal2 = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            const double extent = static_cast<double>(hi[a]) - static_cast<double>(lo[a]);
            frame.origin[a] = static_cast<double>(lo[a]);
            diagonal2 += extent * extent;
        }
        if (diagonal2 > 0) frame.per_length = 1 / std::sqrt(diagonal2);
        frame.per_weight = 1 / static_cast<double>(weight);
        return frame;
    }

    /// Coordinates in [0, 1].
    std::array<float, 3> position(const glm::vec3& p) const {
        const auto coordinate = [this](float x, std::size_t axis) {
            return static_cast<float>((static_cast<double>(x) - origin[axis]) * per_length);
        };
        return {coordinate(p.x, 0), coordinate(p.y, 1), coordinate(p.z, 2)};
    }

    /// In (0, 1].
    double weight(float w) const { return static_cast<double>(w) * per_weight; }
};

}  // namespace lightcuts::detail
