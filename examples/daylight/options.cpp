#include "options.hpp"

#include <optional>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>
#include <render/io/escape.hpp>
#include <render/option_declaration.hpp>

#include "cie_sky.hpp"
#include "year_files.hpp"

namespace daylighting {
namespace {

using render::number_in;
using render::refuse;
using render::to_number;
using render::usage_error;
using Words = render::OptionDeclaration;

/// X,Y,Z,X,Y,Z
void set_grid(LevelGrid& grid, const std::string& text) {
    double numbers[6] = {};
    std::string_view rest = text;
    for (int i = 0; i < 6; ++i) {
        const std::size_t comma = rest.find(',');
        const auto value = to_number<double>(rest.substr(0, comma));
        if (!value || (comma == std::string_view::npos) != (i == 5)) {
            refuse("--grid", text, "two opposite corners X,Y,Z,X,Y,Z");
        }
        numbers[i] = *value;
        if (i < 5) rest.remove_prefix(comma + 1);
    }
    grid.corner = {numbers[0], numbers[1], numbers[2]};
    grid.opposite = {numbers[3], numbers[4], numbers[5]};
}

/// The CIE's standard sky that is named, or none for Perez'.
std::optional<int> sky_of(const std::string& text) {
    if (text == "perez") return std::nullopt;
    const std::string_view prefix = "cie:";
    const std::string_view all = text;
    const auto type = all.starts_with(prefix) ? to_number<int>(all.substr(prefix.size())) : std::nullopt;
    if (!type || *type < 1 || *type > cie_sky_count) refuse("--sky", text, "perez, or cie:1 to cie:16");
    return *type;
}

void set_occupancy(Occupancy& occupancy, const std::string& text) {
    const std::size_t dash = text.find('-');
    const std::string_view all = text;
    const auto from = to_number<int>(all.substr(0, dash));
    const auto to = dash == std::string::npos ? std::nullopt : to_number<int>(all.substr(dash + 1));
    if (!from || !to || *from < 0 || *to > 24 || *from >= *to) {
        refuse("--hours", text, "FROM-TO in whole hours of the day, such as 8-18");
    }
    occupancy = {*from, *to};
}

void add_common(CLI::App& app, Options& options) {
    Words words(app);
    words.threads(options.threads);
    app.add_flag("--quiet", options.quiet, "print nothing but errors");
}

void add_trace(CLI::App& app, Options& options, LevelGrid& grid, bool& has_grid, bool& has_spacing) {
    Words words(app);
    app.add_option("SCENE", options.scene, "glTF 2.0 (.gltf, .glb), OBJ, or builtin:NAME")->required();
    words.file("-o,--output", "what the sensors see, for `year`", options.output)->required();
    words.file("--sensors", "lines x y z dx dy dz", options.sensors);
    words.text("--grid", "X,Y,Z,X,Y,Z", "opposite corners of a level grid of sensors that look up",
               [&](const std::string& s) {
                   set_grid(grid, s);
                   has_grid = true;
               });
    words.text("--spacing", "S", "width of the grid's cells (0.5)", [&](const std::string& s) {
        grid.spacing = number_in("--spacing", s, 1e-6, 1e6, "a number from 1e-6 to 1e6");
        has_spacing = true;
    });
    words.text("--up", "y|z", "the scene's axis that points up; north is -z, or y (y)", [&](const std::string& s) {
        if (s != "y" && s != "z") refuse("--up", s, "y or z");
        options.up = s == "y" ? UpAxis::y : UpAxis::z;
    });
    words.number<std::size_t>("--directions", "N", "spread over the sphere (32768)", 64, 1 << 20,
                              "a whole number from 64 to 1048576", options.directions);
    words.number("--error", "R", "L2 error of what a sensor sees, as a share of it (0.05)", 0.0, 1.0,
                 "a number from 0 to 1", options.error);
    words.text("--bounce", "S", "light that surfaces reflect once, by points about S apart (none)",
               [&](const std::string& s) {
                   options.bounce = number_in("--bounce", s, 1e-6, 1e6, "a number from 1e-6 to 1e6");
               });
    words.isa("instruction set of the ray tracer (the best)", options.isa);
    app.add_flag("--resume", options.resume, "go on with the interrupted run that --output names");
    add_common(app, options);
}

void add_year(CLI::App& app, Options& options) {
    Words words(app);
    words.file("TRACED,--traced", "a file of `trace`", options.visibility)->required();
    words.file("--weather", "EnergyPlus weather file (.epw)", options.weather);
    words.text("--sky", "perez|cie:N",
               "skies that --weather makes: all-weather, or a CIE standard sky of 1 to 16 (perez)",
               [&](const std::string& s) { options.cie_type = sky_of(s); });
    words.file("--skies", "sky matrix of gendaymtx (.smx); --weather then gives suns alone", options.skies);
    words.file("-o,--output", "CSV of illuminance, an hour a line", options.output);
    words.file("--matrix", "the same for Radiance, a sensor a line", options.matrix);
    words.file("--annual", "CSV of a year's figures, a sensor a line", options.annual);
    words.file("--picture", "PNG of a grid in false colors", options.picture);
    words.choice("--figure", "NAME", "that it shows: " + render::listed(figure_names()) + " (autonomy)", figure_names(),
                 options.figure);
    words.text("--scene", "SCENE",
               "that was traced, for a ray to the sun of each hour; else the nearest direction counts",
               [&](const std::string& s) {
                   if (s.empty()) refuse("--scene", "''", "a scene");
                   options.scene = s;
               });
    words.isa("instruction set of these rays (the best)", options.isa);
    words.number("--north", "DEG", "by which the scene's north is turned from true north towards the east (0)", -360.0,
                 360.0, "degrees from -360 to 360", options.turned);
    words.number("--ground", "ALBEDO", "of what is below the horizon (0.2)", 0.0, 1.0, "a number from 0 to 1",
                 options.ground);
    words.text("--hours", "FROM-TO", "of the day in which the room is used (8-18)",
               [&](const std::string& s) { set_occupancy(options.occupancy, s); });
    words.number("--target", "LUX", "of the daylight autonomy (300)", 0.0, 1e6, "a number from 0 to 1e6",
                 options.target);
    add_common(app, options);
}

}  // namespace

Options parse_options(int argc, const char* const* argv) {
    Options options;
    LevelGrid grid;
    bool version = false, has_grid = false, has_spacing = false;
    CLI::App app("Daylight on sensors in every hour of a year.", "lightcuts-daylight");
    app.set_help_flag("-h,--help", "print this text");
    app.add_flag("--version", version, "print the version");
    CLI::App* trace = app.add_subcommand("trace", "find what sensors see of the sky; once a scene");
    CLI::App* year = app.add_subcommand("year", "light it by a year's weather");
    app.require_subcommand(0, 1);
    add_trace(*trace, options, grid, has_grid, has_spacing);
    add_year(*year, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        options.action = Options::Action::help;
        options.help = (trace->parsed() ? trace : year->parsed() ? year : &app)->help();
        return options;
    } catch (const CLI::ParseError& e) { throw usage_error(render::one_line(e.what())); }
    if (version) {
        options.action = Options::Action::version;
    } else if (trace->parsed()) {
        options.action = Options::Action::trace;
        if (has_grid == !options.sensors.empty()) throw usage_error("give either --sensors or --grid");
        if (has_spacing && !has_grid) throw usage_error("--spacing needs --grid: sensors of a file have none");
        if (has_grid) options.grid = grid;
    } else if (year->parsed()) {
        options.action = Options::Action::year;
        if (options.output.empty() && options.matrix.empty() && options.annual.empty() && options.picture.empty()) {
            throw usage_error("nothing is to be written: give --output, --matrix, --annual or --picture");
        }
        if (options.weather.empty()) {
            if (options.skies.empty()) throw usage_error("give --weather, or --skies");
            if (!options.scene.empty()) throw usage_error("--scene needs --weather, which says where the sun is");
            if (options.figure == "sun") throw usage_error("--figure sun needs --weather, which says where the sun is");
        }
        for (const char* name : {"--sky", "--ground"}) {
            if (!options.skies.empty() && year->get_option(name)->count() > 0) {
                throw usage_error(std::string(name) + " is of no use with --skies, which have their own; leave it out");
            }
        }
        if (!options.isa.empty() && options.scene.empty()) throw usage_error("--isa needs --scene");
        if (year->get_option("--figure")->count() > 0 && options.picture.empty()) {
            throw usage_error("--figure needs --picture");
        }
    } else {
        throw usage_error("give what to do: trace or year");
    }
    return options;
}

}  // namespace daylighting
