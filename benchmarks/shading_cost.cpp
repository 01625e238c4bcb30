#include "shading_cost.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "timing.hpp"
#include "workload.hpp"

namespace benchmark {

namespace {

double sum_of_channels(const glm::vec3& v) { return static_cast<double>(v.x) + v.y + v.z; }

double squared(const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

/// The light of 64 samples, which are the same with any `rays`.
std::vector<render::Shading> sampled(const ShadedPoints& where, const render::RayScene& rays) {
    const auto shader = render::make_shader(where.scene(), rays, by("power", {}));
    const auto scratch = shader->make_scratch();
    std::vector<render::Shading> shadings(where.points().size());
    shader->shade(where.points(), shadings, *scratch);
    return shadings;
}

}  // namespace

std::vector<render::SurfacePoint> spread(std::span<const render::SurfacePoint> points, std::size_t count) {
    const std::size_t stride = std::max<std::size_t>(1, points.size() / std::max<std::size_t>(1, count));
    std::vector<render::SurfacePoint> some;
    for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
    return some;
}

render::Options by(const std::string& method, render::Options options) {
    options.method = method;
    return options;
}

ShadedPoints::ShadedPoints(render::Scene scene, int width, int height, render::Shade shade)
    : scene_(std::move(scene)), rays_(scene_), points_(points_seen(scene_, rays_, width, height, shade)) {}

std::vector<render::SurfacePoint> ShadedPoints::with_clear_view() const {
    render::Scene nothing;
    const render::RayScene no_shadows(nothing);
    const auto seen = sampled(*this, rays_), unshadowed = sampled(*this, no_shadows);
    std::vector<render::SurfacePoint> clear;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const double all = sum_of_channels(unshadowed[i].radiance);
        if (all > 0.0 && sum_of_channels(seen[i].radiance) >= 0.95 * all) clear.push_back(points_[i]);
    }
    return clear;
}

TimedMethod::TimedMethod(render::Scene scene, const render::RayScene& rays,
                         std::span<const render::SurfacePoint> points, const render::Options& options)
    : scene_(std::make_unique<render::Scene>(std::move(scene))), points_(points), shadings_(points.size()) {
    shader_ = render::make_shader(*scene_, rays, options);
    scratch_ = shader_->make_scratch();
    cost_.lights = scene_->light_count();
    cost_.points = points.size();
}

void TimedMethod::run() {
    const double count = static_cast<double>(points_.size());
    cost_.runs.push_back(seconds([&] { shader_->shade(points_, shadings_, *scratch_); }) * 1e6 / count);
    cost_.microseconds = median(cost_.runs);
    double nodes = 0, rays = 0;
    for (const render::Shading& s : shadings_) {
        nodes += s.cut_size;
        rays += s.shadow_rays;
    }
    cost_.cut_size = nodes / count;
    cost_.shadow_rays = rays / count;
}

void run_by_turns(std::span<TimedMethod> methods, int runs) {
    for (int run = 0; run < runs; ++run) {
        for (std::size_t turn = 0; turn < methods.size(); ++turn) {
            methods[run % 2 == 0 ? turn : methods.size() - 1 - turn].run();
        }
    }
}

double time_ratio(const ShadingCost& cost, const ShadingCost& base) {
    std::vector<double> ratios;
    for (std::size_t run = 0; run < cost.runs.size(); ++run) ratios.push_back(cost.runs[run] / base.runs[run]);
    return median(ratios);
}

double relative_rmse(std::span<const render::Shading> shadings, std::span<const render::Shading> truth) {
    double error = 0, norm = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        error += squared(glm::dvec3(shadings[i].radiance) - glm::dvec3(truth[i].radiance));
        norm += squared(glm::dvec3(truth[i].radiance));
    }
    return norm > 0.0 ? std::sqrt(error / norm) : 0.0;
}

}  // namespace benchmark
