#pragma once

#include <string>

#include "options.hpp"
#include "scene.hpp"

namespace benchmark {

/// render::prepare_scene of `options`, which are those of the scene that benchmarks call `name`.
/// throws: invalid_input, which names the scene also where options do not go with it.
render::Scene prepared_scene(const std::string& name, render::Options& options);

/// The same with the virtual lights that the options ask for.
render::Scene lit_scene(const std::string& name, render::Options& options);

}  // namespace benchmark
