#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene.hpp"

namespace render {

/// Fills `scene.sphere_points`: `points` omni lights of equal power inside each of `scene.spheres`, such that the
/// sphere is equally bright all over, and likewise those of spheres at instants; 0 `points` leave spheres out. throws:
/// invalid_input when that would be more than 100 million lights.
void add_sphere_lights(Scene& scene, std::size_t points, std::uint64_t seed);

/// Lights on the surfaces of `scene.spheres`, just as many as inside: what particles start from, since what a sphere
/// contains does not shadow it.
std::vector<lightcuts::OrientedPointLight<>> sphere_shells(const Scene& scene);

/// The same of spheres at instants.
std::vector<lightcuts::InstantLight<lightcuts::OrientedPointLight<>>> moving_sphere_shells(const Scene& scene);

}  // namespace render
