#pragma once

#include <cstddef>
#include <cstdint>

#include "rays/ray_scene.hpp"
#include "scene.hpp"
#include "surfaces/surface_lobes.hpp"

namespace render {

/// Fills `scene.virtual_lights` and, in fog, `volume_lights`: about `count` lights that stand for all light which
/// surfaces reflect diffusely and fog scatters, after any number of bounces, from all other lights of the scene. 0:
/// none. `rays`: of `scene`. Where light changes while the shutter is open, they are at instants: about `count`
/// together, at least one particle for each instant. throws: invalid_input naming the scene if all particles from its
/// lights miss it, or none is reflected diffusely. threads: those of the calling task arena; the lights do not depend
/// on them.
void add_virtual_lights(Scene& scene, const RayScene& rays, std::size_t count, Shade shade, std::uint64_t seed);

/// Names in `scene.left_out` the materials whose diffuse and glossy parts add up to more than 1, of which particles
/// carry on at most 1.
void name_amplifying_materials(Scene& scene);

}  // namespace render
