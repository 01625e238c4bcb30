#pragma once

#include <filesystem>

#include "io/file_source.hpp"
#include "scene.hpp"

namespace render {

/// Reads a Wavefront OBJ file and its MTL libraries: triangles (polygons are cut, concave ones and those with bridges
/// to holes too), per-face materials, vertex normals, uvs and vertex colors where given.
/// Kd with map_Kd: diffuse, times the vertex color; Ks with map_Ks, and Ns: modified Phong, unless illum is 0 or 1;
/// Ke with map_Ke: emitted radiance; d or map_d or map_Kd's alpha: opacity; norm: normal map; illum 5: mirror of
/// reflectance Ks with map_Ks, and opacity d or map_d; illum 7: glass of index Ni tinted by Tf (white where Tf is
/// absent or black). A factor that is not there while its map is counts as 1. Faces without a material are light gray,
/// or of their vertices' colors. What is left out is in `left_out`. throws: invalid_input naming the file, and the
/// line where there is one.
Scene load_obj(const std::filesystem::path& path, const FileSource& files = DiskFiles());

}  // namespace render
