#include "report/page.hpp"

#include <cmath>
#include <cstdio>
#include <string_view>

#include "report/equal_time.hpp"
#include "report/pictures.hpp"
#include "report/plots.hpp"

namespace benchmark {

namespace {

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Error against run time</title>
<style>
body { font-family: sans-serif; max-width: 1480px; margin: 1em auto; padding: 0 1em; color: #222; background: #fff; }
table { border-collapse: collapse; margin: 0.5em 0; }
th, td { padding: 0.15em 0.7em; text-align: right; border-bottom: 1px solid #ddd; font-size: 90%; }
th:first-child, td:first-child, td.text { text-align: left; }
figure { display: inline-block; margin: 0 0.6em 0.8em 0; vertical-align: top; }
figure img { display: block; image-rendering: pixelated; width: 320px; }
figcaption { font-size: 80%; max-width: 320px; }
svg { max-width: 100%; height: auto; }
</style></head><body>
<h1>Error against run time</h1>
)";

constexpr const char* explanation = R"(<p>Times are processor seconds of a method's own work, summed over threads:
eye rays, which are the same for all, and building trees are not in them. Errors are against the exhaustive sum, and of reflected light: emitters and the background in view are left out.
Lightcuts clamp virtual lights, and so does their exhaustive sum; methods that do not are compared with the sum that does not.
A curve has one point for each value of its method's parameter; errors below 0.01&nbsp;% are drawn at 0.01&nbsp;%.
Steps are differences of luminance between neighboring pixels that the reference does not have, relative to the
brighter of the two. Of methods without clusters, the cut size is the number of lights that are tested.</p>
)";

std::string digits(double value, int count = 3) {
    if (!std::isfinite(value)) return "&infin;";
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", count, value);
    // Powers of ten as people write numbers.
    if (std::string_view(text).find('e') != std::string_view::npos && std::abs(value) >= 1.0) {
        std::snprintf(text, sizeof text, "%.0f", value);
    }
    return text;
}

std::string percent(double share) { return std::isfinite(share) ? digits(100.0 * share) + "&nbsp;%" : "&infin;"; }

std::string cells(const std::vector<std::string>& row, const char* tag = "td") {
    std::string html = "<tr>";
    for (const std::string& cell : row) html += std::string("<") + tag + ">" + cell + "</" + tag + ">";
    return html + "</tr>\n";
}

std::string figure_cell(const EqualTime::Figure& f) {
    const std::string other = f.best_other ? percent(*f.best_other) + " (" + escaped(f.other) + ")" : "none as fast";
    const std::string ratio = f.ratio() ? "; " + digits(*f.ratio()) : "";
    return percent(f.lightcuts) + " : " + other + ratio;
}

std::string equal_time_table(const Report& report) {
    std::string html =
        "<h2>At equal time</h2>\n<p>At the time in which lightcuts reach a relative RMSE of 2&nbsp;%: "
        "their error : the least error of any other method in that time; the quotient.</p>\n<table>\n";
    html += cells({"scene", "lightcuts", "seconds", "exhaustive", "relative RMSE", "99.9th percentile",
                   "steps, 99.9th percentile"},
                  "th");
    for (const SceneMeasurement& scene : report.scenes) {
        for (const EqualTime& row : equal_times(scene)) {
            html += cells({escaped(scene.scene.name), escaped(row.curve) + (row.reached ? "" : " (2 % not reached)"),
                           digits(row.seconds), digits(row.exhaustive_seconds), figure_cell(row.relative_rmse),
                           figure_cell(row.p999_relative), figure_cell(row.p999_step)});
        }
    }
    return html + "</table>\n";
}

std::vector<std::string> figures_row(const std::string& method, const std::string& setting, const Measurement& m) {
    const render::ErrorFigures& e = m.error;
    return {escaped(method),
            setting,
            digits(m.seconds),
            digits(m.prepare_seconds),
            digits(m.rays_per_pixel, 4),
            digits(m.cut_size, 4),
            percent(e.relative_rmse),
            percent(e.relative_l1),
            percent(e.p999_relative),
            percent(e.max_step),
            percent(e.p999_step)};
}

std::string figures_table(const SceneMeasurement& scene) {
    std::string html = "<details><summary>All figures</summary>\n<table>\n";
    html += cells({"method", "parameter", "seconds", "trees", "rays a pixel", "cut size", "relative RMSE",
                   "relative L1", "99.9th percentile", "worst step", "steps, 99.9th"},
                  "th");
    html += cells(figures_row("exhaustive", "", scene.exhaustive));
    if (scene.unclamped) html += cells(figures_row("exhaustive, not clamped", "", *scene.unclamped));
    for (const Curve& curve : scene.curves) {
        for (const Measurement& m : curve.points) {
            html += cells(figures_row(curve.method->name, as_text(m.value), m));
        }
    }
    return html + "</table></details>\n";
}

std::string plots(const SceneMeasurement& scene) {
    std::string html;
    for (const PlotError error : {PlotError::relative_rmse, PlotError::p999_relative, PlotError::p999_step}) {
        const bool first = error == PlotError::relative_rmse;
        if (error == PlotError::p999_relative) html += "<details><summary>Other errors</summary>\n";
        html += to_svg(plot_of(scene, PlotCost::seconds, error));
        html += to_svg(plot_of(scene, PlotCost::shadow_rays, error));
        if (first) html += "<br>\n";
    }
    return html + "</details>\n";
}

std::string section(const SceneMeasurement& measured) {
    const ReportScene& scene = measured.scene;
    return "<h2>" + escaped(scene.name) + "</h2>\n<p>" + std::to_string(scene.scene->light_count()) + " lights, " +
           std::to_string(scene.scene->triangles.size()) + " triangles, " + std::to_string(scene.width) + " x " +
           std::to_string(scene.height) + " pixels.</p>\n" + plots(measured) + pictures_html(measured) +
           figures_table(measured);
}

}  // namespace

std::string to_html(const Report& report) {
    std::string html = head;
    const MeasurementOptions& options = report.options;
    html += "<p>" + escaped(to_text(report.machine)) + ". Rendered by " + std::to_string(options.threads) +
            (options.threads == 1 ? " thread" : " threads") + "; medians of " + std::to_string(options.runs) +
            (options.runs == 1 ? " run" : " runs") + ", of one for what takes seconds.</p>\n";
    html += explanation;
    html += equal_time_table(report);
    for (const SceneMeasurement& scene : report.scenes) html += section(scene);
    return html + "</body></html>\n";
}

}  // namespace benchmark
