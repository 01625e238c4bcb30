#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/assertion.hpp"
#include "../core/cone.hpp"
#include "../core/henyey_greenstein.hpp"
#include "../core/vector.hpp"
#include "conservative_rounding.hpp"
#include "glossy_envelope.hpp"
#include "material.hpp"

namespace lightcuts {

template <Spectrum S>
class HenyeyGreensteinEnvelope;

/// Scattering by a medium towards the viewer [Henyey and Greenstein 1941]: albedo (1 - g^2) / (4 pi (1 + g^2 - 2 g
/// cos)^(3/2)), 1/sr, where cos is 1 for light that goes straight on. A Material without a cosine: the receiver is a
/// point in the medium. g = 0 scatters evenly.
template <Spectrum S = glm::vec3>
class HenyeyGreenstein {
public:
    /// `view` (towards the viewer): unit; `albedo`: in [0, 1], the share of the light that is scattered; `g`: mean
    /// cosine, above -1 and below 1, positive forward.
    HenyeyGreenstein(const glm::vec3& view, const S& albedo, float g)
        : axis_(g < 0.0f ? glm::dvec3(view) : -glm::dvec3(view)), asymmetry_(std::fabs(static_cast<double>(g))),
          albedo_(albedo) {
        LIGHTCUTS_ASSERT(is_unit(view) && g > -1.0f && g < 1.0f);
        axis_ = glm::normalize(axis_);
    }

    S evaluate(const glm::vec3& to_light) const {
        // 1 - cos of the angle to the axis, free of cancellation.
        const glm::dvec3 away = glm::normalize(glm::dvec3(to_light)) - axis_;
        return albedo_ * static_cast<float>(henyey_greenstein(asymmetry_, 0.5 * detail::dot(away, away)));
    }

    /// cost: about 60 ns
    S upper_bound(const OffsetBox& offsets) const { return envelope().upper_bound(offsets); }

    /// Bounds this function and, merged, others like it.
    HenyeyGreensteinEnvelope<S> envelope() const;

    /// Towards the lights of which it scatters most, of length 0 where it scatters evenly.
    glm::vec3 main_direction() const { return glm::vec3(axis_ * (4.0 * asymmetry_)); }

private:
    friend class HenyeyGreensteinEnvelope<S>;

    glm::dvec3 axis_;  ///< where most is scattered to the viewer from
    double asymmetry_;
    S albedo_;
};

/// Dominates several phase functions of Henyey and Greenstein: by a cone of their axes and the range of |g|.
template <Spectrum S>
class HenyeyGreensteinEnvelope {
public:
    HenyeyGreensteinEnvelope() = default;
    explicit HenyeyGreensteinEnvelope(const HenyeyGreenstein<S>& phase)
        : axes_(detail::cone_about(phase.axis_)), least_(phase.asymmetry_), largest_(phase.asymmetry_),
          albedo_(phase.albedo_) {}

    S upper_bound(const OffsetBox& offsets) const {
        if (!(largest_ > 0.0)) return detail::scaled_up(albedo_, 0.079577471545947668);
        const double cosine = detail::max_cosine_to_cone(axes_, detail::rounded_directions(offsets),
                                                         1e-2 * (1.0 - largest_) * (1.0 - largest_));
        // A direction that float has turned by 1e-6 radians, and the rounding of the cosine.
        const double sine = std::sqrt(cosine < 1.0 ? 2.0 * (1.0 - cosine) : 0.0);
        const double away = 1.0 - cosine - detail::direction_error * sine - 1e-15;
        return detail::scaled_up(albedo_, largest_value(away > 0.0 ? away : 0.0));
    }

    /// Dominates what either dominates.
    friend HenyeyGreensteinEnvelope merge(const HenyeyGreensteinEnvelope& a, const HenyeyGreensteinEnvelope& b) {
        HenyeyGreensteinEnvelope both = a;
        both.axes_ = merge(a.axes_, b.axes_);
        both.least_ = a.least_ < b.least_ ? a.least_ : b.least_;
        both.largest_ = a.largest_ > b.largest_ ? a.largest_ : b.largest_;
        both.albedo_ = larger_channels(a.albedo_, b.albedo_);
        return both;
    }

private:
    /// At least the value of each g of the range at a given 1 - cos: the largest numerator, and the least denominator,
    /// which is that of g = cos.
    double largest_value(double away) const {
        if (least_ == largest_) return henyey_greenstein(least_, away);
        const double best = 1.0 - away;
        const double g = best < least_ ? least_ : best > largest_ ? largest_ : best;
        const double root2 = (1.0 - g) * (1.0 - g) + 2.0 * g * away;
        return 0.079577471545947668 * (1.0 - least_) * (1.0 + least_) / (root2 * std::sqrt(root2));
    }

    Cone axes_{};
    double least_ = 0.0;
    double largest_ = 0.0;
    S albedo_ = black<S>();
};

template <Spectrum S>
HenyeyGreensteinEnvelope<S> HenyeyGreenstein<S>::envelope() const {
    return HenyeyGreensteinEnvelope<S>(*this);
}

template <class S>
HenyeyGreenstein(glm::vec3, S, float) -> HenyeyGreenstein<S>;

}  // namespace lightcuts
