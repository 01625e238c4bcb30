#include "workload.hpp"

#include <lightcuts/core/invalid_input.hpp>

#include "prepare_scene.hpp"
#include "prepared_scene.hpp"
#include "scene_options.hpp"
#include "tile_order.hpp"
#include "view.hpp"

namespace benchmark {

std::vector<render::SurfacePoint> points_seen(const render::Scene& scene, const render::RayScene& rays, int width,
                                              int height, render::Shade shade) {
    constexpr int tile_side = 16;  // the renderer's
    if (scene.cameras.empty()) throw lightcuts::invalid_input(scene.name + ": has no camera; choose another scene");
    const render::View view(scene.cameras.front(), scene.origin, width, height);
    const render::EyePathTracer tracer(scene, rays, shade);
    std::vector<render::SurfacePoint> points;
    for (const render::Tile& tile : render::tiles_of(width, height, tile_side)) {
        for (int y = tile.y0; y < tile.y1; ++y) {
            for (int x = tile.x0; x < tile.x1; ++x) {
                const auto pixel = static_cast<std::uint32_t>(y * width + x);
                tracer.follow(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f), pixel, 0, points);
            }
        }
    }
    return points;
}

Workload::Workload(const std::string& scene, int width, int height)
    : options_(scene_options(scene)), scene_(std::make_unique<render::Scene>(lit_scene(scene, options_))),
      rays_(std::make_unique<render::RayScene>(*scene_)) {
    if (rays_->transmissive()) throw lightcuts::invalid_input(scene + ": lets light pass, which is not measured");
    lights_ = std::make_unique<render::SceneLights>(*scene_, options_);

    points_ = points_seen(*scene_, *rays_, width, height, render::shade_of(options_));
    receivers_.reserve(points_.size());
    for (const render::SurfacePoint& p : points_) {
        receivers_.push_back(
            {p.position, render::SurfaceMaterial(p), p.ray_origin, static_cast<std::uint32_t>(receivers_.size())});
    }
}

}  // namespace benchmark
