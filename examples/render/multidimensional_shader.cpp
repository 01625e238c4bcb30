#include "multidimensional_shader.hpp"

#include <utility>

#include "pair_shader.hpp"

namespace render {

std::unique_ptr<Shader> make_multidimensional_shader(const Scene& scene, const RayScene& rays, const Options& given) {
    Options options = given;
    // Pairs of one light cluster draw different lights, where one for all would be wrong together.
    if (!given.is_given("--representatives")) options.representatives = 32;
    if (scene.at_instants.count() > 0) return make_shader_of_moving_lights(scene, rays, options);
    auto lights = std::make_unique<const SceneLights>(scene, options);
    const auto make = [&]<class Forest>(const Forest& forest) -> std::unique_ptr<Shader> {
        return std::make_unique<PairShader<SceneLights, Forest>>(scene, rays, std::move(lights), forest, options);
    };
    // Two sets of kinds, not the three of `SceneLights::visit`: each takes the compiler a minute, and an empty kind
    // costs a sum over pairs next to nothing.
    const SceneLights& trees = *lights;
    return scene.virtual_count() > 0 ? make(trees.forest()) : make(trees.direct());
}

}  // namespace render
