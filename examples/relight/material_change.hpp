#pragma once

#include <span>

#include <render/surfaces/surface.hpp>
#include <render/surfaces/surface_lobes.hpp>

namespace relight {

/// What is changed of all materials of a scene.
struct MaterialChange {
    bool is_diffuse = false;   ///< all are Lambert with their base color, glass too
    float albedo = 1.0f;       ///< times what surfaces reflect and let through diffusely, which stays at most 1
    float gloss_width = 1.0f;  ///< times the width of glossy lobes: GGX's alpha, and of Phong's lobes likewise

    bool operator==(const MaterialChange&) const = default;
};

/// `lobes` with another albedo and width, as `change` says; untouched by factors of 1. Whether they are diffuse is
/// decided where they are made. A GGX alpha stays between 0.0004, that of the smoothest that is no mirror, and 1, an
/// exponent at least 0. pre: both factors are finite, the albedo's at least 0, the width's above 0.
render::SurfaceLobes changed(const render::SurfaceLobes& lobes, const MaterialChange& change);

/// Gives each of `points` its own lobes, changed. pre: as many lobes as points. threads: those of the calling arena
void change_all(std::span<const render::SurfaceLobes> own, const MaterialChange& change,
                std::span<render::SurfacePoint> points);

}  // namespace relight
