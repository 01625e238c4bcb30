#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>
#include <render/rays/ray_scene.hpp>

#include "directions.hpp"
#include "patches.hpp"
#include "seen_points.hpp"
#include "site.hpp"
#include "site_sky.hpp"

namespace relight {

/// Where the visibility of an exhaustive sum comes from.
enum class Truth : std::uint8_t {
    pixels,    ///< a ray from each point: what light does
    vertices,  ///< rays from the sites at the triangle's corners, interpolated: what cuts stand for
    none,      ///< everything is visible
};

/// By point, the radiance that it reflects of all directions one by one. `power`: by direction. `shown`: progress on a
/// terminal. threads: those of the calling arena. cost: a ray a point and direction, or three a triangle in sight.
void shade_exhaustively(const SeenPoints& seen, const Sites& sites, const Directions& directions,
                        std::span<const glm::vec3> power, const render::RayScene& rays, Sides sides, Truth truth,
                        bool shown, std::span<glm::vec3> radiance);

/// Adds to `radiance`, by point, what it reflects of the light of all patches one by one. `patch_radiance`: by patch.
/// Otherwise as `shade_exhaustively`.
void add_bounce_exhaustively(const SeenPoints& seen, const Sites& sites, const Patches& patches,
                             const render::Scene& scene, std::span<const glm::vec3> patch_radiance,
                             const render::RayScene& rays, Sides sides, Truth truth, bool shown,
                             std::span<glm::vec3> radiance);

}  // namespace relight
