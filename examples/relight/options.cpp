#include "options.hpp"

#include <limits>

#include <CLI/CLI.hpp>
#include <render/io/escape.hpp>
#include <render/option_declaration.hpp>

#include "view_state.hpp"

namespace relight {

namespace {

using render::number_in;
using render::refuse;
using render::usage_error;

using Declaration = render::OptionDeclaration;

void declare_common(Declaration& app, Options& options) {
    app.isa("instruction set of the ray tracer: " + render::listed(render::isa_names()) + " (the best)",
            options.view.isa);
    app.threads(options.view.threads);
    app.number<std::uint64_t>("--seed", "N", "of all random choices (1)", 0, std::numeric_limits<std::uint64_t>::max(),
                              "a whole number of at least 0", options.view.seed);
}

void declare_prepare(CLI::App& command, Options& options) {
    command.set_help_flag("-h,--help", "print this text");
    Declaration app(command);
    app.text("scene", "SCENE", ".gltf, .glb, .obj or builtin:NAME",
             [&options](const std::string& s) { options.view.scene = s; })
        ->required();
    app.file("-o,--output", "the file of visibility cuts", options.view.output)->required();
    app.number<std::uint32_t>("--directions", "N", "directions of light (32768)", 16, 1u << 20,
                              "a whole number from 16 to 1048576", options.directions);
    app.number("--deviation", "S", "largest L2 error of a cluster of directions (1.5); 0: exact", 0.0, 1e6,
               "a number from 0 to 1e6", options.cuts.deviation);
    app.number("--edge", "LENGTH", "split edges of the mesh until none is longer (0: as they are)", 0.0, 1e30,
               "a length of at least 0", options.longest_edge);
    app.text("--sides", "front|both", "of surfaces that are seen; front: half of the rays (both)",
             [&options](const std::string& s) {
                 if (s != "front" && s != "both") refuse("--sides", s, "front or both");
                 options.cuts.sides = s == "front" ? Sides::front : Sides::both;
             });
    app.text("--tree", "geometric|data-driven", "over the directions (geometric)", [&options](const std::string& s) {
        if (s != "geometric" && s != "data-driven") refuse("--tree", s, "geometric or data-driven");
        options.tree = s == "geometric" ? TreeKind::geometric : TreeKind::data_driven;
    });
    app.number("--beta", "B", "share of geometry in a data-driven tree (0.45)", 0.0, 1.0, "a number from 0 to 1",
               options.beta);
    app.text("--bits", "8|16|32", "of a stored visibility (8)", [&options](const std::string& s) {
        using lightcuts::ValueBits;
        if (s != "8" && s != "16" && s != "32") refuse("--bits", s, "8, 16 or 32");
        options.cuts.bits = s == "8" ? ValueBits::eight : s == "16" ? ValueBits::sixteen : ValueBits::full;
    });
    app.text("--bounce", "off|N", "light that surfaces reflect once, of N points spread over them (off; alone: 16384)",
             [&options](const std::string& s) {
                 if (s == "off") {
                     options.bounce_points = 0;
                 } else {
                     options.bounce_points = s.empty()
                                                 ? std::size_t{16384}
                                                 : number_in<std::size_t>("--bounce", s, 16, 1u << 20,
                                                                          "off, or a whole number from 16 to 1048576");
                 }
             })
        ->expected(0, 1);
    app.number("--bounce-deviation", "S",
               "largest L2 error of a cluster of its points, in steradians (0.002); 0: exact", 0.0, 1e6,
               "a number from 0 to 1e6", options.bounce_deviation);
    declare_common(app, options);
    command.add_flag("--quiet", options.view.quiet, "print nothing but errors");
}

void declare_camera(Declaration& app, render::Options& view) {
    app.text("--size", "WxH", "of the picture, in pixels (640x480)",
             [&view](const std::string& s) { render::set_size(view, s); });
    app.number("--spp", "N", "eye rays a pixel (1)", 1, 1 << 10, "a whole number from 1 to 1024", view.spp);
    app.text("--camera", "NAME", "one of the scene's cameras (its first)",
             [&view](const std::string& s) { view.camera = s; });
    app.text("--eye", "X,Y,Z", "camera position",
             [&view](const std::string& s) { view.eye = render::vector_of("--eye", s); });
    app.text("--target", "X,Y,Z", "point the camera looks at",
             [&view](const std::string& s) { view.target = render::vector_of("--target", s); });
    app.text("--up", "X,Y,Z", "upwards in the picture (0,1,0)",
             [&view](const std::string& s) { view.up = glm::vec3(render::vector_of("--up", s)); });
    app.text("--fov", "DEG", "vertical field of view (45 with --eye, else the camera's)",
             [&view](const std::string& s) {
                 view.fov = number_in("--fov", s, 1e-3f, 179.0f, "degrees between 0.001 and 179");
             });
    app.text("--materials", "full|diffuse", "diffuse: Lambert with the base color everywhere (full)",
             [&view](const std::string& s) {
                 if (s != "full" && s != "diffuse") refuse("--materials", s, "full or diffuse");
                 view.diffuse_materials = s == "diffuse";
             });
}

/// What `render` and `view` have in common.
void declare_relit(Declaration& app, Options& options) {
    constexpr float huge = std::numeric_limits<float>::max();
    app.file("cuts", "what `prepare` wrote", options.cut_file)->required();
    app.text("--scene", "SCENE", "of which it was prepared",
             [&options](const std::string& s) { options.view.scene = s; })
        ->required();
    app.file("--env", "latitude-longitude map around the scene, .exr or .hdr", options.map)->required();
    app.number("--env-scale", "S", "times its radiance (1)", std::numeric_limits<float>::min(), huge,
               "a number above 0", options.map_scale);
    app.number("--rotate", "DEG", "of the map, counter-clockwise seen from above (0)", -1e6, 1e6, "degrees",
               options.rotation);
    app.number<std::size_t>("--illumination-size", "N", "clusters of the illumination cut, at most (256)", 1, 1u << 21,
                            "a whole number from 1 to 2097152", options.illumination.size);
    app.number("--cluster-angle", "DEG", "largest radius of a cluster, if the size allows it (15)", 0.0, 180.0,
               "degrees from 0 to 180", options.illumination.cluster_angle);
    app.number("--illumination-error", "R", "share of all light to which it is refined by error, then by value (0.01)",
               0.0, 1e6, "a number of at least 0", options.illumination.relative_error);
    app.number("--gloss-detail", "R", "largest radius of a cluster in a glossy lobe, as a share of its width (0.6)",
               0.01f, 100.0f, "a number from 0.01 to 100", options.relit.gloss_detail);
    app.text("--bounce", "on|off", "light that surfaces reflect once, if it was prepared (on)",
             [&options](const std::string& s) {
                 if (s != "on" && s != "off") refuse("--bounce", s, "on or off");
                 options.with_bounce = s == "on";
             });
    app.number<std::size_t>("--bounce-size", "N", "clusters of the cut of that light, at most (256)", 1, 1u << 21,
                            "a whole number from 1 to 2097152", options.bounce.size);
    declare_camera(app, options.view);
    app.number("--albedo", "S", "times what all surfaces reflect diffusely, at most 1 (1)", 0.0f, 1e3f,
               "a number from 0 to 1000", options.materials.albedo);
    app.number("--gloss-width", "S", "times the width of all glossy lobes (1)", 1e-3f, 1e3f,
               "a number from 0.001 to 1000", options.materials.gloss_width);
}

void declare_picture(Declaration& app, const std::string& help, render::Options& view) {
    app.text("-o,--output", "FILE", help, [&view](const std::string& s) {
        const std::filesystem::path path(s);
        if (!path.has_filename() || path.extension() == ".png" || path.extension() == ".json") {
            refuse("--output", s, "the name of an OpenEXR file; .png and .json are written beside it");
        }
        view.output = path;
    });
}

void declare_render(CLI::App& command, Options& options) {
    command.set_help_flag("-h,--help", "print this text");
    Declaration app(command);
    declare_relit(app, options);
    app.number("--frames", "N", "pictures, NAME-0000.exr and so on if there are several (1)", 1, 100000,
               "a whole number from 1 to 100000", options.frames);
    app.number("--turn", "DEG", "of the map from one frame to the next (0)", -1e6, 1e6, "degrees", options.turn);
    app.text(
        "--exhaustive", "pixels|vertices|none",
        "instead of cuts all directions one by one, with visibility from each pixel, from the vertices, or without",
        [&options](const std::string& s) {
            if (s != "pixels" && s != "vertices" && s != "none") {
                refuse("--exhaustive", s, "pixels, vertices or none");
            }
            options.exhaustive = s == "pixels" ? Truth::pixels : s == "vertices" ? Truth::vertices : Truth::none;
        });
    app.file("--reference", "OpenEXR picture to report the error of the first frame against", options.view.reference);
    declare_picture(app, "OpenEXR picture; .png and .json are written beside it (render.exr)", options.view);
    declare_common(app, options);
    command.add_flag("--quiet", options.view.quiet, "print nothing but errors");
}

void declare_view(CLI::App& command, Options& options) {
    command.set_help_flag("-h,--help", "print this text");
    command.footer(view_keys());
    Declaration app(command);
    declare_relit(app, options);
    declare_picture(app, "what S saves: NAME-0000.exr, .png and so on, by the next free number (render.exr)",
                    options.view);
    app.file("--screenshot", "PNG of the whole window once its picture is finished; then it closes",
             options.screenshot);
    app.number("--seconds", "S", "after which the window closes (0: when it is told to)", 0.0, 1e6,
               "a number from 0 to 1e6", options.seconds);
    command.add_flag("--print-options", options.print_options,
                     "print, for each finished picture, the options with which `render` makes the same; there are none "
                     "for the place of an orthographic camera");
    declare_common(app, options);
    command.add_flag("--quiet", options.view.quiet, "print nothing but errors and what --print-options asks for");
}

}  // namespace

Options parse_options(int argc, const char* const* argv) {
    Options options;
    CLI::App app("Visibility of a mesh once, then pictures under any light from around.", "lightcuts-relight");
    app.set_help_flag("-h,--help", "print this text");
    bool version = false;
    app.add_flag("--version", version, "print the version");
    CLI::App* const prepare = app.add_subcommand("prepare", "trace visibility at the vertices and keep it as cuts");
    CLI::App* const render = app.add_subcommand("render", "make pictures of it under a map");
    declare_prepare(*prepare, options);
    CLI::App* const view = app.add_subcommand("view",
                                              "show it under a map in a window, which answers to mouse and keys");
    declare_render(*render, options);
    declare_view(*view, options);
    app.require_subcommand(0, 1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        const CLI::App& asked = *(prepare->parsed()  ? prepare
                                  : render->parsed() ? render
                                  : view->parsed()   ? view
                                                     : &app);
        options.help = asked.help();
        return options;
    } catch (const CLI::ParseError& e) { throw usage_error(render::one_line(e.what())); }
    if (version) {
        options.action = Options::Action::version;
    } else if (prepare->parsed()) {
        options.action = Options::Action::prepare;
    } else if (render->parsed() || view->parsed()) {
        options.action = render->parsed() ? Options::Action::render : Options::Action::view;
        options.materials.is_diffuse = options.view.diffuse_materials;
        render::check_camera(options.view);
    } else {
        throw usage_error("nothing to do: give prepare, render or view");
    }
    return options;
}

}  // namespace relight
