#pragma once

#include <string>
#include <string_view>

#include "io/picture.hpp"

namespace render {

/// What an OpenEXR picture is read for.
enum class ExrUse {
    picture,  ///< to be shown or compared: with all channels
    map,      ///< light from around: color alone, and no cube maps
    texture,  ///< color, and alpha as the channel `A` if there is one
};

/// Reads an OpenEXR picture: R, G and B, or Y as gray, or luminance and chroma (Y, RY, BY), of the first part that has
/// color, whatever the channels' type.
///
/// The picture is what the display window shows: black where there are no data, and without what lies outside; data
/// that lie outside altogether are the picture themselves. RGB of other primaries than Rec. 709, by the attribute
/// `chromaticities`, is converted to it. The shape of pixels is left alone. Infinite and NaN values are kept.
/// Of other channels, those with a value for each pixel are read. `name`: of the file, for messages.
/// throws: invalid_input, one line: not an OpenEXR picture, cut short, damaged, deep, of no color, or too large.
Picture exr_picture(std::string_view bytes, const std::string& name, ExrUse use);

}  // namespace render
