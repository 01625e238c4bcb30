#include "particle_cost.hpp"

#include <chrono>
#include <limits>
#include <optional>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include "lights/particle_scene.hpp"
#include "lights/spheres.hpp"
#include "prepare_scene.hpp"
#include "prepared_scene.hpp"
#include "rays/embree.hpp"
#include "scene_options.hpp"
#include "tbb_executor.hpp"
#include "timing.hpp"
#include "workload.hpp"

namespace benchmark {

namespace {

struct PathRay {
    glm::vec3 origin, direction;
};

/// The rays of all paths, in the order in which one thread traces them, and how tasks share them out.
struct Recording {
    std::vector<PathRay> rays;
    std::vector<std::vector<std::size_t>> calls;  ///< of the executor: where the rays of each task end
};

/// Particles meet the same as without it.
class RecordingScene {
public:
    RecordingScene(const render::ParticleScene& scene, Recording& recording) : scene_(scene), recording_(recording) {}

    std::optional<render::ParticleScene::Hit> intersect(const glm::vec3& origin, const glm::vec3& direction) const {
        recording_.rays.push_back({origin, direction});
        return scene_.intersect(origin, direction);
    }
    glm::vec3 diffuse_albedo(const render::ParticleScene::Hit& met) const { return scene_.diffuse_albedo(met); }
    glm::vec3 diffuse_transmittance(const render::ParticleScene::Hit& met) const {
        return scene_.diffuse_transmittance(met);
    }
    lightcuts::ScatteredParticle<> scatter(const render::ParticleScene::Hit& met, const glm::vec3& direction,
                                           const glm::vec3& u) const {
        return scene_.scatter(met, direction, u);
    }
    const lightcuts::Box& bounds() const { return scene_.bounds(); }

private:
    const render::ParticleScene& scene_;
    Recording& recording_;
};
static_assert(lightcuts::TransmissiveParticleScene<render::ParticleScene, glm::vec3> &&
              lightcuts::TransmissiveParticleScene<RecordingScene, glm::vec3>);

/// One thread, which notes where tasks end.
struct RecordingExecutor {
    Recording& recording;

    template <class Task>
    void operator()(std::size_t count, Task&& task) const {
        std::vector<std::size_t>& ends = recording.calls.emplace_back();
        for (std::size_t i = 0; i < count; ++i) {
            task(i);
            ends.push_back(recording.rays.size());
        }
    }
};

void trace(RTCScene scene, const PathRay& ray) {
    RTCRayHit query{};
    query.ray.org_x = ray.origin.x;
    query.ray.org_y = ray.origin.y;
    query.ray.org_z = ray.origin.z;
    query.ray.dir_x = ray.direction.x;
    query.ray.dir_y = ray.direction.y;
    query.ray.dir_z = ray.direction.z;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    render::QueryContext context;
    render::init_context(context);
    render::intersect(scene, context, query);
}

/// Traces the rays of a recording with as many threads as there are.
void replay(RTCScene scene, const Recording& recording) {
    std::size_t start = 0;
    for (const std::vector<std::size_t>& ends : recording.calls) {
        render::TbbExecutor{}(ends.size(), [&](std::size_t task) {
            const std::size_t first = task == 0 ? start : ends[task - 1];
            for (std::size_t i = first; i < ends[task]; ++i) trace(scene, recording.rays[i]);
        });
        if (!ends.empty()) start = ends.back();
    }
}

struct Lap {
    double processor = 0;  ///< seconds of all threads
    double wall = 0;
};

template <class F>
Lap lap(F&& f) {
    const auto processor = [] {
        timespec now{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    };
    const auto wall_start = std::chrono::steady_clock::now();
    const double start = processor();
    f();
    return {processor() - start, std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count()};
}

}  // namespace

ParticleCost measure_particles(const ParticleCostOptions& options) {
    render::Options lighting = scene_options(options.scene, options.area_points);
    const render::Scene scene = prepared_scene(options.scene, lighting);
    const auto shells = render::sphere_shells(scene);
    const render::RayScene rays(scene);
    const render::ParticleScene surfaces(scene, rays, render::shade_of(lighting));
    const lightcuts::ParticleSources sources(scene.omni, scene.oriented, scene.spots, scene.directional, shells);
    const lightcuts::ParticleOptions wanted{.lights = options.lights};
    const lightcuts::ScrambledSobol sampler{lighting.seed};

    Recording recording;
    const auto recorded = lightcuts::virtual_lights(RecordingScene(surfaces, recording), sources, wanted, sampler,
                                                    RecordingExecutor{recording});

    ParticleCost cost;
    cost.recorded_lights = recorded.lights.size();
    cost.rays = recording.rays.size();
    std::vector<double> seconds, ray_seconds, wall_seconds, ratios, wall_ratios;
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.threads));
    tbb::task_arena arena(options.threads);
    arena.execute([&] {
        for (int run = 0; run < options.runs; ++run) {
            const Lap traced = lap([&] { replay(rays.embree_scene(), recording); });
            const Lap made = lap([&] {
                const auto lights = lightcuts::virtual_lights(surfaces, sources, wanted, sampler,
                                                              render::TbbExecutor{});
                cost.virtual_lights = lights.lights.size();
                cost.particles = lights.particles;
            });
            seconds.push_back(made.processor);
            ray_seconds.push_back(traced.processor);
            wall_seconds.push_back(made.wall);
            ratios.push_back(made.processor / traced.processor);
            wall_ratios.push_back(made.wall / traced.wall);
        }
    });
    cost.seconds = median(seconds);
    cost.ray_seconds = median(ray_seconds);
    cost.wall_seconds = median(wall_seconds);
    cost.ratio = median(ratios);
    cost.wall_ratio = median(wall_ratios);
    return cost;
}

}  // namespace benchmark
