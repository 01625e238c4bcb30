#pragma once

#include <filesystem>
#include <string>

#include "io/picture.hpp"

namespace render {

/// How far a picture is from a reference. Infinite against a black reference, unless both are black.
struct ErrorFigures {
    double relative_rmse = 0;  ///< |picture - reference|_2 / |reference|_2 over all channels
    double relative_l1 = 0;    ///< likewise with the 1-norm
    double relative_bias = 0;  ///< sum of (picture - reference) / sum of reference: above 0 the picture is too bright
    /// Of |L - L_ref| / L_ref over pixels, L being luminance; pixels with L_ref = 0 are left out.
    double max_relative = 0;
    double p999_relative = 0;  ///< 99.9th percentile, interpolated between neighbors
    /// Steps that the reference does not have, as bands and noise make them: |(L_i - L_j) - (Lref_i - Lref_j)| /
    /// max(Lref_i, Lref_j) over pixels i, j beside or below each other; pairs with two black references are left out.
    double max_step = 0;
    double p999_step = 0;
};

/// throws: invalid_input if the sizes differ.
ErrorFigures compare(const Picture& picture, const Picture& reference);

/// A picture of each pixel's relative error of luminance, in false colors. pre: white > 0.
/// throws: invalid_input if the sizes differ.
std::vector<glm::vec3> heat_map(const Picture& picture, const Picture& reference, double white);

}  // namespace render
