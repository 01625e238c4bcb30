#pragma once

#include <cmath>

#include <glm/vec3.hpp>

#include "../core/cone.hpp"
#include "../core/cosine.hpp"
#include "../core/spectrum.hpp"
#include "conservative_rounding.hpp"

namespace lightcuts {

namespace detail {

/// A cone about a direction known within 2e-6 radians: more than its rounding to float.
inline Cone cone_about(const glm::dvec3& direction) { return {glm::vec3(glm::normalize(direction)), 1e-12f}; }

/// The direction `mirror`, from 1 for a wide lobe to 4 for a sharp one: of Phong's exponent, or of that of a lobe about
/// as wide [Multidimensional Lightcuts 2006, section 3.4].
inline glm::vec3 glossy_direction(const glm::dvec3& mirror, double exponent) {
    const double length = 1.0 + 0.4 * std::log2(1.0 + (exponent > 0.0 ? exponent : 0.0));
    return glm::vec3(mirror * (length < 4.0 ? length : 4.0));
}

/// Upper bound of the cosine between any direction of a cone and any of a box.
inline double max_cosine_to_cone(const Cone& cone, const OffsetBox& box, double tolerance = 1e-3) {
    return widen_cosine(max_cosine(unit_axis(cone), box, tolerance), cone);
}

/// Lower bound of the same.
inline double min_cosine_to_cone(const Cone& cone, const OffsetBox& box) {
    return -widen_cosine(max_cosine(-unit_axis(cone), box), negated(cone));
}

}  // namespace detail

/// Dominates several of Phong's lobes [Lafortune and Willems 1994]: by cones of their normals and mirror directions,
/// and their range of exponents.
template <Spectrum S>
struct PhongEnvelope {
    Cone normals{};
    Cone mirrors{};
    double least_exponent = 0.0;
    double largest_exponent = 0.0;
    S specular = black<S>();  ///< the largest; black: no lobe reflects

    /// cost: about 150 ns
    S upper_bound(const OffsetBox& offsets) const {
        if (is_black(specular)) return black<S>();
        const OffsetBox box = detail::rounded_directions(offsets);
        const double cosine = detail::max_cosine_to_cone(normals, box) + 2.0 * detail::direction_error;
        const double along = detail::max_cosine_to_cone(mirrors, box, 0.01 / (1.0 + largest_exponent)) + 1e-12;
        if (!(cosine > 0.0 && along > 0.0)) return black<S>();
        return detail::scaled_up(specular,
                                 peak(along < 1.0 ? along : 1.0) * 0.15915494309189535 * (cosine < 1.0 ? cosine : 1.0));
    }

    /// Dominates what either dominates.
    friend PhongEnvelope merge(const PhongEnvelope& a, const PhongEnvelope& b) {
        if (is_black(a.specular)) return b;
        if (is_black(b.specular)) return a;
        return {merge(a.normals, b.normals), merge(a.mirrors, b.mirrors),
                a.least_exponent < b.least_exponent ? a.least_exponent : b.least_exponent,
                a.largest_exponent > b.largest_exponent ? a.largest_exponent : b.largest_exponent,
                larger_channels(a.specular, b.specular)};
    }

private:
    /// The largest (e + 2) c^e of the exponents: unimodal in e, with its peak at -1 / ln c - 2.
    double peak(double c) const {
        const double logarithm = std::log(c);
        const double best = logarithm < 0.0 ? -1.0 / logarithm - 2.0 : largest_exponent;
        const double e = best < least_exponent ? least_exponent : best > largest_exponent ? largest_exponent : best;
        const double power = e * logarithm;
        return power > -700.0 ? (e + 2.0) * std::exp(power) : 0.0;
    }
};

/// Dominates several GGX lobes: by cones of their normals, mirror directions and views, and ranges of the rest. Of the
/// angle between half-vector and normal it knows that it is at least half of that between light and mirror direction.
template <Spectrum S, class Shadowing>
struct GgxEnvelope {
    Cone normals{};
    Cone mirrors{};
    Cone views{};
    double least_alpha2 = 0.0;
    double largest_alpha2 = 0.0;
    double least_cos_view = 0.0;
    S f0 = black<S>();  ///< the largest
    float f90 = 0.0f;   ///< the largest
    bool reflects = false;

    /// cost: about 250 ns
    S upper_bound(const OffsetBox& offsets) const {
        if (!reflects) return black<S>();
        const OffsetBox box = detail::rounded_directions(offsets);
        const double most = detail::max_cosine_to_cone(normals, box) + 2.0 * detail::direction_error;
        if (!(most > 0.0)) return black<S>();
        const double cosine = most < 1.0 ? most : 1.0;
        const double along = detail::max_cosine_to_cone(mirrors, box, 0.01 * least_alpha2);
        const double sin2 = along < 1.0 ? 0.5 * (1.0 - along) : 0.0;
        const double facing2 = 0.5 * (1.0 + detail::min_cosine_to_cone(views, box));
        const double facing = (facing2 > 0.0 ? std::sqrt(facing2) : 0.0) - 2e-6;
        const double away = facing < 1.0 ? 1.0 - facing : 0.0;
        const float weight = detail::with_rounding_margin((away * away) * (away * away) * away);
        const float factor = detail::with_rounding_margin(distribution(sin2) * shadowed_cosine(cosine));
        return make_spectrum<S>([&](int c) {
            const float fresnel = channel(f0, c) + (weight < 1.0f ? weight : 1.0f) * f90;
            return detail::positive_product(fresnel, factor);
        });
    }

    /// Dominates what either dominates.
    friend GgxEnvelope merge(const GgxEnvelope& a, const GgxEnvelope& b) {
        if (!a.reflects) return b;
        if (!b.reflects) return a;
        const auto least = [](auto x, auto y) { return x < y ? x : y; };
        const auto most = [](auto x, auto y) { return x > y ? x : y; };
        return {merge(a.normals, b.normals),
                merge(a.mirrors, b.mirrors),
                merge(a.views, b.views),
                least(a.least_alpha2, b.least_alpha2),
                most(a.largest_alpha2, b.largest_alpha2),
                least(a.least_cos_view, b.least_cos_view),
                larger_channels(a.f0, b.f0),
                most(a.f90, b.f90),
                true};
    }

private:
    /// The largest D of the roughnesses, at least so far from the normal.
    double distribution(double sin2) const {
        constexpr double inverse_pi = 0.31830988618379067;
        const double best = sin2 < 1.0 ? sin2 / (1.0 - sin2) : largest_alpha2;
        const double last = largest_alpha2 < 1.0 ? largest_alpha2 : 1.0;
        const double first = least_alpha2 < last ? least_alpha2 : last;
        const double alpha2 = best < first ? first : best > last ? last : best;
        const double q = sin2 + alpha2 * (1.0 - sin2);
        const double d = inverse_pi * alpha2 / (q * q);
        // Beyond alpha = 1 the distribution is largest away from the normal.
        const double rough = largest_alpha2 > 1.0 ? inverse_pi * largest_alpha2 : 0.0;
        return d > rough ? d : rough;
    }

    /// The largest cos / denominator: of the smoothest lobe, seen most from the side.
    double shadowed_cosine(double cosine) const {
        const double root = std::sqrt(least_alpha2 + (1.0 - least_alpha2) * (cosine * cosine));
        const double of_view = std::sqrt(least_alpha2 + (1.0 - least_alpha2) * (least_cos_view * least_cos_view));
        return cosine /
               Shadowing::denominator(least_cos_view, of_view < 1.0 ? of_view : 1.0, cosine, root < 1.0 ? root : 1.0);
    }
};

}  // namespace lightcuts
