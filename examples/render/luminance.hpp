#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace render {

/// Luminance of a linear Rec. 709 color (0.2126 R + 0.7152 G + 0.0722 B).
inline float luminance(const glm::vec3& c) { return glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

}  // namespace render
