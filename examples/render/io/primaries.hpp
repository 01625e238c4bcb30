#pragma once

#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace render {

/// The CIE 1931 chromaticities (x, y) of a color space's primaries and of its white, which is (1, 1, 1).
struct Primaries {
    glm::dvec2 red{0.0};
    glm::dvec2 green{0.0};
    glm::dvec2 blue{0.0};
    glm::dvec2 white{0.0};
};

/// Of Rec. 709 and sRGB, which all colors in a scene have.
inline constexpr Primaries rec709_primaries{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

/// Of Radiance's pictures that name none.
inline constexpr Primaries radiance_primaries{{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, {1.0 / 3.0, 1.0 / 3.0}};

/// A change of color space. Colors without negative channels keep none: what the space converted to cannot show is
/// moved towards the gray of its luminance.
class ColorConversion {
public:
    /// `matrix` takes colors to a space in which `luminance` are the channels' weights, which sum up to 1.
    ColorConversion(const glm::dmat3& matrix, const glm::dvec3& luminance) : matrix_(matrix), luminance_(luminance) {}

    glm::dvec3 operator()(const glm::dvec3& color) const;

private:
    glm::dmat3 matrix_;
    glm::dvec3 luminance_;
};

/// From CIE XYZ to RGB of these primaries, whose white has Y = 1. throws: std::runtime_error if they span no colors.
ColorConversion from_xyz(const Primaries& to);

/// From RGB of these primaries to Rec. 709; white stays white [Bradford's chromatic adaptation]. None if that would
/// change nothing: the primaries are those of Rec. 709, or Radiance's, which differ by 0.01, or all zero, by which
/// files say that they do not know. throws: std::runtime_error if they span no colors.
std::optional<ColorConversion> to_rec709(const Primaries& from);

}  // namespace render
