#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/measurement.hpp"

namespace benchmark {

/// For each curve, the setting whose time is closest to that of lightcuts at their usual error ratio.
/// pre: the scene has a curve of lightcuts.
std::vector<const Measurement*> equal_time_settings(const SceneMeasurement& scene);

/// The reference and these settings as pictures within the page: what is seen, the difference from the reference
/// sixteenfold, and where cuts are large. All pictures of a scene are exposed alike.
std::string pictures_html(const SceneMeasurement& scene);

/// The cut size that is white in a map of them: the 99th percentile of those above 0. A pixel behind glass has the cuts
/// of many points; a few such pixels would leave the rest black. Nothing if all sizes above 0 are the same.
std::optional<float> white_cut_size(std::vector<float> sizes);

}  // namespace benchmark
