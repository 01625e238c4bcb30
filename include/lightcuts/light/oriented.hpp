#pragma once

#include "falloff.hpp"
#include "light.hpp"

namespace lightcuts {

/// A point that emits intensity * max(0, cos) about an axis: a small piece of a diffuse emitter.
template <Spectrum S = glm::vec3, class Falloff = InverseSquare>
struct OrientedPointLight {
    glm::vec3 position{0.0f};
    glm::vec3 axis{0.0f, 0.0f, 1.0f};  ///< unit, towards the maximum of emission
    S intensity = black<S>();          ///< W/sr, along the axis
    [[no_unique_address]] Falloff attenuation{};

    constexpr float falloff(float distance) const requires(!std::same_as<Falloff, InverseSquare>) {
        return attenuation(distance);
    }
    constexpr FalloffEnvelope<Falloff> envelope() const requires(!std::same_as<Falloff, InverseSquare>) {
        return {attenuation};
    }
};

}  // namespace lightcuts
