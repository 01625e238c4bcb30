#include "report/equal_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace benchmark {

namespace {

constexpr double wanted_error = 0.02;

/// Settings from fast to slow, each better than all faster ones.
void keep_best(std::vector<Effort>& settings) {
    std::sort(settings.begin(), settings.end(), [](const Effort& a, const Effort& b) { return a.seconds < b.seconds; });
    double least = std::numeric_limits<double>::infinity();
    std::erase_if(settings, [&](const Effort& e) {
        if (!(e.error < least)) return true;
        least = e.error;
        return false;
    });
}

/// y at x on the line through two points of log-log paper.
double interpolate(double x, double x0, double y0, double x1, double y1) {
    return y0 * std::pow(y1 / y0, std::log(x / x0) / std::log(x1 / x0));
}

double on_paper(double error) { return std::max(error, smallest_error); }

std::vector<Effort> efforts(const Curve& curve, double render::ErrorFigures::*figure) {
    std::vector<Effort> result;
    for (const Measurement& m : curve.points) result.push_back({m.seconds, m.error.*figure});
    return result;
}

/// The methods that the others are rivals of; the unified cut, a reference of the paper, is one of those.
bool is_lightcuts(const Curve& curve) {
    const std::string_view method = curve.method->method;
    return method == "lightcuts" || method == "multidimensional";
}

EqualTime::Figure figure_at(const SceneMeasurement& scene, const Curve& lightcuts, double seconds,
                            double render::ErrorFigures::*figure) {
    EqualTime::Figure result;
    result.lightcuts = error_at(efforts(lightcuts, figure), seconds).value_or(0.0);
    const auto offer = [&](const std::optional<double>& error, const char* name) {
        if (!error || (result.best_other && *result.best_other <= *error)) return;
        result.best_other = error;
        result.other = name;
    };
    offer(error_at({{scene.exhaustive.seconds, 0.0}}, seconds), "exhaustive");
    for (const Curve& curve : scene.curves) {
        if (!is_lightcuts(curve)) offer(error_at(efforts(curve, figure), seconds), curve.method->name);
    }
    return result;
}

}  // namespace

std::optional<double> error_at(std::vector<Effort> settings, double seconds) {
    keep_best(settings);
    const auto slower = std::find_if(settings.begin(), settings.end(),
                                     [&](const Effort& e) { return e.seconds > seconds; });
    if (slower == settings.begin()) return std::nullopt;
    const auto faster = slower - 1;
    if (slower == settings.end() || faster->seconds == seconds) return faster->error;
    return interpolate(seconds, faster->seconds, on_paper(faster->error), slower->seconds, on_paper(slower->error));
}

std::optional<double> time_of(std::vector<Effort> settings, double error) {
    keep_best(settings);
    const auto better = std::find_if(settings.begin(), settings.end(),
                                     [&](const Effort& e) { return e.error <= error; });
    if (better == settings.end()) return std::nullopt;
    if (better == settings.begin()) return better->seconds;
    const auto worse = better - 1;
    if (worse->error <= smallest_error) return better->seconds;
    return interpolate(on_paper(error), worse->error, worse->seconds, on_paper(better->error), better->seconds);
}

std::optional<double> EqualTime::Figure::ratio() const {
    if (!best_other) return std::nullopt;
    return *best_other > 0.0 ? lightcuts / *best_other : std::numeric_limits<double>::infinity();
}

std::vector<EqualTime> equal_times(const SceneMeasurement& scene) {
    using render::ErrorFigures;
    std::vector<EqualTime> rows;
    for (const Curve& curve : scene.curves) {
        if (!is_lightcuts(curve)) continue;
        std::vector<Effort> rmse = efforts(curve, &ErrorFigures::relative_rmse);
        const std::optional<double> seconds = time_of(rmse, wanted_error);
        keep_best(rmse);
        if (rmse.empty()) continue;
        EqualTime& row = rows.emplace_back();
        row.curve = curve.method->name;
        row.reached = seconds.has_value();
        row.seconds = seconds.value_or(rmse.back().seconds);
        row.exhaustive_seconds = scene.exhaustive.seconds;
        row.relative_rmse = figure_at(scene, curve, row.seconds, &ErrorFigures::relative_rmse);
        row.p999_relative = figure_at(scene, curve, row.seconds, &ErrorFigures::p999_relative);
        row.p999_step = figure_at(scene, curve, row.seconds, &ErrorFigures::p999_step);
    }
    return rows;
}

}  // namespace benchmark
