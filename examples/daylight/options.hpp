#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <render/options.hpp>

#include "annual.hpp"
#include "hourly_sky.hpp"
#include "sensors.hpp"

namespace daylighting {

/// The program's command line with its defaults.
struct Options {
    enum class Action { help, version, trace, year };

    Action action = Action::help;
    std::string help;  ///< the text to print when the action is `help`
    int threads = 0;   ///< 0: all
    bool quiet = false;

    // trace
    std::string scene;  ///< a file, or builtin:NAME; of `year` for rays to suns, else empty
    std::filesystem::path sensors;
    std::optional<LevelGrid> grid;
    UpAxis up = UpAxis::y;
    std::size_t directions = 32768;
    double error = 0.05;
    std::optional<double> bounce;  ///< spacing of points that reflect light; empty: none do
    bool resume = false;
    std::string isa;

    // year
    std::filesystem::path visibility;
    std::filesystem::path weather;  ///< may be empty if there are `skies`
    std::filesystem::path skies;    ///< a sky matrix; empty: skies are made of the weather
    std::optional<int> cie_type;    ///< of all skies; empty: Perez' all-weather model
    std::filesystem::path matrix;
    std::filesystem::path annual;
    std::filesystem::path picture;
    std::string figure = "autonomy";
    double turned = 0.0;
    double ground = 0.2;
    Occupancy occupancy;
    double target = 300.0;

    std::filesystem::path output;  ///< of both
};

/// throws: render::usage_error.
Options parse_options(int argc, const char* const* argv);

}  // namespace daylighting
