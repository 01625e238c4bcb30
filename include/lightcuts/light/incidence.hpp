#pragma once

#include <cmath>

#include "../core/lanes.hpp"
#include "../core/vectorized.hpp"
#include "light.hpp"

namespace lightcuts {

/// Where a light stands in its tree: its position, or the unit direction towards it.
template <Light L>
glm::vec3 position_or_direction(const L& light) {
    if constexpr (DirectionalLight<L>) {
        return glm::vec3(-glm::normalize(glm::dvec3(to_vec3(detail::direction_of(light)))));
    } else {
        return to_vec3(detail::position_of(light));
    }
}

/// How a light reaches a point, shadows apart.
struct Incidence {
    glm::vec3 to_light;  ///< unit direction; meaningless if `geometric` is 0
    double geometric;  ///< emission x attenuation [Lightcuts 2005, Eq. 3]: not negative; infinite only if a falloff is
};

/// The geometric term of `light` at `point`. A point light exactly at the point contributes nothing.
template <Light L>
Incidence incidence(const L& light, const glm::vec3& point) {
    if constexpr (DirectionalLight<L>) {
        return {position_or_direction(light), 1.0};
    } else {
        // In double: squares of float offsets neither overflow nor vanish there.
        const glm::dvec3 offset = glm::dvec3(position_or_direction(light)) - glm::dvec3(point);
        const double distance2 = glm::dot(offset, offset);
        if (!(distance2 > 0.0)) return {glm::vec3(0.0f), 0.0};
        const double inverse_distance = 1.0 / std::sqrt(distance2);
        const glm::dvec3 to_light = offset * inverse_distance;
        double geometric = inverse_distance * inverse_distance;
        if constexpr (FalloffLight<L>) {
            geometric = static_cast<double>(
                detail::falloff_of(light, static_cast<float>(distance2 * inverse_distance)));
        }
        if constexpr (OrientedLight<L>) {
            const double cosine = -glm::dot(glm::dvec3(to_vec3(detail::axis_of(light))), to_light);
            if constexpr (ProfiledLight<L>) {
                const double clamped = cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine;
                geometric *= static_cast<double>(detail::emission_of(light, static_cast<float>(clamped)));
            } else {
                geometric = cosine > 0.0 ? geometric * cosine : 0.0;
            }
        }
        return {glm::vec3(to_light), geometric};
    }
}

/// True if the lights of kind `L` fall off with the squared distance.
template <Light L>
inline constexpr bool inverse_square = PointLight<L> && !FalloffLight<L>;
/// True if the lights of kind `L` emit intensity * max(0, cos) about an axis.
template <Light L>
inline constexpr bool cosine_emission = OrientedLight<L> && !ProfiledLight<L>;
/// True if emission or falloff of the lights of kind `L` is a function of the user's.
template <Light L>
inline constexpr bool has_profile = PointLight<L> && (ProfiledLight<L> || FalloffLight<L>);

namespace detail {

/// Where several lights of one kind stand, side by side, and how they are turned if that matters.
struct LightBlock {
    LaneVectors place;  ///< as `position_or_direction`
    LaneVectors axis;

    /// pre: 0 <= lane < lane_count
    template <Light L>
    void set(int lane, const L& light) {
        place.set(lane, position_or_direction(light));
        if constexpr (OrientedLight<L>) axis.set(lane, to_vec3(axis_of(light)));
    }

    /// Repeats the last of `count` lights in the lanes behind it. pre: 0 < count <= lane_count
    template <Light L>
    void finish(int count) {
        repeat_last(place, count);
        if constexpr (OrientedLight<L>) repeat_last(axis, count);
    }
};

/// How several lights reach a point.
struct IncidenceBlock {
    LaneVectors to_light;         ///< unit within 4e-7
    alignas(32) Lanes geometric;  ///< emission x attenuation
    alignas(32) Lanes in_range;   ///< 1; 0 where float cannot tell: ask `incidence`
};

/// `incidence` of the lights in every lane, in float.
template <Light L>
    requires(!has_profile<L>)
LIGHTCUTS_VECTORIZED void incidences(const LightBlock& lights, const glm::vec3& point, IncidenceBlock& arriving) {
    if constexpr (DirectionalLight<L>) {
        arriving.to_light = lights.place;
        for (int i = 0; i < lane_count; ++i) arriving.geometric[i] = arriving.in_range[i] = 1.0f;
    } else {
        for (int i = 0; i < lane_count; ++i) {
            const float x = lights.place.x[0][i] - point.x, y = lights.place.x[1][i] - point.y,
                        z = lights.place.x[2][i] - point.z;
            const float d2 = x * x + y * y + z * z;
            const bool in_range = smaller(d2 - 1e-20f, 1e20f - d2) > 0.0f;
            // Materials are promised unit vectors, whatever becomes of the result.
            const float inverse = inverse_sqrt(select(in_range, d2, 1.0f));
            const float ux = select(in_range, x * inverse, 0.0f), uy = select(in_range, y * inverse, 0.0f),
                        uz = select(in_range, z * inverse, 1.0f);
            float geometric = inverse * inverse;
            if constexpr (OrientedLight<L>) {
                const float cosine = -(lights.axis.x[0][i] * ux + lights.axis.x[1][i] * uy + lights.axis.x[2][i] * uz);
                geometric *= larger(cosine, 0.0f);
            }
            arriving.to_light.x[0][i] = ux;
            arriving.to_light.x[1][i] = uy;
            arriving.to_light.x[2][i] = uz;
            arriving.geometric[i] = geometric;
            arriving.in_range[i] = select(in_range, 1.0f, 0.0f);
        }
    }
}

}  // namespace detail

}  // namespace lightcuts
