#include "prepared_scene.hpp"

#include <lightcuts/core/invalid_input.hpp>

#include "lights/indirect.hpp"
#include "prepare_scene.hpp"
#include "rays/ray_scene.hpp"

namespace benchmark {

render::Scene prepared_scene(const std::string& name, render::Options& options) {
    try {
        return render::prepare_scene(options);
    } catch (const render::usage_error& problem) { throw lightcuts::invalid_input(name + ": " + problem.what()); }
}

render::Scene lit_scene(const std::string& name, render::Options& options) {
    render::Scene scene = prepared_scene(name, options);
    if (options.indirect > 0) {
        const render::RayScene rays(scene);
        render::add_virtual_lights(scene, rays, options.indirect, render::shade_of(options), options.seed);
    }
    return scene;
}

}  // namespace benchmark
