#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <lightcuts/core/invalid_input.hpp>

#include "adaptation.hpp"
#include "choose_camera.hpp"
#include "error.hpp"
#include "fingerprint.hpp"
#include "interrupt.hpp"
#include "io/escape.hpp"
#include "io/load_scene.hpp"
#include "io/outputs.hpp"
#include "io/picture.hpp"
#include "io/resume_file.hpp"
#include "io/standard_streams.hpp"
#include "io/validate.hpp"
#include "learn_visibility.hpp"
#include "lights/indirect.hpp"
#include "moving_view.hpp"
#include "options.hpp"
#include "pilot.hpp"
#include "prepare_scene.hpp"
#include "program.hpp"
#include "rays/ray_scene.hpp"
#include "rays/ray_tracer.hpp"
#include "read_reference.hpp"
#include "render_loop.hpp"
#include "run_program.hpp"
#include "shader.hpp"
#include "statistics.hpp"
#include "stopwatch.hpp"
#include "surfaces/surface.hpp"
#include "view.hpp"

namespace {

using namespace render;

/// The files that the picture is made of, and that with which it is compared.
std::vector<std::filesystem::path> inputs_of(const Options& options, const Scene& scene) {
    std::vector<std::filesystem::path> files = scene.files;
    for (const std::filesystem::path& file : {options.lights, options.env, options.reference}) {
        if (!file.empty()) files.push_back(file);
    }
    return files;
}

void warn(const std::string& message) {
    std::fprintf(stderr, "lightcuts-render: warning: %s\n", escaped(message).c_str());
}

/// Says what becomes of finished tiles that an earlier run may have left.
/// throws: invalid_input if the command line asks for them and they cannot be used.
void announce(const ResumeFile& file, const Options& options) {
    const std::string name = file.path().string();
    if (!file.obstacle().empty()) {
        if (options.resume) throw lightcuts::invalid_input(name + ": " + file.obstacle() + "; leave --resume out");
        warn(name + ": " + file.obstacle() + "; rendering goes on, but could not be resumed");
    } else if (options.resume != file.is_there() && !options.quiet) {
        const char* state = options.resume ? "there are no finished tiles; starting from the beginning"
                                           : "starting over; --resume would have gone on with these finished tiles";
        std::fprintf(stderr, "lightcuts-render: %s: %s\n", escaped(name).c_str(), state);
    }
}

void say_what_is_left_out(const Scene& scene, const Options& options) {
    if (options.quiet) return;
    for (const LeftOut& item : scene.left_out) {
        std::fprintf(stderr, "lightcuts-render: left out: %s\n", escaped(item.what + ": " + item.why).c_str());
    }
}

/// Of an error that is that of clamping rather than of the method.
void warn_of_clamped_reference(const Scene& scene, const Options& options) {
    if (options.quiet || options.reference.empty() || scene.virtual_count() == 0 || !options.is_clamp_idle()) return;
    std::fprintf(stderr,
                 "lightcuts-render: warning: --method %s does not clamp virtual lights; compare it with a --reference "
                 "of --clamp off\n",
                 options.method.c_str());
}

/// Writes what there is of the picture. throws: invalid_input, and then nothing that was rendered is lost.
ExitStatus save_rendering(const Outputs& outputs, ResumeFile& tiles, const Rendering& rendering, RunReport& report) {
    const bool quiet = report.options.quiet;
    tiles.flush();
    if (rendering.interrupted && rendering.tiles == 0) {
        std::fputs("lightcuts-render: interrupted before anything was finished; nothing was written\n", stderr);
        return stopped;
    }
    const Outputs chosen = rendering.interrupted ? outputs.of_unfinished() : outputs;
    report.picture = chosen.exr;
    const auto save_all = [&] { save(chosen, rendering.picture, report); };
    try {
        save_all();
    } catch (const lightcuts::invalid_input& e) {
        if (!tiles.is_of_use()) throw;
        const std::string hint = "; --resume will not render again what is in " + tiles.path().string();
        if (rendering.interrupted) throw lightcuts::invalid_input(e.what() + hint);
        // All that the tiles are for is here now, and they may take the room that it needs.
        try {
            tiles.lend_room(save_all);
        } catch (const lightcuts::invalid_input& again) { throw lightcuts::invalid_input(again.what() + hint); }
    }
    if (!rendering.interrupted) tiles.remove();
    if (!quiet) std::fputs(summary(report).c_str(), stderr);
    if (quiet && rendering.interrupted) std::fprintf(stderr, "lightcuts-render: %s\n", interruption(report).c_str());
    return rendering.interrupted ? stopped : done;
}

ExitStatus render_scene(Options options) {
    const Outputs outputs(options.output);
    outputs.require_all_writable();
    ResumeFile tiles(outputs.resume, warn);
    announce(tiles, options);
    const std::optional<Picture> reference = read_reference(options);

    const int threads = options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);

    Stopwatch watch;
    const RayTracer tracer(options.isa);
    Scene scene = prepare_scene(options);
    outputs.require_no_input(inputs_of(options, scene));
    const Camera camera = choose_camera(scene, options);
    say_what_is_left_out(scene, options);
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
        const MovingView view(camera, scene, options.width, options.height, lens_of(options, camera));
        const EyePathTracer surfaces(scene, rays, shade);
        report.adaptation = options.adaptation ? *options.adaptation : measure_adaptation(view, surfaces, *shader);
        shader->adapt(report.adaptation);
        if (options.learn_visibility) report.learning = learn_visibility(view, surfaces, *shader);
        if (shader->wants_pilot()) shader->try_out(pilot_blocks(view, surfaces));
        report.proofs = shader->proof_use();
        const Fingerprint fingerprint = fingerprint_of(options, scene, camera, rays, program_build());
        defer_signals();
        if (options.resume && tiles.is_there()) {
            tiles.go_on(fingerprint);
        } else {
            tiles.begin(fingerprint);
        }
        rendering = render_picture(view, surfaces, *shader, options, &tiles);
        report.seconds.render = watch.lap();
    });

    report.statistics = rendering.statistics;
    report.interrupted = rendering.interrupted;
    report.resumed_tiles = rendering.resumed_tiles;
    if (reference && !rendering.interrupted) report.error = compare(rendering.picture, *reference);
    return save_rendering(outputs, tiles, rendering, report);
}

ExitStatus run(const Options& options) {
    switch (options.action) {
        case Options::Action::help: print(options.help); return done;
        case Options::Action::version: print("lightcuts-render " + program_version() + "\n"); return done;
        case Options::Action::list_scenes: {
            std::string names;
            for (const std::string& name : builtin_names()) names += "builtin:" + name + "\n";
            print(names);
            return done;
        }
        case Options::Action::render: break;
    }
    return render_scene(options);
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("lightcuts-render", [&] { return run(parse_options(argc, argv)); });
}
