#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/invalid_input.hpp"
#include "../light/light.hpp"
#include "../visibility/query.hpp"
#include "sampler.hpp"

namespace lightcuts {

/// A sphere whose surface emits the same radiance everywhere and in all directions.
template <Spectrum S = glm::vec3>
struct SphereLight {
    glm::vec3 center{0.0f};
    float radius = 1.0f;
    S intensity = black<S>();  ///< W/sr, seen from far away: pi x radius^2 x radiance in W/(m^2 sr)
};

/// One of the omni lights inside a sphere that stand for it. Only what lies outside the sphere may shadow it: an oracle
/// has to end its shadow ray at `shadow_end`.
template <Spectrum S = glm::vec3>
struct SpherePointLight {
    glm::vec3 position{0.0f};
    S intensity = black<S>();  ///< W/sr
    std::uint32_t sphere = 0;  ///< index into the spheres that it was made of
};

/// Where the shadow ray from `from` to a light inside `sphere` ends: where it enters the sphere; `from` itself if that
/// lies in the sphere, so that nothing is in the way. pre: `light` lies in the sphere
template <Spectrum S>
glm::vec3 shadow_end(const SphereLight<S>& sphere, const glm::vec3& from, const glm::vec3& light) {
    const glm::dvec3 start = glm::dvec3(from) - glm::dvec3(sphere.center);
    const glm::dvec3 way = glm::dvec3(light) - glm::dvec3(from);
    const double outside = glm::dot(start, start) - static_cast<double>(sphere.radius) * sphere.radius;
    if (!(outside > 0.0)) return from;
    // |start + t way| = radius: t is the smaller root, written without cancellation.
    const double half = -glm::dot(start, way), length2 = glm::dot(way, way);
    const double discriminant = half * half - length2 * outside;
    const double t = outside / (half + std::sqrt(discriminant > 0.0 ? discriminant : 0.0));
    return t < 1.0 ? glm::vec3(glm::dvec3(from) + t * way) : light;
}

/// `query`, which asks for a light inside `sphere`, with its ray's end where it enters the sphere. For batched oracles:
/// they look up the sphere by the light's index. pre: !query.distant
template <Spectrum S>
VisibilityQuery ending_at(const SphereLight<S>& sphere, VisibilityQuery query) {
    query.to = shadow_end(sphere, query.from, query.to);
    return query;
}

/// `count` omni lights for each sphere, those of sphere i from i x `count` on: points inside it with the density
/// 1 / (pi^2 R^2 sqrt(R^2 - r^2)) [Lightcuts 2005, Eq. 7], which projects to a uniform distribution over the sphere's
/// disc from wherever outside it is seen, so that it is equally bright everywhere. Their intensities are equal and add
/// up to the sphere's, channel by channel.
///
/// throws: invalid_input naming the first sphere whose radius is not positive, whose center is not finite or whose
/// intensity is negative or not finite
template <Spectrum S, Sampler Sequence = ScrambledSobol>
std::vector<SpherePointLight<S>> sphere_lights(std::span<const SphereLight<S>> spheres, std::size_t count,
                                               const Sequence& sampler = {}) {
    std::vector<SpherePointLight<S>> lights;
    lights.reserve(spheres.size() * count);
    for (std::uint32_t i = 0; i < spheres.size(); ++i) {
        const SphereLight<S>& sphere = spheres[i];
        const auto refuse = [&](const std::string& what) {
            LIGHTCUTS_THROW(invalid_input("spherical light " + std::to_string(i) + ": " + what));
        };
        if (!is_finite(sphere.center)) refuse("its center is not finite");
        if (!(sphere.radius > 0.0f && sphere.radius - sphere.radius == 0.0f)) {
            refuse("radius " + std::to_string(sphere.radius) + " is not positive and finite");
        }
        for (int c = 0; c < channels_of<S>; ++c) {
            const float intensity = channel(sphere.intensity, c);
            if (!(intensity >= 0.0f && intensity - intensity == 0.0f)) {
                refuse("intensity " + std::to_string(intensity) + " is negative or not finite");
            }
        }
        const S share = make_spectrum<S>(
            [&](int c) { return static_cast<double>(channel(sphere.intensity, c)) / static_cast<double>(count); });
        for (std::size_t k = 0; k < count; ++k) {
            const auto index = static_cast<std::uint32_t>(lights.size());
            const auto number = [&](std::uint32_t d) { return static_cast<double>(sampler(index, d)); };
            // [Eq. 8]: a point of the disc seen along z, and a place along its chord.
            const double across = std::sqrt(number(0)), turn = 2.0 * std::numbers::pi * number(1);
            const glm::dvec3 unit(across * std::cos(turn), across * std::sin(turn),
                                  std::sqrt(1.0 - number(0)) * std::sin(std::numbers::pi * (number(2) - 0.5)));
            const glm::dvec3 point = glm::dvec3(sphere.center) + static_cast<double>(sphere.radius) * unit;
            lights.push_back({glm::vec3(point), share, i});
        }
    }
    return lights;
}

}  // namespace lightcuts
