#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/assertion.hpp"
#include "../core/cosine.hpp"
#include "../core/vector.hpp"
#include "../core/vectorized.hpp"
#include "conservative_rounding.hpp"
#include "glossy_envelope.hpp"
#include "material.hpp"

namespace lightcuts {

/// The modified Phong lobe of Lafortune and Willems: specular (e + 2) / (2 pi) max(0, r . o)^e cos, where r mirrors the
/// viewer. Reciprocal; reflects at most `specular` of the light.
template <Spectrum S = glm::vec3>
class ModifiedPhong {
public:
    /// `normal`, `view` (towards the viewer): unit; `specular`: in [0, 1]; `exponent`: >= 0, a million is fine.
    /// A view from below the surface makes a black material.
    ModifiedPhong(const glm::vec3& normal, const glm::vec3& view, const S& specular, float exponent)
        : normal_(in_float_range(glm::normalize(glm::dvec3(normal)))), exponent_(static_cast<double>(exponent)) {
        LIGHTCUTS_ASSERT(is_unit(normal) && is_unit(view) && exponent >= 0.0f);
        const glm::dvec3 v = glm::normalize(glm::dvec3(view));
        const double facing = glm::dot(normal_, v);
        mirror_ = in_float_range(glm::normalize(2.0 * facing * normal_ - v));
        if (facing > 0.0) scale_ = specular * static_cast<float>((exponent_ + 2.0) * 0.15915494309189535);
    }

    S evaluate(const glm::vec3& to_light) const {
        const glm::dvec3 o(to_light);
        const double cosine = detail::dot(normal_, o);
        if (!(cosine > 0.0 && detail::dot(mirror_, o) > 0.0)) return black<S>();
        // 1 - cos of the angle to the mirror direction, free of cancellation and of the error in the length of o.
        const double o2 = detail::dot(o, o);
        const glm::dvec3 chord = o - mirror_ * (0.5 + 0.5 * o2);
        const double away = 0.5 * detail::dot(chord, chord) * (2.0 - o2);
        return away < 1.0 ? scale_ * static_cast<float>(power(1.0 - away) * cosine) : black<S>();
    }

    /// cost: about 80 ns
    S upper_bound(const OffsetBox& offsets) const {
        if (detail::lies_below(normal_, offsets) || detail::lies_below(mirror_, offsets)) return black<S>();
        const double along = clamped_max_cosine(mirror_, offsets, 0.01 / (1.0 + exponent_));
        return bound(detail::perturbed_cosine(along), detail::perturbed_cosine(clamped_max_cosine(normal_, offsets)));
    }
    /// cost: about 20 ns each
    LIGHTCUTS_VECTORIZED void quick_upper_bounds(const OffsetBlock& offsets, LaneSpectra<S>& bounds) const {
        alignas(32) Lanes along, cosines;
        detail::clamped_max_cosines(glm::vec3(mirror_), offsets, along);
        detail::clamped_max_cosines(glm::vec3(normal_), offsets, cosines);
        for (int i = 0; i < lane_count; ++i) {
            const bool is_dark = detail::smaller(along[i], cosines[i]) == 0.0f;
            bounds[static_cast<std::size_t>(i)] = is_dark ? black<S>()
                                                          : bound(static_cast<double>(along[i]),
                                                                  static_cast<double>(cosines[i]));
        }
    }

    /// Bounds this lobe and, merged, others like it.
    PhongEnvelope<S> envelope() const {
        return {detail::cone_about(normal_), detail::cone_about(mirror_), exponent_, exponent_,
                scale_ * static_cast<float>(6.2831853071795865 / (exponent_ + 2.0))};
    }

    /// The mirrored view, of length 1 to 4, longer where the lobe is sharper.
    glm::vec3 main_direction() const { return detail::glossy_direction(mirror_, exponent_); }

private:
    /// Without coordinates that float bounds would take for zero.
    static glm::dvec3 in_float_range(const glm::dvec3& v) {
        const auto kept = [](double x) { return std::fabs(x) < 0x1p-126 ? 0.0 : x; };
        return {kept(v.x), kept(v.y), kept(v.z)};
    }

    /// c^e; zero where that underflows, which would be slow.
    double power(double c) const {
        const double logarithm = exponent_ * std::log(c);
        return logarithm > -700.0 ? std::exp(logarithm) : 0.0;
    }

    S bound(double along_mirror, double cosine) const {
        // Rounding may hide a light just in front; evaluate() knows the cosine to the mirror direction to 1e-13.
        const double c = (along_mirror > 0.0 ? along_mirror : 0.0) + 1e-12;
        return detail::scaled_up(scale_, (c < 1.0 ? power(c) : 1.0) * ((cosine > 0.0 ? cosine : 0.0) + 1e-15));
    }

    glm::dvec3 normal_;
    glm::dvec3 mirror_;
    double exponent_;
    S scale_ = black<S>();
};

}  // namespace lightcuts
