#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/assertion.hpp"
#include "../core/cosine.hpp"
#include "../core/vector.hpp"
#include "../core/vectorized.hpp"
#include "conservative_rounding.hpp"
#include "material.hpp"

namespace lightcuts {

/// Ideal diffuse reflection: albedo / pi * cos. `normal`: unit, on the side of the viewer; `albedo`: in [0, 1].
/// About the opposite normal, and with a transmittance, diffuse transmission: see ThinSheet.
template <Spectrum S = glm::vec3>
struct Lambert {
    glm::vec3 normal;
    S albedo;

    S evaluate(const glm::vec3& to_light) const {
        const float cosine = glm::dot(normal, to_light);
        return cosine > 0.0f ? cosine_lobe().scale * cosine : black<S>();
    }
    LIGHTCUTS_VECTORIZED void evaluate_many(const LaneVectors& to_lights, int, LaneSpectra<S>& values) const {
        const S scale = cosine_lobe().scale;
        for (int i = 0; i < lane_count; ++i) {
            const float cosine = glm::dot(normal, to_lights.at(i));
            values[static_cast<std::size_t>(i)] = scale * detail::larger(cosine, 0.0f);
        }
    }
    CosineLobe<S> cosine_lobe() const {
        LIGHTCUTS_ASSERT(is_unit(normal));
        return {normal, albedo * 0.31830988618f};
    }

    /// cost: about 40 ns
    S upper_bound(const OffsetBox& offsets) const {
        const glm::dvec3 n(normal);
        if (detail::lies_below(n, offsets, error)) return black<S>();
        return detail::scaled_up(cosine_lobe().scale, clamped_max_cosine(n, offsets) + error);
    }
    /// cost: about 5 ns each
    void quick_upper_bounds(const OffsetBlock& offsets, LaneSpectra<S>& bounds) const {
        alignas(32) Lanes cosines;
        detail::clamped_max_cosines(normal, offsets, cosines);
        for (int i = 0; i < lane_count; ++i) {
            bounds[static_cast<std::size_t>(i)] = cosines[i] > 0.0f ? detail::scaled_up(cosine_lobe().scale,
                                                                                        static_cast<double>(cosines[i]))
                                                                    : black<S>();
        }
    }

private:
    /// Of the direction and of the dot product in float.
    static constexpr double error = 2.0 * detail::direction_error;
};

template <class S>
Lambert(glm::vec3, S) -> Lambert<S>;

}  // namespace lightcuts
