#pragma once

#include "moving_view.hpp"
#include "shader.hpp"
#include "surfaces/surface.hpp"

namespace render {

/// Lets a shader learn what is visible from the points of a coarse picture of the view: about one pixel in 64, at least
/// 576 and at most 2304, however large the picture. The same for any number of threads.
LearningCost learn_visibility(const MovingView& view, const EyePathTracer& surfaces, Shader& shader);

}  // namespace render
