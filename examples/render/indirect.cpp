#include "indirect.hpp"

#include <string>
#include <vector>

#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/source/particles.hpp>

#include "particle_scene.hpp"
#include "spheres.hpp"
#include "tbb_executor.hpp"

namespace render {

void add_virtual_lights(Scene& scene, const RayScene& rays, std::size_t count, Shade shade, std::uint64_t seed) {
    if (count == 0) return;
    const std::vector<lightcuts::OrientedPointLight<>> shells = sphere_shells(scene);
    const lightcuts::ParticleSources sources(scene.omni, scene.oriented, scene.spots, scene.directional, shells);
    const ParticleScene surfaces(scene, rays, shade);
    try {
        const auto indirect = lightcuts::virtual_lights(surfaces, sources, {.lights = count},
                                                        lightcuts::LowDiscrepancy{seed}, TbbExecutor{});
        scene.virtual_lights.reserve(indirect.lights.size());
        for (const auto& light : indirect.lights) scene.virtual_lights.push_back({light});
    } catch (const lightcuts::invalid_input& problem) {
        throw lightcuts::invalid_input(scene.name + ": " + problem.what() + "; give --indirect 0 or add lights");
    }
}

}  // namespace render
