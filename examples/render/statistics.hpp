#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "error.hpp"
#include "options.hpp"
#include "rays/ray_tracer.hpp"
#include "render_loop.hpp"
#include "scene.hpp"
#include "shader.hpp"

namespace render {

/// Seconds of wall time.
struct PhaseTimes {
    double load = 0;       ///< reading the scene and preparing the ray tracer
    double particles = 0;  ///< following them, for indirect light
    double tree = 0;       ///< what the method builds before it shades
    double render = 0;     ///< eye rays and shading
};

/// Everything that is reported of a run.
struct RunReport {
    RunReport(const Options& o, const Scene& s, const RayTracer& r, int t)
        : options(o), scene(s), ray_tracer(r), threads(t) {}

    const Options& options;
    const Scene& scene;
    const RayTracer& ray_tracer;
    int threads = 1;
    PhaseTimes seconds;
    RenderStatistics statistics;
    LearningCost learning;
    float adaptation = 0;
    ProofUse proofs;
    bool interrupted = false;
    std::size_t resumed_tiles = 0;  ///< of an earlier run
    std::filesystem::path picture;  ///< where it is written
    std::optional<ErrorFigures> error;
};

/// The report with the stable keys of the command line's contract. Numbers that are not finite become null. The
/// error bound of a pixel is that of its worst channel; `cut_size.at_limit` counts surface points.
nlohmann::ordered_json to_json(const RunReport& report);

nlohmann::ordered_json to_json(const ErrorFigures& figures);

/// Where the part of an interrupted picture is, for people.
std::string interruption(const RunReport& report);

/// The report in a few lines for people.
std::string summary(const RunReport& report);

}  // namespace render
