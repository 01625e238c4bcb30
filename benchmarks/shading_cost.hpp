#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "options.hpp"
#include "rays/ray_scene.hpp"
#include "scene.hpp"
#include "shader.hpp"
#include "surfaces/surface.hpp"

namespace benchmark {

/// Every `stride`-th point, such that about `count` are left, but at least one.
std::vector<render::SurfacePoint> spread(std::span<const render::SurfacePoint> points, std::size_t count);

/// `options` with this method.
render::Options by(const std::string& method, render::Options options);

/// The points that a small picture of a scene shades, in the renderer's order.
class ShadedPoints {
public:
    /// Keeps `scene`, which its first camera looks at.
    ShadedPoints(render::Scene scene, int width, int height, render::Shade shade = render::Shade::full);

    const render::Scene& scene() const { return scene_; }
    const render::RayScene& rays() const { return rays_; }
    const std::vector<render::SurfacePoint>& points() const { return points_; }

    std::vector<render::SurfacePoint> about(std::size_t count) const { return spread(points_, count); }
    /// The points from which at least 95 % of the light that would come without shadows is seen to come.
    std::vector<render::SurfacePoint> with_clear_view() const;

private:
    render::Scene scene_;
    render::RayScene rays_;
    std::vector<render::SurfacePoint> points_;
};

/// What a method needs to shade points, means of one.
struct ShadingCost {
    std::size_t lights = 0;
    std::size_t points = 0;
    double cut_size = 0;
    double shadow_rays = 0;
    double microseconds = 0;   ///< processor time of one thread, median of the runs
    std::vector<double> runs;  ///< microseconds of each run
};

/// One method with its lights and trees, ready to be timed.
class TimedMethod {
public:
    /// `scene`: with the surfaces of `rays`. `rays` and `points` are kept.
    TimedMethod(render::Scene scene, const render::RayScene& rays, std::span<const render::SurfacePoint> points,
                const render::Options& options);

    /// Shades all points once more.
    void run();

    const ShadingCost& cost() const { return cost_; }
    const std::vector<render::Shading>& shadings() const { return shadings_; }

private:
    std::unique_ptr<const render::Scene> scene_;
    std::span<const render::SurfacePoint> points_;
    std::unique_ptr<render::Shader> shader_;
    std::unique_ptr<render::Shader::Scratch> scratch_;
    std::vector<render::Shading> shadings_;
    ShadingCost cost_;
};

/// Runs all methods `runs` times by turns: neighbors in time share caches and clock rates. pre: `runs` is odd
void run_by_turns(std::span<TimedMethod> methods, int runs);

/// Median over the runs of time / time of `base` in the same turn.
double time_ratio(const ShadingCost& cost, const ShadingCost& base);

/// Root of the mean square of the radiance's error over that of `truth`, all channels.
double relative_rmse(std::span<const render::Shading> shadings, std::span<const render::Shading> truth);

}  // namespace benchmark
