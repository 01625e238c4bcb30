/// What clamping costs: time of lightcuts whose lights may be clamped, with and without a threshold, over that of the
/// same lights of a kind that is never clamped. One thread. Prints a table and writes clamping.json.

#include <cstdio>
#include <utility>

#include <CLI/CLI.hpp>
#include <lightcuts/light/clampable.hpp>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "timing.hpp"
#include "workload.hpp"

namespace {

using namespace benchmark;
using lightcuts::ClampingOptions;
using lightcuts::CutResult;
using Direct = lightcuts::OrientedPointLight<>;
using Virtual = lightcuts::VirtualPointLight<>;

/// The oriented lights of a workload.
std::vector<Direct> oriented_lights(const Workload& work) {
    std::vector<Direct> lights;
    work.visit([&](const auto& forest) {
        forest.for_each([&](std::uint32_t, const auto& tree) {
            if constexpr (std::same_as<typename std::remove_cvref_t<decltype(tree)>::light_type, Direct>) {
                lights.assign(tree.lights().begin(), tree.lights().end());
            }
        });
    });
    return lights;
}

struct Sums {
    double nodes = 0, queries = 0;
};

template <class Tree>
Sums shade_all(const Workload& work, const Tree& tree, const ClampingOptions& clamp) {
    static lightcuts::scratch_of<Tree> scratch;
    static std::vector<CutResult<glm::vec3>> results(group_size);
    const render::OpaqueOracle oracle = work.oracle();
    Sums sums;
    for_each_group(work.receivers(), [&](std::span<const Receiver> group) {
        const auto out = std::span(results).first(group.size());
        lightcuts::shade(tree, group, oracle, out, scratch, {.clamp = clamp});
        for (const auto& r : out) {
            sums.nodes += r.cut_size;
            sums.queries += r.queries;
        }
    });
    return sums;
}

}  // namespace

int main(int argc, char** argv) {
    int width = 160, height = 120, runs = 15;
    std::vector<std::string> scenes{"builtin:surfaces?lights=30000", "builtin:surfaces?lights=300000"};
    CLI::App app{"Cost of clamping inside lightcuts"};
    app.add_option("scenes", scenes, "whose oriented lights are taken for virtual ones");
    app.add_option("--width", width, "of the picture, pixels");
    app.add_option("--height", height, "of the picture, pixels");
    app.add_option("--runs", runs, "medians are over this odd number")->check(odd_number());
    CLI11_PARSE(app, argc, argv);

    struct Case {
        const char* name;
        ClampingOptions clamp;
    };
    const std::vector<Case> cases = {{"off", {}},
                                     {"radiance 0.01", {.radiance = 0.01f}},
                                     {"automatic", lightcuts::automatic_clamping},
                                     {"transfer 10", {.transfer = 10.0f}}};
    return write_figures("bench-clamping", "clamping.json", [&] {
        nlohmann::json rows = nlohmann::json::array();
        std::printf("%-36s %-16s %8s %8s %12s %10s\n", "scene", "clamping", "cut", "rays", "/ unmarked", "/ off");
        for (const std::string& scene : scenes) {
            const Workload work(scene, width, height);
            const std::vector<Direct> direct = oriented_lights(work);
            std::vector<Virtual> marked(direct.size());
            for (std::size_t i = 0; i < direct.size(); ++i) marked[i] = {direct[i]};
            const lightcuts::LightTree plain(direct);
            const lightcuts::LightTree tree(marked);

            std::vector<std::vector<double>> over_plain(cases.size()), over_off(cases.size());
            std::vector<Sums> sums(cases.size());
            for (int run = 0; run < runs; ++run) {
                // Each in each other's place and order: neighbors in time share caches and clock rates.
                const std::size_t turns = cases.size() + 1;
                std::vector<double> times(turns);
                for (std::size_t turn = 0; turn < turns; ++turn) {
                    const std::size_t forward = (turn + static_cast<std::size_t>(run / 2)) % turns;
                    const std::size_t i = run % 2 == 0 ? forward : turns - 1 - forward;
                    times[i] = seconds([&] {
                        if (i < cases.size()) {
                            sums[i] = shade_all(work, tree, cases[i].clamp);
                        } else {
                            shade_all(work, plain, {});
                        }
                    });
                }
                for (std::size_t i = 0; i < cases.size(); ++i) {
                    over_plain[i].push_back(times[i] / times.back());
                    over_off[i].push_back(times[i] / times.front());
                }
            }
            const auto count = static_cast<double>(work.receivers().size());
            for (std::size_t i = 0; i < cases.size(); ++i) {
                const double plain_ratio = median(over_plain[i]), off_ratio = median(over_off[i]);
                std::printf("%-36s %-16s %8.1f %8.1f %12.3f %10.3f\n", scene.c_str(), cases[i].name,
                            sums[i].nodes / count, sums[i].queries / count, plain_ratio, off_ratio);
                rows.push_back({{"scene", scene},
                                {"clamping", cases[i].name},
                                {"cut_size", sums[i].nodes / count},
                                {"shadow_rays", sums[i].queries / count},
                                {"over_unmarked", plain_ratio},
                                {"over_off", off_ratio}});
            }
            std::fflush(stdout);
        }
        return rows;
    });
}
