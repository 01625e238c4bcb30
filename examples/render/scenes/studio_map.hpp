#pragma once

#include "io/picture.hpp"

namespace render {

/// A latitude-longitude map of a studio at dusk, 1024 x 512 pixels: a red evening sky, windows and screens of light,
/// and one lamp of 1.6 degrees across that is thousands of times as bright as the sky. Always the same.
Picture studio_map();

}  // namespace render
