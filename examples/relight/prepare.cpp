#include "prepare.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <lightcuts/piecewise/even_directions.hpp>
#include <render/fingerprint.hpp>
#include <render/io/output_file.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/rays/ray_tracer.hpp>
#include <render/stopwatch.hpp>

#include "mesh.hpp"
#include "patches.hpp"
#include "pilot.hpp"
#include "relight_file.hpp"

namespace relight {

namespace {

void say(const Mesh& mesh, const Options& options, const CutStatistics& cuts, std::size_t bytes, double tree_seconds,
         double seconds) {
    std::fprintf(
        stderr,
        "%zu triangles, %zu vertices to look from, %u directions\n"
        "visibility cuts: mean size %.1f, largest %zu; RMS of visibility %.4f over the directions asked for, %.4f over "
        "all; file %.2f MB\n"
        "tree %.1f s, cuts %.1f s, %.3g rays; time of the cuts / time of their rays alone: %.2f\n",
        mesh.scene.triangles.size(), cuts.sites, options.directions, cuts.mean_size(), cuts.largest, cuts.rms(),
        cuts.rms() * std::sqrt(static_cast<double>(cuts.rays) / (static_cast<double>(cuts.sites) * options.directions)),
        static_cast<double>(bytes) / 1e6, tree_seconds, seconds, static_cast<double>(cuts.rays),
        cuts.ray_seconds > 0.0 ? cuts.seconds / cuts.ray_seconds : 1.0);
}

void say(const Patches& patches, const CutStatistics& cuts, std::size_t bytes, double seconds) {
    std::fprintf(stderr,
                 "bounce: %zu patches, mean size of a cut %.1f, largest %zu; relative L2 error of solid angles %.4f; "
                 "%.2f MB of the file; %.1f s, %.3g rays\n",
                 patches.size(), cuts.mean_size(), cuts.largest, cuts.relative_error(),
                 static_cast<double>(bytes) / 1e6, seconds, static_cast<double>(cuts.rays));
}

}  // namespace

void prepare(const Options& options) {
    render::require_writable(options.view.output);
    const render::RayTracer tracer(options.view.isa);
    render::Scene scene = load_still_scene(options.view.scene);
    for (const auto& file : scene.files) render::require_apart(options.view.output, file);
    Preparation preparation;
    preparation.scene = scene.name;
    preparation.fingerprint = render::occlusion_hash(scene);
    preparation.longest_edge = options.longest_edge;
    preparation.sides = options.cuts.sides;
    const Mesh mesh = refined(std::move(scene), options.longest_edge);
    preparation.sites = mesh.sites.sites.size();
    const render::RayScene rays(mesh.scene, tracer);

    const int threads = options.view.threads > 0 ? options.view.threads : tbb::this_task_arena::max_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] {
        render::Stopwatch watch;
        const auto points = lightcuts::even_directions(options.directions, options.view.seed);
        const Directions directions = options.tree == TreeKind::geometric
                                          ? geometric_directions(points)
                                          : data_driven_directions(points, mesh.sites.sites, rays,
                                                                   {.beta = options.beta});
        const double tree_seconds = watch.lap();
        CutStatistics statistics;
        const auto cuts = visibility_cuts(directions, mesh.sites.sites, rays, options.cuts, statistics,
                                          !options.view.quiet);
        const double seconds = watch.lap();
        Patches patches;
        CutStatistics bounce_statistics;
        std::vector<std::byte> of_bounce;
        if (options.bounce_points > 0) {
            patches = spread_patches(mesh.scene, options.bounce_points, options.cuts.sides, options.view.seed);
            of_bounce = bounce_cuts(patches, mesh.scene, mesh.sites.sites, rays, options.bounce_deviation,
                                    options.cuts.sides, bounce_statistics, !options.view.quiet);
        }
        const double bounce_seconds = watch.lap();
        const StoredBounce bounce{patches, of_bounce};
        const std::vector<char> file = relight_file(preparation, directions, cuts, patches.empty() ? nullptr : &bounce);
        render::write_file(options.view.output, file);
        if (options.view.quiet) return;
        say(mesh, options, statistics, file.size(), tree_seconds, seconds);
        if (!patches.empty()) say(patches, bounce_statistics, of_bounce.size(), bounce_seconds);
    });
}

}  // namespace relight
