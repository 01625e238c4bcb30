#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace render {

/// Names of the filters by which eye rays are weighted about a pixel's center.
const std::vector<std::string>& pixel_filters();

/// Moves a point of the unit square so that even points become as dense as the filter of that name is high: rays then
/// count alike. (0.5, 0.5) is the pixel's center, and stays. `box`: the pixel; `gaussian`: of standard deviation 0.5,
/// cut off at 1.5 pixels; `blackman-harris`: a window of 3 pixels.
glm::vec2 filtered(const std::string& filter, const glm::vec2& point);

}  // namespace render
