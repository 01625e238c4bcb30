#include "visibility_cuts.hpp"

#include <cmath>

#include "site_cuts.hpp"
#include "site_patches.hpp"

namespace relight {

std::vector<std::byte> visibility_cuts(const Directions& directions, std::span<const Site> sites,
                                       const render::RayScene& rays, const CutOptions& options,
                                       CutStatistics& statistics, bool shown) {
    return site_cuts(
        directions.tree, sites, [&] { return SiteSky(directions, rays, options.sides); },
        {.deviation = options.deviation, .bits = options.bits}, statistics, shown);
}

std::vector<std::byte> bounce_cuts(const Patches& patches, const render::Scene& scene, std::span<const Site> sites,
                                   const render::RayScene& rays, double deviation, Sides sides,
                                   CutStatistics& statistics, bool shown) {
    const std::vector<glm::vec3> ends = ray_ends(patches, scene);
    return site_cuts(
        patches.tree, sites, [&] { return SitePatches(patches, ends, rays, sides); },
        {.deviation = deviation,
         .bits = lightcuts::ValueBits::sixteen,
         .stored = stored_solid_angle,
         .read = read_solid_angle},
        statistics, shown);
}

float stored_solid_angle(float solid_angle) { return std::sqrt(solid_angle); }

float read_solid_angle(float stored) { return stored * stored; }

}  // namespace relight
