#pragma once

#include <string>
#include <string_view>

#include "io/picture.hpp"

namespace render {

/// Reads a Radiance picture (.hdr, .pic), of RGBE or XYZE pixels, with its exposure and color corrections undone, in
/// any of the eight orders of pixels, run-length encoded or not [Ward, Real Pixels, in Graphics Gems II].
///
/// A mantissa m with exponent e stands for m x 2^(e - 136), so that encoded and decoded powers of two are the same;
/// Radiance's own programs take the middle (m + 0.5) of what may have been rounded down. RGB of other primaries than
/// Radiance's becomes Rec. 709. XYZ is luminance in cd/m^2 by Radiance's convention: it becomes RGB of Radiance's
/// primaries and equal-energy white, divided by 179 lm/W, so that a picture that ra_xyze converted comes back the same.
/// units: W/(m^2 sr) if the file has those. `name`: of the file, for messages.
/// throws: invalid_input, one line naming what is damaged, where that can be told the scanline.
Picture radiance_picture(std::string_view bytes, const std::string& name);

}  // namespace render
