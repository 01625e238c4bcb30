#include "prepare_scene.hpp"

#include "emitters.hpp"
#include "light_table.hpp"
#include "load_scene.hpp"
#include "spheres.hpp"
#include "surroundings.hpp"
#include "validate.hpp"

namespace render {

Scene prepare_scene(const Options& options) {
    Scene scene = load_scene(options.scene);
    if (!options.lights.empty()) add_light_table(options.lights, scene);
    add_emitter_lights(scene, options.area_points);
    add_sphere_lights(scene, options.area_points, options.seed);
    if (!options.env.empty()) {
        add_environment(scene, {options.env, options.env_lights, options.env_scale, options.env_rotate, options.seed});
    }
    if (options.sun_sky) {
        const lightcuts::SunPosition sun{static_cast<double>(options.sun_sky->elevation),
                                         static_cast<double>(options.sun_sky->azimuth),
                                         static_cast<double>(options.turbidity)};
        add_daylight(scene, sun, options.sky_lights, options.seed);
    }
    require_lights(scene);
    return scene;
}

Shade shade_of(const Options& options) { return options.diffuse_materials ? Shade::diffuse : Shade::full; }

}  // namespace render
