#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace render {

/// `value` as a color: black at 0 and below, through blue, red and yellow, each a quarter further, to white at `white`
/// and above. What is no number is white. Values in [0, 1], before the sRGB curve. pre: white > 0.
glm::vec3 false_color(double value, double white);

/// What a layer of numbers holds. Infinities and what is no number are left out; zeros if nothing is left.
struct LayerFigures {
    double min = 0;
    double mean = 0;
    double max = 0;
};

LayerFigures figures_of(const std::vector<float>& layer);

}  // namespace render
