#pragma once

#include <cmath>

#include <glm/vec3.hpp>

#include "../core/cosine.hpp"
#include "direction_cap.hpp"
#include "half_vector.hpp"
#include "material.hpp"
#include "outward.hpp"

namespace lightcuts {

/// Smith's shadowing of GGX with light and view correlated by height [Heitz 2014]: glTF's and the default.
struct HeightCorrelated {
    /// cosine / this = shadowing x cosine / (4 cos_view cosine), given both cosines and Lambda's roots
    /// a(c) = sqrt(alpha^2 + (1 - alpha^2) c^2). The quotient increases with `cosine` and has no pole.
    static double denominator(double cos_view, double root_view, double cosine, double root) {
        return 2.0 * (cosine * root_view + cos_view * root);
    }
};

/// Smith's shadowing of GGX as a product of two factors [Walter et al. 2007].
struct SeparableShadowing {
    static double denominator(double cos_view, double root_view, double cosine, double root) {
        return (cos_view + root_view) * (cosine + root);
    }
};

/// Microfacet reflection with the GGX distribution and Schlick's Fresnel term [Walter et al. 2007].
template <Spectrum S = glm::vec3, class Shadowing = HeightCorrelated>
class Ggx {
public:
    /// `normal`, `view` (towards the viewer): unit; `f0`: reflectance at normal incidence, in [0, 1]; `alpha`:
    /// roughness (glTF's roughness squared), >= 0; what is below 1e-6 counts as that. A view from below the surface
    /// makes a black material.
    Ggx(const glm::vec3& normal, const glm::vec3& view, const S& f0, float alpha)
        : frame_(normal, view), alpha2_(detail::squared_roughness(alpha)), f0_(f0) {
        root_view_ = root(frame_.cos_view());
    }

    S evaluate(const glm::vec3& to_light) const {
        if (!(frame_.cos_view() > 0.0)) return S{};
        const detail::HalfVector h = frame_.of(to_light);
        if (!(h.cosine > 0.0)) return S{};
        const double value = without_fresnel(h.cosine, h.sin2);
        const double grazing = value * schlick(h.facing);
        const float a = static_cast<float>(value - grazing);
        const float b = static_cast<float>(grazing);
        return make_spectrum<S>([&](int i) { return channel(f0_, i) * a + b; });
    }

    /// cost: about 110 ns, of smooth surfaces, to 130
    S upper_bound(const OffsetBox& offsets) const {
        if (!(frame_.cos_view() > 0.0) || detail::lies_below(frame_.normal(), offsets)) return S{};
        return bound(most_cosine(offsets), frame_.range_over<true>(detail::rounded_directions(offsets)));
    }
    /// cost: about 45 ns
    S quick_upper_bound(const OffsetBox& offsets) const {
        if (!(frame_.cos_view() > 0.0) || detail::lies_below(frame_.normal(), offsets)) return S{};
        const detail::DirectionCap cap = detail::cap_of(offsets);
        if (!cap.is_narrow) return bound(1.0, {0.0, 0.0});
        return bound(detail::clamped_max_cosine(frame_.normal(), cap), frame_.range_over(cap));
    }

private:
    /// Upper bound of n . o. For smooth surfaces the value hardly depends on it, so a cheap one does.
    double most_cosine(const OffsetBox& offsets) const {
        if (alpha2_ < 0.1) {
            const detail::DirectionCap cap = detail::cap_of(offsets);
            return cap.is_narrow ? detail::clamped_max_cosine(frame_.normal(), cap) : 1.0;
        }
        return detail::turned(clamped_max_cosine(frame_.normal(), offsets, 0.01));
    }

    double root(double cosine) const { return std::sqrt(alpha2_ + (1.0 - alpha2_) * (cosine * cosine)); }

    /// D G cos / (4 cos_view cos), which increases with `cosine` and with cos^2 of the half-vector (alpha <= 1).
    double without_fresnel(double cosine, double sin2) const {
        const double q = sin2 + alpha2_ * (1.0 - sin2);
        return 0.31830988618379067 * alpha2_ * cosine /
               (q * q * Shadowing::denominator(frame_.cos_view(), root_view_, cosine, root(cosine)));
    }

    /// (1 - c)^5
    static double schlick(double c) {
        const double x = c < 1.0 ? 1.0 - c : 0.0;
        return (x * x) * (x * x) * x;
    }

    S bound(double cosine, const detail::HalfVectorRange& h) const {
        // Beyond alpha = 1 the distribution is largest away from the normal.
        const double value = without_fresnel(cosine > 0.0 ? cosine : 0.0, alpha2_ > 1.0 ? 1.0 : h.sin2);
        const float weight = detail::padded(schlick(h.facing - 1e-12));  // evaluate() knows it to 1e-13
        const float factor = detail::padded(value);
        return make_spectrum<S>(
            [&](int i) { return detail::times(channel(f0_, i) * (1.0f - weight) + weight, factor); });
    }

    detail::HalfVectorFrame frame_;
    double alpha2_;
    double root_view_;
    S f0_;
};

}  // namespace lightcuts
