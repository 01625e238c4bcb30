#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace daylighting {

/// Skies of hours in patches, as Radiance's gendaymtx makes them.
struct SkyMatrix {
    int division = 1;         ///< of the patches, see ReinhartPatches
    std::size_t patches = 0;  ///< that below the horizon is the first
    std::size_t hours = 0;
    bool has_suns = false;          ///< in patches: it was made without gendaymtx's -s, as far as its header says
    std::vector<float> luminances;  ///< cd/m^2, those of an hour one after the other

    std::span<const float> of(std::size_t hour) const { return std::span(luminances).subspan(hour * patches, patches); }
};

/// Reads a sky matrix (.smx): lines of a header, the first of which begins with `#?`, to an empty one, then a row each
/// patch, of three numbers an hour: radiance in red, green and blue, W/(sr m^2). The header's NROWS= is 146, 578, 2306,
/// or that of another division up to 16, NCOLS= the number of hours, NCOMP= is 3; FORMAT= is ascii, or float or double,
/// in the order of bytes that BigEndian= says, else lowest byte first. Luminance is 179 lm/W times 0.265 red + 0.670
/// green + 0.065 blue.
/// `path`: for messages. throws: invalid_input, one line naming the file and the header's line or the patch and hour: a
/// header, or one of its numbers, that is not there or of something else; scaled numbers (EXPOSURE=, COLORCORR=), or
/// made so by gendaymtx -O1 or -5; too few or too many numbers; one that is negative, not finite or beyond 1e9.
SkyMatrix sky_matrix(std::string_view bytes, const std::filesystem::path& path);

/// The same of a file. throws: as `sky_matrix`, and if it cannot be read.
SkyMatrix read_sky_matrix(const std::filesystem::path& path);

}  // namespace daylighting
