/// On the hall: error of lightcuts against the exhaustive sum, growth of their time with the number of lights, and the
/// number of lights from which they are the faster of the two. Prints tables and writes error.json.

#include <array>
#include <cstdio>
#include <thread>

#include <CLI/CLI.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <nlohmann/json.hpp>

#include "crossing.hpp"
#include "error.hpp"
#include "figures.hpp"
#include "io/picture.hpp"
#include "timing.hpp"
#include "workload.hpp"

namespace {

using namespace benchmark;

std::string hall(std::uint32_t area_points) { return "builtin:hall?area-points=" + std::to_string(area_points); }

/// Traces shadow rays one by one.
struct SingleRays {
    render::OpaqueOracle oracle;

    template <class R, class L>
    bool operator()(const R& receiver, const L& light) const {
        return oracle(receiver, light);
    }
};

template <class Oracle>
void shade(const Workload& work, const Oracle& oracle, std::span<lightcuts::CutResult<glm::vec3>> results) {
    work.visit([&]<class Forest>(const Forest& forest) {
        static lightcuts::scratch_of<Forest> scratch;
        for_each_group(work.receivers(), [&](std::span<const Receiver> group) {
            lightcuts::shade(forest, group, oracle, results.first(group.size()), scratch, {.clamp = work.clamp()});
            results = results.subspan(group.size());
        });
    });
}

/// One pixel a receiver.
render::Picture blank(const Workload& work) { return {static_cast<int>(work.receivers().size()), 1}; }

render::Picture reference(const Workload& work) {
    render::Picture picture = blank(work);
    const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < count; ++t) {
        threads.emplace_back([&, t] {
            lightcuts::EstimateScratch<glm::vec3> scratch;
            for (std::size_t i = t; i < picture.size(); i += count) {
                picture.pixels[i] = exhaustive_sum(work, work.receivers()[i], work.oracle(), scratch);
            }
        });
    }
    threads.clear();
    return picture;
}

nlohmann::json measure_error(int width, int height) {
    std::printf("%8s %8s %8s %10s %10s %10s\n", "lights", "points", "cut", "rel. RMSE", "99.9th", "largest");
    nlohmann::json rows = nlohmann::json::array();
    for (const std::uint32_t area_points : {64u, 256u}) {
        const Workload work(hall(area_points), width, height);
        std::vector<lightcuts::CutResult<glm::vec3>> results(work.receivers().size());
        shade(work, work.oracle(), std::span(results));
        render::Picture picture = blank(work);
        double cut_size = 0;
        for (std::size_t i = 0; i < results.size(); ++i) {
            picture.pixels[i] = results[i].radiance;
            cut_size += results[i].cut_size / static_cast<double>(results.size());
        }
        const render::ErrorFigures error = render::compare(picture, reference(work));
        std::printf("%8zu %8zu %8.1f %8.2f %% %8.2f %% %8.2f %%\n", work.light_count(), results.size(), cut_size,
                    100.0 * error.relative_rmse, 100.0 * error.p999_relative, 100.0 * error.max_relative);
        std::fflush(stdout);
        rows.push_back({{"lights", work.light_count()},
                        {"receivers", results.size()},
                        {"cut_size", cut_size},
                        {"relative_rmse", error.relative_rmse},
                        {"p999_relative", error.p999_relative},
                        {"max_relative", error.max_relative}});
    }
    return rows;
}

nlohmann::json measure_growth(int width, int height, int runs) {
    const Workload few(hall(256), width, height), many(hall(4096), width, height);
    std::vector<lightcuts::CutResult<glm::vec3>> results(few.receivers().size());
    std::vector<double> few_times, many_times, ratios;
    for (int run = 0; run < runs; ++run) {
        few_times.push_back(seconds([&] { shade(few, few.oracle(), std::span(results)); }));
        many_times.push_back(seconds([&] { shade(many, many.oracle(), std::span(results)); }));
        ratios.push_back(many_times.back() / few_times.back());
    }
    std::printf("\n%8s %10s\n", "lights", "seconds");
    std::printf("%8zu %10.3f\n", few.light_count(), median(few_times));
    std::printf("%8zu %10.3f   growth %.3f\n", many.light_count(), median(many_times), median(ratios));
    std::fflush(stdout);
    return {{"lights", {few.light_count(), many.light_count()}},
            {"seconds", {median(few_times), median(many_times)}},
            {"growth", median(ratios)}};
}

nlohmann::json measure_crossing(int width, int height, int runs) {
    // How rays are traced: by both in streams, by both one by one, by each as is best for it.
    constexpr std::array names = {"streams", "single rays", "best"};
    std::vector<double> lights;
    std::array<std::vector<double>, 3> ratios;
    nlohmann::json rows = nlohmann::json::array();
    std::printf("\n%8s | %-20s | %-20s | exhaustive / lightcuts\n", "", "us/point, lightcuts", "exhaustive");
    std::printf("%8s | %9s %10s | %9s %10s | %9s %11s %9s\n", "lights", "streams", "single", "streams", "single",
                names[0], names[1], names[2]);
    for (const std::uint32_t area_points : {1u, 2u, 4u, 8u, 16u}) {
        const Workload work(hall(area_points), width, height);
        std::vector<lightcuts::CutResult<glm::vec3>> results(work.receivers().size());
        const render::OpaqueOracle streams = work.oracle();
        const SingleRays single{streams};
        lightcuts::EstimateScratch<glm::vec3> scratch;
        const auto sum_all = [&](const auto& oracle) {
            for (const Receiver& r : work.receivers()) exhaustive_sum(work, r, oracle, scratch);
        };
        std::array<std::vector<double>, 4> times;
        for (int run = 0; run < runs; ++run) {
            times[0].push_back(seconds([&] { shade(work, streams, std::span(results)); }));
            times[1].push_back(seconds([&] { shade(work, single, std::span(results)); }));
            times[2].push_back(seconds([&] { sum_all(streams); }));
            times[3].push_back(seconds([&] { sum_all(single); }));
        }
        std::array<double, 4> us{};
        for (std::size_t k = 0; k < us.size(); ++k) {
            us[k] = 1e6 * median(times[k]) / static_cast<double>(work.receivers().size());
        }
        lights.push_back(static_cast<double>(work.light_count()));
        ratios[0].push_back(us[2] / us[0]);
        ratios[1].push_back(us[3] / us[1]);
        ratios[2].push_back(std::min(us[2], us[3]) / std::min(us[0], us[1]));
        std::printf("%8zu | %9.1f %10.1f | %9.1f %10.1f | %9.3f %11.3f %9.3f\n", work.light_count(), us[0], us[1],
                    us[2], us[3], ratios[0].back(), ratios[1].back(), ratios[2].back());
        std::fflush(stdout);
        rows.push_back({{"lights", work.light_count()},
                        {"lightcuts_streams_us", us[0]},
                        {"lightcuts_single_us", us[1]},
                        {"exhaustive_streams_us", us[2]},
                        {"exhaustive_single_us", us[3]}});
    }
    nlohmann::json crossings;
    std::printf("%-55s |", "lightcuts are faster from so many lights");
    for (std::size_t k = 0; k < names.size(); ++k) {
        const double at = crossing(lights, ratios[k]);
        crossings[names[k]] = at;
        std::printf(" %*.0f", k == 1 ? 11 : 9, at);
    }
    std::printf("\n");
    return {{"rows", rows}, {"lights_at_crossing", crossings}};
}

}  // namespace

int main(int argc, char** argv) {
    std::string only;
    int width = 160, height = 90, runs = 5;
    CLI::App app{"Error of lightcuts on the hall, growth of their time, and where they beat the exhaustive sum"};
    app.add_option("--only", only, "measure only this")->check(CLI::IsMember({"error", "growth", "crossing"}));
    app.add_option("--width", width, "of the picture, pixels; the crossing uses half of it");
    app.add_option("--height", height, "of the picture, pixels; the crossing uses half of it");
    app.add_option("--runs", runs, "medians are over this odd number")->check(odd_number());
    CLI11_PARSE(app, argc, argv);

    return write_figures("bench-error", "error.json", [&] {
        nlohmann::json json;
        if (only.empty() || only == "error") json["error"] = measure_error(width, height);
        if (only.empty() || only == "growth") json["growth"] = measure_growth(width, height, runs);
        if (only.empty() || only == "crossing") json["crossing"] = measure_crossing(width / 2, height / 2, runs);
        return json;
    });
}
