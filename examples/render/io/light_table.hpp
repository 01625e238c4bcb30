#pragma once

#include <filesystem>

#include "io/file_source.hpp"
#include "scene.hpp"

namespace render {

/// Adds the lights of a CSV file with the header `kind,x,y,z,dx,dy,dz,r,g,b` to `scene`. kind: `omni` (x y z),
/// `oriented` (x y z, and d: the direction of maximum emission), `directional` (d: the direction light travels),
/// `sphere` (x y z, and its radius in dx); fields that a kind does not use are empty. r g b: intensity, W/sr
/// (directional: irradiance on a facing plane, W/m^2). Directions need not be of unit length. Lights of zero intensity
/// are counted and left out; empty lines are skipped. throws: invalid_input with "file:line: problem"; the scene is
/// then unchanged.
void add_light_table(const std::filesystem::path& path, Scene& scene, const FileSource& files = DiskFiles());

}  // namespace render
