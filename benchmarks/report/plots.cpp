#include "report/plots.hpp"

#include "report/equal_time.hpp"

namespace benchmark {

namespace {

double cost_of(const Measurement& m, PlotCost cost) { return cost == PlotCost::seconds ? m.seconds : m.rays_per_pixel; }

double error_of(const Measurement& m, PlotError error) {
    switch (error) {
        case PlotError::relative_rmse: return m.error.relative_rmse;
        case PlotError::p999_relative: return m.error.p999_relative;
        case PlotError::p999_step: return m.error.p999_step;
    }
    return 0.0;
}

const char* name_of(PlotError error) {
    switch (error) {
        case PlotError::relative_rmse: return "relative RMSE";
        case PlotError::p999_relative: return "99.9th percentile of the pixels' relative error";
        case PlotError::p999_step: return "99.9th percentile of steps between neighbors";
    }
    return "";
}

}  // namespace

Plot plot_of(const SceneMeasurement& scene, PlotCost cost, PlotError error) {
    Plot plot;
    plot.title = scene.scene.name;
    plot.x_title = cost == PlotCost::seconds ? "processor seconds" : "shadow rays a pixel";
    plot.y_title = name_of(error);
    plot.least_y = smallest_error;
    plot.mark = PlotMark{cost_of(scene.exhaustive, cost), "exhaustive sum"};
    for (const Curve& curve : scene.curves) {
        PlotCurve& drawn = plot.curves.emplace_back();
        drawn.name = std::string(curve.method->name) + " (" + curve.method->parameter + ")";
        for (const Measurement& m : curve.points) {
            drawn.points.push_back({cost_of(m, cost), error_of(m, error), as_text(m.value)});
        }
    }
    return plot;
}

}  // namespace benchmark
