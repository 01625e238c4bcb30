#pragma once

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <lightcuts/adapt/embree.hpp>
#include <lightcuts/cut/lightcut.hpp>

#include "ray_scene.hpp"
#include "scene.hpp"
#include "scene_lights.hpp"
#include "surface_material.hpp"

namespace benchmark {

using Receiver = lightcuts::Receiver<render::SurfaceMaterial>;
using Forest = render::SceneLights::Forest;

/// A scene with its lights in trees and the points that a small picture of it shades.
class Workload {
public:
    /// `area_points`: lights per emissive surface. `builder`: as the renderer's option.
    Workload(const std::string& scene, std::uint32_t area_points, int width, int height,
             const std::string& builder = "binned");

    std::size_t light_count() const;
    const Forest& forest() const { return lights_->forest(); }
    std::span<const Receiver> receivers() const { return receivers_; }
    RTCScene embree_scene() const { return rays_->embree_scene(); }
    lightcuts::EmbreeOracle oracle() const { return lightcuts::EmbreeOracle(embree_scene()); }

private:
    std::unique_ptr<render::Scene> scene_;
    std::unique_ptr<render::RayScene> rays_;
    std::unique_ptr<render::SceneLights> lights_;
    std::vector<Receiver> receivers_;
};

/// Receivers that advance in lock-step, as in the renderer.
inline constexpr std::size_t group_size = 64;

/// Calls `f(group)` for consecutive groups of receivers.
template <class F>
void for_each_group(std::span<const Receiver> receivers, F&& f) {
    for (std::size_t begin = 0; begin < receivers.size(); begin += group_size) {
        f(receivers.subspan(begin, std::min(group_size, receivers.size() - begin)));
    }
}

/// Processor seconds of this thread: on a shared machine the clock on the wall measures the neighbours.
inline double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Processor seconds that `f()` takes on this thread.
template <class F>
double seconds(F&& f) {
    const double start = processor_seconds();
    f();
    return processor_seconds() - start;
}

/// The middle of an odd number of values.
double median(std::vector<double> values);

}  // namespace benchmark
