#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <string>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <glm/geometric.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <nlohmann/json.hpp>

#include "adaptation.hpp"
#include "error.hpp"
#include "indirect.hpp"
#include "interrupt.hpp"
#include "load_scene.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "picture.hpp"
#include "prepare_scene.hpp"
#include "ray_scene.hpp"
#include "ray_tracer.hpp"
#include "render_loop.hpp"
#include "shader.hpp"
#include "statistics.hpp"
#include "surface.hpp"
#include "validate.hpp"
#include "view.hpp"

#ifndef LIGHTCUTS_VERSION
#define LIGHTCUTS_VERSION "unknown"
#endif

namespace {

using namespace render;

enum ExitStatus { done = 0, bad_input = 1, bad_command_line = 2, stopped = 3 };

constexpr float default_fov = 45.0f;

class Stopwatch {
public:
    /// Seconds since the last call, or since construction.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The three files that a run leaves.
struct Outputs {
    std::filesystem::path exr;
    std::filesystem::path png;
    std::filesystem::path json;

    explicit Outputs(const std::filesystem::path& exr_path) : exr(exr_path), png(exr_path), json(exr_path) {
        png.replace_extension(".png");
        json.replace_extension(".json");
    }
    void require_all_writable() const {
        for (const auto& path : {exr, png, json}) require_writable(path);
    }
};

std::optional<Picture> read_reference(const Options& options) {
    if (options.reference.empty()) return std::nullopt;
    Picture reference = read_exr(options.reference);
    if (reference.width != options.width || reference.height != options.height) {
        throw lightcuts::invalid_input(options.reference.string() + ": is " + std::to_string(reference.width) + "x" +
                                       std::to_string(reference.height) + " pixels; give --size " +
                                       std::to_string(reference.width) + "x" + std::to_string(reference.height) +
                                       " or another reference");
    }
    return reference;
}

Camera scene_camera(const Scene& scene, const std::string& name) {
    if (scene.cameras.empty()) {
        throw lightcuts::invalid_input(scene.name + ": the scene has no camera; give --eye and --target");
    }
    if (name.empty()) return scene.cameras.front();
    std::string names;
    for (const Camera& camera : scene.cameras) {
        if (camera.name == name) return camera;
        names += (names.empty() ? "" : ", ") + camera.name;
    }
    throw lightcuts::invalid_input(scene.name + ": no camera '" + name + "'; there is " + names);
}

Camera choose_camera(const Scene& scene, const Options& options) {
    Camera camera;
    if (options.eye) {
        camera.eye = *options.eye;
        camera.target = *options.target;
        camera.up = options.up.value_or(default_up(camera.eye, camera.target));
        camera.vertical_fov = default_fov;
    } else {
        camera = scene_camera(scene, options.camera);
    }
    if (options.fov) camera.vertical_fov = *options.fov;
    require_usable(camera, options.eye ? "--eye, --target" : scene.name + ": camera '" + camera.name + "'");
    return camera;
}

void save(const Outputs& outputs, const Picture& picture, const RunReport& report) {
    OutputFile exr(outputs.exr);
    OutputFile png(outputs.png);
    OutputFile json(outputs.json);
    write_exr(exr.path(), picture);
    write_png(png.path(), picture.width, picture.height, tone_mapped(picture));
    std::ofstream text(json.path());
    text << to_json(report).dump(2) << "\n";
    text.close();
    if (!text) throw lightcuts::invalid_input(outputs.json.string() + ": cannot be written; is the disk full?");
    exr.commit();
    png.commit();
    json.commit();
}

/// Of an error that is that of clamping rather than of the method.
void warn_of_clamped_reference(const Scene& scene, const Options& options) {
    if (options.quiet || options.reference.empty() || scene.virtual_lights.empty() || !options.is_clamp_idle()) return;
    std::fprintf(stderr,
                 "lightcuts-render: warning: --method %s does not clamp virtual lights; compare it with a --reference "
                 "of --clamp off\n",
                 options.method.c_str());
}

ExitStatus render_scene(Options options) {
    const Outputs outputs(options.output);
    outputs.require_all_writable();
    const std::optional<Picture> reference = read_reference(options);

    const int threads = options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    watch_interrupt();

    Stopwatch watch;
    const RayTracer tracer(options.isa);
    Scene scene = prepare_scene(options);
    const Camera camera = choose_camera(scene, options);
    const RayScene rays(scene, tracer);
    RunReport report(options, scene, tracer, threads);
    report.seconds.load = watch.lap();

    Rendering rendering;
    arena.execute([&] {
        const Shade shade = shade_of(options);
        add_virtual_lights(scene, rays, options.indirect, shade, options.seed);
        warn_of_clamped_reference(scene, options);
        report.seconds.particles = watch.lap();
        const auto shader = make_shader(scene, rays, options);
        report.seconds.tree = watch.lap();
        const View view(camera, options.width, options.height);
        const SurfaceFinder surfaces(scene, rays, shade);
        report.adaptation = options.adaptation ? *options.adaptation : measure_adaptation(view, surfaces, *shader);
        shader->adapt(report.adaptation);
        rendering = render_picture(view, surfaces, *shader, options);
        report.seconds.render = watch.lap();
    });

    report.statistics = rendering.statistics;
    report.interrupted = rendering.interrupted;
    if (reference && !rendering.interrupted) report.error = compare(rendering.picture, *reference);
    save(outputs, rendering.picture, report);
    if (!options.quiet) std::fputs(summary(report).c_str(), stderr);
    return rendering.interrupted ? stopped : done;
}

ExitStatus run(const Options& options) {
    switch (options.action) {
        case Options::Action::help: std::fputs(options.help.c_str(), stdout); return done;
        case Options::Action::version: std::puts("lightcuts-render " LIGHTCUTS_VERSION); return done;
        case Options::Action::list_scenes:
            for (const std::string& name : builtin_names()) std::printf("builtin:%s\n", name.c_str());
            return done;
        case Options::Action::render: break;
    }
    return render_scene(options);
}

ExitStatus fail(ExitStatus status, const std::string& message) {
    std::fprintf(stderr, "lightcuts-render: %s\n", one_line(message).c_str());
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(parse_options(argc, argv));
    } catch (const usage_error& e) {
        return fail(bad_command_line, std::string(e.what()) + " (--help lists the options)");
    } catch (const std::bad_alloc&) {
        return fail(bad_input, "not enough memory; give a smaller --size or scene");
    } catch (const std::exception& e) { return fail(bad_input, e.what()); }
}
