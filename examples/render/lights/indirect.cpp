#include "lights/indirect.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/source/virtual_lights.hpp>

#include "lights/particle_scene.hpp"
#include "lights/spheres.hpp"
#include "tbb_executor.hpp"

namespace render {

void add_virtual_lights(Scene& scene, const RayScene& rays, std::size_t count, Shade shade, std::uint64_t seed) {
    if (count == 0) return;
    const std::vector<lightcuts::OrientedPointLight<>> shells = sphere_shells(scene);
    const lightcuts::ParticleSources sources(scene.omni, scene.oriented, scene.spots, scene.directional, shells);
    const ParticleScene surfaces(scene, rays, shade);
    try {
        const auto indirect = lightcuts::virtual_lights(surfaces, sources, {.lights = count},
                                                        lightcuts::ScrambledSobol{seed}, TbbExecutor{});
        scene.virtual_lights.reserve(indirect.lights.size());
        for (const auto& light : indirect.lights) scene.virtual_lights.push_back({light});
    } catch (const lightcuts::invalid_input& problem) {
        throw lightcuts::invalid_input(scene.name + ": " + problem.what() + "; give --indirect 0 or add lights");
    }
}

void name_amplifying_materials(Scene& scene) {
    for (const Material& m : scene.materials) {
        const glm::vec3 sum = m.base_color + m.specular;
        const bool amplifies = m.model == Material::Model::phong && std::max({sum.r, sum.g, sum.b}) > 1.0f + 1e-6f;
        if (!amplifies) continue;
        leave_out(scene.left_out, "what is above 1 of Kd + Ks of material '" + m.name + "'",
                  "in indirect light a surface reflects no more than it gets");
    }
}

}  // namespace render
