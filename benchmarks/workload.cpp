#include "workload.hpp"

#include <lightcuts/core/invalid_input.hpp>

#include "indirect.hpp"
#include "prepare_scene.hpp"
#include "scene_options.hpp"
#include "surface.hpp"
#include "view.hpp"

namespace benchmark {

Workload::Workload(const std::string& scene, int width, int height)
    : options_(scene_options(scene)), scene_(std::make_unique<render::Scene>(render::prepare_scene(options_))),
      rays_(std::make_unique<render::RayScene>(*scene_)) {
    if (rays_->transmissive()) throw lightcuts::invalid_input(scene + ": lets light pass, which is not measured");
    render::add_virtual_lights(*scene_, *rays_, options_.indirect, render::shade_of(options_), options_.seed);
    lights_ = std::make_unique<render::SceneLights>(*scene_, options_);

    if (scene_->cameras.empty()) throw lightcuts::invalid_input(scene + ": has no camera; choose another scene");
    const render::View view(scene_->cameras.front(), width, height);
    const render::SurfaceFinder finder(*scene_, *rays_, render::shade_of(options_));
    constexpr int tile = 16;  // the renderer's order: neighbours share cache lines of the trees
    for (int top = 0; top < height; top += tile) {
        for (int left = 0; left < width; left += tile) {
            for (int y = top; y < std::min(top + tile, height); ++y) {
                for (int x = left; x < std::min(left + tile, width); ++x) {
                    const auto pixel = static_cast<std::uint32_t>(y * width + x);
                    finder.follow(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), pixel, 0,
                                  points_);
                }
            }
        }
    }
    receivers_.reserve(points_.size());
    for (const render::SurfacePoint& p : points_) {
        receivers_.push_back(
            {p.position, render::SurfaceMaterial(p), p.ray_origin, static_cast<std::uint32_t>(receivers_.size())});
    }
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

}  // namespace benchmark
