#pragma once

#include <cstddef>
#include <span>

#include <glm/vec3.hpp>
#include <render/rays/ray_scene.hpp>

#include "directions.hpp"
#include "site.hpp"

namespace relight {

struct PilotOptions {
    double beta = 0.45;           ///< share of geometry in the metric [Cut merging 2008, Eq. 12]
    std::size_t clusters = 1024;  ///< of sites, the length of a direction's visibility vector
    std::size_t sites = 4096;     ///< that are tried out: the paper takes all, for twice the rays
};

/// A tree in which directions are neighbors that about the same sites see, found out by some sites that lie evenly in
/// their list. cost: a ray a tried site and direction; directions x clusters numbers, and some passes over them.
Directions data_driven_directions(std::span<const glm::vec3> directions, std::span<const Site> sites,
                                  const render::RayScene& rays, const PilotOptions& options);

}  // namespace relight
