/// Error against run time of all methods on the same scenes. Writes error_vs_time.csv, .json and .html, one page with
/// plots and pictures, and prints how lightcuts compare with the best other method at equal time.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "io/escape.hpp"
#include "io/output_file.hpp"
#include "options.hpp"
#include "report/equal_time.hpp"
#include "report/files.hpp"
#include "report/page.hpp"
#include "report/plots.hpp"

namespace {

using namespace benchmark;

struct Arguments {
    ReportSceneOptions scenes;
    MeasurementOptions measurement;
    std::filesystem::path output = ".";
    bool svg = false;
};

/// A line on the terminal that says what is measured; none where there is no terminal.
class StatusLine {
public:
    explicit StatusLine(std::size_t settings) : settings_(settings), shown_(::isatty(STDERR_FILENO) == 1) {}
    ~StatusLine() { clear(); }
    StatusLine(const StatusLine&) = delete;
    StatusLine& operator=(const StatusLine&) = delete;

    void show(const std::string& text) {
        ++done_;
        if (!shown_) return;
        std::fprintf(stderr, "\r\033[K[%zu/%zu] %s", done_, settings_, text.c_str());
        std::fflush(stderr);
    }
    void clear() const {
        if (shown_) std::fputs("\r\033[K", stderr);
    }

private:
    std::size_t settings_;
    std::size_t done_ = 0;
    bool shown_;
};

std::string figure_text(const EqualTime::Figure& f) {
    char text[96];
    if (!f.best_other) {
        std::snprintf(text, sizeof text, "%8.2f %% %10s %-20s %7s", 100.0 * f.lightcuts, "", "none", "");
    } else {
        std::snprintf(text, sizeof text, "%8.2f %% %8.2f %% %-20s %7.3f", 100.0 * f.lightcuts, 100.0 * *f.best_other,
                      f.other.c_str(), *f.ratio());
    }
    return text;
}

void print_header(int name_width) {
    std::printf("At the time in which lightcuts reach a relative RMSE of 2 %%:\n");
    std::printf("%-*s %-28s %9s %9s | %-50s | 99.9th percentile\n", name_width, "", "", "", "exhaust.",
                "relative RMSE");
    std::printf("%-*s %-28s %9s %9s | %10s %-31s %7s | %10s %-31s %7s\n", name_width, "scene", "method", "seconds",
                "seconds", "lightcuts", "best other", "ratio", "lightcuts", "best other", "ratio");
    std::fflush(stdout);
}

void print_rows(const SceneMeasurement& scene, int name_width) {
    for (const EqualTime& row : equal_times(scene)) {
        std::printf("%-*s %-28s %9.4f %9.3f | %s | %s%s\n", name_width, scene.scene.name.c_str(), row.curve.c_str(),
                    row.seconds, row.exhaustive_seconds, figure_text(row.relative_rmse).c_str(),
                    figure_text(row.p999_relative).c_str(), row.reached ? "" : "  2 % not reached");
    }
    std::fflush(stdout);
}

/// Files of the report that appear together when all of them are complete.
class ReportOutput {
public:
    explicit ReportOutput(std::filesystem::path folder) : folder_(std::move(folder)) {}

    void add(const std::string& name, const std::string& text) {
        render::OutputFile& file = *files_.emplace_back(std::make_unique<render::OutputFile>(folder_ / name));
        std::ofstream stream(file.path(), std::ios::binary);
        stream << text;
        stream.close();
        if (!stream)
            throw lightcuts::invalid_input((folder_ / name).string() + ": cannot be written; is the disk full?");
    }

    void commit() {
        for (const auto& file : files_) file->commit();
    }

private:
    std::filesystem::path folder_;
    std::vector<std::unique_ptr<render::OutputFile>> files_;
};

/// `name` with what is unusual in file names replaced.
std::string file_name(const std::string& name) {
    std::string result;
    for (const char c : name) {
        const bool usual = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
        if (usual) {
            result += c;
        } else if (!result.empty() && result.back() != '-') {
            result += '-';
        }
    }
    return result;
}

void write(const Report& report, const Arguments& arguments) {
    ReportOutput output(arguments.output);
    output.add("error_vs_time.csv", to_csv(report));
    output.add("error_vs_time.json", to_json(report).dump(2) + "\n");
    output.add("error_vs_time.html", to_html(report));
    if (arguments.svg) {
        for (const SceneMeasurement& scene : report.scenes) {
            output.add("error_vs_time-" + file_name(scene.scene.name) + ".svg",
                       to_svg(plot_of(scene, PlotCost::seconds, PlotError::relative_rmse)));
        }
    }
    output.commit();
}

void run(const Arguments& arguments) {
    render::require_writable(arguments.output / "error_vs_time.html");
    const std::vector<ReportScene> scenes = load_report_scenes(arguments.scenes);
    std::size_t settings = 0;
    std::size_t name_width = 0;
    for (const ReportScene& scene : scenes) {
        settings += setting_count(scene, arguments.measurement);
        name_width = std::max(name_width, scene.name.size());
    }
    StatusLine status(settings);
    Report report{this_machine(), arguments.measurement, {}};
    print_header(static_cast<int>(name_width));
    for (const ReportScene& scene : scenes) {
        report.scenes.push_back(measure(scene, arguments.measurement,
                                        [&](const std::string& setting) { status.show(scene.name + ": " + setting); }));
        status.clear();
        print_rows(report.scenes.back(), static_cast<int>(name_width));
    }
    write(report, arguments);
    std::printf("written: %s and .csv, .json\n", (arguments.output / "error_vs_time.html").c_str());
}

int fail(int status, const std::string& message) {
    std::fprintf(stderr, "bench-error_vs_time: %s\n", render::one_line(message).c_str());
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app{"Error against run time of all methods, as CSV, JSON and one HTML page"};
    const CLI::Range sides(1, 1 << 14);
    app.add_option(
        "--scene", arguments.scenes.scenes,
        "glTF or OBJ file, seen by the cameras of the scene.json beside it, or builtin:NAME, and ?KEY=VALUE&... "
        "for its lights; repeatable (all built-ins)");
    app.add_option("--width", arguments.scenes.width, "of the pictures, pixels (as 160x90)")->check(sides);
    app.add_option("--height", arguments.scenes.height, "of the pictures, pixels")->check(sides);
    app.add_option("--area-points", arguments.scenes.area_points,
                   "lights per emissive surface where a scene does not say (64)");
    app.add_option("--runs", arguments.measurement.runs, "medians are over this odd number (3)")->check(odd_number());
    app.add_option("--threads", arguments.measurement.threads, "of rendering; seconds are summed over them (1)")
        ->check(CLI::Range(1, 4096));
    app.add_option("--output", arguments.output, "folder for the files (.)");
    app.add_flag("--svg", arguments.svg, "also write each scene's plot of RMSE over time as a file");
    app.add_flag("--quick", arguments.measurement.quick,
                 "every other setting, one run, one camera a scene, a quarter of the pixels");
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::fputs(app.help().c_str(), stdout);
        return 0;
    } catch (const CLI::ParseError& e) { return fail(2, std::string(e.what()) + " (--help lists the options)"); }
    if (arguments.scenes.scenes.empty()) arguments.scenes.scenes = builtin_report_scenes();
    if (arguments.measurement.quick) {
        arguments.measurement.runs = 1;
        arguments.scenes.first_camera = true;
        if (!arguments.scenes.width && !arguments.scenes.height) arguments.scenes.pixels /= 4;
    }
    try {
        run(arguments);
        return 0;
    } catch (const std::bad_alloc&) {
        return fail(1, "not enough memory; give a smaller --width or fewer scenes");
    } catch (const std::exception& e) { return fail(1, e.what()); }
}
