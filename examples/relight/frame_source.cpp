#include "frame_source.hpp"

#include <cstdint>
#include <utility>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>
#include <render/stopwatch.hpp>

#include "exhaustive.hpp"

namespace relight {

namespace {

double per(std::uint64_t sum, std::uint64_t count) {
    return count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0.0;
}

bool is_canceled() { return tbb::is_current_task_group_canceling(); }

/// The same eye rays, and the same points but for what a material reflects.
bool see_alike(const FrameState& a, const FrameState& b) {
    return a.camera.eye == b.camera.eye && a.camera.target == b.camera.target && a.camera.up == b.camera.up &&
           a.camera.vertical_fov == b.camera.vertical_fov && a.camera.height == b.camera.height && a.width == b.width &&
           a.height == b.height && a.materials.is_diffuse == b.materials.is_diffuse;
}

}  // namespace

bool FrameState::operator==(const FrameState& other) const {
    return see_alike(*this, other) && rotation == other.rotation && materials == other.materials;
}

double FrameFigures::nodes_per_triangle() const { return per(relit.nodes, relit.triangles); }
double FrameFigures::clusters_per_point() const { return per(relit.clusters, points); }
double FrameFigures::directions_per_glossy_point() const { return per(relit.directions, relit.glossy); }

FrameSource::FrameSource(const Options& options, const PreparedScene& prepared, render::Environment environment)
    : options_(options), prepared_(prepared), environment_(std::move(environment)),
      map_(environment_.picture, environment_.scale, prepared.file.directions().size(), options.map.string()),
      nearest_(prepared.file.directions().leaves), power_(prepared.file.directions().size()),
      illumination_(prepared.file.directions()) {}

bool FrameSource::look(const FrameState& state) {
    if (!seen_of_ || !see_alike(*seen_of_, state)) {
        seen_of_.reset();
        shader_.reset();
        bounce_.reset();
        const render::Shade shade = state.materials.is_diffuse ? render::Shade::diffuse : render::Shade::full;
        const render::View view(state.camera, prepared_.mesh.scene.origin, state.width, state.height);
        seen_ = see(prepared_.mesh.scene, prepared_.rays, view, options_.view.spp, options_.view.seed, shade);
        own_lobes_.assign(seen_.points.begin(), seen_.points.end());
        radiance_.resize(seen_.points.size());
        if (!options_.exhaustive) shader_.emplace(prepared_.file, prepared_.mesh.sites, seen_);
        if (options_.with_bounce && !prepared_.file.patches().empty()) {
            bounce_.emplace(prepared_.file, prepared_.mesh.scene, prepared_.mesh.sites, seen_, shade);
        }
        figures_.points = seen_.points.size();
        figures_.mean_visibility_cut = shader_ ? shader_->mean_cut_size() : 0.0;
        seen_of_ = state;
        seen_of_->materials = {.is_diffuse = state.materials.is_diffuse};
    }
    if (seen_of_->materials != state.materials) {
        change_materials(state.materials);
        seen_of_->materials = state.materials;
    }
    if (is_canceled()) seen_of_.reset();
    return seen_of_.has_value();
}

void FrameSource::change_materials(const MaterialChange& change) {
    change_all(own_lobes_, change, seen_.points);
    if (bounce_) bounce_->change_materials(change);
}

bool FrameSource::light(double rotation) {
    if (rotation_ == rotation) return true;
    rotation_.reset();
    map_.turn(rotation, nearest_, power_);
    if (!options_.exhaustive) illumination_.set(power_, options_.illumination);
    if (is_canceled()) return false;
    environment_.rotation = static_cast<float>(rotation);
    rotation_ = rotation;
    return true;
}

void FrameSource::shade() {
    if (options_.exhaustive) {
        const RelightFile& file = prepared_.file;
        shade_exhaustively(seen_, prepared_.mesh.sites, file.directions(), power_, prepared_.rays,
                           file.preparation().sides, *options_.exhaustive, !options_.view.quiet, radiance_);
        if (bounce_) add_bounce_exhaustively();
        return;
    }
    figures_.illumination_cut = illumination_.cut().size();
    figures_.relit = shader_->shade(illumination_, options_.relit, radiance_);
    figures_.bounce_cut = 0;
    if (bounce_ && !is_canceled()) {
        bounce_->add(illumination_, options_.bounce, options_.relit, radiance_);
        figures_.bounce_cut = bounce_->light_cut_size();
    }
}

void FrameSource::add_bounce_exhaustively() {
    const RelightFile& file = prepared_.file;
    const Sites& sites = prepared_.mesh.sites;
    const Sides sides = file.preparation().sides;
    const SeenPoints& points = bounce_->points();
    std::vector<glm::vec3> light(points.points.size());
    shade_exhaustively(points, sites, file.directions(), power_, prepared_.rays, sides, *options_.exhaustive,
                       !options_.view.quiet, light);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] *= points.points[i].weight;
    relight::add_bounce_exhaustively(seen_, sites, file.patches(), prepared_.mesh.scene, light, prepared_.rays, sides,
                                     *options_.exhaustive, !options_.view.quiet, radiance_);
}

std::optional<render::Picture> FrameSource::picture(const FrameState& state) {
    if (!look(state)) return std::nullopt;
    render::Stopwatch watch;
    const bool is_lit = rotation_ == state.rotation;
    if (!light(state.rotation)) return std::nullopt;
    const double seconds = watch.lap();
    figures_.seconds_light = is_lit ? 0.0 : seconds;
    shade();
    render::Picture picture = compose();
    if (is_canceled()) return std::nullopt;
    figures_.seconds_shade = watch.lap();
    return picture;
}

/// What is seen under the light: `radiance_`, and the map where rays leave the scene.
render::Picture FrameSource::compose() const {
    render::Picture picture(seen_.width, seen_.height);
    picture.pixels = seen_.emitted;
    for (std::size_t i = 0; i < seen_.points.size(); ++i) {
        picture.pixels[seen_.points[i].pixel] += seen_.points[i].weight * radiance_[i];
    }
    const auto map = environment_.map();
    std::vector<glm::vec3> sky(seen_.escapes.size());
    tbb::parallel_for(std::size_t{0}, sky.size(), [&](std::size_t i) {
        sky[i] = seen_.escapes[i].weight * map.radiance(glm::dvec3(seen_.escapes[i].direction));
    });
    for (std::size_t i = 0; i < sky.size(); ++i) picture.pixels[seen_.escapes[i].pixel] += sky[i];
    return picture;
}

}  // namespace relight
