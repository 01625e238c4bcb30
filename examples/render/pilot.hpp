#pragma once

#include <vector>

#include "moving_view.hpp"
#include "surfaces/surface.hpp"

namespace render {

/// What one eye ray a pixel sees in some blocks of 8 x 8 pixels, spread over the picture: four of them, 16 in a
/// picture of 160,000 pixels and more. The same for the same view.
std::vector<std::vector<SurfacePoint>> pilot_blocks(const MovingView& view, const EyePathTracer& surfaces);

}  // namespace render
