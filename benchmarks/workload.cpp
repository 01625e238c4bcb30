#include "workload.hpp"

#include "emitters.hpp"
#include "load_scene.hpp"
#include "surface.hpp"
#include "validate.hpp"
#include "view.hpp"

namespace benchmark {

Workload::Workload(const std::string& scene, std::uint32_t area_points, int width, int height,
                   const std::string& builder)
    : scene_(std::make_unique<render::Scene>(render::load_scene(scene))) {
    render::validate(*scene_);
    render::add_emitter_lights(*scene_, area_points);
    rays_ = std::make_unique<render::RayScene>(*scene_);
    render::Options options;
    options.builder = builder;
    lights_ = std::make_unique<render::SceneLights>(*scene_, options);

    const render::View view(scene_->cameras.front(), width, height);
    const render::SurfaceFinder finder(*scene_, *rays_, render::Shade::full);
    std::vector<render::SurfacePoint> points;
    constexpr int tile = 16;  // the renderer's order: neighbours share cache lines of the trees
    for (int top = 0; top < height; top += tile) {
        for (int left = 0; left < width; left += tile) {
            for (int y = top; y < std::min(top + tile, height); ++y) {
                for (int x = left; x < std::min(left + tile, width); ++x) {
                    const auto pixel = static_cast<std::uint32_t>(y * width + x);
                    finder.follow(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), pixel, 0,
                                  points);
                }
            }
        }
    }
    receivers_.reserve(points.size());
    for (const render::SurfacePoint& p : points) {
        receivers_.push_back(
            {p.position, render::SurfaceMaterial(p), p.ray_origin, static_cast<std::uint32_t>(receivers_.size())});
    }
}

std::size_t Workload::light_count() const {
    return scene_->omni.size() + scene_->oriented.size() + scene_->spots.size() + scene_->directional.size();
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

}  // namespace benchmark
