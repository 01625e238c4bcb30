#pragma once

#include <filesystem>

namespace relight {

/// The name of one of several pictures: NAME-0007.exr for picture 7 of NAME.exr; .exr if it has no extension.
std::filesystem::path frame_path(const std::filesystem::path& whole, int number);

}  // namespace relight
