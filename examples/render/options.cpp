#include "options.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include "io/escape.hpp"
#include "option_declaration.hpp"
#include "pixel_filter.hpp"
#include "rays/ray_tracer.hpp"

namespace render {

namespace {

constexpr double longest_time = 1e6;  ///< seconds
constexpr std::uint32_t most_candidates = 65536;
constexpr std::uint32_t most_instants = 65536;  ///< as many as time vectors hold

const std::vector<std::string> methods = {
    "exhaustive", "lightcuts",       "multidimensional",   "unified-cut",         "ward", "power", "tree-sampling",
    "resampled",  "resampled-power", "adaptive-splitting", "stochastic-lightcuts"};
const std::vector<std::string> later_methods = {"reconstruction", "row-column"};
const std::vector<std::string> pair_sides = {"bounds", "sizes"};
const std::vector<std::string> bounds_modes = {"auto", "on", "off"};
const std::vector<std::string> builders = {"binned", "agglomerate", "longest-axis"};

bool contains(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

void set_sun(Options& options, const std::string& text) {
    const std::vector<std::string> parts = split(text, ',');
    const auto elevation = parts.size() == 2 ? to_number<double>(parts[0]) : std::nullopt;
    const auto azimuth = parts.size() == 2 ? to_number<double>(parts[1]) : std::nullopt;
    if (!elevation || !azimuth || *elevation < 0.0 || *elevation > 90.0) {
        refuse("--sun-sky", text,
               "ELEVATION,AZIMUTH in degrees; the elevation from 0 to 90, the sky ends at the horizon");
    }
    options.sun_sky = {.elevation = *elevation, .azimuth = *azimuth};
}

void set_method(Options& options, const std::string& name) {
    if (contains(later_methods, name)) {
        throw usage_error("--method " + name + ": comes with a later version; this one has " + listed(methods));
    }
    if (!contains(methods, name)) refuse("--method", name, "one of " + listed(methods));
    options.method = name;
}

void set_aovs(Options& options, const std::string& text) {
    for (const std::string& name : split(text, ',')) {
        if (!contains(aov_names(), name)) refuse("--aov", text, "a comma-separated list of " + listed(aov_names()));
        if (!options.has_aov(name)) options.aovs.push_back(name);
    }
}

void set_output(Options& options, const std::string& text) {
    const std::filesystem::path path(text);
    if (path.extension() == ".png" || path.extension() == ".json" || path.extension() == ".resume") {
        refuse("--output", text,
               "the name of an OpenEXR file; .png, .json and .resume of the same stem are written beside it");
    }
    if (!path.has_filename()) refuse("--output", text, "a file name");
    options.output = path;
}

/// `ratio`: if it was given.
void set_clamp(Options& options, const std::string& mode, std::optional<float> ratio) {
    if (mode != "auto") {
        if (ratio) throw usage_error("--clamp-ratio goes with --clamp auto: leave it out with --clamp " + mode);
        options.clamp = {};
        if (mode != "off") {
            options.clamp.radiance = number_in("--clamp", mode, 0.0f, std::numeric_limits<float>::max(),
                                               "auto, off or a number of at least 0");
        }
    }
    if (ratio) options.clamp.ratio = *ratio;
}

void check_together(const Options& options) {
    check_camera(options);
    if (options.visibility_bounds == "on" && options.method != "lightcuts") {
        throw usage_error("--visibility-bounds on goes with --method lightcuts, not " + options.method);
    }
    if (options.learn_visibility && options.method != "lightcuts") {
        throw usage_error("--learn-visibility goes with --method lightcuts, not " + options.method);
    }
    if (options.learn_visibility && options.visibility_bounds == "on") {
        throw usage_error("--learn-visibility goes without --visibility-bounds on: what is proved need not be learned");
    }
    if (options.has_aov("expected_error") && !options.learn_visibility) {
        throw usage_error("--aov expected_error needs --learn-visibility: nothing else is expected than error_bound");
    }
    if (options.focus && options.aperture == 0.0f) throw usage_error("--focus needs --aperture: a pinhole is sharp");
}

}  // namespace

bool Options::is_given(const std::string& name) const { return contains(given, name); }

bool Options::has_aov(const std::string& name) const { return contains(aovs, name); }

bool Options::sums_pixels() const { return method == "multidimensional" || method == "unified-cut"; }

lightcuts::ClampingOptions Options::clamping() const {
    if (sums_pixels() && is_clamp_given() && clamp.is_automatic()) return clamp;
    return contains(clamping_methods(), method) ? clamp : lightcuts::ClampingOptions{};
}

const std::vector<std::string>& clamping_methods() {
    static const std::vector<std::string> names = {"exhaustive", "lightcuts"};
    return names;
}

const std::vector<std::string>& aov_names() {
    static const std::vector<std::string> names = {"cut_size",       "shadow_rays", "hidden_share",
                                                   "gather_points",  "instants",    "error_bound",
                                                   "expected_error", "depth",       "normal"};
    return names;
}

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

Options parse_options(int argc, const char* const* argv) {
    constexpr float huge = std::numeric_limits<float>::max();
    constexpr std::uint32_t many = std::numeric_limits<std::uint32_t>::max() / 4;

    Options options;
    CLI::App app("Renders a scene lit by many lights.", "lightcuts-render");
    app.set_help_flag("-h,--help", "print this text");
    bool version = false;
    bool list_scenes = false;

    OptionDeclaration declare(app);
    const auto text = [&declare](const std::string& names, const std::string& type, const std::string& help,
                                 std::function<void(const std::string&)> set) {
        return declare.text(names, type, help, std::move(set));
    };
    const auto count = [&text](const std::string& name, const std::string& help, std::uint32_t lowest,
                               std::uint32_t highest, std::uint32_t& value) {
        const std::string wanted = "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest);
        return text(name, "N", help, [=, &value](const std::string& s) {
            value = number_in<std::uint32_t>(name, s, lowest, highest, wanted);
        });
    };

    app.add_option("SCENE", options.scene, "glTF 2.0 (.gltf, .glb), OBJ, or builtin:NAME (builtin:hall)");
    app.add_flag("--list-scenes", list_scenes, "print the built-in scenes");
    app.add_flag("--version", version, "print the version");

    text("-o,--output", "FILE", "OpenEXR picture (render.exr); a .png and a .json go beside it",
         [&](const std::string& s) { set_output(options, s); });
    text("--size", "WxH", "pixels (640x480)", [&](const std::string& s) { set_size(options, s); });
    text("--spp", "N", "eye rays a pixel (1)", [&](const std::string& s) {
        options.spp = number_in<int>("--spp", s, 1, 1 << 16, "a whole number from 1 to 65536");
    });
    text("--camera", "NAME", "one of the scene's cameras (its first)",
         [&](const std::string& s) { options.camera = s; });
    text("--eye", "X,Y,Z", "camera position", [&](const std::string& s) { options.eye = vector_of("--eye", s); });
    text("--target", "X,Y,Z", "point the camera looks at",
         [&](const std::string& s) { options.target = vector_of("--target", s); });
    text("--up", "X,Y,Z", "upwards in the picture (0,1,0)",
         [&](const std::string& s) { options.up = glm::vec3(vector_of("--up", s)); });
    text("--fov", "DEG", "vertical field of view (45 with --eye, else the camera's)", [&](const std::string& s) {
        options.fov = number_in("--fov", s, 1e-3f, 179.0f, "degrees between 0.001 and 179");
    });
    text("--shutter", "S", "seconds for which the shutter is open (0: nothing moves)", [&](const std::string& s) {
        options.shutter.seconds = number_in("--shutter", s, 0.0, longest_time, "seconds from 0 to 1e6");
    });
    count("--instants", "moments while it is open at which eye rays and lights are (1)", 1, most_instants,
          options.shutter.instants);
    text("--shutter-shape", "gaussian|box", "how light comes in while it is open (gaussian)",
         [&](const std::string& s) {
             if (s != "gaussian" && s != "box") refuse("--shutter-shape", s, "gaussian or box");
             options.shutter.shape = s == "box" ? ShutterShape::box : ShutterShape::gaussian;
         });
    text("--time", "S", "second of the scene's clock at which the shutter opens (0)", [&](const std::string& s) {
        options.shutter.opens = number_in("--time", s, -longest_time, longest_time, "seconds from -1e6 to 1e6");
    });
    text("--method", "NAME", listed(methods) + " (lightcuts)", [&](const std::string& s) { set_method(options, s); });
    text("--error-ratio", "R", "largest error of a cluster as a share of the total (0.02)", [&](const std::string& s) {
        options.error_ratio = number_in("--error-ratio", s, 0.0f, huge, "a number of at least 0");
    });
    count("--max-cut", "largest cut (1000); 0: unlimited; never below the number of trees", 0, many, options.max_cut);
    count("--representatives", "representatives of each cluster (1)", 1, 32, options.representatives);
    text("--adaptation", "VALUE|auto", "radiance the eye is adapted to; a tenth is added to the total (0)",
         [&](const std::string& s) {
             options.adaptation.reset();
             if (s != "auto") {
                 options.adaptation = number_in("--adaptation", s, 0.0f, huge, "a number of at least 0, or auto");
             }
         });
    app.add_flag("--learn-visibility", options.learn_visibility,
                 "with --method lightcuts: refine less what is hidden from points of a coarse picture");
    count("--samples", "light samples of the sampling methods (64)", 1, many, options.samples);
    count("--candidates", "lights drawn for each sample that the resampling methods keep (32)", 1, most_candidates,
          options.candidates);
    text("--ward-threshold", "R", "share of the total that Ward's method may leave untested (0.1)",
         [&](const std::string& s) {
             options.ward_threshold = number_in("--ward-threshold", s, 0.0f, huge, "a number of at least 0");
         });
    text("--splitting-threshold", "R", "deviation within a cluster from which adaptive splitting splits it (0.1)",
         [&](const std::string& s) {
             options.splitting_threshold = number_in("--splitting-threshold", s, 0.0f, huge, "a number of at least 0");
         });
    declare.choice("--builder", "NAME", "how light trees are built: " + listed(builders) + " (" + options.builder + ")",
                   builders, options.builder);
    declare.choice("--visibility-bounds", "auto|on|off",
                   "prove that clusters are hidden: where a pilot says that it pays, always, never (" +
                       options.visibility_bounds + ")",
                   bounds_modes, options.visibility_bounds);
    declare.choice("--pair-sides", "NAME",
                   "which side of a pair of clusters is split: " + listed(pair_sides) + " (" + options.pair_sides + ")",
                   pair_sides, options.pair_sides);
    text("--lights", "FILE", "more lights, CSV: kind,x,y,z,dx,dy,dz,r,g,b", [&](const std::string& s) {
        if (s.empty()) refuse("--lights", "''", "a file name");
        options.lights = s;
    });
    count("--area-points", "lights per emissive surface or sphere, at most (64); 0 leaves them out", 0, many,
          options.area_points);
    text("--area-lights", "N",
         "about the most lights on all emissive surfaces together, 0: any number (200000 if there are more than 3125)",
         [&](const std::string& s) {
             options.area_lights = number_in<std::uint32_t>("--area-lights", s, 0, many,
                                                            "a whole number from 0 to " + std::to_string(many));
         });
    text("--env", "FILE", "latitude-longitude map around the scene, .exr or .hdr", [&](const std::string& s) {
        if (s.empty()) refuse("--env", "''", "a file name");
        options.env = s;
    });
    count("--env-lights", "distant lights that stand for it (3000); 0: it is only seen", 0, many, options.env_lights);
    text("--env-scale", "S", "times its radiance (1)", [&](const std::string& s) {
        options.env_scale = number_in("--env-scale", s, std::numeric_limits<float>::min(), huge, "a number above 0");
    });
    text("--env-rotate", "DEG", "counter-clockwise seen from above (0)",
         [&](const std::string& s) { options.env_rotate = number_in("--env-rotate", s, -huge, huge, "degrees"); });
    text("--sun-sky", "ELEVATION,AZIMUTH", "sun and clear sky; degrees, azimuth from +z to +x",
         [&](const std::string& s) { set_sun(options, s); });
    text("--turbidity", "T", "haze of the sky, 2 (very clear) to 10 (3)", [&](const std::string& s) {
        options.turbidity = number_in("--turbidity", s, 2.0f, 10.0f, "a number from 2 to 10");
    });
    count("--sky-lights", "distant lights that stand for the sky (5000); 0: it is only seen", 0, many,
          options.sky_lights);
    text("--ground", "ALBEDO", "of the ground below the horizon, which sun and sky light (0.2); 0: black",
         [&](const std::string& s) { options.ground = number_in("--ground", s, 0.0f, 1.0f, "a number from 0 to 1"); });
    count("--indirect", "about so many virtual lights for indirect light (0, or the scene's own)", 0, many,
          options.indirect);
    std::string clamp = "auto";
    std::optional<float> clamp_ratio;
    text("--clamp", "auto|off|VALUE", "most radiance that a virtual light adds at a point (auto: of its total)",
         [&](const std::string& s) { clamp = s; });
    text("--clamp-ratio", "R", "that share of a point's total (0.01)", [&](const std::string& s) {
        clamp_ratio = number_in("--clamp-ratio", s, std::numeric_limits<float>::min(), std::nextafter(1.0f, 0.0f),
                                "a number above 0 and below 1");
    });
    text("--fog", "SIGMA", "extinction of a uniform medium in the scene's box, per unit of length (0)",
         [&](const std::string& s) { options.fog = number_in("--fog", s, 0.0f, huge, "a number of at least 0"); });
    text("--fog-albedo", "A", "share of the light that fog scatters (0.9)", [&](const std::string& s) {
        options.fog_albedo = number_in("--fog-albedo", s, 0.0f, 1.0f, "a number from 0 to 1");
    });
    text("--fog-anisotropy", "G", "mean cosine of its scattering, forward above 0 (0)", [&](const std::string& s) {
        options.fog_anisotropy = number_in("--fog-anisotropy", s, -0.999f, 0.999f, "a number from -0.999 to 0.999");
    });
    text("--aperture", "D", "diameter of the lens, in units of the scene (0: a pinhole)", [&](const std::string& s) {
        options.aperture = number_in("--aperture", s, 0.0f, huge, "a number of at least 0");
    });
    text("--focus", "D", "distance of what is sharp (the target's)", [&](const std::string& s) {
        options.focus = number_in("--focus", s, std::numeric_limits<float>::min(), huge, "a number above 0");
    });
    declare.choice("--filter", "NAME", "of pixels: " + listed(pixel_filters()) + " (box)", pixel_filters(),
                   options.filter);
    text("--materials", "full|diffuse", "diffuse: Lambert with the base color everywhere (full)",
         [&](const std::string& s) {
             if (s != "full" && s != "diffuse") refuse("--materials", s, "full or diffuse");
             options.diffuse_materials = s == "diffuse";
         });
    text("--reference", "FILE", "OpenEXR picture to report the error against", [&](const std::string& s) {
        if (s.empty()) refuse("--reference", "''", "a file name");
        options.reference = s;
    });
    text("--aov", "LIST", "further layers, comma-separated: " + listed(aov_names()),
         [&](const std::string& s) { set_aovs(options, s); });
    declare.isa("instruction set of the ray tracer: " + listed(isa_names()) + " (the best)", options.isa);
    declare.threads(options.threads);
    text("--seed", "N", "of all random choices (1)", [&](const std::string& s) {
        options.seed = number_in<std::uint64_t>("--seed", s, 0, std::numeric_limits<std::uint64_t>::max(),
                                                "a whole number of at least 0");
    });
    app.add_flag("--resume", options.resume, "go on with the interrupted picture that --output names");
    app.add_flag("--quiet", options.quiet, "print nothing but errors");

    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        options.action = Options::Action::help;
        options.help = app.help();
        return options;
    } catch (const CLI::ParseError& e) { throw usage_error(one_line(e.what())); }
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() == 0) continue;
        options.given.push_back(option->get_name());
        options.given_texts.push_back(listed(option->results()));
    }
    if (version) options.action = Options::Action::version;
    if (list_scenes) options.action = Options::Action::list_scenes;
    set_clamp(options, clamp, clamp_ratio);
    check_together(options);
    return options;
}

}  // namespace render
