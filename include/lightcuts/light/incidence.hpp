#pragma once

#include <cmath>

#include "light.hpp"

namespace lightcuts {

/// Where a light stands in its tree: its position, or the unit direction towards it.
template <Light L>
glm::vec3 place_of(const L& light) {
    if constexpr (DirectionalLight<L>) {
        return glm::vec3(-glm::normalize(glm::dvec3(to_vec3(detail::direction_of(light)))));
    } else {
        return to_vec3(detail::position_of(light));
    }
}

/// How a light reaches a point, shadows apart.
struct Incidence {
    glm::vec3 to_light;  ///< unit direction; meaningless if `geometric` is 0
    double geometric;    ///< emission x attenuation [Lightcuts 2005, Eq. 3]: finite, not negative
};

/// The geometric term of `light` at `point`. A point light exactly at the point contributes nothing.
template <Light L>
Incidence incidence(const L& light, const glm::vec3& point) {
    if constexpr (DirectionalLight<L>) {
        return {place_of(light), 1.0};
    } else {
        // In double: squares of float offsets neither overflow nor vanish there.
        const glm::dvec3 offset = glm::dvec3(place_of(light)) - glm::dvec3(point);
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

}  // namespace lightcuts
