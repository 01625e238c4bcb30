#pragma once

#include <cstdint>

namespace render {

/// Pictures of more pixels, or longer sides, are refused: what a damaged file claims must not fill the memory.
inline constexpr std::int64_t max_picture_pixels = std::int64_t(1) << 28;
inline constexpr std::int64_t max_picture_side = std::int64_t(1) << 17;

/// Throws std::runtime_error if a picture cannot have this size: it has no pixels, or too many.
void check_picture_size(std::int64_t width, std::int64_t height);

}  // namespace render
