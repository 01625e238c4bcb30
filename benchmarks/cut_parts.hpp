#pragma once

#include <cstddef>

#include "workload.hpp"

namespace benchmark {

/// A count by where light comes from.
struct Parts {
    double direct = 0;       ///< lamps: all that is neither of the following
    double environment = 0;  ///< distant lights: maps, sun and sky
    double indirect = 0;     ///< virtual lights

    double sum() const { return direct + environment + indirect; }
};

/// What the lightcuts of a workload consist of, means over its points.
struct CutParts {
    Parts lights;         ///< of the scene
    Parts cut;            ///< clusters on a cut
    double rays = 0;      ///< shadow rays
    double at_limit = 0;  ///< share of the cuts that ended at their largest size
};

/// Shades every point of the workload.
CutParts measure_cut_parts(const Workload& work, const lightcuts::LightcutOptions& options);

}  // namespace benchmark
