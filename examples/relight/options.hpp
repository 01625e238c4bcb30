#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <render/options.hpp>

#include "bounce_shader.hpp"
#include "exhaustive.hpp"
#include "illumination.hpp"
#include "material_change.hpp"
#include "relit_shader.hpp"
#include "visibility_cuts.hpp"

namespace relight {

/// How the tree over the directions is built.
enum class TreeKind : std::uint8_t { geometric, data_driven };

/// The command line of lightcuts-relight with its defaults.
struct Options {
    enum class Action { help, version, prepare, render, view };

    Action action = Action::help;
    std::string help;  ///< the text to print when the action is `help`

    /// The scene, the camera and the picture's size, by the renderer's own options, and the output of either action.
    render::Options view;

    // prepare
    std::uint32_t directions = 32768;
    CutOptions cuts;
    double longest_edge = 0.0;  ///< to which the mesh is refined; 0: as it is
    TreeKind tree = TreeKind::geometric;
    double beta = 0.45;               ///< of a data-driven tree
    std::size_t bounce_points = 0;    ///< spread over the surface, for light that it reflects; 0: without
    double bounce_deviation = 0.002;  ///< steradians: largest L2 error of a cluster of patches

    // render and view
    std::filesystem::path cut_file;
    std::filesystem::path map;
    float map_scale = 1.0f;
    double rotation = 0.0;     ///< degrees
    MaterialChange materials;  ///< `is_diffuse` is that of `view`
    IlluminationOptions illumination;
    RelitOptions relit;
    bool with_bounce = true;  ///< if the file has one
    BounceOptions bounce;

    // render
    int frames = 1;
    double turn = 0.0;  ///< degrees from frame to frame
    std::optional<Truth> exhaustive;

    // view
    std::filesystem::path screenshot;  ///< empty: none
    double seconds = 0.0;              ///< after which the window closes; 0: when it is told to
    bool print_options = false;        ///< of each picture at rest
};

/// throws: render::usage_error, one line.
Options parse_options(int argc, const char* const* argv);

}  // namespace relight
