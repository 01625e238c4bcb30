/// Shades the points of a small picture by lightcuts, one thread, so that callgrind can count the instructions that
/// it takes: see instructions.sh, which prints them. Prints the number of shadow rays.

#include <cstdio>

#include <CLI/CLI.hpp>

#include "figures.hpp"
#include "workload.hpp"

namespace {

using namespace benchmark;

}  // namespace

/// What callgrind counts: its name is the argument of --toggle-collect.
[[gnu::noinline]] std::uint64_t shade_receivers(const Workload& work) {
    static std::vector<lightcuts::CutResult<glm::vec3>> results(group_size);
    const render::OpaqueOracle oracle = work.oracle();
    std::uint64_t rays = 0;
    work.visit([&]<class Forest>(const Forest& forest) {
        static lightcuts::scratch_of<Forest> scratch;
        for_each_group(work.receivers(), [&](std::span<const Receiver> group) {
            const auto out = std::span(results).first(group.size());
            lightcuts::shade(forest, group, oracle, out, scratch, {.clamp = work.clamp()});
            for (const auto& r : out) rays += r.queries;
        });
    });
    return rays;
}

int main(int argc, char** argv) {
    std::string scene = "builtin:hall?area-points=64";
    int width = 48, height = 36;
    CLI::App app{"Shades a small picture for callgrind"};
    app.add_option("scene", scene, "a file or builtin:NAME, and ?KEY=VALUE&... for its lights");
    app.add_option("--width", width, "of the picture, pixels");
    app.add_option("--height", height, "of the picture, pixels");
    CLI11_PARSE(app, argc, argv);
    const Workload work(scene, width, height);
    std::printf("%llu\n", static_cast<unsigned long long>(shade_receivers(work)));
    return 0;
}
