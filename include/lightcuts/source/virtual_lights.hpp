#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/basis.hpp"
#include "../core/executor.hpp"
#include "../core/henyey_greenstein.hpp"
#include "../core/invalid_input.hpp"
#include "../light/oriented.hpp"
#include "../light/scattering.hpp"
#include "particle_sources.hpp"
#include "sampler.hpp"

namespace lightcuts {

/// Where a particle goes on after it met a surface.
template <Spectrum S = glm::vec3>
struct ScatteredParticle {
    glm::vec3 origin{0.0f};  ///< moved off the surface, as shadow rays are
    glm::vec3 direction{0.0f, 0.0f, 1.0f};
    S weight = black<S>();  ///< BRDF x cosine / density of the direction; black if it is absorbed
};

/// What particles need to know of a scene. It is used by several threads if the executor has them.
/// - `intersect(origin, direction)`: the first hit, as a std::optional, a pointer or another type that tests true and
///   can be dereferenced iff something is hit. A hit has `position` and `normal`, which is unit and on the side that
///   was hit.
/// - `diffuse_albedo(hit)`: of the diffuse part of its BRDF, in [0, 1]
/// - `scatter(hit, direction, u)`: a direction drawn from the whole BRDF for a particle that arrives along `direction`;
///   u: three numbers in [0, 1), the first two for the direction and the third for the choice of a lobe
/// - `bounds()`: the Box of the scene, where directional lights are among the sources
template <class Sc, class S>
concept ParticleScene = requires(const Sc& scene, glm::vec3 v) {
    static_cast<bool>(scene.intersect(v, v));
    { (*scene.intersect(v, v)).position } -> Vector3;
    { (*scene.intersect(v, v)).normal } -> Vector3;
    { scene.diffuse_albedo(*scene.intersect(v, v)) } -> std::convertible_to<S>;
    { scene.scatter(*scene.intersect(v, v), v, v) } -> std::convertible_to<ScatteredParticle<S>>;
};

/// A scene with thin surfaces that pass light on diffusely, such as leaves. Of a hit there, `position_behind` is as
/// `position`, off the surface on its other side, and `diffuse_transmittance(hit)`, with `diffuse_albedo` at most 1, is
/// the share that leaves there. `scatter` then draws from what is transmitted, too.
template <class Sc, class S>
concept TransmissiveParticleScene = ParticleScene<Sc, S> && requires(const Sc& scene, glm::vec3 v) {
    { (*scene.intersect(v, v)).position_behind } -> Vector3;
    { scene.diffuse_transmittance(*scene.intersect(v, v)) } -> std::convertible_to<S>;
};

/// What a medium does with the light that it stops.
template <Spectrum S = glm::vec3>
struct MediumScattering {
    S albedo = black<S>();   ///< share that it scatters rather than absorbs, in [0, 1]
    float asymmetry = 0.0f;  ///< mean cosine of Henyey and Greenstein's phase function, above -1 and below 1
};

/// A scene filled with a medium that scatters or absorbs.
/// - `free_flight(origin, direction, u)`: how far a particle gets before the medium stops it, were there no surface;
///   infinite if it leaves the medium. Drawn in proportion to what is stopped: u is uniform in [0, 1).
/// - `scattering_at(position)`: a MediumScattering
/// - `bounds()`, where directional lights are among the sources, hold the medium too: their particles start outside.
template <class Sc, class S>
concept ScatteringParticleScene = ParticleScene<Sc, S> && requires(const Sc& scene, glm::vec3 v, double u) {
    { scene.free_flight(v, v, u) } -> std::convertible_to<double>;
    { scene.scattering_at(v) } -> std::convertible_to<MediumScattering<S>>;
};

namespace detail {
template <class Sc>
concept HasFreeFlight = requires(const Sc& scene, glm::vec3 v, double u) {
    scene.free_flight(v, v, u);
};
template <class Sc>
concept HasScattering = requires(const Sc& scene, glm::vec3 v) {
    scene.scattering_at(v);
};
template <class Sc>
concept HitsHavePositionBehind = requires(const Sc& scene, glm::vec3 v) {
    (*scene.intersect(v, v)).position_behind;
};
template <class Sc>
concept HasDiffuseTransmittance = requires(const Sc& scene, glm::vec3 v) {
    scene.diffuse_transmittance(*scene.intersect(v, v));
};
}  // namespace detail

struct ParticleOptions {
    std::size_t lights = 10000;         ///< wanted, over all bounces; about as many are made
    std::uint32_t longest_path = 1000;  ///< times that it meets a surface or is scattered; what lies beyond is lost
};

/// Indirect light as point lights.
template <Spectrum S = glm::vec3>
struct VirtualLights {
    std::vector<OrientedPointLight<S>> lights;
    std::vector<ScatteringPointLight<S>> scattered;  ///< in the medium of a ScatteringParticleScene
    std::uint64_t particles = 0;                     ///< that left a light
    std::uint64_t landed = 0;                        ///< of these, how many met a surface or were stopped by a medium
};

namespace detail {

/// Particles that were followed one after the other, and the lights they left for a total power of 1 each.
template <Spectrum S>
struct ParticleTally {
    std::vector<OrientedPointLight<S>> lights;
    std::vector<ScatteringPointLight<S>> scattered;
    std::uint64_t landed = 0;

    std::size_t left() const { return lights.size() + scattered.size(); }
    void append(const ParticleTally& other) {
        lights.insert(lights.end(), other.lights.begin(), other.lights.end());
        scattered.insert(scattered.end(), other.scattered.begin(), other.scattered.end());
        landed += other.landed;
    }
};

/// Leaves what `power` makes at `hit` to a light, with a probability in proportion: on the side that was hit, or behind
/// it.
template <class Scene, class Hit, Spectrum S>
void leave_light(const Scene& scene, const Hit& hit, const S& power, double roulette,
                 std::vector<OrientedPointLight<S>>& lights) {
    const S reflected = power * S(scene.diffuse_albedo(hit));
    const double front = channel_sum(reflected);
    S transmitted = black<S>();
    if constexpr (TransmissiveParticleScene<Scene, S>) transmitted = power * S(scene.diffuse_transmittance(hit));
    const double behind = channel_sum(transmitted);
    const double whole = (std::max)(front + behind, 1.0);
    const auto add = [&](const glm::vec3& position, const glm::vec3& normal, const S& leaving, double sum) {
        const double scale = whole / (std::numbers::pi * sum);
        lights.push_back({position, normal, S(leaving * static_cast<float>(scale)), {}});
    };
    const double drawn = roulette * whole;
    if (drawn < front) {
        add(to_vec3(hit.position), to_vec3(hit.normal), reflected, front);
    } else if (drawn < front + behind) {
        if constexpr (TransmissiveParticleScene<Scene, S>) {
            add(to_vec3(hit.position_behind), -to_vec3(hit.normal), transmitted, behind);
        }
    }
}

/// Leaves what `power` makes where a medium stops a particle that travels along `direction` to a light, with a
/// probability in proportion, and sends the particle on. `u`: two numbers in [0, 1)
template <Spectrum S>
ScatteredParticle<S> scatter_in_medium(const MediumScattering<S>& medium, const glm::vec3& position,
                                       const glm::vec3& direction, const S& power, const glm::dvec2& u, double roulette,
                                       std::vector<ScatteringPointLight<S>>& lights) {
    const S scattered = power * medium.albedo;
    const double sum = channel_sum(scattered), whole = (std::max)(sum, 1.0);
    if (roulette * whole < sum) {
        lights.push_back(scattering_point_light(position, direction, S(scattered * static_cast<float>(whole / sum)),
                                                medium.asymmetry));
    }
    const double cosine = henyey_greenstein_cosine(static_cast<double>(medium.asymmetry), u.x);
    const Basis forward(glm::normalize(glm::dvec3(direction)));
    return {position, glm::vec3(forward.out(around_z(cosine, u.y))), medium.albedo};
}

/// Follows particle `index` and appends its lights.
template <class Scene, class Emission, Sampler Sequence>
void follow(const Scene& scene, const Emission& emission, const Sequence& sampler, std::uint32_t index,
            std::uint32_t longest_path, ParticleTally<typename Emission::S>& tally) {
    using S = typename Emission::S;
    constexpr bool scatters = ScatteringParticleScene<Scene, S>;
    // For each way, one more says how far it goes through a medium, and one is left out: they come in pairs.
    constexpr std::uint32_t numbers = scatters ? 6 : 4;
    // Together, as samplers may share work among consecutive dimensions.
    const auto four_numbers = [&](std::uint32_t dimension) {
        std::array<double, 4> u;
        for (std::uint32_t d = 0; d < 4; ++d) u[d] = static_cast<double>(sampler(index, dimension + d));
        return u;
    };
    const std::array<double, 4> start = four_numbers(0);
    emission.emit_ray(start[0], {start[2], start[3]}, start[1], [&](const auto& light, const auto& emitted) {
        using L = std::remove_cvref_t<decltype(light)>;
        S power = emitted.power;
        glm::vec3 origin(emitted.ray.origin), direction(emitted.ray.direction);
        for (std::uint32_t bounce = 0; bounce < longest_path; ++bounce) {
            const auto hit = scene.intersect(origin, direction);
            bool is_stopped = false;
            float way = hit ? glm::distance(origin, to_vec3((*hit).position)) : 0.0f;
            if constexpr (scatters) {
                const double u = static_cast<double>(sampler(index, numbers * bounce + 4));
                const auto flight = static_cast<double>(scene.free_flight(origin, direction, u));
                is_stopped = hit ? flight < static_cast<double>(way) : flight < std::numeric_limits<double>::infinity();
                if (is_stopped) way = static_cast<float>(flight);
            }
            if (!hit && !is_stopped) return;
            if (bounce == 0) {
                ++tally.landed;
                if constexpr (FalloffLight<L>) power = power * (falloff_of(light, way) * way * way);
            }
            const std::array<double, 4> drawn = four_numbers(numbers * (bounce + 1));
            // One number decides whether a light is left, on either side, and whether the particle goes on: each
            // decision has its right probability, and fewer particles end without having left a light.
            const double roulette = drawn[3];
            ScatteredParticle<S> next;
            if (is_stopped) {
                if constexpr (scatters) {
                    const glm::vec3 position = origin + way * direction;
                    next = scatter_in_medium<S>(scene.scattering_at(position), position, direction, power,
                                                {drawn[0], drawn[1]}, roulette, tally.scattered);
                }
            } else {
                leave_light(scene, *hit, power, roulette, tally.lights);
                const auto below_one = [&](std::size_t d) {
                    return (std::min)(static_cast<float>(drawn[d]), 1.0f - 0x1p-24f);
                };
                next = scene.scatter(*hit, direction, glm::vec3(below_one(0), below_one(1), below_one(2)));
            }
            power = power * next.weight;
            const double survival = channel_sum(power);
            if (!(roulette < survival)) return;
            if (survival < 1.0) power = power * static_cast<float>(1.0 / survival);
            origin = next.origin;
            direction = next.direction;
        }
    });
}

/// Follows `count` particles from index `first` on. The result does not depend on the executor.
template <class Scene, class Emission, Sampler Sequence, Executor E>
ParticleTally<typename Emission::S> follow_all(const Scene& scene, const Emission& emission, const Sequence& sampler,
                                               std::uint32_t first, std::uint32_t count, std::uint32_t longest_path,
                                               const E& execute) {
    using Tally = ParticleTally<typename Emission::S>;
    constexpr std::uint32_t block = 4096;
    std::vector<Tally> tallies((count + block - 1) / block);
    execute(tallies.size(), [&](std::size_t b) {
        const auto begin = static_cast<std::uint32_t>(b) * block;
        const std::uint32_t end = (std::min)(begin + block, count);
        for (std::uint32_t i = begin; i < end; ++i) {
            follow(scene, emission, sampler, first + i, longest_path, tallies[b]);
        }
    });
    Tally all;
    for (const Tally& tally : tallies) all.append(tally);
    return all;
}

}  // namespace detail

/// Indirect light by instant radiosity [Keller 1997; Lightcuts 2005, section 5]: particles leave the lights in
/// proportion to their power and scatter through the scene; wherever one meets a surface with a diffuse part, a virtual
/// oriented light takes over what that part reflects, or one behind it what a leaf lets through; wherever a medium
/// stops one, a scattering light takes over what that scatters [Multidimensional Lightcuts 2006, section 3.4]. Russian
/// roulette keeps every particle, and so every light, at the same power (sum of channels; brighter only where `scatter`
/// returns weights above 1, or a falloff is not 1/d^2). On average over seeds the lights carry all light that surfaces
/// reflect diffusely and media scatter after any number of bounces, caustics included.
///
/// Light profiles are resolved in 512 steps of the angle. A first, smaller set of particles finds how many lights a
/// particle leaves; `options.lights` then is met within a few per cent.
/// throws: invalid_input if no light emits, if one is negative or not finite, if all particles miss the scene, or none
/// is reflected or let through diffusely or scattered. cost: about one intersection a light, and as many for particles
/// that end. threads: the result does not depend on them.
template <class Scene, Light... Ls, Sampler Sequence = ScrambledSobol, Executor E = Sequential>
    requires ParticleScene<Scene, typename ParticleSources<Ls...>::spectrum>
auto virtual_lights(const Scene& scene, const ParticleSources<Ls...>& sources, const ParticleOptions& options = {},
                    const Sequence& sampler = {}, const E& execute = {}) {
    using S = typename ParticleSources<Ls...>::spectrum;
    static_assert(
        TransmissiveParticleScene<Scene, S> ||
            !(detail::HitsHavePositionBehind<Scene> || detail::HasDiffuseTransmittance<Scene>),
        "a scene with leaves needs both: diffuse_transmittance(hit) const, which returns the lights' Spectrum, "
        "and hits with a position_behind");
    static_assert(ScatteringParticleScene<Scene, S> || !(detail::HasFreeFlight<Scene> || detail::HasScattering<Scene>),
                  "a scene with a medium needs both: free_flight(origin, direction, u) const, which returns a "
                  "distance, and scattering_at(position) const, which returns a MediumScattering of the lights' "
                  "Spectrum");
    VirtualLights<S> result;
    Box bounds;
    if constexpr (ParticleSources<Ls...>::has_directional) {
        bounds = scene.bounds();
        if (is_empty(bounds) || !is_finite(bounds.lo) || !is_finite(bounds.hi)) {
            LIGHTCUTS_THROW(invalid_input("virtual lights: the scene's bounds are empty or not finite"));
        }
    }
    const detail::ParticleEmission<ParticleSources<Ls...>> emission(sources, bounds);
    if (options.lights == 0) return result;

    // How many lights does a particle leave? Other particles than the final ones find out, so that their number does
    // not depend on what these meet.
    constexpr std::uint32_t pilots = 0x80000000u;
    constexpr std::uint32_t most_pilots = 65536;
    const auto least_pilots = static_cast<std::uint32_t>(std::clamp<std::size_t>(options.lights, 1024, 16384));
    std::uint64_t followed = 0, landed = 0, left = 0;
    for (std::uint32_t count = least_pilots; left == 0 && followed < most_pilots; count *= 2) {
        const auto tally = detail::follow_all(scene, emission, sampler, pilots + static_cast<std::uint32_t>(followed),
                                              count, options.longest_path, execute);
        followed += count;
        landed += tally.landed;
        left += tally.left();
    }
    if (landed == 0) {
        LIGHTCUTS_THROW(invalid_input("virtual lights: none of " + std::to_string(followed) +
                                      " particles from the lights met a surface or a medium"));
    }
    if (left == 0) {
        LIGHTCUTS_THROW(
            invalid_input("virtual lights: of " + std::to_string(followed) + " particles " + std::to_string(landed) +
                          " met a surface or a medium, but none was reflected or let through diffusely or scattered"));
    }
    const double wanted = static_cast<double>(options.lights) * static_cast<double>(followed) /
                          static_cast<double>(left);
    const auto particles = static_cast<std::uint32_t>(std::clamp(wanted + 0.5, 1.0, 0x1p31 - 1.0));

    auto tally = detail::follow_all(scene, emission, sampler, 0, particles, options.longest_path, execute);
    const double share = emission.power() / static_cast<double>(particles);
    const auto scale = [share](auto& lights) {
        for (auto& light : lights) {
            light.intensity = make_spectrum<S>(
                [&](int c) { return static_cast<double>(channel(light.intensity, c)) * share; });
        }
    };
    scale(tally.lights);
    scale(tally.scattered);
    result.lights = std::move(tally.lights);
    result.scattered = std::move(tally.scattered);
    result.particles = particles;
    result.landed = tally.landed;
    return result;
}

}  // namespace lightcuts
