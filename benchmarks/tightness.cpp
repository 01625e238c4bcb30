/// Size of cuts by the library's bounds over that by exact ones: what tighter bounds could still save. Prints a table
/// and writes tightness.json.

#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "bound_tightness.hpp"
#include "figures.hpp"

namespace {

using namespace benchmark;

nlohmann::json to_json(const BoundTightness& r) {
    return {{"scene", r.scene},
            {"lights", r.lights},
            {"receivers", r.receivers},
            {"cut_size_exact", r.exact},
            {"cut_size_default", r.usual},
            {"cut_size_tight", r.tight},
            {"cut_size_separate", r.separate},
            {"default_over_exact", r.usual / r.exact},
            {"default_over_exact_median", r.median_ratio},
            {"tight_over_exact", r.tight / r.exact},
            {"separate_over_exact", r.separate / r.exact}};
}

}  // namespace

int main(int argc, char** argv) {
    std::string only;
    int width = 40, height = 30;
    std::size_t max_cut = 0;
    std::vector<std::string> scenes{"builtin:hall?area-points=64",
                                    "builtin:hall?area-points=64&indirect=100000",
                                    "builtin:omni?lights=10000",
                                    "builtin:directional?lights=10000",
                                    "builtin:surfaces?lights=10000&rotated=0",
                                    "builtin:surfaces?lights=10000"};
    CLI::App app{"Size of cuts by the library's bounds over that by exact ones"};
    app.add_option("scenes", scenes, "files or builtin:NAME, and ?KEY=VALUE&... for their lights");
    app.add_option("--only", only, "measure only scenes whose name contains this");
    app.add_option("--width", width, "of the picture, pixels");
    app.add_option("--height", height, "of the picture, pixels");
    app.add_option("--max-cut", max_cut, "most clusters in a cut; 0: unlimited");
    CLI11_PARSE(app, argc, argv);
    return write_figures("bench-tightness", "tightness.json", [&] {
        nlohmann::json rows = nlohmann::json::array();
        std::printf("%-44s %7s %6s | %7s | %7s %7s %8s | %8s %8s %8s | %8s\n", "mean cut size by bounds", "lights",
                    "points", "exact", "default", "tight", "separate", "/exact", "/exact", "/exact", "median");
        for (const std::string& name : scenes) {
            if (name.find(only) == std::string::npos) continue;
            const BoundTightness r = measure_tightness(name, width, height, max_cut);
            std::printf("%-44s %7zu %6zu | %7.1f | %7.1f %7.1f %8.1f | %8.3f %8.3f %8.3f | %8.3f\n", name.c_str(),
                        r.lights, r.receivers, r.exact, r.usual, r.tight, r.separate, r.usual / r.exact,
                        r.tight / r.exact, r.separate / r.exact, r.median_ratio);
            std::fflush(stdout);
            rows.push_back(to_json(r));
        }
        return rows;
    });
}
