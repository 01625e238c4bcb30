#pragma once

#include <string_view>

#include <ImfMultiPartInputFile.h>

namespace render {

/// Throws std::runtime_error if the header of an OpenEXR file ends before its attributes do: OpenEXR makes room for as
/// much as they claim to have.
void check_exr_attributes(std::string_view bytes);

/// Where the color of an OpenEXR file is, and in which channels.
struct ExrColor {
    enum class Kind {
        rgb,               ///< R, G and B
        gray,              ///< Y alone
        luminance_chroma,  ///< Y, and RY and BY for every second pixel of every second row
    };
    int part = 0;
    Kind kind = Kind::rgb;
};

/// The first part with color. throws: std::runtime_error if there is none, saying what there is, or if its channels
/// are of a layout that is not read.
ExrColor exr_color(const Imf::MultiPartInputFile& file);

}  // namespace render
