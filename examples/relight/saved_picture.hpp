#pragma once

#include <filesystem>

#include "frame_thread.hpp"

namespace relight {

/// Names of the files of a saved picture.
struct SavedPaths {
    std::filesystem::path exr;
    std::filesystem::path png;
};

/// NAME-0000.exr and NAME-0000.png, where `whole` is NAME.exr, or those of the first number of which there is neither.
SavedPaths free_paths(const std::filesystem::path& whole);

/// Saves `frame` under the `free_paths` of `whole`: radiance, and the colors as they are shown. Returns the name of the
/// former.
/// throws: invalid_input; each of the files is written whole or not at all.
std::filesystem::path save_picture(const std::filesystem::path& whole, const ShownFrame& frame);

}  // namespace relight
