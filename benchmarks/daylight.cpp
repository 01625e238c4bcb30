/// A year of daylight by cuts against fixed patches of the sky: how far hourly illuminances are from the sum over all
/// directions, for how much memory and time; sizes of cuts; what precomputation takes besides its rays. One thread,
/// seconds of the processor. Prints tables and writes daylight.json.

#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <CLI/CLI.hpp>
#include <daylight/sensor_cuts.hpp>
#include <daylight/sun_rays.hpp>
#include <daylight/visibility.hpp>
#include <daylight/visibility_file.hpp>
#include <daylight/year.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "dense_product.hpp"
#include "error_sum.hpp"
#include "figures.hpp"
#include "fixed_patches.hpp"
#include "io/load_scene.hpp"
#include "timing.hpp"

namespace {

using namespace daylighting;
using benchmark::ErrorSum;
using benchmark::FixedPatches;

/// A year by a formula, at 48 degrees north: clear and cloudy hours by turns.
Weather synthetic_year() {
    constexpr std::array<int, 12> days = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    Weather weather;
    weather.city = "Madeup";
    weather.place = {48.2, 16.37, 1.0};
    int day_number = 0;
    for (int month = 1; month <= 12; ++month) {
        for (int day = 1; day <= days[static_cast<std::size_t>(month - 1)]; ++day) {
            ++day_number;
            for (int hour = 1; hour <= 24; ++hour) {
                WeatherHour h{2001, month, day, hour, 5.0, 0.0, 0.0};
                const double height = towards_sun(weather.place, h.middle()).z;
                const double cloud = 0.5 + 0.5 * std::sin(day_number * 1.7 + hour * 0.15);
                if (height > 0.01) {
                    h.direct_normal = std::max(0.0, 1.0 - 1.25 * cloud) * 950.0 * std::exp(-0.13 / (height + 0.03));
                    h.diffuse_horizontal = height * (110.0 + 260.0 * cloud * (1.25 - 0.6 * cloud)) +
                                           12.0 * std::sqrt(height);
                }
                weather.hours.push_back(h);
            }
        }
    }
    return weather;
}

struct SitePlan {
    std::string name, scene;
    LevelGrid grid;
};

/// A scene with sensors in it.
struct Site {
    render::Scene scene;
    render::RayScene rays;
    SensorSet sensors;

    Site(const SitePlan& place, double spacing)
        : scene(render::load_scene(place.scene)), rays(scene),
          sensors(sensors_of({place.grid.corner, place.grid.opposite, spacing}, UpAxis::y)) {}
};

constexpr std::array cut_errors = {0.5, 0.4, 0.3, 0.2, 0.1, 0.05};

/// What is compared at some sensors and hours: light by all directions, by patches, and by cuts. Besides, how far all
/// are from where the sun is no direction of the tree but a ray to its center.
nlohmann::json errors(const SitePlan& place, const DirectionTree& directions, const Weather& weather,
                      std::size_t step) {
    Site site(place, place.grid.spacing);
    const Setting setting{};
    const std::vector<LitHour> all = lit_hours(weather, directions, setting);
    std::vector<LitHour> hours;
    for (std::size_t i = step / 2; i < all.size(); i += step) hours.push_back(all[i]);
    const Facing facing(directions, site.sensors.sensors[0].normal);
    const VisibilityTracer tracer(site.scene, site.rays, directions);
    VisibilityTracer::Scratch scratch;
    const std::size_t count = site.sensors.sensors.size();

    std::vector<std::vector<float>> visibility(count), weighted(count);
    CutMaker maker;
    std::array<std::vector<SensorCuts>, cut_errors.size()> cuts;
    for (std::size_t s = 0; s < count; ++s) {
        tracer.trace(site.sensors.sensors[s], facing, visibility[s], scratch);
        weighted[s] = visibility[s];
        for (std::size_t i = 0; i < directions.size(); ++i) weighted[s][i] *= facing.cosines()[i];
        for (std::size_t e = 0; e < cut_errors.size(); ++e) {
            cuts[e].emplace_back();
            maker.make(directions, facing, visibility[s], cut_errors[e], cuts[e].back());
        }
    }
    // By all directions: first the skies, then with suns.
    std::vector<std::vector<double>> sky(count, std::vector<double>(hours.size())), exact = sky, by_rays = sky;
    const FixedPatches coarse(directions, setting, 1), fine(directions, setting, 4);
    struct Rival {
        const FixedPatches* patches;
        FixedPatches::Sun sun;
        std::vector<float> coefficients{}, columns{};
        ErrorSum of_sky{}, with_sun{}, by_ray{};
    };
    std::vector<Rival> rivals;
    for (const FixedPatches* p : {&coarse, &fine}) {
        for (const auto sun : {FixedPatches::Sun::four, FixedPatches::Sun::nearest, FixedPatches::Sun::none}) {
            rivals.push_back({p, sun});
            for (std::size_t s = 0; s < count; ++s) {
                const std::vector<float> row = p->coefficients(visibility[s], facing.cosines());
                rivals.back().coefficients.insert(rivals.back().coefficients.end(), row.begin(), row.end());
            }
        }
    }
    SkyBlock block(directions, setting);
    for (std::size_t first = 0; first < hours.size(); first += block_hours) {
        const std::size_t in_block = std::min(block_hours, hours.size() - first);
        block.fill(std::span(hours).subspan(first, in_block));
        for (std::size_t s = 0; s < count; ++s) {
            std::array<double, block_hours> sums{};
            for (std::size_t i = 0; i < directions.size(); ++i) {
                if (weighted[s][i] == 0.0f) continue;
                for (std::size_t h = 0; h < block_hours; ++h) {
                    sums[h] += static_cast<double>(weighted[s][i]) * static_cast<double>(block.light()[i][h]);
                }
            }
            std::copy_n(sums.begin(), in_block, sky[s].begin() + static_cast<std::ptrdiff_t>(first));
        }
        for (Rival& rival : rivals) {
            for (std::size_t h = 0; h < in_block; ++h) {
                const auto column = rival.patches->luminances(block, h, hours[first + h], rival.sun);
                rival.columns.insert(rival.columns.end(), column.begin(), column.end());
            }
        }
    }
    const RayStarts starts(site.scene);
    for (std::size_t s = 0; s < count; ++s) {
        const glm::vec3 normal = site.sensors.sensors[s].normal;
        for (std::size_t h = 0; h < hours.size(); ++h) {
            exact[s][h] = by_rays[s][h] = sky[s][h];
            const double cosine = static_cast<double>(glm::dot(normal, hours[h].towards_sun));
            if (!hours[h].has_sun() || !(cosine > 0.0)) continue;
            exact[s][h] += static_cast<double>(visibility[s][hours[h].sun_place]) * cosine *
                           hours[h].direct_illuminance;
            const Sensor& sensor = site.sensors.sensors[s];
            const glm::vec3 seen = site.rays.to_infinity(starts(sensor), hours[h].towards_sun);
            by_rays[s][h] += static_cast<double>(seen.r + seen.g + seen.b) / 3.0 * cosine * hours[h].direct_illuminance;
        }
    }
    nlohmann::json result{{"scene", place.name}, {"sensors", count}, {"hours", hours.size()}};
    std::printf("\n%s: %zu sensors, %zu hours\n%-36s %10s %10s %10s %12s\n", place.name.c_str(), count, hours.size(),
                "", "RMSE, sky", "with sun", "sun by ray", "bytes/sensor");
    const char* suns[] = {"", ", sun in the nearest", ", sun in four"};  // in the order of Sun
    for (Rival& rival : rivals) {
        const std::vector<float> light = benchmark::dense_product(rival.coefficients, rival.columns,
                                                                  rival.patches->size());
        for (std::size_t h = 0; h < hours.size(); ++h) {
            for (std::size_t s = 0; s < count; ++s) {
                const auto value = static_cast<double>(light[h * count + s]);
                if (rival.sun == FixedPatches::Sun::none) {
                    rival.of_sky.add(value, sky[s][h]);
                } else {
                    rival.with_sun.add(value, exact[s][h]);
                    rival.by_ray.add(value, by_rays[s][h]);
                }
            }
        }
        const bool is_sky = rival.sun == FixedPatches::Sun::none;
        const std::string name = std::to_string(rival.patches->size() - 1) + " patches" +
                                 suns[static_cast<int>(rival.sun)];
        const double error = (is_sky ? rival.of_sky : rival.with_sun).relative();
        const std::size_t memory = rival.patches->size() * sizeof(float);
        if (is_sky) {
            std::printf("%-36s %8.3f %% %10s %10s %12zu\n", name.c_str(), 100.0 * error, "", "", memory);
        } else {
            std::printf("%-36s %10s %8.3f %% %8.3f %% %12zu\n", name.c_str(), "", 100.0 * error,
                        100.0 * rival.by_ray.relative(), memory);
        }
        result["patches"].push_back({{"name", name}, {is_sky ? "sky" : "all", error}});
    }
    for (std::size_t e = 0; e < cut_errors.size(); ++e) {
        const CutMatrix matrix(site.sensors.sensors, [&](std::size_t i, auto& out) { out = cuts[e][i].sky; });
        Illuminances lux = sky_light(matrix, directions, hours, setting);
        ErrorSum of_sky, with_sun, by_ray, with_rays;
        std::size_t pieces = 0, sun_pieces = 0, stored = 0;
        std::vector<std::byte> bytes;
        const SunList suns_of_year(hours);
        const SunRays sun_rays(site.scene, site.rays, hours);
        SunRays::Scratch sun_scratch;
        for (std::size_t s = 0; s < count; ++s) {
            for (std::size_t h = 0; h < hours.size(); ++h) { of_sky.add(static_cast<double>(lux.of(s)[h]), sky[s][h]); }
            std::vector<float> by_sun_rays(lux.of(s).begin(), lux.of(s).end());
            sun_rays.add(site.sensors.sensors[s], weather, by_sun_rays, sun_scratch);
            for (std::size_t h = 0; h < hours.size(); ++h) {
                with_rays.add(static_cast<double>(by_sun_rays[h]), by_rays[s][h]);
            }
            suns_of_year.add(cuts[e][s].sun, site.sensors.sensors[s].normal, weather, lux.of(s));
            for (std::size_t h = 0; h < hours.size(); ++h) {
                with_sun.add(static_cast<double>(lux.of(s)[h]), exact[s][h]);
                by_ray.add(static_cast<double>(lux.of(s)[h]), by_rays[s][h]);
            }
            pieces += cuts[e][s].sky.size();
            sun_pieces += cuts[e][s].sun.size();
            bytes.clear();
            lightcuts::encode(cuts[e][s].sky, cut_encoding, bytes);
            lightcuts::encode(cuts[e][s].sun, cut_encoding, bytes);
            stored += bytes.size();
        }
        // In memory the sky's entries are 8 bytes each; the suns' cuts stay as they are stored.
        const double n = static_cast<double>(count);
        const double memory = static_cast<double>(matrix.memory_bytes()) / n +
                              3.0 * static_cast<double>(sun_pieces) / n;
        char name[64];
        std::snprintf(name, sizeof name, "cuts, --error %.2f, %.0f + %.0f pieces", cut_errors[e],
                      static_cast<double>(pieces) / n, static_cast<double>(sun_pieces) / n);
        std::printf("%-36s %8.3f %% %8.3f %% %8.3f %% %12.0f, in the file %.0f; --scene %.3f %%\n", name,
                    100.0 * of_sky.relative(), 100.0 * with_sun.relative(), 100.0 * by_ray.relative(), memory,
                    static_cast<double>(stored) / n, 100.0 * with_rays.relative());
        result["cuts"].push_back({{"error", cut_errors[e]},
                                  {"pieces", static_cast<double>(pieces) / n},
                                  {"sun_pieces", static_cast<double>(sun_pieces) / n},
                                  {"sky", of_sky.relative()},
                                  {"all", with_sun.relative()},
                                  {"sun_by_ray", by_ray.relative()},
                                  {"sun_by_ray_with_scene", with_rays.relative()},
                                  {"memory", memory},
                                  {"file", static_cast<double>(stored) / n}});
    }
    // Sizes at a root mean square of .06: of the directions before a sensor, weighted by their cosines; and of all
    // directions alike, those behind it hidden, as the method's paper has it.
    lightcuts::OrderedApproximation<float> ordered;
    std::vector<lightcuts::Moments<1>> moments;
    double pieces = 0.0, plain = 0.0;
    const double weight = std::accumulate(facing.cosines().begin(), facing.cosines().end(), 0.0);
    for (std::size_t s = 0; s < count; ++s) {
        facing.moments(directions.tree, visibility[s], moments);
        ordered.start(directions.tree, moments);
        ordered.refine_to_total_error(0.06 * std::sqrt(weight));
        pieces += static_cast<double>(ordered.size()) / static_cast<double>(count);
        lightcuts::refit_moments(directions.tree, moments, [&](std::uint32_t i) { return visibility[s][i]; });
        ordered.start(directions.tree, moments);
        ordered.refine_to_total_error(0.06 * std::sqrt(static_cast<double>(directions.size())));
        plain += static_cast<double>(ordered.size()) / static_cast<double>(count);
    }
    std::printf(
        "pieces at a root mean square error of visibility of 0.06: %.0f by cosine, %.0f of all directions alike\n",
        pieces, plain);
    result["pieces_at_rms_0.06"] = pieces;
    result["plain_pieces_at_rms_0.06"] = plain;
    return result;
}

/// Seconds of precomputation and of a year for some ten thousand sensors.
nlohmann::json times(const SitePlan& place, const DirectionTree& directions, const Weather& weather, double error,
                     std::size_t sensors, int runs) {
    const double area = std::abs((place.grid.opposite.x - place.grid.corner.x) *
                                 (place.grid.opposite.z - place.grid.corner.z));
    Site site(place, std::sqrt(area / static_cast<double>(sensors)));
    const std::size_t count = site.sensors.sensors.size();
    const Setting setting{};
    const Facing facing(directions, site.sensors.sensors[0].normal);
    const VisibilityTracer tracer(site.scene, site.rays, directions);
    VisibilityTracer::Scratch scratch;
    CutMaker maker;
    std::vector<SensorCuts> cuts(count);
    std::vector<float> visibility;
    double ray_seconds = 0.0;
    std::vector<std::byte> bytes;
    const double whole = benchmark::seconds([&] {
        for (std::size_t s = 0; s < count; ++s) {
            ray_seconds += benchmark::seconds(
                [&] { tracer.trace(site.sensors.sensors[s], facing, visibility, scratch); });
            maker.make(directions, facing, visibility, error, cuts[s]);
            bytes.clear();
            lightcuts::encode(cuts[s].sky, cut_encoding, bytes);
            lightcuts::encode(cuts[s].sun, cut_encoding, bytes);
        }
    });
    std::printf("\n%s: %zu sensors, --error %.2f\nprecomputation %.2f s, of which rays %.2f s: %.2f\n",
                place.name.c_str(), count, error, whole, ray_seconds, whole / ray_seconds);

    const std::vector<LitHour> hours = lit_hours(weather, directions, setting);
    const CutMatrix matrix(site.sensors.sensors, [&](std::size_t i, auto& out) { out = cuts[i].sky; });
    std::vector<double> skies, years, suns, sun_ray_times, denses;
    const SunRays sun_rays(site.scene, site.rays, hours);
    SunRays::Scratch sun_scratch;
    const FixedPatches fine(directions, setting, 4);
    std::vector<float> rows, columns;
    SkyBlock block(directions, setting);
    for (std::size_t s = 0; s < count; ++s) {
        tracer.trace(site.sensors.sensors[s], facing, visibility, scratch);
        const std::vector<float> row = fine.coefficients(visibility, facing.cosines());
        rows.insert(rows.end(), row.begin(), row.end());
    }
    columns.assign(fine.size() * hours.size(), 1.0f);
    for (int run = 0; run < runs; ++run) {
        skies.push_back(benchmark::seconds([&] {
            for (std::size_t first = 0; first < hours.size(); first += block_hours) {
                block.fill(std::span(hours).subspan(first, std::min(block_hours, hours.size() - first)));
            }
        }));
        Illuminances lux;
        years.push_back(benchmark::seconds([&] { lux = sky_light(matrix, directions, hours, setting); }));
        suns.push_back(benchmark::seconds([&] {
            const SunList list(hours);
            for (std::size_t s = 0; s < count; ++s) {
                list.add(cuts[s].sun, site.sensors.sensors[s].normal, weather, lux.of(s));
            }
        }));
        sun_ray_times.push_back(benchmark::seconds([&] {
            for (std::size_t s = 0; s < count; ++s) {
                sun_rays.add(site.sensors.sensors[s], weather, lux.of(s), sun_scratch);
            }
        }));
        denses.push_back(benchmark::seconds([&] { benchmark::dense_product(rows, columns, fine.size()); }));
    }
    const double sky = benchmark::median(skies), year = benchmark::median(years), sun = benchmark::median(suns),
                 dense = benchmark::median(denses), sun_ray = benchmark::median(sun_ray_times);
    std::printf(
        "a year, %zu lit hours: cuts %.2f s (of which skies %.2f s) + suns %.2f s, or by rays %.2f s; Eigen, 2305 "
        "patches, %.2f s\n"
        "ours / Eigen: %.2f; without evaluating the skies %.2f\n",
        hours.size(), year, sky, sun, sun_ray, dense, (year + sun) / dense, (year - sky + sun) / dense);
    return {{"scene", place.name}, {"sensors", count},      {"precomputation", whole},
            {"rays", ray_seconds}, {"hours", hours.size()}, {"year", year},
            {"skies", sky},        {"suns", sun},           {"suns_by_rays", sun_ray},
            {"dense", dense}};
}

}  // namespace

int main(int argc, char** argv) {
    std::size_t directions = 32768, sensors = 10'000, step = 7;
    double error = 0.05;
    int runs = 3;
    CLI::App app{"A year of daylight by cuts against fixed patches of the sky"};
    app.add_option("--directions", directions, "over the sphere (32768)");
    app.add_option("--sensors", sensors, "of which times are taken (10000)");
    app.add_option("--step", step, "errors are taken every so many lit hours (7)");
    app.add_option("--error", error, "of cuts of which times are taken (0.05)");
    app.add_option("--runs", runs, "medians are over this odd number (3)")->check(benchmark::odd_number());
    CLI11_PARSE(app, argc, argv);
    return benchmark::write_figures("bench-daylight", "daylight.json", [&] {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const DirectionTree tree = make_direction_tree(directions);
        const Weather weather = synthetic_year();
        const std::array places = {
            SitePlan{"classroom", LIGHTCUTS_CLASSROOM, {{-5, 0.8, -4}, {5, 0.8, 4}, 0.4}},
            SitePlan{"colonnade", "builtin:colonnade", {{-12, 1.0, -12}, {12, 1.0, 12}, 1.1}},
        };
        nlohmann::json result;
        for (const SitePlan& place : places) {
            result["errors"].push_back(errors(place, tree, weather, step));
            result["times"].push_back(times(place, tree, weather, error, sensors, runs));
        }
        return result;
    });
}
