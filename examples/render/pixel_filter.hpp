#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace render {

class InverseIntegral;

/// Names of the filters by which eye rays are weighted about a pixel's center.
const std::vector<std::string>& pixel_filters();

/// Moves points of the unit square so that even ones become as dense as a filter is high: rays then count alike. (0.5,
/// 0.5) is the pixel's center, and stays.
class PixelFilter {
public:
    /// `box`: the pixel; `gaussian`: of standard deviation 0.5, cut off at 1.5 pixels; `blackman-harris`: a window of 3
    /// pixels. pre: one of pixel_filters()
    explicit PixelFilter(const std::string& name);

    glm::vec2 operator()(const glm::vec2& point) const;

private:
    const InverseIntegral* integral_;  ///< null: the box
};

}  // namespace render
