/// The tables of the papers, on scenes that resemble theirs: what lightcuts consist of, how they scale, how tight their
/// bounds are [Walter et al. 2005], and how much faster they are than the exhaustive sum at coarser thresholds and with
/// several representatives [Mikšík 2007]. One thread. Prints tables and writes paper_tables.json.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bound_tightness.hpp"
#include "crossing.hpp"
#include "cut_parts.hpp"
#include "figures.hpp"
#include "method_contest.hpp"
#include "timing.hpp"

namespace {

using namespace benchmark;
using nlohmann::json;

struct Settings {
    std::string only;
    int width = 120, height = 90, runs = 3;
    std::size_t points = 512, terms = 50'000'000;
    std::vector<std::string> cuts{"builtin:hall",
                                  "builtin:hall?indirect=50000",
                                  "builtin:hall?sun-sky=35,120&ground=0&indirect=50000",
                                  "builtin:tableau",
                                  "builtin:tableau?indirect=10000",
                                  "builtin:colonnade?indirect=0",
                                  "builtin:colonnade?indirect=500000&clamp=auto",
                                  "builtin:screens?indirect=25000"};
    std::vector<std::size_t> hall_points{1, 2, 4, 8, 16, 64, 256, 1024, 4096};
    std::vector<std::size_t> map_lights{100, 200, 300, 1000, 3000, 10'000, 30'000, 100'000};
    std::vector<std::string> bounds{"builtin:hall", "builtin:hall?indirect=50000", "builtin:tableau",
                                    "builtin:tableau?indirect=10000", "builtin:colonnade?indirect=0"};
    std::vector<std::string> speed_up{"builtin:hall?area-points=139", "builtin:surfaces?lights=10000&rotated=0",
                                      "builtin:hall?area-points=28&indirect=10000"};
    std::vector<std::string> thresholds{"builtin:surfaces?lights=10000&rotated=0", "builtin:hall?area-points=139"};
    std::vector<float> error_ratios{0.9f, 0.7f, 0.5f, 0.2f, 0.1f, 0.05f, 0.02f};
    std::vector<std::uint32_t> representatives{1, 8, 16, 32};

    Workload workload(const std::string& scene) const { return {scene, width, height}; }
    /// So few points that to sum up all lights at each does not take long.
    std::size_t points_for(std::size_t lights) const {
        return std::min(points, std::max<std::size_t>(terms / std::max<std::size_t>(1, lights), 64));
    }
};

void by_lightcuts(render::Options& options) { options.method = "lightcuts"; }

void by_ward(render::Options& options) { options.method = "ward"; }

json to_json(const Parts& p) {
    return {{"direct", p.direct}, {"environment", p.environment}, {"indirect", p.indirect}, {"total", p.sum()}};
}

/// [Lightcuts, Fig. 6, 7, 9, 13]
json measure_cuts(const Settings& set) {
    std::printf("%-44s | %7s %6s %7s %7s | %6s %6s %6s %7s %6s | %7s %9s %9s | %8s %8s | %8s %8s\n", "lightcuts",
                "direct", "env.", "indir.", "lights", "direct", "env.", "indir.", "cut", "limit", "rays", "naive",
                "Ward", "naive", "Ward", "error", "Ward");
    json rows = json::array();
    for (const std::string& scene : set.cuts) {
        const Workload work = set.workload(scene);
        const CutParts parts = measure_cut_parts(work, {.seed = work.options().seed, .clamp = work.clamp()});
        MethodContest contest(work, set.points_for(work.light_count()));
        const std::size_t cut = contest.add(by_lightcuts), ward = contest.add(by_ward);
        contest.run(set.runs);
        const double ward_time = time_ratio(contest.cost(ward), contest.cost(cut));
        std::printf(
            "%-44s | %7.0f %6.0f %7.0f %7.0f | %6.1f %6.1f %6.1f %7.1f %4.0f %% | %7.1f %9.1f %9.1f | %8.2f "
            "%8.2f | %6.2f %% %6.2f %%\n",
            scene.c_str(), parts.lights.direct, parts.lights.environment, parts.lights.indirect, parts.lights.sum(),
            parts.cut.direct, parts.cut.environment, parts.cut.indirect, parts.cut.sum(), 100.0 * parts.at_limit,
            parts.rays, contest.cost(0).shadow_rays, contest.cost(ward).shadow_rays, contest.speed_up(cut), ward_time,
            100.0 * contest.error(cut), 100.0 * contest.error(ward));
        std::fflush(stdout);
        rows.push_back({{"scene", scene},
                        {"points", work.receivers().size()},
                        {"lights", to_json(parts.lights)},
                        {"cut_size", to_json(parts.cut)},
                        {"at_limit", parts.at_limit},
                        {"rays", parts.rays},
                        {"summed_points", contest.points()},
                        {"naive_rays", contest.cost(0).shadow_rays},
                        {"ward_rays", contest.cost(ward).shadow_rays},
                        {"naive_over_lightcuts", contest.speed_up(cut)},
                        {"ward_over_lightcuts", ward_time},
                        {"relative_rmse", contest.error(cut)},
                        {"ward_relative_rmse", contest.error(ward)}});
    }
    return rows;
}

json measure_scaling_of(const Settings& set, const std::string& scene, const std::vector<std::size_t>& counts) {
    std::printf("\n%-44s | %7s %9s %9s | %8s %9s %9s | %8s %8s\n", "scaling", "rays", "naive", "Ward", "us", "naive",
                "Ward", "naive /", "Ward /");
    json rows = json::array();
    std::vector<double> lights, naive_ratios, ward_ratios;
    // The same points for all, since these differ in what they cost.
    const std::size_t points = set.points_for(set.workload(scene + std::to_string(counts.back())).light_count());
    for (const std::size_t count : counts) {
        const std::string name = scene + std::to_string(count);
        const Workload work = set.workload(name);
        MethodContest contest(work, points);
        const std::size_t cut = contest.add(by_lightcuts), ward = contest.add(by_ward);
        contest.run(set.runs);
        const ShadingCost &ours = contest.cost(cut), &naive = contest.cost(0), &wards = contest.cost(ward);
        lights.push_back(static_cast<double>(work.light_count()));
        naive_ratios.push_back(contest.speed_up(cut));
        ward_ratios.push_back(time_ratio(wards, ours));
        std::printf("%-34s %9zu | %7.1f %9.1f %9.1f | %8.2f %9.1f %9.1f | %8.2f %8.2f\n", name.c_str(),
                    work.light_count(), ours.shadow_rays, naive.shadow_rays, wards.shadow_rays, ours.microseconds,
                    naive.microseconds, wards.microseconds, naive_ratios.back(), ward_ratios.back());
        std::fflush(stdout);
        rows.push_back({{"lights", work.light_count()},
                        {"cut_size", ours.cut_size},
                        {"rays", ours.shadow_rays},
                        {"naive_rays", naive.shadow_rays},
                        {"ward_rays", wards.shadow_rays},
                        {"microseconds", ours.microseconds},
                        {"naive_microseconds", naive.microseconds},
                        {"ward_microseconds", wards.microseconds},
                        {"naive_over_lightcuts", naive_ratios.back()},
                        {"ward_over_lightcuts", ward_ratios.back()}});
    }
    const double naive = crossing(lights, naive_ratios), ward = crossing(lights, ward_ratios);
    const auto from = [](double crossed, const std::vector<double>& ratios) {
        if (ratios.front() > 1.0) return std::string("the fewest");
        return crossed > 0.0 ? std::to_string(std::lround(crossed)) : std::string("none");
    };
    std::printf("lightcuts are faster from so many lights on: %s than naive, %s than Ward\n",
                from(naive, naive_ratios).c_str(), from(ward, ward_ratios).c_str());
    return {{"scene", scene},
            {"points", points},
            {"rows", rows},
            {"lights_at_crossing", {{"naive", naive}, {"ward", ward}}}};
}

/// [Lightcuts, Fig. 8]
json measure_scaling(const Settings& set) {
    json scenes = json::array();
    scenes.push_back(measure_scaling_of(set, "builtin:hall?area-points=", set.hall_points));
    scenes.push_back(measure_scaling_of(set, "builtin:tableau?env-lights=", set.map_lights));
    return scenes;
}

/// [Lightcuts, Fig. 11]
json measure_bounds(const Settings& set) {
    std::printf("\n%-44s | %8s | %7s %8s %8s | %8s\n", "bounds: cut size", "lights", "ours", "separate", "exact",
                "/ exact");
    json rows = json::array();
    for (const std::string& scene : set.bounds) {
        const BoundTightness r = measure_tightness(scene, set.width / 3, set.height / 3, 1000);
        std::printf("%-44s | %8zu | %7.1f %8.1f %8.1f | %8.3f\n", scene.c_str(), r.lights, r.usual, r.separate, r.exact,
                    r.usual / r.exact);
        std::fflush(stdout);
        rows.push_back({{"scene", scene},
                        {"lights", r.lights},
                        {"cut_size", r.usual},
                        {"cut_size_separate", r.separate},
                        {"cut_size_exact", r.exact},
                        {"over_exact", r.usual / r.exact}});
    }
    return rows;
}

/// Processor seconds of building the trees of a scene.
double tree_seconds(const Workload& work, const std::string& builder, int runs) {
    render::Options options = work.options();
    options.builder = builder;
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
        times.push_back(seconds([&] { const render::SceneLights trees(work.scene(), options); }));
    }
    return median(times);
}

/// [Mikšík, table 1]
json measure_speed_up(const Settings& set) {
    constexpr std::uint32_t many = 16;  // his limit
    std::printf("\n%-44s | %8s | %8s %8s | %7s | %8s %8s | %8s %8s\n", "speed-up", "lights", "binned s", "greedy s",
                "cut", "1 repr.", "16 repr.", "error", "16 repr.");
    json rows = json::array();
    for (const std::string& scene : set.speed_up) {
        const Workload work = set.workload(scene);
        MethodContest contest(work, set.points_for(work.light_count()));
        const std::size_t one = contest.add(by_lightcuts);
        const std::size_t several = contest.add([](render::Options& options) { options.representatives = many; });
        contest.run(set.runs);
        const double binned = tree_seconds(work, "binned", set.runs);
        const double greedy = tree_seconds(work, "agglomerate", set.runs);
        std::printf("%-44s | %8zu | %8.4f %8.4f | %7.1f | %8.2f %8.2f | %6.2f %% %6.2f %%\n", scene.c_str(),
                    work.light_count(), binned, greedy, contest.cost(one).cut_size, contest.speed_up(one),
                    contest.speed_up(several), 100.0 * contest.error(one), 100.0 * contest.error(several));
        std::fflush(stdout);
        rows.push_back({{"scene", scene},
                        {"lights", work.light_count()},
                        {"binned_seconds", binned},
                        {"agglomerate_seconds", greedy},
                        {"cut_size", contest.cost(one).cut_size},
                        {"speed_up", contest.speed_up(one)},
                        {"speed_up_16_representatives", contest.speed_up(several)},
                        {"relative_rmse", contest.error(one)},
                        {"relative_rmse_16_representatives", contest.error(several)}});
    }
    return rows;
}

json measure_thresholds_in(const Settings& set, const std::string& scene) {
    const Workload work = set.workload(scene);
    MethodContest contest(work, set.points_for(work.light_count()));
    for (const float error_ratio : set.error_ratios) {
        for (const std::uint32_t representatives : set.representatives) {
            contest.add([&](render::Options& options) {
                options.error_ratio = error_ratio;
                options.representatives = representatives;
            });
        }
    }
    contest.run(set.runs);
    std::printf("\n%-44s |", scene.c_str());
    for (const std::uint32_t n : set.representatives) std::printf(" %16u repr. |", n);
    std::printf("\n%-44s |", "error threshold");
    for (std::size_t i = 0; i < set.representatives.size(); ++i)
        std::printf(" %6s %7s %7s |", "cut", "speedup", "error");
    json rows = json::array();
    std::size_t method = 1;
    for (const float error_ratio : set.error_ratios) {
        std::printf("\n%-42.0f %% |", 100.0 * static_cast<double>(error_ratio));
        for (const std::uint32_t representatives : set.representatives) {
            const double cut = contest.cost(method).cut_size;
            std::printf(" %6.1f %6.1fx %5.1f %% |", cut, contest.speed_up(method), 100.0 * contest.error(method));
            rows.push_back({{"error_ratio", error_ratio},
                            {"representatives", representatives},
                            {"cut_size", cut},
                            {"speed_up", contest.speed_up(method)},
                            {"relative_rmse", contest.error(method)}});
            ++method;
        }
    }
    std::printf("\n");
    return {{"scene", scene}, {"lights", work.light_count()}, {"rows", rows}};
}

/// [Mikšík, appendix C]
json measure_thresholds(const Settings& set) {
    json scenes = json::array();
    for (const std::string& scene : set.thresholds) scenes.push_back(measure_thresholds_in(set, scene));
    return scenes;
}

}  // namespace

int main(int argc, char** argv) {
    constexpr std::pair<const char*, json (*)(const Settings&)> tables[] = {{"cuts", measure_cuts},
                                                                            {"scaling", measure_scaling},
                                                                            {"bounds", measure_bounds},
                                                                            {"speed-up", measure_speed_up},
                                                                            {"thresholds", measure_thresholds}};
    std::vector<std::string> names;
    for (const auto& [name, measure] : tables) names.push_back(name);
    Settings set;
    CLI::App app{"The tables of the papers, on scenes that resemble theirs"};
    app.add_option("--only", set.only, "measure only this table")->check(CLI::IsMember(names));
    app.add_option("--width", set.width, "of the pictures, pixels; `bounds` uses a third")->check(CLI::Range(3, 10000));
    app.add_option("--height", set.height, "of the pictures, pixels; `bounds` uses a third")
        ->check(CLI::Range(3, 10000));
    app.add_option("--runs", set.runs, "medians are over this odd number")->check(odd_number());
    app.add_option("--points", set.points, "at most so many where methods are compared")->check(CLI::PositiveNumber);
    app.add_option("--terms", set.terms, "fewer points if these times the lights would be more, but 64");
    app.add_option("--cuts", set.cuts, "scenes of the table `cuts`");
    app.add_option("--hall-points", set.hall_points, "lights a panel, in `scaling`")->delimiter(',');
    app.add_option("--map-lights", set.map_lights, "that stand for the map, in `scaling`")->delimiter(',');
    app.add_option("--bounds", set.bounds, "scenes of the table `bounds`");
    app.add_option("--speed-up", set.speed_up, "scenes of the table `speed-up`");
    app.add_option("--thresholds", set.thresholds, "scenes of the table `thresholds`");
    app.add_option("--error-ratios", set.error_ratios, "of the table `thresholds`")->delimiter(',');
    app.add_option("--representatives", set.representatives, "of the table `thresholds`")->delimiter(',');
    CLI11_PARSE(app, argc, argv);
    return write_figures("bench-paper_tables", "paper_tables.json", [&] {
        const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
        json result;
        for (const auto& [name, measure] : tables) {
            if (set.only.empty() || set.only == name) result[name] = measure(set);
        }
        return result;
    });
}
