#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/scene.hpp>
#include <render/surfaces/surface.hpp>
#include <render/view.hpp>

namespace relight {

/// What a camera sees of a scene whatever lights it: surface points, also in mirrors and through glass, with their
/// materials, and where rays leave the scene. Pictures under any light are made of it without another eye ray.
struct SeenPoints {
    int width = 0;
    int height = 0;
    std::vector<render::SurfacePoint> points;  ///< by pixel; weights are shares of the pixel
    std::vector<render::Escape> escapes;       ///< likewise
    std::vector<glm::vec3> emitted;            ///< by pixel: of the scene's own emitters in sight

    std::size_t pixel_count() const { return emitted.size(); }
};

/// With `spp` eye rays a pixel. threads: those of the calling arena.
SeenPoints see(const render::Scene& scene, const render::RayScene& rays, const render::View& view, int spp,
               std::uint64_t seed, render::Shade shade);

}  // namespace relight
