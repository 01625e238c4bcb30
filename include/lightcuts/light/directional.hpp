#pragma once

#include "light.hpp"

namespace lightcuts {

/// A light at infinity, such as a sun or a texel of an environment map.
template <Spectrum S = glm::vec3>
struct DistantLight {
    glm::vec3 direction{0.0f, -1.0f, 0.0f};  ///< unit, the way the light travels
    S intensity = black<S>();                ///< irradiance on a facing plane, W/m^2
};

}  // namespace lightcuts
