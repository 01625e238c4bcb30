#pragma once

#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/core/box.hpp>

namespace render {

/// The smallest box that holds all of `positions`.
inline lightcuts::Box bounding_box(const std::vector<glm::vec3>& positions) {
    lightcuts::Box box;
    for (const glm::vec3& p : positions) box = lightcuts::merge(box, lightcuts::box_of(p));
    return box;
}

}  // namespace render
