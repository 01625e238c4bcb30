/// What sources of light cost: generating virtual lights over tracing their paths' rays alone, shading under an
/// environment map by its number of lights, lightcuts over the exhaustive sum where lights are few, and a scene with
/// very many lights over the hall. Prints a table and writes sources.json.

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "particle_cost.hpp"
#include "prepare_scene.hpp"
#include "prepared_scene.hpp"
#include "scene_options.hpp"
#include "shading_cost.hpp"
#include "source_scenes.hpp"

namespace {

using namespace benchmark;

struct Settings {
    std::string only;
    int width = 96, height = 72, runs = 5, threads = 2;
    std::uint32_t area_points = 64;
    std::size_t virtual_lights = 1000000, error_points = 48;
    std::vector<std::size_t> environment_lights{3000, 10000, 30000, 100000};
    std::vector<std::size_t> lamp_lights{1, 16, 64};
    std::string usual = "builtin:hall";
    std::vector<std::string> environments{"builtin:directional", "builtin:tableau?materials=diffuse",
                                          "builtin:tableau"};
    std::vector<std::string> few{"builtin:omni?lights=64", "builtin:omni?lights=128", "builtin:omni?lights=256"};
    std::vector<std::string> many{"builtin:screens"};
};

/// Every part's figures on one sheet.
class Table {
public:
    Table() {
        std::printf("%-12s %-32s %-16s %8s %8s %7s %7s %9s %7s %8s\n", "part", "scene", "what", "lights", "points",
                    "cut", "rays", "us", "ratio", "error");
    }

    /// `error`: below 0 if it is not known.
    void add(const std::string& part, const std::string& scene, const std::string& what, const ShadingCost& cost,
             double ratio, double error = -1.0) {
        const bool known = error >= 0.0;
        char percent[16] = "";
        if (known) std::snprintf(percent, sizeof percent, "%.2f %%", 100.0 * error);
        std::printf("%-12s %-32s %-16s %8zu %8zu %7.1f %7.1f %9.3f %7.3f %8s\n", part.c_str(), scene.c_str(),
                    what.c_str(), cost.lights, cost.points, cost.cut_size, cost.shadow_rays, cost.microseconds, ratio,
                    percent);
        std::fflush(stdout);
        rows_.push_back({{"part", part},
                         {"scene", scene},
                         {"what", what},
                         {"lights", cost.lights},
                         {"points", cost.points},
                         {"cut_size", cost.cut_size},
                         {"rays", cost.shadow_rays},
                         {"microseconds", cost.microseconds},
                         {"ratio", ratio},
                         {"relative_rmse", known ? nlohmann::json(error) : nlohmann::json()}});
    }

    const nlohmann::json& rows() const { return rows_; }

private:
    nlohmann::json rows_ = nlohmann::json::array();
};

void particles(const Settings& set, Table& table) {
    const ParticleCost made = measure_particles({.scene = set.usual,
                                                 .lights = set.virtual_lights,
                                                 .area_points = set.area_points,
                                                 .threads = set.threads,
                                                 .runs = set.runs});
    const auto count = static_cast<double>(made.particles);
    ShadingCost cost;
    cost.lights = made.virtual_lights;
    cost.points = made.particles;
    cost.shadow_rays = static_cast<double>(made.rays) / count;
    cost.microseconds = 1e6 * made.ray_seconds / count;
    table.add("particles", set.usual, "rays alone", cost, 1.0);
    cost.microseconds = 1e6 * made.seconds / count;
    table.add("particles", set.usual, "virtual lights", cost, made.ratio);
    cost.microseconds = 1e6 * made.wall_seconds / count;
    table.add("particles", set.usual, "... on the wall", cost, made.wall_ratio);
}

void under_map(const std::string& name, const Settings& set, Table& table) {
    render::Options options = scene_options(name, set.area_points);
    render::Scene scene = prepared_scene(name, options);
    if (options.indirect > 0) {
        throw lightcuts::invalid_input(name + ": virtual lights do not stand for a map; say indirect=0");
    }
    surround(scene);
    const ShadedPoints where(scene, set.width, set.height, render::shade_of(options));
    const std::vector<render::SurfacePoint> some = where.about(set.error_points);
    std::vector<TimedMethod> methods;
    std::vector<double> errors;
    for (const std::size_t lights : set.environment_lights) {
        light_by_map(scene, lights);
        methods.emplace_back(scene, where.rays(), where.points(), by("lightcuts", options));
        TimedMethod cut(scene, where.rays(), some, by("lightcuts", options));
        TimedMethod truth(scene, where.rays(), some, by("exhaustive", options));
        cut.run();
        truth.run();
        errors.push_back(relative_rmse(cut.shadings(), truth.shadings()));
    }
    run_by_turns(methods, set.runs);
    for (std::size_t i = 0; i < methods.size(); ++i) {
        table.add("environment", name, "lightcuts", methods[i].cost(), time_ratio(methods[i].cost(), methods[0].cost()),
                  errors[i]);
    }
}

void environment(const Settings& set, Table& table) {
    for (const std::string& name : set.environments) under_map(name, set, table);
}

void exhaustive_below(const Settings& set, Table& table) {
    const auto compare = [&](const std::string& name, render::Scene scene, const render::Options& options) {
        const ShadedPoints where(std::move(scene), set.width, set.height, render::shade_of(options));
        std::vector<TimedMethod> methods;
        for (const char* method : {"exhaustive", "lightcuts"}) {
            methods.emplace_back(where.scene(), where.rays(), where.points(), by(method, options));
        }
        run_by_turns(methods, set.runs);
        const ShadingCost& truth = methods[0].cost();
        table.add("few", name, "exhaustive", truth, 1.0);
        table.add("few", name, "lightcuts", methods[1].cost(), time_ratio(methods[1].cost(), truth),
                  relative_rmse(methods[1].shadings(), methods[0].shadings()));
    };
    for (const std::size_t lights : set.lamp_lights) compare("room with one lamp", room_with_lamp(lights), {});
    for (const std::string& name : set.few) {
        render::Options options = scene_options(name, set.area_points);
        render::Scene scene = lit_scene(name, options);
        compare(name, std::move(scene), options);
    }
}

void many_lights(const Settings& set, Table& table) {
    const auto seen = [&](const std::string& name, render::Options& options) {
        options = scene_options(name, set.area_points);
        render::Scene scene = lit_scene(name, options);
        return ShadedPoints(std::move(scene), set.width, set.height, render::shade_of(options));
    };
    render::Options usual_options, options;
    const ShadedPoints usual = seen(set.usual, usual_options);
    for (const std::string& name : set.many) {
        const ShadedPoints where = seen(name, options);
        const std::vector<render::SurfacePoint> clear = where.with_clear_view();
        std::vector<TimedMethod> methods;
        methods.emplace_back(usual.scene(), usual.rays(), usual.points(), by("lightcuts", usual_options));
        methods.emplace_back(where.scene(), where.rays(), where.points(), by("lightcuts", options));
        if (!clear.empty()) methods.emplace_back(where.scene(), where.rays(), clear, by("lightcuts", options));
        run_by_turns(methods, set.runs);
        for (std::size_t i = 0; i < methods.size(); ++i) {
            table.add("many", i == 0 ? set.usual : name, i < 2 ? "all points" : "with clear view", methods[i].cost(),
                      time_ratio(methods[i].cost(), methods[0].cost()));
        }
    }
}

constexpr std::pair<const char*, void (*)(const Settings&, Table&)> parts[] = {
    {"particles", particles}, {"environment", environment}, {"few", exhaustive_below}, {"many", many_lights}};

nlohmann::json measure_all(const Settings& set) {
    Table table;
    for (const auto& [name, measure] : parts) {
        if (set.only.empty() || set.only == name) measure(set, table);
    }
    return table.rows();
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> names;
    for (const auto& [name, measure] : parts) names.push_back(name);
    Settings set;
    CLI::App app{"Cost of virtual lights, environment maps, few lights and very many"};
    app.add_option("--only", set.only, "measure only this part")->check(CLI::IsMember(names));
    app.add_option("--width", set.width, "of the pictures, pixels")->check(CLI::PositiveNumber);
    app.add_option("--height", set.height, "of the pictures, pixels")->check(CLI::PositiveNumber);
    app.add_option("--runs", set.runs, "medians are over this odd number")->check(odd_number());
    app.add_option("--threads", set.threads, "that generate virtual lights")->check(CLI::PositiveNumber);
    app.add_option("--area-points", set.area_points, "lights per emissive surface");
    app.add_option("--virtual-lights", set.virtual_lights, "to be generated")->check(CLI::PositiveNumber);
    app.add_option("--usual", set.usual, "where virtual lights are generated, and what `many` is compared with");
    app.add_option("--environment", set.environments, "scenes under their own map, else under a sky");
    app.add_option("--environment-lights", set.environment_lights, "that stand for the map")->delimiter(',');
    app.add_option("--error-points", set.error_points, "where the map's lights are summed up one by one");
    app.add_option("--lamp-lights", set.lamp_lights, "that stand for the only lamp of a room")->delimiter(',');
    app.add_option("--few", set.few, "scenes with few lights");
    app.add_option("--many", set.many, "scenes with very many lights");
    CLI11_PARSE(app, argc, argv);
    return write_figures("bench-sources", "sources.json", [&] { return measure_all(set); });
}
