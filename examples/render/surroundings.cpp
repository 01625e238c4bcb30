#include "surroundings.hpp"

#include <initializer_list>
#include <string>
#include <utility>

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
                                                          lightcuts::CentredNumbers{options.seed});
        scene.directional.insert(scene.directional.end(), lights.begin(), lights.end());
        scene.environment_lights += lights.size();
    } catch (const invalid_input& problem) {
        throw invalid_input(name + ": " + problem.what() + "; correct it or give another map");
    }
    scene.background.environment = std::move(environment);
}

void add_daylight(Scene& scene, const Options& options) {
    const lightcuts::SunSky daylight({static_cast<double>(options.sun_sky->elevation),
                                      static_cast<double>(options.sun_sky->azimuth),
                                      static_cast<double>(options.turbidity)});
    const auto of_sun = lightcuts::sun_lights(daylight, sun_disc_lights, lightcuts::LowDiscrepancy{options.seed});
    const auto of_sky = lightcuts::sky_lights(daylight, options.sky_lights, sky_rows,
                                              lightcuts::CentredNumbers{options.seed});
    scene.directional.insert(scene.directional.end(), of_sun.begin(), of_sun.end());
    scene.directional.insert(scene.directional.end(), of_sky.begin(), of_sky.end());
    scene.sun_lights += of_sun.size();
    scene.sky_lights += of_sky.size();
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
    const bool given = options.is_given("--clamp") || options.is_given("--clamp-ratio");
    if (options.indirect > 0 && given && options.is_clamp_idle()) {
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
            options.sun_sky = {static_cast<float>(own.sun->elevation), static_cast<float>(own.sun->azimuth)};
            if (!options.is_given("--turbidity")) options.turbidity = static_cast<float>(own.sun->turbidity);
        }
    } else {
        own.environment.reset();
    }
    if (!options.is_given("--indirect")) options.indirect = own.indirect;
    if (own.clamp && !options.is_given("--clamp") && !options.is_given("--clamp-ratio")) {
        options.clamp = {.radiance = *own.clamp};
    }

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
        refuse_given(options, {"--turbidity", "--sky-lights"}, "--sun-sky");
    }
    refuse_idle_clamp(options);
}

}  // namespace render
