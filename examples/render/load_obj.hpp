#pragma once

#include <filesystem>

#include "scene.hpp"

namespace render {

/// Reads a Wavefront OBJ file and its MTL libraries: triangles (polygons are cut), per-face materials, vertex normals
/// and uvs where given. Kd with map_Kd: diffuse; Ks and Ns: modified Phong; Ke with map_Ke: emitted radiance; d or
/// map_Kd's alpha: partial cover; illum 5: mirror of reflectance Ks; illum 7: glass of index Ni tinted by Tf (white
/// where Tf is absent or black). Faces without a material are light grey.
/// throws: invalid_input naming the file, and the line where there is one.
Scene load_obj(const std::filesystem::path& path);

}  // namespace render
