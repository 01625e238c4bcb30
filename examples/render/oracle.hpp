#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include <lightcuts/adapt/embree.hpp>
#include <lightcuts/light/incidence.hpp>
#include <lightcuts/source/sphere.hpp>
#include <lightcuts/visibility/query.hpp>

#include "ray_scene.hpp"
#include "scene.hpp"
#include "scene_lights.hpp"

namespace render {

/// Where the shadow ray from `from` to `light` ends: where it enters the sphere, for lights inside one.
template <lightcuts::PointLight L>
glm::vec3 shadow_end(const Scene& scene, const glm::vec3& from, const L& light) {
    if constexpr (std::same_as<L, lightcuts::SpherePointLight<>>) {
        return lightcuts::shadow_end(scene.spheres[light.sphere], from, light.position);
    } else {
        return lightcuts::position_or_direction(light);
    }
}

/// Visibility through surfaces that let light pass, tinted by them.
class TransmissiveOracle {
public:
    TransmissiveOracle(const Scene& scene, const RayScene& rays) : scene_(scene), rays_(rays) {}

    template <class R, lightcuts::Light L>
    glm::vec3 operator()(const R& receiver, const L& light) const {
        const glm::vec3 from = receiver.shadow_origin;
        if constexpr (lightcuts::DirectionalLight<L>) {
            return rays_.to_infinity(from, lightcuts::position_or_direction(light));
        } else {
            const glm::vec3 end = shadow_end(scene_, from, light);
            return end == from ? glm::vec3(1.0f) : rays_.to_point(from, end);
        }
    }

private:
    const Scene& scene_;
    const RayScene& rays_;
};

/// Visibility among opaque surfaces, by streams of plain Embree rays.
class OpaqueOracle {
public:
    OpaqueOracle(const Scene& scene, const RayScene& rays)
        : scene_(scene), embree_(rays.embree_scene(), 1.0f - RayScene::shadow_ray_end) {}

    template <class R, lightcuts::Light L>
    bool operator()(const R& receiver, const L& light) const {
        if constexpr (std::same_as<L, lightcuts::SpherePointLight<>>) {
            const glm::vec3 end = shadow_end(scene_, receiver.shadow_origin, light);
            return end == receiver.shadow_origin || embree_(receiver, lightcuts::OmniLight<>{end, {}, {}});
        } else {
            return embree_(receiver, light);
        }
    }

    void many(std::span<const lightcuts::VisibilityQuery> queries, std::span<float> answers) const {
        if (scene_.sphere_points.empty()) return embree_.many(queries, answers);
        std::array<lightcuts::VisibilityQuery, 256> some;
        for (std::size_t begin = 0; begin < queries.size(); begin += some.size()) {
            const std::size_t count = std::min(some.size(), queries.size() - begin);
            for (std::size_t i = 0; i < count; ++i) {
                some[i] = queries[begin + i];
                if (some[i].kind != SceneLights::sphere_kind) continue;
                some[i].to = shadow_end(scene_, some[i].from, scene_.sphere_points[some[i].light]);
            }
            embree_.many(std::span(some).first(count), answers.subspan(begin, count));
            for (std::size_t i = 0; i < count; ++i) {
                if (!some[i].distant && some[i].to == some[i].from) answers[begin + i] = 1.0f;
            }
        }
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
