#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace render {

/// First line on which each material of an OBJ file is used.
using MaterialUses = std::map<std::string, std::size_t>;

/// Reads the lines of an OBJ file and of its MTL libraries for what tinyobjloader would silently turn into zeros or
/// skip: numbers that are none or not finite, faces of less than three vertices, indices without a vertex, libraries
/// that are not there. Without a library no material counts as used. throws: invalid_input naming file and line.
MaterialUses check_obj(const std::filesystem::path& path, std::string_view text);

}  // namespace render
