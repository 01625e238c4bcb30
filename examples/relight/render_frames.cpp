#include "render_frames.hpp"

#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <lightcuts/core/invalid_input.hpp>
#include <nlohmann/json.hpp>
#include <render/choose_camera.hpp>
#include <render/error.hpp>
#include <render/io/escape.hpp>
#include <render/io/map_picture.hpp>
#include <render/io/output_file.hpp>
#include <render/io/picture.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/rays/ray_tracer.hpp>
#include <render/read_reference.hpp>
#include <render/stopwatch.hpp>

#include "mesh.hpp"
#include "seen_points.hpp"

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

std::filesystem::path frame_path(const Options& options, int frame) {
    const std::filesystem::path& whole = options.view.output;
    if (options.frames == 1) return whole;
    char number[16];
    std::snprintf(number, sizeof number, "-%04d", frame);
    const std::string extension = whole.extension().string();
    return render::beside(whole, number + (extension.empty() ? ".exr" : extension));
}

/// The file names of all frames, which must all be writable and none of `inputs`.
void check_outputs(const Options& options, const std::vector<std::filesystem::path>& inputs) {
    std::vector<std::filesystem::path> outputs{render::beside(options.view.output, ".json")};
    for (int frame = 0; frame < options.frames; ++frame) {
        outputs.push_back(frame_path(options, frame));
        outputs.push_back(render::beside(outputs.back(), ".png"));
    }
    for (const auto& output : outputs) {
        render::require_writable(output);
        for (const auto& input : inputs) render::require_apart(output, input);
    }
}

/// What is seen under a light: `radiance`, by point, and the map where rays leave the scene.
render::Picture compose(const SeenPoints& seen, std::span<const glm::vec3> radiance,
                        const render::Environment& environment) {
    render::Picture picture(seen.width, seen.height);
    picture.pixels = seen.emitted;
    for (std::size_t i = 0; i < seen.points.size(); ++i) {
        picture.pixels[seen.points[i].pixel] += seen.points[i].weight * radiance[i];
    }
    const auto map = environment.map();
    std::vector<glm::vec3> sky(seen.escapes.size());
    tbb::parallel_for(std::size_t{0}, sky.size(), [&](std::size_t i) {
        sky[i] = seen.escapes[i].weight * map.radiance(glm::dvec3(seen.escapes[i].direction));
    });
    for (std::size_t i = 0; i < sky.size(); ++i) picture.pixels[seen.escapes[i].pixel] += sky[i];
    return picture;
}

double per(std::uint64_t sum, std::uint64_t count) {
    return count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0.0;
}

Json report_of(const Options& options, const RelightFile& file, const Mesh& mesh, const SeenPoints& seen) {
    Json json;
    json["scene"] = render::as_utf8(mesh.scene.name);
    json["cuts"] = render::as_utf8(options.cut_file.string());
    json["map"] = render::as_utf8(options.map.string());
    json["method"] = !options.exhaustive                      ? "relit"
                     : *options.exhaustive == Truth::pixels   ? "exhaustive, visibility from pixels"
                     : *options.exhaustive == Truth::vertices ? "exhaustive, visibility from vertices"
                                                              : "exhaustive, without visibility";
    json["width"] = options.view.width;
    json["height"] = options.view.height;
    json["spp"] = options.view.spp;
    json["directions"] = file.directions().size();
    json["triangles"] = mesh.scene.triangles.size();
    json["sites"] = mesh.sites.sites.size();
    json["file_bytes"] = file.bytes();
    json["points"] = seen.points.size();
    return json;
}

class FrameLoop {
public:
    FrameLoop(const Options& options, const RelightFile& file, const Mesh& mesh, const render::RayScene& rays,
              const SeenPoints& seen, render::Environment environment)
        : options_(options), file_(file), mesh_(mesh), rays_(rays), seen_(seen), environment_(std::move(environment)),
          map_(environment_.picture, environment_.scale, file.directions().size(), options.map.string()),
          nearest_(file.directions().leaves), illumination_(file.directions()), power_(file.directions().size()),
          radiance_(seen.points.size()) {
        if (!options.exhaustive) shader_.emplace(file, mesh.sites, seen);
    }

    /// The picture of the map turned by `degrees`; fills `json`.
    render::Picture frame(double degrees, Json& json) {
        render::Stopwatch watch;
        map_.turn(degrees, nearest_, power_);
        json["rotation"] = degrees;
        if (options_.exhaustive) {
            shade_exhaustively(seen_, mesh_.sites, file_.directions(), power_, rays_, file_.preparation().sides,
                               *options_.exhaustive, !options_.view.quiet, radiance_);
        } else {
            illumination_.set(power_, options_.illumination);
            json["illumination_cut"] = illumination_.cut().size();
            json["seconds_light"] = watch.lap();
            const RelitStatistics statistics = shader_->shade(illumination_, options_.relit, radiance_);
            json["nodes_per_triangle"] = per(statistics.nodes, statistics.triangles);
            json["clusters_per_point"] = per(statistics.clusters, seen_.points.size());
            json["triangles_in_sight"] = statistics.triangles;
            json["glossy_points"] = statistics.glossy;
            json["directions_per_glossy_point"] = per(statistics.directions, statistics.glossy);
            json["points_of_a_back"] = statistics.backs;
        }
        environment_.rotation = static_cast<float>(degrees);
        render::Picture picture = compose(seen_, radiance_, environment_);
        json["seconds_shade"] = watch.lap();
        return picture;
    }

    double mean_cut_size() const { return shader_ ? shader_->mean_cut_size() : 0.0; }

private:
    const Options& options_;
    const RelightFile& file_;
    const Mesh& mesh_;
    const render::RayScene& rays_;
    const SeenPoints& seen_;
    render::Environment environment_;
    SplitMap map_;
    NearestDirection nearest_;
    Illumination illumination_;
    std::vector<glm::vec3> power_;     ///< by direction
    std::vector<glm::vec3> radiance_;  ///< by point
    std::optional<RelitShader> shader_;
};

void render_all(const Options& options, const RelightFile& file, const Mesh& mesh, const render::RayScene& rays,
                const render::View& view) {
    render::Stopwatch watch;
    const std::optional<render::Picture> reference = render::read_reference(options.view);
    render::Environment environment{render::read_map(options.map), options.map_scale, 0.0f};
    environment.picture.channels.clear();
    const SeenPoints seen = see(mesh.scene, rays, view, options.view.spp, options.view.seed,
                                options.view.diffuse_materials ? render::Shade::diffuse : render::Shade::full);
    FrameLoop loop(options, file, mesh, rays, seen, std::move(environment));
    Json json = report_of(options, file, mesh, seen);
    json["mean_visibility_cut"] = loop.mean_cut_size();
    json["seconds_start"] = watch.lap();
    double seconds = 0.0;
    std::optional<render::ToneCurve> curve;
    for (int i = 0; i < options.frames; ++i) {
        Json of_frame;
        watch.lap();
        const std::clock_t work = std::clock();
        const render::Picture picture = loop.frame(options.rotation + options.turn * i, of_frame);
        const double took = watch.lap();
        of_frame["seconds"] = took;
        of_frame["processor_seconds"] = static_cast<double>(std::clock() - work) / CLOCKS_PER_SEC;
        seconds += took;
        // One curve for all, so that frames can be compared and a film does not flicker.
        if (!curve) curve = render::tone_curve(picture);
        const std::filesystem::path path = frame_path(options, i);
        render::write_exr(path, picture);
        render::write_png(render::beside(path, ".png"), picture.width, picture.height,
                          render::tone_mapped(picture, *curve));
        if (i == 0 && reference) {
            const render::ErrorFigures error = render::compare(picture, *reference);
            json["relative_rmse"] = error.relative_rmse;
            json["relative_bias"] = error.relative_bias;
            if (!options.view.quiet) {
                std::fprintf(stderr, "relative RMSE %.4f, bias %+.4f\n", error.relative_rmse, error.relative_bias);
            }
        }
        json["frames"].push_back(std::move(of_frame));
    }
    json["frames_per_second"] = seconds > 0.0 ? options.frames / seconds : 0.0;
    const std::string text = json.dump(2) + "\n";
    render::write_file(render::beside(options.view.output, ".json"), std::span(text.data(), text.size()));
    if (options.view.quiet) return;
    const Json& last = json["frames"].back();
    std::fprintf(stderr, "%zu points; ", seen.points.size());
    if (!options.exhaustive) {
        std::fprintf(stderr, "visibility cuts in use %.1f, illumination cut %zu, clusters a point %.1f; ",
                     loop.mean_cut_size(), last["illumination_cut"].get<std::size_t>(),
                     last["clusters_per_point"].get<double>());
        if (last["points_of_a_back"] > 0) {
            std::fprintf(stderr, "%zu points show a side that was not prepared, and are black; ",
                         last["points_of_a_back"].get<std::size_t>());
        }
    }
    std::fprintf(stderr, "%.3f s a frame\n", seconds / options.frames);
}

}  // namespace

void render_frames(const Options& options) {
    const RelightFile file(options.cut_file);
    const render::RayTracer tracer(options.view.isa);
    render::Scene scene = load_still_scene(options.view.scene);
    std::vector<std::filesystem::path> inputs = scene.files;
    inputs.push_back(options.cut_file);
    inputs.push_back(options.map);
    if (!options.view.reference.empty()) inputs.push_back(options.view.reference);
    check_outputs(options, inputs);
    file.require_scene(scene);
    const Mesh mesh = refined(std::move(scene), file.preparation().longest_edge);
    if (mesh.sites.sites.size() != file.preparation().sites) {
        throw lightcuts::invalid_input(options.cut_file.string() + ": has cuts for " +
                                       std::to_string(file.preparation().sites) + " places of the mesh, which has " +
                                       std::to_string(mesh.sites.sites.size()) + "; prepare it anew");
    }
    const render::Camera camera = render::choose_camera(mesh.scene, options.view);
    const render::View view(camera, mesh.scene.origin, options.view.width, options.view.height);
    const render::RayScene rays(mesh.scene, tracer);
    const int threads = options.view.threads > 0 ? options.view.threads : tbb::this_task_arena::max_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] { render_all(options, file, mesh, rays, view); });
}

}  // namespace relight
