#pragma once

#include "light.hpp"

namespace lightcuts {

/// The angular attenuation of glTF's KHR_lights_punctual: 1 inside the inner cone, 0 outside the outer one, the
/// square of a linear ramp in the cosine between them. pre: cos_outer < cos_inner.
struct SpotProfile {
    float cos_inner = 1.0f;
    float cos_outer = 0.70710678f;

    constexpr float operator()(float cosine) const {
        if (!(cos_inner > cos_outer)) return cosine >= cos_outer ? 1.0f : 0.0f;
        const float ramp = (cosine - cos_outer) / (cos_inner - cos_outer);
        const float clamped = ramp < 0.0f ? 0.0f : ramp > 1.0f ? 1.0f : ramp;
        return clamped * clamped;
    }
    /// Largest emission for cosines in [cos_min, cos_max]. The 1e-6 absorbs the rounding of the ramp.
    constexpr float emission_bound(float, float cos_max) const {
        const float peak = (*this)(cos_max)*1.000001f;
        return peak > 1.0f ? 1.0f : peak;
    }
    /// The profile that is nowhere below `a` or `b`: both ramps start and end at the wider angles.
    friend constexpr SpotProfile merge(SpotProfile a, SpotProfile b) {
        return {a.cos_inner < b.cos_inner ? a.cos_inner : b.cos_inner,
                a.cos_outer < b.cos_outer ? a.cos_outer : b.cos_outer};
    }
};

/// An omni light with an emission profile about an axis; see SpotProfile.
template <Spectrum S = glm::vec3>
struct SpotLight {
    glm::vec3 position{0.0f};
    glm::vec3 axis{0.0f, 0.0f, 1.0f};  ///< unit, along the beam
    S intensity = black<S>();          ///< W/sr, along the axis
    SpotProfile profile{};

    constexpr float emission(float cosine) const { return profile(cosine); }
    constexpr SpotProfile envelope() const { return profile; }
};

}  // namespace lightcuts
