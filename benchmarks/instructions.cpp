/// Shades the points of a small picture by lightcuts, one thread, so that callgrind can count the instructions that
/// it takes: see instructions.sh, which prints them. Prints the number of shadow rays.

#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>
#include <lightcuts/product/gather.hpp>

#include "figures.hpp"
#include "workload.hpp"

namespace {

using namespace benchmark;
using GatherPoint = lightcuts::GatherPoint<render::SurfaceMaterial>;

}  // namespace

/// How the points are shaded.
enum class Way { groups, one_by_one, as_gather_points };

/// What callgrind counts: its name is the argument of --toggle-collect.
[[gnu::noinline]] std::uint64_t shade_receivers(const Workload& work, Way way) {
    static std::vector<lightcuts::CutResult<glm::vec3>> results(group_size);
    const render::OpaqueOracle oracle = work.oracle();
    std::uint64_t rays = 0;
    work.visit([&]<class Forest>(const Forest& forest) {
        static lightcuts::scratch_of<Forest> scratch;
        static lightcuts::gather_scratch_of<Forest> gather_scratch;
        static lightcuts::GatherForest<GatherPoint> points;
        const lightcuts::LightcutOptions cut{.clamp = work.clamp()};
        const auto shade = [&](std::span<const Receiver> group) {
            const auto out = std::span(results).first(group.size());
            lightcuts::shade(forest, group, oracle, out, scratch, cut);
            for (const auto& r : out) rays += r.queries;
        };
        if (way == Way::groups) {
            for_each_group(work.receivers(), shade);
            return;
        }
        for (const Receiver& r : work.receivers()) {
            if (way == Way::one_by_one) {
                shade({&r, 1});
            } else {
                const GatherPoint point{r, glm::vec3(1.0f)};
                points.build({&point, 1}, {});
                rays += lightcuts::gather(forest, points, oracle, gather_scratch, {.cut = cut}).queries;
            }
        }
    });
    return rays;
}

int main(int argc, char** argv) {
    std::string scene = "builtin:hall?area-points=64";
    int width = 48, height = 36;
    bool alone = false, gather = false;
    CLI::App app{"Shades a small picture for callgrind"};
    app.add_option("scene", scene, "a file or builtin:NAME, and ?KEY=VALUE&... for its lights");
    app.add_option("--width", width, "of the picture, pixels");
    app.add_option("--height", height, "of the picture, pixels");
    app.add_flag("--alone", alone, "points one by one, not in groups that advance side by side");
    app.add_flag(
        "--gather", gather,
        "each point as a sum over one gather point, by multidimensional lightcuts; not with clamping by radiance");
    CLI11_PARSE(app, argc, argv);
    const Way way = gather ? Way::as_gather_points : alone ? Way::one_by_one : Way::groups;
    try {
        const Workload work(scene, width, height);
        std::printf("%llu\n", static_cast<unsigned long long>(shade_receivers(work, way)));
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bench-instructions: %s\n", e.what());
        return 1;
    }
    return 0;
}
