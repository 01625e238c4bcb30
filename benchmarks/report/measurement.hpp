#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "error.hpp"
#include "io/picture.hpp"
#include "report/methods.hpp"
#include "report/scenes.hpp"

namespace benchmark {

/// A picture by one method at one setting of its parameter, and what it cost.
struct Measurement {
    double value = 0;            ///< of the method's parameter
    double seconds = 0;          ///< processor seconds of shading, median of the runs
    double prepare_seconds = 0;  ///< processor seconds before the first point is shaded: building trees
    int runs = 0;
    double rays_per_pixel = 0;  ///< shadow rays
    double cut_size = 0;        ///< clusters, pairs or lights of a cut, mean
    render::ErrorFigures error;
    render::Picture picture;  ///< reflected light alone, with the layer `cut_size`
};

struct Curve {
    const ReportMethod* method = nullptr;
    std::vector<Measurement> points;  ///< in the order of the method's values
};

struct SceneMeasurement {
    ReportScene scene;
    render::Picture emitted;  ///< what is seen of the emitters themselves, and of the background
    Measurement exhaustive;   ///< the reference, with virtual lights clamped as by lightcuts
    /// The same without clamping, where that makes a difference.
    std::optional<Measurement> unclamped;
    std::vector<Curve> curves;

    /// What a picture by `method` would be without error: a method that does not clamp has the reference that does not.
    const Measurement& reference_of(const ReportMethod& method) const;
};

struct MeasurementOptions {
    int runs = 3;        ///< medians are over this many
    int threads = 1;     ///< seconds are summed over them
    bool quick = false;  ///< every other setting
};

/// Settings of a scene that `measure` visits.
std::size_t setting_count(const ReportScene& scene, const MeasurementOptions& options);

/// Measures all methods. `start` is called with a description before each setting.
/// Only the method's own work is timed, not eye rays, which are the same for all. What takes seconds is run once.
/// Errors are of reflected light: the radiance of emitters and of the background in view is no method's work, and often
/// so bright that the rest would not count.
SceneMeasurement measure(const ReportScene& scene, const MeasurementOptions& options,
                         const std::function<void(const std::string&)>& start);

/// As few digits as tell settings apart.
std::string as_text(double value);

}  // namespace benchmark
