#pragma once

#include <cmath>
#include <concepts>

#include <glm/vec3.hpp>

#include "../core/cosine.hpp"
#include "../core/vectorized.hpp"
#include "conservative_rounding.hpp"
#include "direction_caps.hpp"
#include "glossy_envelope.hpp"
#include "half_vector.hpp"
#include "material.hpp"

namespace lightcuts {

/// Smith's shadowing of GGX with light and view correlated by height [Heitz 2014]: glTF's and the default.
struct HeightCorrelated {
    /// cosine / this = shadowing x cosine / (4 cos_view cosine), given both cosines and Lambda's roots
    /// a(c) = sqrt(alpha^2 + (1 - alpha^2) c^2). The quotient increases with `cosine` and has no pole.
    template <std::floating_point T>
    static T denominator(T cos_view, T root_view, T cosine, T root) {
        return T(2) * (cosine * root_view + cos_view * root);
    }
};

/// Smith's shadowing of GGX as a product of two factors [Walter et al. 2007].
struct SeparableShadowing {
    template <std::floating_point T>
    static T denominator(T cos_view, T root_view, T cosine, T root) {
        return (cos_view + root_view) * (cosine + root);
    }
};

/// Microfacet reflection with the GGX distribution and Schlick's Fresnel term [Walter et al. 2007].
template <Spectrum S = glm::vec3, class Shadowing = HeightCorrelated>
class Ggx {
public:
    /// `normal`, `view` (towards the viewer): unit; `f0`: reflectance at normal incidence, in [0, 1]; `alpha`:
    /// roughness (glTF's roughness squared), >= 0; what is below 1e-6 counts as that; `f90`: reflectance at grazing
    /// incidence, raised to the largest channel of `f0` if it is below that. A view from below the surface makes a
    /// black material.
    Ggx(const glm::vec3& normal, const glm::vec3& view, const S& f0, float alpha, float f90 = 1.0f)
        : frame_(normal, view), alpha2_(detail::squared_roughness(alpha)), f0_(f0),
          f90_(detail::larger(f90, channel_max(f0))) {
        root_view_ = root(frame_.cos_view());
    }

    S evaluate(const glm::vec3& to_light) const {
        if (!(frame_.cos_view() > 0.0)) return black<S>();
        const detail::HalfVector h = frame_.of(to_light);
        if (!(h.cosine > 0.0)) return black<S>();
        const double value = without_fresnel(h.cosine, h.sin2);
        const double grazing = value * schlick(h.facing);
        const float a = static_cast<float>(value - grazing);
        const float b = static_cast<float>(grazing) * f90_;
        return make_spectrum<S>([&](int i) { return channel(f0_, i) * a + b; });
    }

    LIGHTCUTS_VECTORIZED void evaluate_many(const LaneVectors& to_lights, int count, LaneSpectra<S>& values) const {
        if (!(frame_.cos_view() > 0.0)) return values.fill(black<S>());
        if (alpha2_ < 1e-2) {  // too sharp for float
            for (int i = 0; i < count; ++i) values[static_cast<std::size_t>(i)] = evaluate(to_lights.at(i));
            return;
        }
        const glm::vec3 n(frame_.normal()), v(frame_.view());
        const auto alpha2 = static_cast<float>(alpha2_), cos_view = static_cast<float>(frame_.cos_view()),
                   root_view = static_cast<float>(root_view_);
        alignas(32) Lanes plain, grazing, doubtful;
        for (int i = 0; i < lane_count; ++i) {
            const float x = to_lights.x[0][i], y = to_lights.x[1][i], z = to_lights.x[2][i];
            const float cosine = n.x * x + n.y * y + n.z * z;
            const float hx = x + v.x, hy = y + v.y, hz = z + v.z;
            const float h2 = detail::larger(hx * hx + hy * hy + hz * hz, 1e-12f);
            const float ax = n.y * hz - n.z * hy, ay = n.z * hx - n.x * hz, az = n.x * hy - n.y * hx;
            const float sin2 = detail::smaller((ax * ax + ay * ay + az * az) / h2, 1.0f);
            const float q = sin2 + alpha2 * (1.0f - sin2);
            const float c = detail::larger(cosine, 1e-20f);
            const float root = detail::square_root(alpha2 + (1.0f - alpha2) * (c * c));
            const float value = 0.31830989f * alpha2 * c /
                                (q * q * Shadowing::denominator(cos_view, root_view, c, root));
            const float away = detail::larger(1.0f - 0.5f * detail::square_root(h2), 0.0f), away2 = away * away;
            const float lit = detail::select(cosine > 0.0f, value, 0.0f);
            const float share = lit * (away2 * away2 * away);
            plain[i] = lit - share;
            grazing[i] = share * f90_;
            doubtful[i] = detail::select(h2 < 0.01f, lit, 0.0f);
        }
        for (int i = 0; i < lane_count; ++i) {
            S& value = values[static_cast<std::size_t>(i)];
            value = make_spectrum<S>([&](int c) { return channel(f0_, c) * plain[i] + grazing[i]; });
            // Where light and viewer are nearly opposite the half-vector is a small difference.
            if (doubtful[i] > 0.0f) value = evaluate(to_lights.at(i));
        }
    }

    /// cost: about 110 ns, of smooth surfaces, to 130
    S upper_bound(const OffsetBox& offsets) const {
        if (!(frame_.cos_view() > 0.0) || detail::lies_below(frame_.normal(), offsets)) return black<S>();
        return bound(most_cosine(offsets), frame_.range_over<true>(detail::rounded_directions(offsets)));
    }
    /// cost: about 10 ns each
    LIGHTCUTS_VECTORIZED void quick_upper_bounds(const OffsetBlock& offsets, LaneSpectra<S>& bounds) const {
        if (!(frame_.cos_view() > 0.0)) return bounds.fill(black<S>());
        const glm::vec3 normal(frame_.normal());
        detail::DirectionCaps caps;
        detail::HalfVectorRanges h;
        alignas(32) Lanes most, factor, facing, grazing;
        detail::caps_of(offsets, caps);
        detail::clamped_max_cosines(normal, caps, most);
        frame_.ranges_over(caps, h);
        const auto alpha2 = static_cast<float>(alpha2_), cos_view = static_cast<float>(frame_.cos_view()),
                   root_view = static_cast<float>(root_view_);
        const float least_sin2 = alpha2 > 1.0f ? 1.0f : 0.0f;  // beyond, the lobe is largest away from the normal
        for (int i = 0; i < lane_count; ++i) {
            const float cosine = most[i];
            const float sin2 = detail::larger(h.sin2[i], least_sin2);
            const float q = sin2 + alpha2 * (1.0f - sin2);
            const float root = detail::square_root(alpha2 + (1.0f - alpha2) * (cosine * cosine));
            const float value = 0.31830989f * (alpha2 / q) *
                                (cosine / (q * Shadowing::denominator(cos_view, root_view, cosine, root)));
            const float away = 1.0f - h.facing[i], away2 = away * away;
            // Where roundings add up to something that is no number, the comparison fails.
            factor[i] = detail::select(value < 1e30f, detail::larger(value * 1.0001f, 1e-18f), 1e30f);
            const float weight = away2 * away2 * away * 1.00001f + 1e-18f;
            facing[i] = 1.0f - weight;
            grazing[i] = weight * f90_;
        }
        for (int i = 0; i < lane_count; ++i) {
            bounds[static_cast<std::size_t>(i)] = make_spectrum<S>(
                [&](int c) { return (channel(f0_, c) * facing[i] + grazing[i]) * factor[i]; });
        }
        detail::blacken_below(normal, offsets, bounds);
    }

    /// Bounds this lobe and, merged, others like it.
    GgxEnvelope<S, Shadowing> envelope() const {
        if (!(frame_.cos_view() > 0.0)) return {};
        const glm::dvec3 n = frame_.normal(), v = frame_.view();
        return {detail::cone_about(n),
                detail::cone_about(2.0 * frame_.cos_view() * n - v),
                detail::cone_about(v),
                alpha2_,
                alpha2_,
                frame_.cos_view(),
                f0_,
                f90_,
                true};
    }

    /// The mirrored view, of length 1 to 4, longer where the lobe is sharper.
    glm::vec3 main_direction() const {
        const glm::dvec3 mirror = 2.0 * frame_.cos_view() * frame_.normal() - frame_.view();
        return detail::glossy_direction(mirror, 2.0 / alpha2_ - 2.0);
    }

private:
    /// Upper bound of n . o.
    double most_cosine(const OffsetBox& offsets) const {
        return detail::perturbed_cosine(clamped_max_cosine(frame_.normal(), offsets, 0.01));
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
        const float weight = detail::with_rounding_margin(
            schlick(h.facing - 1e-6));  // evaluate_many() knows it to 3e-7
        const float factor = detail::with_rounding_margin(value);
        return make_spectrum<S>(
            [&](int i) { return detail::positive_product(channel(f0_, i) * (1.0f - weight) + weight * f90_, factor); });
    }

    detail::HalfVectorFrame frame_;
    double alpha2_;
    double root_view_;
    S f0_;
    float f90_;
};

}  // namespace lightcuts
