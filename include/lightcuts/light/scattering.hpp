#pragma once

#include <cmath>

#include "../core/assertion.hpp"
#include "../core/henyey_greenstein.hpp"
#include "light.hpp"

namespace lightcuts {

/// Henyey and Greenstein's phase function over its peak: 1 along the axis, and 1 everywhere for asymmetry 0.
struct ScatteringProfile {
    float asymmetry = 0.0f;  ///< the mean cosine about the axis, in [0, 1)

    float operator()(float cosine) const {
        const float narrow = (1.0f - asymmetry) * (1.0f - asymmetry);
        const float away = cosine < 1.0f ? 1.0f - cosine : 0.0f;
        const float ratio = narrow / (narrow + 2.0f * asymmetry * away);
        return ratio * std::sqrt(ratio);
    }
    /// Largest emission for cosines in [cos_min, cos_max]. The 1e-6 absorbs the rounding of profiles that were merged.
    float emission_bound(float, float cos_max) const {
        const float peak = (*this)(cos_max)*1.000001f;
        return peak > 1.0f ? 1.0f : peak;
    }
    /// The profile that is nowhere below `a` or `b`: the wider one.
    friend constexpr ScatteringProfile merge(ScatteringProfile a, ScatteringProfile b) {
        return {a.asymmetry < b.asymmetry ? a.asymmetry : b.asymmetry};
    }
};

/// A point in a medium that scatters light by Henyey and Greenstein's phase function; see scattering_point_light.
template <Spectrum S = glm::vec3>
struct ScatteringPointLight {
    glm::vec3 position{0.0f};
    glm::vec3 axis{0.0f, 0.0f, 1.0f};  ///< unit, towards the maximum of emission
    S intensity = black<S>();          ///< W/sr, along the axis
    ScatteringProfile profile{};

    float emission(float cosine) const { return profile(cosine); }
    constexpr ScatteringProfile envelope() const { return profile; }
};

/// The light that scatters `power`, W, of what travels along `direction`, unit. `g`: mean cosine of the phase function,
/// above -1 and below 1, positive forward.
template <Spectrum S>
ScatteringPointLight<S> scattering_point_light(const glm::vec3& position, const glm::vec3& direction, const S& power,
                                               float g) {
    LIGHTCUTS_ASSERT(g > -1.0f && g < 1.0f);
    const float asymmetry = std::fabs(g);
    const double peak = henyey_greenstein(static_cast<double>(asymmetry), 0.0);
    return {position, g < 0.0f ? -direction : direction, power * static_cast<float>(peak), {asymmetry}};
}

}  // namespace lightcuts
