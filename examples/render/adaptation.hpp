#pragma once

#include <span>

#include "moving_view.hpp"
#include "shader.hpp"
#include "surfaces/surface.hpp"

namespace render {

/// Geometric mean of luminances, which black ones do not pull to 0: exp(mean(log(1e-4 m + L))), m being their
/// arithmetic mean. 0 if all are black or there are none.
double geometric_mean(std::span<const double> luminances);

/// What an eye adapts to [Walter et al. 2006, section 3.5]: the geometric mean over a coarse grid of pixels, at most 32
/// x 32, of the luminance of the light that surfaces reflect. Emitters and background do not count, and pixels that see
/// nothing else are left out.
float measure_adaptation(const MovingView& view, const EyePathTracer& surfaces, const Shader& shader);

}  // namespace render
