#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace benchmark {

/// What it takes to generate the virtual lights of a scene.
struct ParticleCost {
    std::size_t virtual_lights = 0;
    std::size_t recorded_lights = 0;  ///< where the rays were noted: as many
    std::size_t particles = 0;        ///< that left a light, without those that find out how many are needed
    std::size_t rays = 0;             ///< of all paths
    double seconds = 0;               ///< processor seconds of generating, all threads
    double ray_seconds = 0;           ///< of tracing the same rays one by one, in the same order and tasks
    double wall_seconds = 0;          ///< of generating, by the clock on the wall
    double ratio = 0;                 ///< of the processor seconds
    double wall_ratio = 0;
};

struct ParticleCostOptions {
    std::string scene;               ///< see scene_options; `lights` take the place of `indirect`
    std::size_t lights = 1000000;    ///< virtual lights wanted
    std::uint32_t area_points = 64;  ///< lights per emissive surface, from which the particles start
    int threads = 2;
    int runs = 3;  ///< medians are over this many
};

/// throws: lightcuts::invalid_input for a scene that cannot be used
ParticleCost measure_particles(const ParticleCostOptions& options);

}  // namespace benchmark
