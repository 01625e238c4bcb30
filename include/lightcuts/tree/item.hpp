#pragma once

#include <glm/vec3.hpp>

namespace lightcuts {

/// What builders read of an item without direction: an omni light, or a directional light whose direction stands
/// for its position. pre: finite; weight > 0.
struct PointItem {
    glm::vec3 position;
    float weight;  ///< intensity, as the sum of channels
};

/// What builders read of an item with a direction. pre: finite; |axis| = 1; weight > 0.
struct OrientedItem {
    glm::vec3 position;
    glm::vec3 axis;
    float weight;
};

}  // namespace lightcuts
