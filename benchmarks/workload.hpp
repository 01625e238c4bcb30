#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>

#include "lights/scene_lights.hpp"
#include "options.hpp"
#include "rays/oracle.hpp"
#include "rays/ray_scene.hpp"
#include "scene.hpp"
#include "surfaces/surface.hpp"
#include "surfaces/surface_material.hpp"

namespace benchmark {

using Receiver = lightcuts::Receiver<render::SurfaceMaterial>;

/// The points that a small picture by the scene's first camera shades, in the renderer's order: neighbors share cache
/// lines of the trees. throws: lightcuts::invalid_input if there is no camera.
std::vector<render::SurfacePoint> points_seen(const render::Scene& scene, const render::RayScene& rays, int width,
                                              int height, render::Shade shade = render::Shade::full);

/// A scene with its lights in trees and the points that a small picture of it shades.
class Workload {
public:
    /// `scene`: see scene_options. It is seen by its first camera.
    Workload(const std::string& scene, int width, int height);

    std::size_t light_count() const { return scene_->light_count(); }
    /// As by default, or as the scene's name says.
    const lightcuts::ClampingOptions& clamp() const { return options_.clamp; }
    /// Calls `f(forest)` as the renderer would: with a kind for virtual lights only if there are some.
    template <class F>
    decltype(auto) visit(F&& f) const {
        return lights_->visit(f);
    }
    std::span<const Receiver> receivers() const { return receivers_; }
    /// What the receivers were made of, in the same order.
    std::span<const render::SurfacePoint> points() const { return points_; }
    const render::Scene& scene() const { return *scene_; }
    const render::RayScene& rays() const { return *rays_; }
    const render::Options& options() const { return options_; }
    RTCScene embree_scene() const { return rays_->embree_scene(); }
    render::OpaqueOracle oracle() const { return {*scene_, *rays_}; }

private:
    render::Options options_;
    std::unique_ptr<render::Scene> scene_;
    std::unique_ptr<render::RayScene> rays_;
    std::unique_ptr<render::SceneLights> lights_;
    std::vector<render::SurfacePoint> points_;
    std::vector<Receiver> receivers_;
};

/// Receivers that advance in lock-step, as in the renderer.
inline constexpr std::size_t group_size = 16;

/// Calls `f(group)` for consecutive groups of receivers.
template <class F>
void for_each_group(std::span<const Receiver> receivers, F&& f) {
    for (std::size_t begin = 0; begin < receivers.size(); begin += group_size) {
        f(receivers.subspan(begin, std::min(group_size, receivers.size() - begin)));
    }
}

/// The sum that a lightcut of the workload approximates.
template <class Oracle>
glm::vec3 exhaustive_sum(const Workload& work, const Receiver& receiver, const Oracle& oracle,
                         lightcuts::EstimateScratch<glm::vec3>& scratch) {
    return work.visit([&](const auto& forest) {
        return lightcuts::exhaustive(forest, receiver, oracle, scratch, work.clamp()).radiance;
    });
}

}  // namespace benchmark
