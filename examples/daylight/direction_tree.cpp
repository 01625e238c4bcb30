#include "direction_tree.hpp"

#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <lightcuts/piecewise/even_directions.hpp>
#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/build/two_centers.hpp>
#include <lightcuts/tree/leaf_order.hpp>

namespace daylighting {

double DirectionTree::solid_angle() const { return 4.0 * std::numbers::pi / static_cast<double>(size()); }

std::uint32_t DirectionTree::nearest(const glm::vec3& direction) const {
    std::size_t best = 0;
    float largest = -2.0f;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const float cosine = glm::dot(directions[i], direction);
        if (cosine > largest) {
            largest = cosine;
            best = i;
        }
    }
    return static_cast<std::uint32_t>(best);
}

DirectionTree make_direction_tree(std::size_t count) {
    const std::vector<glm::vec3> spread = lightcuts::even_directions(count);
    std::vector<lightcuts::PointItem> items;
    items.reserve(count);
    for (const glm::vec3& direction : spread) items.push_back({direction, 1.0f});
    lightcuts::LeafOrder ordered = lightcuts::in_leaf_order(lightcuts::divide(items, lightcuts::TwoCenters{}));

    DirectionTree result;
    result.tree = std::move(ordered.tree);
    result.directions.reserve(count);
    for (const std::uint32_t item : ordered.items) result.directions.push_back(spread[item]);
    return result;
}

}  // namespace daylighting
