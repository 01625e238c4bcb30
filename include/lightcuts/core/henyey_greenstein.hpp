#pragma once

#include <cmath>

namespace lightcuts {

/// Share of scattered light that goes on within a unit of solid angle [Henyey and Greenstein 1941], 1/sr: (1 - g^2) /
/// (4 pi (1 + g^2 - 2 g cos)^(3/2)). `g`: mean cosine, above -1 and below 1; `away`: 1 - cos of the angle by which the
/// light turns, in [0, 2], which keeps its precision where g is near 1.
inline double henyey_greenstein(double g, double away) {
    const double root2 = (1.0 - g) * (1.0 - g) + 2.0 * g * away;
    return 0.079577471545947668 * (1.0 - g) * (1.0 + g) / (root2 * std::sqrt(root2));
}

/// The cosine below which a share of `u` of what is scattered lies: drawn by it if u is uniform in [0, 1).
inline double henyey_greenstein_cosine(double g, double u) {
    // The usual formula, with its division by g carried out: g may be 0.
    const double t = 2.0 * u - 1.0, scale = 1.0 + g * t;
    const double cosine = (t + g * (0.5 * (t * t + 3.0) + g * (t + g * 0.5 * (t * t - 1.0)))) / (scale * scale);
    return std::fmin(std::fmax(cosine, -1.0), 1.0);
}

}  // namespace lightcuts
