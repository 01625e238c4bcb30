#include <type_traits>
#include <utility>

#include "multidimensional_shader.hpp"
#include "pair_shader.hpp"

namespace render {

// By itself, as it takes the compiler as long as all others.
std::unique_ptr<Shader> make_shader_of_moving_lights(const Scene& scene, const RayScene& rays, const Options& options) {
    auto lights = std::make_unique<const InstantSceneLights>(scene, options);
    const auto& forest = lights->forest();
    using Forest = std::remove_cvref_t<decltype(forest)>;
    return std::make_unique<PairShader<InstantSceneLights, Forest>>(scene, rays, std::move(lights), forest, options);
}

}  // namespace render
