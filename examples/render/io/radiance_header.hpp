#pragma once

#include <cstddef>
#include <string_view>

#include <glm/vec3.hpp>

#include "io/primaries.hpp"

namespace render {

/// What a Radiance picture says of itself above its pixels.
struct RadianceHeader {
    bool is_xyz = false;                       ///< FORMAT=32-bit_rle_xyze; else RGB
    glm::dvec3 exposure{1.0};                  ///< stored / true: the product of all EXPOSURE and COLORCORR lines
    Primaries primaries = radiance_primaries;  ///< of RGB

    /// The order of pixels, by the resolution line: `-Y` alone begins with the picture's upper edge, `+X` with its
    /// left one.
    bool by_columns = false;   ///< scanlines are columns
    bool from_bottom = false;  ///< rows, or the pixels of a column, go up
    bool from_right = false;   ///< columns, or the pixels of a row, go left
    int width = 0;
    int height = 0;

    std::size_t size = 0;  ///< bytes of the header

    int scanlines() const { return by_columns ? width : height; }
    int scanline_length() const { return by_columns ? height : width; }
};

/// Reads the lines up to the resolution line, from which the size is known to be one that is read. Lines that are
/// indented are a copied header of another picture, and comments like all lines of other names.
/// throws: std::runtime_error saying what is wrong.
RadianceHeader radiance_header(std::string_view bytes);

}  // namespace render
