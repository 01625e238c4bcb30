#include "lights/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/source/environment.hpp>
#include <lightcuts/source/sun_sky.hpp>

#include "io/map_picture.hpp"

namespace render {

namespace {

using lightcuts::invalid_input;

constexpr std::size_t sun_disc_lights = 64;
constexpr std::uint32_t sky_rows = 256;

/// `name`: of the map, for messages.
void add_environment(Scene& scene, Picture map, const std::string& name, const Options& options) {
    Environment environment{std::move(map), options.env_scale, options.env_rotate};
    environment.picture.channels.clear();
    try {
        const auto lights = lightcuts::environment_lights(environment.map(), options.env_lights,
                                                          lightcuts::CenteredSobol{options.seed});
        scene.directional.insert(scene.directional.end(), lights.begin(), lights.end());
        scene.environment_lights += lights.size();
    } catch (const invalid_input& problem) {
        throw invalid_input(name + ": " + problem.what() + "; correct it or give another map");
    }
    scene.background.environment = std::move(environment);
}

/// How many lights of the power of one of the sky's make up the ground's: a light that comes or goes at the edge of a
/// shadow then is as large a step, whichever it is.
std::size_t ground_light_count(const lightcuts::SunSky& daylight,
                               const std::vector<lightcuts::DistantLight<>>& of_sky) {
    const double power = 2.0 * std::numbers::pi * lightcuts::channel_sum(daylight.ground_radiance());
    if (of_sky.empty() || power == 0.0) return 0;
    const double ratio = power / lightcuts::channel_sum(of_sky.front().intensity);
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(ratio)));
}

void add_daylight(Scene& scene, const Options& options) {
    const lightcuts::SunSky daylight(
        {options.sun_sky->elevation, options.sun_sky->azimuth, static_cast<double>(options.turbidity)},
        glm::vec3(options.ground));
    const auto of_sun = lightcuts::sun_lights(daylight, sun_disc_lights, lightcuts::ScrambledSobol{options.seed});
    const auto of_sky = lightcuts::sky_lights(daylight, options.sky_lights, sky_rows,
                                              lightcuts::CenteredSobol{options.seed});
    scene.directional.insert(scene.directional.end(), of_sun.begin(), of_sun.end());
    scene.directional.insert(scene.directional.end(), of_sky.begin(), of_sky.end());
    const auto of_ground = lightcuts::ground_lights(daylight, ground_light_count(daylight, of_sky),
                                                    lightcuts::CenteredSobol{options.seed});
    scene.directional.insert(scene.directional.end(), of_ground.begin(), of_ground.end());
    scene.sun_lights += of_sun.size();
    scene.sky_lights += of_sky.size();
    scene.ground_lights += of_ground.size();
    scene.background.daylight = daylight;
}

/// Throws for the first of `details` that was given.
void refuse_given(const Options& options, std::initializer_list<const char*> details, const std::string& needed) {
    for (const char* name : details) {
        if (options.is_given(name)) throw usage_error(std::string(name) + " needs " + needed);
    }
}

/// Throws if virtual lights are to be clamped, as was asked for, and the method cannot.
void refuse_idle_clamp(const Options& options) {
    if (options.indirect > 0 && options.is_clamp_given() && options.is_clamp_idle()) {
        if (options.sums_pixels()) {
            throw usage_error("--method " + options.method +
                              " does not clamp virtual lights to a radiance: give --clamp auto or off");
        }
        throw usage_error("--method " + options.method +
                          " does not clamp virtual lights: give --clamp off, or one of " + listed(clamping_methods()));
    }
}

}  // namespace

void add_surroundings(Scene& scene, Options& options) {
    Lighting own = std::move(scene.lighting);
    scene.lighting = {};
    if (options.env.empty() && !options.sun_sky) {
        if (own.sun) {
            options.sun_sky = own.sun;
            if (!options.is_given("--turbidity")) options.turbidity = static_cast<float>(own.sun->turbidity);
        }
    } else {
        own.environment.reset();
    }
    if (own.ground && !options.is_given("--ground")) options.ground = *own.ground;
    if (!options.is_given("--indirect")) options.indirect = own.indirect;
    if (own.clamp && !options.is_clamp_given()) { options.clamp = {.radiance = *own.clamp}; }

    if (!options.env.empty()) {
        add_environment(scene, read_map(options.env), options.env.string(), options);
    } else if (own.environment) {
        add_environment(scene, std::move(*own.environment), scene.name, options);
    } else {
        refuse_given(options, {"--env-lights", "--env-scale", "--env-rotate"}, "--env");
    }
    if (options.sun_sky) {
        add_daylight(scene, options);
    } else {
        refuse_given(options, {"--turbidity", "--sky-lights", "--ground"}, "--sun-sky");
    }
    refuse_idle_clamp(options);
}

}  // namespace render
