#include "../window.hpp"

#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <render/choose_camera.hpp>
#include <render/interrupt.hpp>
#include <render/io/output_file.hpp>
#include <render/rays/ray_tracer.hpp>
#include <render/thread_limit.hpp>
#include <render/view.hpp>

#include "../mesh.hpp"
#include "../prepared_scene.hpp"
#include "../saved_picture.hpp"
#include "viewer.hpp"

namespace relight {

namespace {

/// From the eye to what a camera is led around: its target, if the user gave one, else what it sees in the middle.
double middle_distance(const PreparedScene& prepared, const render::Camera& camera, const Options& options) {
    const double to_target = glm::length(camera.target - camera.eye);
    if (options.view.target) return to_target;
    const render::EyeRay ray = render::View(camera, prepared.mesh.scene.origin, 1, 1).ray(0.5f, 0.5f);
    const auto hit = prepared.rays.nearest(ray.origin, ray.direction);
    return hit ? static_cast<double>(hit->distance) : to_target;
}

void check_outputs(const Options& options, const std::vector<std::filesystem::path>& inputs) {
    const SavedPaths paths = free_paths(options.view.output);
    render::require_writable(paths.exr);
    render::require_writable(paths.png);
    if (options.screenshot.empty()) return;
    render::require_writable(options.screenshot);
    for (const auto& input : inputs) render::require_apart(options.screenshot, input);
}

}  // namespace

render::ExitStatus show_window(const Options& options) {
    const Glfw glfw;  // without a display there is no need to read anything
    const render::RayTracer tracer(options.view.isa);
    render::Scene scene = load_still_scene(options.view.scene);
    check_outputs(options, inputs_of(options, scene));
    const PreparedScene prepared(options.cut_file, std::move(scene), tracer);
    const render::Camera camera = render::choose_camera(prepared.mesh.scene, options.view);
    const render::ThreadLimit limit(options.view.threads);
    FrameSource source(options, prepared, read_environment(options));
    const ViewState state({camera, options.rotation, options.materials, options.view.width, options.view.height},
                          middle_distance(prepared, camera, options));
    Viewer viewer(options, state, source, limit.count(), prepared.mesh.scene.name);
    render::defer_signals();
    const render::ExitStatus status = viewer.run();
    if (status == render::stopped) std::fputs("lightcuts-relight: interrupted; the window is closed\n", stderr);
    return status;
}

}  // namespace relight
