#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lightcuts/piecewise/compact.hpp>
#include <render/rays/ray_scene.hpp>

#include "cut_statistics.hpp"
#include "directions.hpp"
#include "patches.hpp"
#include "site.hpp"
#include "site_sky.hpp"

namespace relight {

struct CutOptions {
    double deviation = 1.5;  ///< largest L2 error of a node, over its directions [Cut merging 2008, Eq. 5]
    lightcuts::ValueBits bits = lightcuts::ValueBits::eight;
    Sides sides = Sides::both;
};

/// The bytes of a file of one visibility cut a site, in their order. All threads of the calling arena work; the bytes
/// do not depend on how many there are. `shown`: progress on a terminal. cost: a ray a site and direction.
std::vector<std::byte> visibility_cuts(const Directions& directions, std::span<const Site> sites,
                                       const render::RayScene& rays, const CutOptions& options,
                                       CutStatistics& statistics, bool shown = false);

/// The same of patches: solid angles times visibility, `deviation` in steradians, each in 16 bits as
/// `stored_solid_angle`. cost: a ray a site and patch that faces it.
std::vector<std::byte> bounce_cuts(const Patches& patches, const render::Scene& scene, std::span<const Site> sites,
                                   const render::RayScene& rays, double deviation, Sides sides,
                                   CutStatistics& statistics, bool shown = false);

/// Solid angles of one cut differ by orders of magnitude: their roots are stored, and squared when they are read.
float stored_solid_angle(float solid_angle);
float read_solid_angle(float stored);

}  // namespace relight
