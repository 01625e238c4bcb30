#pragma once

#include "sky_shape.hpp"

namespace daylighting {

/// The number of skies that `cie_sky` has.
inline constexpr int cie_sky_count = 16;

/// A standard sky of the CIE [ISO 15469:2004 / CIE S 011:2003, Spatial distribution of daylight]: 1 to 15 are the
/// general sky, from overcast by way of even (5) to clear (12, and 13 over polluted places); 16 is the traditional
/// overcast sky, 1 + 2 sin h, which the standard keeps as a formula of its own. 1 is its counterpart among the general
/// ones, within a tenth of the zenith's luminance.
/// throws: invalid_input if there is no such type.
SkyShape cie_sky(int type);

}  // namespace daylighting
