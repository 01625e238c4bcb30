#include "prepare_scene.hpp"

#include "io/light_table.hpp"
#include "io/load_scene.hpp"
#include "io/validate.hpp"
#include "lights/emitters.hpp"
#include "lights/indirect.hpp"
#include "lights/spheres.hpp"
#include "lights/surroundings.hpp"

namespace render {

Scene prepare_scene(Options& options) {
    Scene scene = load_scene(options.scene);
    if (!options.lights.empty()) add_light_table(options.lights, scene);
    add_emitter_lights(scene, {.points = options.area_points, .total = options.area_lights});
    add_sphere_lights(scene, options.area_points, options.seed);
    add_surroundings(scene, options);
    require_lights(scene);
    if (options.indirect > 0) name_amplifying_materials(scene);
    return scene;
}

Shade shade_of(const Options& options) { return options.diffuse_materials ? Shade::diffuse : Shade::full; }

}  // namespace render
