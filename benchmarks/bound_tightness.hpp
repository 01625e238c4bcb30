#pragma once

#include <cstddef>
#include <string>

namespace benchmark {

/// Cut sizes by the library's bounds and by exact ones, averaged over receivers.
struct BoundTightness {
    std::string scene;
    std::size_t lights = 0, receivers = 0;
    double exact = 0;         ///< by the largest transfer that any of a cluster's lights has, shadows apart
    double usual = 0;         ///< by the default, TwoStageBounds
    double tight = 0;         ///< by its second stage wherever there is one
    double separate = 0;      ///< by SeparateBounds
    double median_ratio = 0;  ///< of usual / exact over the receivers
};

/// Shades a picture of `scene` (see scene_options) by all of them. `max_cut`: as in LightcutOptions.
BoundTightness measure_tightness(const std::string& scene, int width, int height, std::size_t max_cut);

}  // namespace benchmark
