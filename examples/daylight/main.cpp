#include <cstdio>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <lightcuts/core/invalid_input.hpp>
#include <render/fingerprint.hpp>
#include <render/interrupt.hpp>
#include <render/io/escape.hpp>
#include <render/io/load_scene.hpp>
#include <render/io/output_file.hpp>
#include <render/io/standard_streams.hpp>
#include <render/program.hpp>
#include <render/progress.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/run_program.hpp>
#include <render/stopwatch.hpp>

#include "annual.hpp"
#include "bounce.hpp"
#include "options.hpp"
#include "sky_matrix.hpp"
#include "sun_rays.hpp"
#include "trace.hpp"
#include "visibility_file.hpp"
#include "year.hpp"
#include "year_files.hpp"

namespace {

using namespace daylighting;

using render::ExitStatus;

void say(const std::string& text) { std::fprintf(stderr, "lightcuts-daylight: %s\n", render::escaped(text).c_str()); }

template <class Number>
std::string text_of(const char* format, Number value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// throws: invalid_input unless all `outputs` can be written and none is one of `inputs`, or another output.
void require_usable(const std::vector<std::filesystem::path>& outputs,
                    const std::vector<std::filesystem::path>& inputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (const std::filesystem::path& input : inputs) render::require_apart(outputs[i], input);
        for (std::size_t k = 0; k < i; ++k) {
            if (outputs[i].lexically_normal() == outputs[k].lexically_normal()) {
                throw lightcuts::invalid_input(outputs[i].string() + ": two files would have this name");
            }
        }
        render::require_writable(outputs[i]);
    }
}

ExitStatus trace(const Options& options) {
    const std::filesystem::path unfinished = render::beside(options.output, ".resume");
    if (unfinished == options.output) {
        throw render::usage_error("--output " + options.output.string() +
                                  ": this extension is that of unfinished runs");
    }
    std::vector<std::filesystem::path> inputs;
    if (!options.sensors.empty()) inputs.push_back(options.sensors);
    require_usable({options.output}, inputs);
    const render::Stopwatch watch;
    const SensorSet sensors = options.grid ? sensors_of(*options.grid, options.up)
                                           : read_sensors(options.sensors, options.up);
    const render::Scene scene = render::load_scene(options.scene);
    require_usable({options.output}, scene.files);
    const render::RayScene rays(scene, render::RayTracer(options.isa));
    const DirectionTree directions = make_direction_tree(options.directions);
    Bounce bounce;
    if (options.bounce) bounce = find_bounce(scene, rays, sensors.sensors, {.spacing = *options.bounce});
    std::vector<Sensor> all = sensors.sensors;
    all.insert(all.end(), bounce.points.begin(), bounce.points.end());
    std::error_code ignored;
    if (const bool is_there = std::filesystem::exists(unfinished, ignored);
        is_there != options.resume && !options.quiet) {
        say(unfinished.string() + (is_there ? ": starting over; --resume would have gone on with these finished sensors"
                                            : ": there are no finished sensors; starting from the beginning"));
    }
    render::defer_signals();
    const Trace result = trace_sensors(
        scene, rays, directions, all,
        {.error = options.error, .unfinished = unfinished, .resume = options.resume, .shows_progress = !options.quiet});
    const std::size_t count = all.size();
    if (result.finished < count) {
        say(result.finished == 0 ? std::string("interrupted before anything was finished; nothing was written")
                                 : "interrupted; " + std::to_string(result.finished) + " of " + std::to_string(count) +
                                       " sensors are in " + unfinished.string() + ", and --resume goes on with them");
        return render::stopped;
    }
    const std::vector<std::byte> file = visibility_file(directions, sensors, bounce, result.sky, result.sun,
                                                        render::occlusion_hash(scene));
    render::write_file(options.output, {reinterpret_cast<const char*>(file.data()), file.size()});
    std::filesystem::remove(unfinished, ignored);
    if (!options.quiet) {
        const auto n = static_cast<double>(count);
        say(std::to_string(sensors.sensors.size()) + " sensors, " +
            (options.bounce ? std::to_string(bounce.points.size()) + " points that reflect light, " : std::string()) +
            std::to_string(directions.size()) +
            " directions; pieces a sensor: " + text_of("%.0f", static_cast<double>(result.sky_pieces) / n) +
            " for skies, " + text_of("%.0f", static_cast<double>(result.sun_pieces) / n) + " for the sun; " +
            text_of("%.1f", static_cast<double>(file.size()) / 1e6) + " MB, " + text_of("%.1f", watch.seconds()) +
            " s" + (result.resumed > 0 ? ", " + std::to_string(result.resumed) + " sensors by an earlier run" : ""));
    }
    return render::done;
}

std::vector<std::filesystem::path> year_outputs(const Options& options) {
    std::vector<std::filesystem::path> outputs;
    for (const auto& path : {options.output, options.matrix, options.annual, options.picture}) {
        if (!path.empty()) outputs.push_back(path);
    }
    return outputs;
}

/// Adds suns, and returns the hours in which they shone on each sensor.
std::vector<double> add_suns(const Options& options, const VisibilityFile& traced, const std::vector<Sensor>& sensors,
                             const Weather& weather, std::span<const LitHour> hours, Illuminances& lux) {
    std::vector<double> sun_hours(sensors.size());
    if (options.scene.empty()) {
        const SunList suns(hours);
        tbb::parallel_for(std::size_t{0}, sensors.size(), [&](std::size_t i) {
            lightcuts::PiecewiseConstant<float> sun;
            traced.read_sun(i, sun);
            sun_hours[i] = suns.add(sun, sensors[i].normal, weather, lux.of(i));
        });
        return sun_hours;
    }
    const render::Scene scene = render::load_scene(options.scene);
    require_usable(year_outputs(options), scene.files);
    if (render::occlusion_hash(scene) != traced.scene()) {
        throw lightcuts::invalid_input(options.scene + ": is not the scene that " + options.visibility.string() +
                                       " was traced in, or has changed; trace it anew");
    }
    const render::RayScene rays(scene, render::RayTracer(options.isa));
    const SunRays suns(scene, rays, hours);
    tbb::enumerable_thread_specific<SunRays::Scratch> scratches;
    tbb::parallel_for(std::size_t{0}, sensors.size(), [&](std::size_t i) {
        sun_hours[i] = suns.add(sensors[i], weather, lux.of(i), scratches.local());
    });
    return sun_hours;
}

/// The hours of a year: those of its weather, or, without one, those that a sky matrix has a column each for.
Weather weather_of(const Options& options, const std::optional<SkyMatrix>& skies) {
    if (!options.weather.empty()) {
        Weather weather = read_epw(options.weather);
        if (skies && skies->hours != weather.hours.size()) {
            throw lightcuts::invalid_input(options.skies.string() + ": " + std::to_string(skies->hours) +
                                           " columns, but " + options.weather.string() + " has " +
                                           std::to_string(weather.hours.size()) + " hours; make it of that weather");
        }
        if (skies && skies->has_suns) {
            throw lightcuts::invalid_input(options.skies.string() +
                                           ": has suns, and so has --weather; make it with gendaymtx -s, or leave "
                                           "--weather out");
        }
        return weather;
    }
    if (skies->hours != 8760 && skies->hours != 8784) {
        throw lightcuts::invalid_input(options.skies.string() + ": " + std::to_string(skies->hours) +
                                       " columns, which are no year of 8760 or 8784 hours; give --weather too, "
                                       "whose hours they are");
    }
    return calendar_year(skies->hours);
}

ExitStatus year(const Options& options) {
    std::vector<std::filesystem::path> inputs{options.visibility};
    for (const auto& path : {options.weather, options.skies}) {
        if (!path.empty()) inputs.push_back(path);
    }
    require_usable(year_outputs(options), inputs);
    const render::Stopwatch watch;
    std::optional<SkyMatrix> skies;
    if (!options.skies.empty()) skies = read_sky_matrix(options.skies);
    const Weather weather = weather_of(options, skies);
    const VisibilityFile traced(options.visibility);
    const SensorSet& sensors = traced.sensors();
    if (!options.picture.empty() && sensors.columns == 0) {
        throw lightcuts::invalid_input(
            options.visibility.string() +
            ": its sensors are no grid, of which alone there are pictures; leave --picture out");
    }
    const Setting setting{.up = sensors.up, .turned = options.turned, .ground_albedo = options.ground};
    const std::vector<LitHour> hours = skies ? lit_hours(*skies, weather, traced.directions(), setting)
                                             : lit_hours(weather, traced.directions(), setting, options.cie_type);
    const std::vector<Sensor> all = traced.all();
    const CutMatrix cuts(all, [&](std::size_t i, auto& out) { traced.read_sky(i, out); });
    Illuminances lux;
    {
        render::Progress progress((hours.size() + block_hours - 1) / block_hours, !options.quiet);
        lux = sky_light(cuts, traced.directions(), hours, setting, [&] { progress.step(); });
    }
    std::vector<double> sun_hours;
    if (!options.weather.empty()) sun_hours = add_suns(options, traced, all, weather, hours, lux);
    add_bounce(traced.bounce(), lux);
    lux.drop_beyond(sensors.sensors.size());
    std::vector<AnnualFigures> figures(sensors.sensors.size());
    tbb::parallel_for(std::size_t{0}, figures.size(), [&](std::size_t i) {
        figures[i] = annual_figures(weather, hours, lux.of(i), options.occupancy, options.target,
                                    sun_hours.empty() ? std::nullopt : std::optional(sun_hours[i]));
    });
    const double seconds = watch.seconds();
    if (!options.output.empty()) write_hourly(options.output, weather, hours, lux);
    if (!options.matrix.empty()) write_matrix(options.matrix, weather, hours, lux);
    if (!options.annual.empty()) write_annual(options.annual, sensors, figures, options.target);
    std::string shown;
    if (!options.picture.empty()) {
        const double white = write_picture(options.picture, sensors, figures, options.figure);
        shown = "; the picture shows " + options.figure + " from 0, black, to " + text_of("%.4g", white) + ", white";
    }
    if (!options.quiet) {
        double autonomy = 0.0;
        for (const AnnualFigures& f : figures) autonomy += f.autonomy / static_cast<double>(figures.size());
        say(std::to_string(figures.size()) + " sensors, " + std::to_string(weather.hours.size()) + " hours, " +
            std::to_string(hours.size()) + " of them lit, in " + text_of("%.1f", seconds) +
            " s; mean daylight autonomy " + text_of("%.0f", 100.0 * autonomy) + " %" + shown);
    }
    return render::done;
}

ExitStatus run(const Options& options) {
    if (options.action == Options::Action::help) render::print(options.help);
    if (options.action == Options::Action::version) {
        render::print("lightcuts-daylight " + render::program_version() + "\n");
    }
    if (options.action != Options::Action::trace && options.action != Options::Action::year) return render::done;
    const int threads = options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    return arena.execute([&] { return options.action == Options::Action::trace ? trace(options) : year(options); });
}

}  // namespace

int main(int argc, char** argv) {
    return render::run_program("lightcuts-daylight", [&] { return run(parse_options(argc, argv)); });
}
