#pragma once

#include <lightcuts/shading/receiver.hpp>

#include "scene.hpp"
#include "surfaces/surface.hpp"
#include "surfaces/surface_material.hpp"

namespace render {

using SurfaceReceiver = lightcuts::Receiver<SurfaceMaterial>;

inline SurfaceReceiver receiver_of(const Scene& scene, const SurfacePoint& p) {
    return {p.position, SurfaceMaterial(p), p.ray_origin, receiver_name(scene, p)};
}

}  // namespace render
