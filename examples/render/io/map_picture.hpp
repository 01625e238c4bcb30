#pragma once

#include <filesystem>

#include "io/picture.hpp"

namespace render {

/// Reads a picture of the light from around: a Radiance or OpenEXR file, by what it holds and not by its name.
/// throws: invalid_input with the path when it is missing, of another kind, damaged or cut short.
Picture read_map(const std::filesystem::path& path);

}  // namespace render
