#include "statistics.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

#include <nlohmann/json.hpp>

#include "io/escape.hpp"
#include "memory.hpp"
#include "motion.hpp"

namespace render {

namespace {

using Json = nlohmann::ordered_json;

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double per(double sum, std::uint64_t count) { return count > 0 ? sum / static_cast<double>(count) : 0.0; }

/// A float's shortest decimal form, 0.02 rather than 0.0199999996.
double as_written(float value) {
    std::ostringstream text;
    text << std::setprecision(7) << value;
    return std::stod(text.str());
}

Json to_json(const glm::vec3& v) { return {as_written(v.x), as_written(v.y), as_written(v.z)}; }
Json to_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json path_or_null(const std::filesystem::path& path) {
    return path.empty() ? Json(nullptr) : Json(as_utf8(path.string()));
}

Json options_json(const RunReport& report) {
    const Options& o = report.options;
    Json json;
    json["output"] = as_utf8(o.output.string());
    json["camera"] = o.camera.empty() ? Json(nullptr) : Json(as_utf8(o.camera));
    json["eye"] = o.eye ? to_json(*o.eye) : Json(nullptr);
    json["target"] = o.target ? to_json(*o.target) : Json(nullptr);
    json["up"] = o.up ? to_json(*o.up) : Json(nullptr);
    json["fov"] = o.fov ? Json(as_written(*o.fov)) : Json(nullptr);
    json["time"] = o.shutter.opens;
    json["shutter"] = o.shutter.seconds;
    json["instants"] = o.shutter.instants;
    json["shutter_shape"] = name_of(o.shutter.shape);
    json["error_ratio"] = as_written(o.error_ratio);
    json["max_cut"] = o.max_cut;
    json["representatives"] = o.representatives;
    json["adaptation"] = as_written(report.adaptation);
    json["learn_visibility"] = o.learn_visibility;
    json["samples"] = o.samples;
    json["ward_threshold"] = as_written(o.ward_threshold);
    json["candidates"] = o.candidates;
    json["splitting_threshold"] = as_written(o.splitting_threshold);
    json["builder"] = o.builder;
    json["visibility_bounds"] = o.visibility_bounds;
    json["pair_sides"] = o.pair_sides;
    json["lights"] = path_or_null(o.lights);
    json["area_points"] = o.area_points;
    json["area_lights"] = o.area_lights ? Json(*o.area_lights) : Json(nullptr);
    json["env"] = path_or_null(o.env);
    json["env_lights"] = o.env_lights;
    json["env_scale"] = as_written(o.env_scale);
    json["env_rotate"] = as_written(o.env_rotate);
    json["sun_sky"] = o.sun_sky ? Json{o.sun_sky->elevation, o.sun_sky->azimuth} : Json(nullptr);
    json["turbidity"] = as_written(o.turbidity);
    json["sky_lights"] = o.sky_lights;
    json["ground"] = as_written(o.ground);
    json["indirect"] = o.indirect;
    const lightcuts::ClampingOptions clamp = o.clamping();
    json["clamp"] = clamp.is_automatic()    ? Json("auto")
                    : clamp.has_threshold() ? Json(as_written(clamp.radiance))
                                            : Json("off");
    json["clamp_ratio"] = clamp.is_automatic() ? Json(as_written(clamp.ratio)) : Json(nullptr);
    json["fog"] = as_written(o.fog);
    json["fog_albedo"] = as_written(o.fog_albedo);
    json["fog_anisotropy"] = as_written(o.fog_anisotropy);
    json["aperture"] = as_written(o.aperture);
    json["focus"] = o.focus ? Json(as_written(*o.focus)) : Json(nullptr);
    json["filter"] = o.filter;
    json["materials"] = o.diffuse_materials ? "diffuse" : "full";
    json["isa"] = o.isa.empty() ? Json(nullptr) : Json(o.isa);
    json["reference"] = path_or_null(o.reference);
    json["aov"] = o.aovs;
    return json;
}

/// What moves while the shutter is open; null if nothing does.
Json motion_json(const Scene& scene) {
    if (scene.is_still()) return nullptr;
    std::size_t triangles = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) triangles += moves(scene, t) ? 1 : 0;
    const LightsAtInstants& lights = scene.at_instants;
    return {{"instants", scene.instants.size()},
            {"triangles", triangles},
            {"lights", lights.count() - lights.virtual_count()}};
}

/// How virtual lights were clamped; null if there are none.
Json clamp_json(const RunReport& report) {
    if (report.scene.virtual_count() == 0) return nullptr;
    const lightcuts::ClampingOptions clamp = report.options.clamping();
    const RenderStatistics& s = report.statistics;
    Json json;
    json["mode"] = clamp.is_automatic() ? "auto" : clamp.has_threshold() ? "value" : "off";
    json["ratio"] = clamp.is_automatic() ? Json(as_written(clamp.ratio)) : Json(nullptr);
    json["threshold"] = nullptr;
    if (s.clamp_thresholds > 0) {
        json["threshold"] = {{"mean", per(s.clamp_threshold_sum, s.clamp_thresholds)},
                             {"min", s.least_clamp_threshold},
                             {"max", s.largest_clamp_threshold}};
    }
    return json;
}

/// What was proved to be hidden.
Json proofs_json(const RunReport& report) {
    const RenderStatistics& s = report.statistics;
    const ProofUse& use = report.proofs;
    return {{"used", use.used},
            {"pilot_ratio", use.pilot_ratio ? finite_or_null(*use.pilot_ratio) : Json(nullptr)},
            {"hidden_share", per(static_cast<double>(s.hidden), s.cut_nodes)}};
}

/// What was learned from, as a share of all shadow rays; null if nothing was.
Json learning_json(const RunReport& report, std::uint64_t shadow_rays) {
    if (!report.options.learn_visibility) return nullptr;
    const auto own = static_cast<double>(report.learning.shadow_rays);
    return {{"pilots", report.learning.pilots},
            {"shadow_rays", report.learning.shadow_rays},
            {"share", per(own, shadow_rays)}};
}

}  // namespace

Json to_json(const ErrorFigures& figures) {
    Json json;
    json["relative_rmse"] = finite_or_null(figures.relative_rmse);
    json["relative_l1"] = finite_or_null(figures.relative_l1);
    json["relative_bias"] = finite_or_null(figures.relative_bias);
    json["max_relative"] = finite_or_null(figures.max_relative);
    json["p999_relative"] = finite_or_null(figures.p999_relative);
    json["max_step"] = finite_or_null(figures.max_step);
    json["p999_step"] = finite_or_null(figures.p999_step);
    return json;
}

Json to_json(const RunReport& report) {
    const Options& o = report.options;
    const Scene& scene = report.scene;
    const RenderStatistics& s = report.statistics;
    Json json;
    json["scene"] = as_utf8(o.scene);
    json["method"] = o.method;
    json["size"] = {o.width, o.height};
    json["spp"] = o.spp;
    json["seed"] = o.seed;
    json["threads"] = report.threads;
    json["ray_tracer"] = {{"version", report.ray_tracer.version()}, {"isa", report.ray_tracer.isa()}};
    json["interrupted"] = report.interrupted;
    json["picture"] = as_utf8(report.picture.string());
    json["resumed_tiles"] = report.resumed_tiles;
    json["triangles"] = scene.triangles.size();
    const std::size_t of_file = scene.directional.size() - scene.environment_lights - scene.sun_lights -
                                scene.sky_lights - scene.ground_lights;
    json["lights"] = {{"omni", scene.omni.size()},
                      {"oriented", scene.oriented.size()},
                      {"spot", scene.spots.size()},
                      {"directional", of_file},
                      {"sphere", scene.sphere_points.size()},
                      {"environment", scene.environment_lights},
                      {"sun", scene.sun_lights},
                      {"sky", scene.sky_lights},
                      {"ground", scene.ground_lights},
                      {"virtual", scene.virtual_count()}};
    json["motion"] = motion_json(scene);
    json["seconds"] = {{"load", report.seconds.load},
                       {"particles", report.seconds.particles},
                       {"tree", report.seconds.tree},
                       {"render", report.seconds.render}};
    const std::uint64_t shadow_rays = s.shadow_rays + report.learning.shadow_rays;
    json["shadow_rays"] = shadow_rays;
    json["shadow_rays_per_pixel"] = per(static_cast<double>(shadow_rays), s.pixels);
    json["learned_visibility"] = learning_json(report, shadow_rays);
    json["gather_points_per_pixel"] = per(static_cast<double>(s.gather_points), s.pixels);
    json["pairs_per_pixel"] = s.pairs > 0.0 ? Json(per(s.pairs, s.pixels)) : Json(nullptr);
    json["cut_size"] = {
        {"mean", per(static_cast<double>(s.cut_nodes), s.cuts)}, {"max", s.largest_cut}, {"at_limit", s.at_limit}};
    json["error_bound"] = {{"mean", finite_or_null(per(s.error_bound_sum, s.pixels))},
                           {"max", finite_or_null(s.largest_error_bound)}};
    json["visibility_bounds"] = proofs_json(report);
    json["clamp"] = clamp_json(report);
    json["left_out"] = Json::array();
    for (const LeftOut& item : scene.left_out)
        json["left_out"].push_back({{"what", as_utf8(item.what)}, {"why", as_utf8(item.why)}});
    json["peak_memory_bytes"] = peak_memory();
    json["options"] = options_json(report);
    if (report.error) json["error"] = to_json(*report.error);
    return json;
}

std::string interruption(const RunReport& report) {
    std::string text = "interrupted; what was finished is in " + escaped(report.picture.string());
    if (report.picture != report.options.output) {
        text += "; a finished picture has the name " + escaped(report.options.output.string());
    }
    return text;
}

std::string summary(const RunReport& report) {
    const Scene& scene = report.scene;
    const RenderStatistics& s = report.statistics;
    std::ostringstream text;
    text << std::setprecision(3);
    text << escaped(report.options.scene) << ": " << scene.triangles.size() << " triangles, " << scene.light_count()
         << " lights\n";
    text << report.options.method << ": " << report.seconds.load << " s loading, " << report.seconds.tree
         << " s trees, " << report.seconds.render << " s rendering, "
         << per(static_cast<double>(s.shadow_rays + report.learning.shadow_rays), s.pixels)
         << " shadow rays a pixel, cut size " << per(static_cast<double>(s.cut_nodes), s.cuts) << "\n";
    if (report.resumed_tiles > 0) text << report.resumed_tiles << " tiles of these were there from an earlier run\n";
    if (report.error) {
        text << "relative RMSE " << 100.0 * report.error->relative_rmse << " %, 99.9th percentile "
             << 100.0 * report.error->p999_relative << " %\n";
    }
    text << (report.interrupted ? interruption(report) : "written: " + escaped(report.picture.string())) << "\n";
    return text.str();
}

}  // namespace render
