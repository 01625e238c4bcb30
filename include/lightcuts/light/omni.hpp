#pragma once

#include "falloff.hpp"
#include "light.hpp"

namespace lightcuts {

/// A point that shines equally in all directions.
template <Spectrum S = glm::vec3, class Falloff = InverseSquare>
struct OmniLight {
    glm::vec3 position{0.0f};
    S intensity = black<S>();  ///< W/sr
    [[no_unique_address]] Falloff attenuation{};

    constexpr float falloff(float distance) const requires(!std::same_as<Falloff, InverseSquare>) {
        return attenuation(distance);
    }
    constexpr FalloffEnvelope<Falloff> envelope() const requires(!std::same_as<Falloff, InverseSquare>) {
        return {attenuation};
    }
};

}  // namespace lightcuts
