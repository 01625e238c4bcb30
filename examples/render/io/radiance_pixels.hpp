#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace render {

/// Three mantissas and the exponent that they share.
using Rgbe = std::array<std::uint8_t, 4>;

/// Unpacks `scanlines` scanlines of `length` pixels, in the file's order; `bytes` begin after the header, and what
/// follows the last scanline is left alone.
///
/// A scanline that begins with 2, 2 and its length in two bytes, the higher below 128, is run-length encoded channel by
/// channel; none shorter than 8 or longer than 32767 pixels is. In others, pixels 1, 1, 1, n after the first repeat the
/// one before n times; directly following ones count 256 times as much each. Where that fails, pixels that fill four
/// bytes each exactly are taken as they are: in some files they look like encoded ones.
/// cost: memory in proportion to what is unpacked, not to the size that is asked for.
/// throws: std::runtime_error naming the scanline, from 1, that is cut short or damaged.
std::vector<Rgbe> radiance_pixels(std::string_view bytes, std::size_t length, std::size_t scanlines);

}  // namespace render
