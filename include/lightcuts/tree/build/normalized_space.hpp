#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

namespace lightcuts {

/// Where builders measure: positions from `origin` in units of 1 / per_length, weights in units of 1 / per_weight.
/// Builders compute in float: in the space of a set of items, positions and weights should be of the order of 1, and
/// must not exceed 1e18.
struct NormalizedSpace {
    std::array<double, 3> origin{};
    double per_length = 1;  ///< lengths in the space per world unit
    double per_weight = 1;

    /// The space of a set of items: positions from the lower corner of their box in units of its diagonal (world units
    /// if all coincide), weights in units of the largest (as they are if all are zero). cost: one pass.
    template <class Item>
    static NormalizedSpace of(std::span<const Item> items) {
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
        NormalizedSpace space;
        double diagonal2 = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            const double extent = static_cast<double>(hi[a]) - static_cast<double>(lo[a]);
            space.origin[a] = static_cast<double>(lo[a]);
            diagonal2 += extent * extent;
        }
        if (diagonal2 > 0) space.per_length = 1 / std::sqrt(diagonal2);
        if (weight > 0) space.per_weight = 1 / static_cast<double>(weight);
        return space;
    }

    /// In the space of the items themselves, coordinates in [0, 1].
    std::array<float, 3> position(const glm::vec3& p) const {
        const auto coordinate = [this](float x, std::size_t axis) {
            return static_cast<float>((static_cast<double>(x) - origin[axis]) * per_length);
        };
        return {coordinate(p.x, 0), coordinate(p.y, 1), coordinate(p.z, 2)};
    }

    /// In the space of the items themselves in [0, 1].
    double weight(float w) const { return static_cast<double>(w) * per_weight; }

    /// What a unit of direction counts for in the space: `length`, in world units, or `standard`, in the space's, where
    /// that is unset. Limited, so that products stay finite.
    float direction_share(const std::optional<double>& length, float standard) const {
        return length ? static_cast<float>((std::min)(*length * per_length, 1e18)) : standard;
    }
};

}  // namespace lightcuts
