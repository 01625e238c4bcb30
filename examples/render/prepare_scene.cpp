#include "prepare_scene.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "bounding_box.hpp"
#include "io/light_table.hpp"
#include "io/load_scene.hpp"
#include "io/validate.hpp"
#include "lights/emitters.hpp"
#include "lights/indirect.hpp"
#include "lights/spheres.hpp"
#include "lights/surroundings.hpp"

namespace render {

namespace {

void add_fog(Scene& scene, const Options& options) {
    const lightcuts::Box box = bounding_box(scene.positions);
    // Points of the surfaces themselves lie inside.
    const auto margin = static_cast<float>(0.01 * std::sqrt(lightcuts::diagonal2(box)));
    scene.fog = {lightcuts::UniformMedium(options.fog, {box.lo - margin, box.hi + margin}), options.fog_albedo,
                 options.fog_anisotropy, fog_points_per_ray(options.spp)};
}

/// Only gather points that have an instant can be lit by lights that have one.
void require_method_for_motion(const Scene& scene, const Options& options) {
    if (options.sums_pixels()) return;
    const std::string way_out = "; give --method multidimensional, or --shutter 0";
    if (scene.at_instants.count() > 0) {
        throw usage_error("--method " + options.method + ": lights move while the shutter is open, and this method " +
                          "sums up lights that stand still" + way_out);
    }
    if (options.indirect > 0 && scene.light_moves()) {
        throw usage_error("--method " + options.method + ": what moves while the shutter is open changes indirect " +
                          "light, and this method sums up lights that stand still" + way_out + " or --indirect 0");
    }
}

}  // namespace

Scene prepare_scene(Options& options) {
    Scene scene = load_scene(options.scene, options.shutter);
    if (!options.lights.empty()) add_light_table(options.lights, scene);
    add_emitter_lights(scene, {.points = options.area_points, .total = options.area_lights});
    add_sphere_lights(scene, options.area_points, options.seed);
    add_surroundings(scene, options);
    require_lights(scene);
    if (options.fog > 0.0f) add_fog(scene, options);
    require_method_for_motion(scene, options);
    if (options.indirect > 0) name_amplifying_materials(scene);
    return scene;
}

Shade shade_of(const Options& options) { return options.diffuse_materials ? Shade::diffuse : Shade::full; }

float fog_points_per_ray(int spp) { return std::max(4.0f, 64.0f / static_cast<float>(spp)); }

Lens lens_of(const Options& options, const Camera& camera) {
    const double focus = options.focus ? static_cast<double>(*options.focus) : glm::length(camera.target - camera.eye);
    return {.aperture = static_cast<double>(options.aperture), .focus = focus};
}

}  // namespace render
