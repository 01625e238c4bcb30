#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lightcuts/piecewise/compact.hpp>
#include <render/rays/ray_scene.hpp>

#include "directions.hpp"
#include "site.hpp"
#include "site_sky.hpp"

namespace relight {

struct CutOptions {
    double deviation = 1.5;  ///< largest L2 error of a node, over its directions [Cut merging 2008, Eq. 5]
    lightcuts::ValueBits bits = lightcuts::ValueBits::eight;
    Sides sides = Sides::both;
};

/// What cuts cost, and how far off they are.
struct CutStatistics {
    std::size_t sites = 0;
    std::size_t pieces = 0;  ///< of all cuts
    std::size_t largest = 0;
    std::uint64_t rays = 0;
    double squared_error = 0.0;  ///< of stored visibility, summed over all rays
    double seconds = 0.0;        ///< of all threads together
    double ray_seconds = 0.0;    ///< of these, in the ray tracer

    double mean_size() const;
    double rms() const;
};

/// The bytes of a file of one visibility cut a site, in their order. All threads of the calling arena work; the bytes
/// do not depend on how many there are. `shown`: progress on a terminal. cost: a ray a site and direction.
std::vector<std::byte> visibility_cuts(const Directions& directions, std::span<const Site> sites,
                                       const render::RayScene& rays, const CutOptions& options,
                                       CutStatistics& statistics, bool shown = false);

}  // namespace relight
