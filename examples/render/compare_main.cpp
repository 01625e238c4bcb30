#include <cstdio>
#include <exception>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "error.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "picture.hpp"
#include "statistics.hpp"

namespace {

using namespace render;

/// Relative error that the heat map shows as white.
constexpr double heat_scale = 0.1;

void compare_files(const std::string& picture_path, const std::string& reference_path, const std::string& heat_path) {
    const Picture picture = read_exr(picture_path);
    const Picture reference = read_exr(reference_path);
    const ErrorFigures figures = compare(picture, reference);
    if (!heat_path.empty()) {
        OutputFile heat(heat_path);
        write_png(heat.path(), picture.width, picture.height, heat_map(picture, reference, heat_scale));
        heat.commit();
    }
    std::printf("%s\n", to_json(figures).dump(2).c_str());
}

}  // namespace

int main(int argc, char** argv) {
    std::string picture;
    std::string reference;
    std::string heat;
    CLI::App app("Prints how far picture A is from reference B, as JSON.", "lightcuts-compare");
    app.add_option("A", picture, "OpenEXR picture")->required();
    app.add_option("B", reference, "OpenEXR reference")->required();
    app.add_option("--out", heat, "PNG of the relative error of luminance, black (0) to white (10 % and more)");
    try {
        app.parse(argc, argv);
        compare_files(picture, reference, heat);
        return 0;
    } catch (const CLI::CallForHelp&) {
        std::fputs(app.help().c_str(), stdout);
        return 0;
    } catch (const CLI::ParseError& e) {
        std::fprintf(stderr, "lightcuts-compare: %s (--help lists the options)\n", one_line(e.what()).c_str());
        return 2;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "lightcuts-compare: %s\n", one_line(e.what()).c_str());
        return 1;
    }
}
