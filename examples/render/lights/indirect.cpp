#include "lights/indirect.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <oneapi/tbb/parallel_for.h>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/core/random.hpp>
#include <lightcuts/source/virtual_lights.hpp>

#include "lights/particle_scene.hpp"
#include "lights/spheres.hpp"
#include "tbb_executor.hpp"

namespace render {

namespace {

using OrientedLights = std::vector<lightcuts::OrientedPointLight<>>;

/// Lights of one kind in the order of their instants.
template <class L>
class ByInstant {
public:
    ByInstant(const std::vector<L>& lights, std::size_t instants) : lights_(lights), begin_(instants + 1) {
        std::stable_sort(lights_.begin(), lights_.end(), [](const L& a, const L& b) { return a.instant < b.instant; });
        for (const L& light : lights_) ++begin_[light.instant + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    }

    std::span<const L> operator[](std::size_t instant) const {
        return std::span(lights_).subspan(begin_[instant], begin_[instant + 1] - begin_[instant]);
    }

private:
    std::vector<L> lights_;
    std::vector<std::size_t> begin_;
};

/// About `count` lights for all instants together. Those of each instant stand for all indirect light then: a particle
/// carries as many times its power as there are instants.
template <class Surroundings>
void add_at_instants(Scene& scene, const Surroundings& surroundings, const OrientedLights& shells, std::size_t count,
                     std::uint64_t seed) {
    const std::size_t instants = scene.instants.size();
    const ByInstant omni(scene.at_instants.omni, instants);
    const ByInstant oriented(scene.at_instants.oriented, instants);
    const ByInstant spots(scene.at_instants.spots, instants);
    const ByInstant directional(scene.at_instants.directional, instants);
    const ByInstant moving_shells(moving_sphere_shells(scene), instants);
    // Spread evenly, also where there are fewer lights than instants.
    const auto share_of = [&](std::size_t t) { return (t + 1) * count / instants - t * count / instants; };
    std::vector<lightcuts::VirtualLights<>> made(instants);
    std::vector<std::string> problems(instants);
    tbb::parallel_for(std::size_t{0}, instants, [&](std::size_t t) {
        const lightcuts::ParticleSources sources(
            std::span(std::as_const(scene.omni)), std::span(std::as_const(scene.oriented)),
            std::span(std::as_const(scene.spots)), std::span(std::as_const(scene.directional)), std::span(shells),
            omni[t], oriented[t], spots[t], directional[t], moving_shells[t]);
        try {
            made[t] = lightcuts::virtual_lights(surroundings.at(scene.instants[t]), sources,
                                                {.lights = std::max<std::size_t>(share_of(t), 1)},
                                                lightcuts::ScrambledSobol{lightcuts::hash_keys(seed, t)});
        } catch (const lightcuts::invalid_input& problem) { problems[t] = problem.what(); }
    });
    // At some instants there may be nothing to light.
    if (std::none_of(problems.begin(), problems.end(), [](const std::string& text) { return text.empty(); })) {
        throw lightcuts::invalid_input(problems.front());
    }
    for (std::size_t t = 0; t < instants; ++t) {
        const auto instant = static_cast<std::uint32_t>(t);
        for (const auto& light : made[t].lights) scene.at_instants.virtual_lights.push_back({{{light}}, instant});
        for (const auto& light : made[t].scattered) scene.at_instants.volume_lights.push_back({{{light}}, instant});
    }
}

template <class Surroundings>
void add_all(Scene& scene, const Surroundings& surroundings, std::size_t count, std::uint64_t seed) {
    const OrientedLights shells = sphere_shells(scene);
    if (scene.light_moves()) return add_at_instants(scene, surroundings, shells, count, seed);
    const lightcuts::ParticleSources sources(scene.omni, scene.oriented, scene.spots, scene.directional, shells);
    const auto indirect = lightcuts::virtual_lights(surroundings, sources, {.lights = count},
                                                    lightcuts::ScrambledSobol{seed}, TbbExecutor{});
    scene.virtual_lights.reserve(indirect.lights.size());
    for (const auto& light : indirect.lights) scene.virtual_lights.push_back({light});
    scene.volume_lights.reserve(indirect.scattered.size());
    for (const auto& light : indirect.scattered) scene.volume_lights.push_back({light});
}

}  // namespace

void add_virtual_lights(Scene& scene, const RayScene& rays, std::size_t count, Shade shade, std::uint64_t seed) {
    if (count == 0) return;
    const ParticleScene surfaces(scene, rays, shade);
    try {
        if (scene.fog.is_there()) {
            add_all(scene, FoggyParticleScene(surfaces, scene.fog), count, seed);
        } else {
            add_all(scene, surfaces, count, seed);
        }
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
