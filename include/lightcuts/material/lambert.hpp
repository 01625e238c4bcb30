#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/cosine.hpp"
#include "direction_cap.hpp"
#include "material.hpp"
#include "outward.hpp"

namespace lightcuts {

/// Ideal diffuse reflection: albedo / pi * cos. `normal`: unit, on the side of the viewer; `albedo`: in [0, 1].
template <Spectrum S = glm::vec3>
struct Lambert {
    glm::vec3 normal;
    S albedo;

    S evaluate(const glm::vec3& to_light) const {
        const float cosine = glm::dot(normal, to_light);
        return cosine > 0.0f ? cosine_lobe().scale * cosine : S{};
    }
    CosineLobe<S> cosine_lobe() const { return {normal, albedo * 0.31830988618f}; }

    /// cost: about 40 ns
    S upper_bound(const OffsetBox& offsets) const {
        const glm::dvec3 n(normal);
        if (detail::lies_below(n, offsets, error)) return S{};
        return detail::scaled_up(cosine_lobe().scale, clamped_max_cosine(n, offsets) + error);
    }
    /// cost: about 15 ns
    S quick_upper_bound(const OffsetBox& offsets) const {
        const glm::dvec3 n(normal);
        if (detail::lies_below(n, offsets, error)) return S{};
        const detail::DirectionCap cap = detail::cap_of(offsets);
        const double cosine = cap.is_narrow ? detail::clamped_max_cosine(n, cap) : 1.0;
        return detail::scaled_up(cosine_lobe().scale, (cosine > 0.0 ? cosine : 0.0) + error);
    }

private:
    /// Of the direction and of the dot product in float.
    static constexpr double error = 2.0 * detail::direction_error;
};

template <class S>
Lambert(glm::vec3, S) -> Lambert<S>;

}  // namespace lightcuts
