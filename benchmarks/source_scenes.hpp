#pragma once

#include <cstddef>

#include "scene.hpp"

namespace benchmark {

/// The furnished room of `builtin:surfaces`, lit by one square lamp under its ceiling that is `points` oriented lights.
render::Scene room_with_lamp(std::size_t points);

/// Puts a map around `scene` unless one is there: a sky with a bright and a dim sun over a dark ground.
void surround(render::Scene& scene);

/// Replaces the distant lights of `scene` by `count` that stand for the map around it. pre: there is one
void light_by_map(render::Scene& scene, std::size_t count);

}  // namespace benchmark
