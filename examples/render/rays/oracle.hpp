#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>

#include <glm/geometric.hpp>
#include <lightcuts/adapt/embree.hpp>
#include <lightcuts/light/incidence.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/source/sphere.hpp>
#include <lightcuts/visibility/query.hpp>

#include "lights/scene_lights.hpp"
#include "motion.hpp"
#include "rays/ray_scene.hpp"
#include "scene.hpp"

namespace render {

/// Where the shadow ray from `from` ends to a light that stands off a surface along `axis`, as those of emitters and
/// virtual lights do: as much farther off as the rounding of the ray and of its intersection with that surface, which
/// grow with the distance, so that the surface does not hide it and all before it does.
inline glm::vec3 end_before_surface(const glm::vec3& from, const glm::vec3& light, const glm::vec3& axis) {
    constexpr float by_distance = 0x1.8p-22f;
    constexpr float by_coordinate = 0x1p-20f;
    const float coordinate = std::max({std::abs(light.x), std::abs(light.y), std::abs(light.z)});
    return light + (by_distance * glm::length(light - from) + by_coordinate * coordinate) * axis;
}

/// The same for a light that shines in all directions, or in a cone: it may lie in a surface, but which is not known.
inline glm::vec3 end_before_point(const glm::vec3& from, const glm::vec3& light) {
    constexpr float share = 0x1p-15f;
    return light + share * (from - light);
}

/// The same where the ray enters the sphere of the lights inside one; `from` if it begins there.
inline glm::vec3 end_before_sphere(const Scene& scene, const glm::vec3& from,
                                   const lightcuts::SpherePointLight<>& light) {
    return end_before_point(from, lightcuts::shadow_end(scene.spheres[light.sphere], from, light.position));
}
inline glm::vec3 end_before_sphere(const Scene& scene, const glm::vec3& from,
                                   const lightcuts::InstantLight<lightcuts::SpherePointLight<>>& light) {
    const lightcuts::SphereLight<>& sphere = scene.at_instants.spheres[light.sphere];
    return end_before_point(from, lightcuts::shadow_end(sphere, from, light.position));
}

template <lightcuts::PointLight L>
glm::vec3 shadow_end(const Scene& scene, const glm::vec3& from, const L& light) {
    if constexpr (std::derived_from<L, lightcuts::SpherePointLight<>>) {
        return end_before_sphere(scene, from, light);
    } else if constexpr (std::derived_from<L, lightcuts::OrientedPointLight<>>) {
        return end_before_surface(from, light.position, light.axis);
    } else {
        return end_before_point(from, lightcuts::position_or_direction(light));
    }
}

/// The same of a query about the lights of a `SceneLights`.
inline glm::vec3 shadow_end(const Scene& scene, const lightcuts::VisibilityQuery& query) {
    switch (query.kind) {
        case SceneLights::oriented_kind:
            return end_before_surface(query.from, query.to, scene.oriented[query.light].axis);
        case SceneLights::virtual_kind:
            return end_before_surface(query.from, query.to, scene.virtual_lights[query.light].axis);
        case SceneLights::sphere_kind: return end_before_sphere(scene, query.from, scene.sphere_points[query.light]);
        case InstantSceneLights::oriented_kind:
            return end_before_surface(query.from, query.to, scene.at_instants.oriented[query.light].axis);
        case InstantSceneLights::sphere_kind:
            return end_before_sphere(scene, query.from, scene.at_instants.sphere_points[query.light]);
        case InstantSceneLights::virtual_kind:
            return end_before_surface(query.from, query.to, scene.at_instants.virtual_lights[query.light].axis);
        default: return end_before_point(query.from, query.to);
    }
}

/// Visibility through fog and surfaces that let light pass, tinted by them, at the time of the receiver.
class TransmissiveOracle {
public:
    TransmissiveOracle(const Scene& scene, const RayScene& rays) : scene_(scene), rays_(rays) {}

    template <class R, lightcuts::Light L>
    glm::vec3 operator()(const R& receiver, const L& light) const {
        const glm::vec3 from = receiver.shadow_origin;
        const glm::vec3 place = lightcuts::position_or_direction(light);
        const float time = time_of_receiver(scene_, receiver.id);
        if constexpr (lightcuts::DirectionalLight<L>) {
            return rays_.to_infinity(from, place, time) * scene_.fog.medium.transmittance_to_infinity(from, place);
        } else {
            const glm::vec3 end = shadow_end(scene_, from, light);
            const glm::vec3 tint = end == from ? glm::vec3(1.0f) : rays_.to_point(from, end, time);
            return tint * scene_.fog.medium.transmittance(from, place);
        }
    }

private:
    const Scene& scene_;
    const RayScene& rays_;
};

/// Visibility among opaque surfaces and through fog, at the time of the receiver, by streams of plain Embree rays.
class OpaqueOracle {
public:
    OpaqueOracle(const Scene& scene, const RayScene& rays)
        : scene_(scene), embree_(rays.embree_scene(), 1.0f - RayScene::shadow_ray_end) {}

    template <class R, lightcuts::Light L>
    float operator()(const R& receiver, const L& light) const {
        const glm::vec3 from = receiver.shadow_origin, place = lightcuts::position_or_direction(light);
        const float time = time_of_receiver(scene_, receiver.id);
        if constexpr (lightcuts::DirectionalLight<L>) {
            return embree_(receiver, light, time) ? scene_.fog.medium.transmittance_to_infinity(from, place) : 0.0f;
        } else {
            const glm::vec3 end = shadow_end(scene_, from, light);
            const bool visible = end == from || embree_(receiver, lightcuts::OmniLight<>{end, {}, {}}, time);
            return visible ? scene_.fog.medium.transmittance(from, place) : 0.0f;
        }
    }

    void many(std::span<const lightcuts::VisibilityQuery> queries, std::span<float> answers) const {
        const auto end_of = [this](const lightcuts::VisibilityQuery& query) { return shadow_end(scene_, query); };
        if (scene_.is_still()) {
            embree_.many(queries, answers, end_of);
        } else {
            embree_.many(queries, answers, end_of, [this](const lightcuts::VisibilityQuery& query) {
                return time_of_receiver(scene_, query.receiver);
            });
        }
        if (scene_.fog.is_there()) lightcuts::attenuate(scene_.fog.medium, queries, answers);
    }

private:
    const Scene& scene_;
    lightcuts::EmbreeOracle embree_;
};

/// Calls `f(oracle)` with the scene's visibility.
template <class F>
void with_oracle(const Scene& scene, const RayScene& rays, F&& f) {
    if (rays.transmissive()) {
        f(TransmissiveOracle(scene, rays));
    } else {
        f(OpaqueOracle(scene, rays));
    }
}

}  // namespace render
