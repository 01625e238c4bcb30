#include "report/files.hpp"

#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "report/equal_time.hpp"
#include "statistics.hpp"

namespace benchmark {

namespace {

using Json = nlohmann::ordered_json;

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// A text field; names of scenes may have commas.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + "\"";
}

std::string csv_row(const ReportScene& scene, const std::string& method, const std::string& parameter,
                    const std::string& value, const Measurement& m) {
    std::ostringstream row;
    row << quoted(scene.name) << "," << scene.width << "," << scene.height << "," << scene.scene->light_count() << ","
        << quoted(method) << "," << quoted(parameter) << "," << value << "," << m.seconds << "," << m.prepare_seconds
        << "," << m.runs << "," << m.rays_per_pixel << "," << m.cut_size;
    const render::ErrorFigures& e = m.error;
    for (const double figure :
         {e.relative_rmse, e.relative_l1, e.relative_bias, e.max_relative, e.p999_relative, e.max_step, e.p999_step}) {
        row << ",";
        if (std::isfinite(figure)) row << figure;
    }
    row << "\n";
    return row.str();
}

Json measurement_json(const Measurement& m) {
    Json json;
    json["seconds"] = m.seconds;
    json["prepare_seconds"] = m.prepare_seconds;
    json["runs"] = m.runs;
    json["shadow_rays_per_pixel"] = m.rays_per_pixel;
    json["cut_size"] = m.cut_size;
    json["error"] = render::to_json(m.error);
    return json;
}

Json curve_json(const Curve& curve) {
    Json json;
    json["name"] = curve.method->name;
    json["method"] = curve.method->method;
    json["parameter"] = curve.method->parameter;
    for (const Measurement& m : curve.points) {
        Json point;
        point["value"] = m.value;
        point.update(measurement_json(m));
        json["points"].push_back(point);
    }
    return json;
}

Json figure_json(const EqualTime::Figure& figure) {
    Json json;
    json["lightcuts"] = finite_or_null(figure.lightcuts);
    json["best_other"] = figure.best_other ? finite_or_null(*figure.best_other) : Json(nullptr);
    json["other"] = figure.best_other ? Json(figure.other) : Json(nullptr);
    json["ratio"] = figure.ratio() ? finite_or_null(*figure.ratio()) : Json(nullptr);
    return json;
}

Json equal_time_json(const SceneMeasurement& scene) {
    Json rows = Json::array();
    for (const EqualTime& row : equal_times(scene)) {
        Json json;
        json["lightcuts"] = row.curve;
        json["seconds"] = row.seconds;
        json["exhaustive_seconds"] = row.exhaustive_seconds;
        json["reached"] = row.reached;
        json["relative_rmse"] = figure_json(row.relative_rmse);
        json["p999_relative"] = figure_json(row.p999_relative);
        json["p999_step"] = figure_json(row.p999_step);
        rows.push_back(json);
    }
    return rows;
}

}  // namespace

std::string to_csv(const Report& report) {
    std::string csv =
        "scene,width,height,lights,method,parameter,value,seconds,prepare_seconds,runs,shadow_rays_per_pixel,"
        "cut_size,relative_rmse,relative_l1,relative_bias,max_relative,p999_relative,max_step,p999_step\n";
    for (const SceneMeasurement& scene : report.scenes) {
        csv += csv_row(scene.scene, "exhaustive", "", "", scene.exhaustive);
        if (scene.unclamped) csv += csv_row(scene.scene, "exhaustive, not clamped", "", "", *scene.unclamped);
        for (const Curve& curve : scene.curves) {
            for (const Measurement& m : curve.points) {
                csv += csv_row(scene.scene, curve.method->name, curve.method->parameter, as_text(m.value), m);
            }
        }
    }
    return csv;
}

Json to_json(const Report& report) {
    Json json;
    const Machine& machine = report.machine;
    json["machine"] = {{"processor", machine.processor},
                       {"threads", machine.threads},
                       {"compiler", machine.compiler},
                       {"build", machine.build},
                       {"date", machine.date}};
    json["runs"] = report.options.runs;
    json["threads"] = report.options.threads;
    json["scenes"] = Json::array();
    for (const SceneMeasurement& measured : report.scenes) {
        const ReportScene& scene = measured.scene;
        Json entry;
        entry["name"] = scene.name;
        entry["size"] = {scene.width, scene.height};
        entry["triangles"] = scene.scene->triangles.size();
        entry["lights"] = scene.scene->light_count();
        entry["exhaustive"] = measurement_json(measured.exhaustive);
        if (measured.unclamped) entry["exhaustive_not_clamped"] = measurement_json(*measured.unclamped);
        for (const Curve& curve : measured.curves) entry["curves"].push_back(curve_json(curve));
        entry["equal_time"] = equal_time_json(measured);
        json["scenes"].push_back(entry);
    }
    return json;
}

}  // namespace benchmark
