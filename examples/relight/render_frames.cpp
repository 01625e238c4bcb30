#include "render_frames.hpp"

#include <cinttypes>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <oneapi/tbb/task_arena.h>
#include <nlohmann/json.hpp>
#include <render/choose_camera.hpp>
#include <render/error.hpp>
#include <render/io/escape.hpp>
#include <render/io/output_file.hpp>
#include <render/io/picture.hpp>
#include <render/rays/ray_tracer.hpp>
#include <render/read_reference.hpp>
#include <render/stopwatch.hpp>
#include <render/thread_limit.hpp>

#include "frame_path.hpp"
#include "frame_source.hpp"
#include "mesh.hpp"
#include "prepared_scene.hpp"

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

std::filesystem::path path_of_frame(const Options& options, int frame) {
    return options.frames == 1 ? options.view.output : frame_path(options.view.output, frame);
}

/// The file names of all frames, which must all be writable and none of `inputs`.
void check_outputs(const Options& options, const std::vector<std::filesystem::path>& inputs) {
    std::vector<std::filesystem::path> outputs{render::beside(options.view.output, ".json")};
    for (int frame = 0; frame < options.frames; ++frame) {
        outputs.push_back(path_of_frame(options, frame));
        outputs.push_back(render::beside(outputs.back(), ".png"));
    }
    for (const auto& output : outputs) {
        render::require_writable(output);
        for (const auto& input : inputs) render::require_apart(output, input);
    }
}

Json report_of(const Options& options, const PreparedScene& prepared) {
    Json json;
    json["scene"] = render::as_utf8(prepared.mesh.scene.name);
    json["cuts"] = render::as_utf8(options.cut_file.string());
    json["map"] = render::as_utf8(options.map.string());
    json["method"] = !options.exhaustive                      ? "relit"
                     : *options.exhaustive == Truth::pixels   ? "exhaustive, visibility from pixels"
                     : *options.exhaustive == Truth::vertices ? "exhaustive, visibility from vertices"
                                                              : "exhaustive, without visibility";
    json["width"] = options.view.width;
    json["height"] = options.view.height;
    json["spp"] = options.view.spp;
    json["directions"] = prepared.file.directions().size();
    json["triangles"] = prepared.mesh.scene.triangles.size();
    json["sites"] = prepared.mesh.sites.sites.size();
    json["patches"] = options.with_bounce ? prepared.file.patches().size() : 0;
    json["file_bytes"] = prepared.file.bytes();
    return json;
}

Json report_of(const FrameFigures& figures, double degrees, bool is_exhaustive) {
    Json json;
    json["rotation"] = degrees;
    if (!is_exhaustive) {
        json["illumination_cut"] = figures.illumination_cut;
        json["seconds_light"] = figures.seconds_light;
        json["nodes_per_triangle"] = figures.nodes_per_triangle();
        json["clusters_per_point"] = figures.clusters_per_point();
        json["triangles_in_sight"] = figures.relit.triangles;
        json["glossy_points"] = figures.relit.glossy;
        json["directions_per_glossy_point"] = figures.directions_per_glossy_point();
        json["points_of_a_back"] = figures.relit.backs;
        if (figures.bounce_cut > 0) json["bounce_cut"] = figures.bounce_cut;
    }
    json["seconds_shade"] = figures.seconds_shade;
    return json;
}

void render_all(const Options& options, const PreparedScene& prepared, const render::Camera& camera) {
    render::Stopwatch watch;
    const std::optional<render::Picture> reference = render::read_reference(options.view);
    FrameSource source(options, prepared, read_environment(options));
    FrameState state{camera, options.rotation, options.materials, options.view.width, options.view.height};
    source.look(state);
    const FrameFigures& figures = source.figures();
    Json json = report_of(options, prepared);
    json["points"] = figures.points;
    json["mean_visibility_cut"] = figures.mean_visibility_cut;
    json["seconds_start"] = watch.lap();
    double seconds = 0.0;
    std::optional<render::ToneCurve> curve;
    for (int i = 0; i < options.frames; ++i) {
        watch.lap();
        const std::clock_t work = std::clock();
        state.rotation = options.rotation + options.turn * i;
        const render::Picture picture = source.picture(state).value();
        const double took = watch.lap();
        Json of_frame = report_of(figures, state.rotation, options.exhaustive.has_value());
        of_frame["seconds"] = took;
        of_frame["processor_seconds"] = static_cast<double>(std::clock() - work) / CLOCKS_PER_SEC;
        seconds += took;
        // One curve for all, so that frames can be compared and a film does not flicker.
        if (!curve) curve = render::tone_curve(picture);
        const std::filesystem::path path = path_of_frame(options, i);
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
    std::fprintf(stderr, "%zu points; ", figures.points);
    if (!options.exhaustive) {
        std::fprintf(stderr, "visibility cuts in use %.1f, illumination cut %zu, clusters a point %.1f; ",
                     figures.mean_visibility_cut, figures.illumination_cut, figures.clusters_per_point());
        if (figures.relit.backs > 0) {
            std::fprintf(stderr, "%" PRIu64 " points show a side that was not prepared, and are black; ",
                         figures.relit.backs);
        }
    }
    std::fprintf(stderr, "%.3f s a frame\n", seconds / options.frames);
}

}  // namespace

void render_frames(const Options& options) {
    const render::RayTracer tracer(options.view.isa);
    render::Scene scene = load_still_scene(options.view.scene);
    std::vector<std::filesystem::path> inputs = inputs_of(options, scene);
    if (!options.view.reference.empty()) inputs.push_back(options.view.reference);
    check_outputs(options, inputs);
    const PreparedScene prepared(options.cut_file, std::move(scene), tracer);
    const render::Camera camera = render::choose_camera(prepared.mesh.scene, options.view);
    const render::ThreadLimit limit(options.view.threads);
    tbb::task_arena arena(limit.count());
    arena.execute([&] { render_all(options, prepared, camera); });
}

}  // namespace relight
