#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <nlohmann/json.hpp>

#include "error.hpp"
#include "false_color.hpp"
#include "io/escape.hpp"
#include "io/output_file.hpp"
#include "io/picture.hpp"
#include "io/standard_streams.hpp"
#include "options.hpp"
#include "run_program.hpp"
#include "statistics.hpp"

namespace {

using namespace render;

struct CompareOptions {
    std::string picture;
    std::string reference;
    std::string layer;
    std::string out;
    double white = 0;  ///< 0: not given
};

void write_colors(const std::string& path, const Picture& picture, const std::vector<glm::vec3>& colors) {
    require_writable(path);
    write_png(path, picture.width, picture.height, colors);
}

/// throws: invalid_input if the output is one of the pictures that are read.
void require_outputs_apart(const CompareOptions& options) {
    for (const std::string& input : {options.picture, options.reference}) {
        if (!options.out.empty() && !input.empty()) require_apart(options.out, input);
    }
}

void compare_pictures(const CompareOptions& options) {
    /// Relative error that the heat map shows as white.
    constexpr double usual_white = 0.1;
    const Picture picture = read_exr(options.picture);
    const Picture reference = read_exr(options.reference);
    const ErrorFigures figures = compare(picture, reference);
    if (!options.out.empty()) {
        const double white = options.white > 0 ? options.white : usual_white;
        write_colors(options.out, picture, heat_map(picture, reference, white));
    }
    print(to_json(figures).dump(2) + "\n");
}

const std::vector<float>& layer_of(const Picture& picture, const CompareOptions& options) {
    if (const Picture::Channel* channel = picture.find(options.layer)) return channel->values;
    std::string names;
    for (const Picture::Channel& channel : picture.channels) names += (names.empty() ? "" : ", ") + channel.name;
    throw lightcuts::invalid_input(
        options.picture + ": no layer " + options.layer + "; " +
        (names.empty() ? "it has none, which lightcuts-render --aov writes" : "it has " + names));
}

void show_layer(const CompareOptions& options) {
    const Picture picture = read_exr(options.picture);
    const std::vector<float>& values = layer_of(picture, options);
    const LayerFigures figures = figures_of(values);
    const double white = options.white > 0 ? options.white : figures.max > 0 ? figures.max : 1.0;
    if (!options.out.empty()) {
        std::vector<glm::vec3> colors;
        colors.reserve(values.size());
        for (const float v : values) colors.push_back(false_color(static_cast<double>(v), white));
        write_colors(options.out, picture, colors);
    }
    nlohmann::ordered_json json;
    json["layer"] = as_utf8(options.layer);
    json["min"] = figures.min;
    json["mean"] = figures.mean;
    json["max"] = figures.max;
    json["white"] = white;
    print(json.dump(2) + "\n");
}

ExitStatus run(int argc, const char* const* argv) {
    CompareOptions options;
    CLI::App app(
        "Prints how far picture A is from reference B, as JSON; or what a layer of A holds.\n"
        "Pictures in false colors: black is 0, then blue, red, yellow and white, a quarter of the range each.",
        "lightcuts-compare");
    app.add_option("A", options.picture, "OpenEXR picture")->required();
    auto* reference = app.add_option("B", options.reference, "OpenEXR reference");
    auto* layer = app.add_option("--layer", options.layer, "show this layer of A, such as cut_size");
    app.add_option("--out", options.out, "PNG in false colors: of the relative error of luminance, or of the layer");
    auto* white = app.add_option("--white", options.white,
                                 "what is white in it (0.1, which is 10 %; of a layer its largest value)");
    layer->excludes(reference);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        print(app.help());
        return done;
    } catch (const CLI::ParseError& e) { throw usage_error(one_line(e.what())); }
    if (white->count() > 0 && !(options.white > 0 && std::isfinite(options.white))) {
        throw usage_error("--white: expected a finite number above 0");
    }
    if (options.layer.empty() && options.reference.empty()) {
        throw usage_error("a reference B, or --layer NAME, is required");
    }
    require_outputs_apart(options);
    if (options.layer.empty()) {
        compare_pictures(options);
    } else {
        show_layer(options);
    }
    return done;
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("lightcuts-compare", [&] { return run(argc, argv); });
}
