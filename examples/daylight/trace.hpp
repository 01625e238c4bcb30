#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include <lightcuts/piecewise/cut_file.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/scene.hpp>

#include "direction_tree.hpp"
#include "sensors.hpp"

namespace daylighting {

/// How sensors are traced.
struct TraceSettings {
    double error = 0.05;                 ///< of sky cuts, see CutMaker
    std::filesystem::path unfinished{};  ///< where finished sensors are kept until all are; empty: nowhere
    bool resume = false;                 ///< go on with those
    bool shows_progress = false;         ///< on a terminal
};

/// The cuts of all sensors, and what they took.
struct Trace {
    explicit Trace(const DirectionTree& directions);

    lightcuts::CutFileWriter sky, sun;
    std::size_t sky_pieces = 0, sun_pieces = 0;
    std::size_t finished = 0;  ///< sensors; fewer than there are if the run was interrupted
    std::size_t resumed = 0;   ///< of these, by an earlier run
};

/// Traces what all sensors see, on all threads of the calling arena, until `render::interrupted()`. The cuts do not
/// depend on the number of threads, nor on what was resumed.
/// throws: invalid_input if what is unfinished cannot be kept, or resumed.
Trace trace_sensors(const render::Scene& scene, const render::RayScene& rays, const DirectionTree& directions,
                    std::span<const Sensor> sensors, const TraceSettings& settings);

}  // namespace daylighting
