#pragma once

#include "scene.hpp"

namespace render {

/// Pictures for monitors, of radiance: mountains and a lake at dusk, and a test card. No pixel is black.
Texture dusk_picture(int width, int height);
Texture test_card(int width, int height);

}  // namespace render
