#pragma once

#include <glm/vec3.hpp>

namespace daylighting {

/// How luminance is distributed over a sky, up to a factor that all directions share: a gradation by the height h of a
/// direction above the horizon, times an indicatrix by its angle x to the sun,
///   (1 + a exp(b / sin h) + s sin h) (base + c exp(d x) + e cos^2 x).
/// Perez' all-weather model has a base of 1, the CIE's general sky one by which the indicatrix is 1 at right angles to
/// the sun. Only the CIE's traditional overcast sky has an s. As it stands, luminance is even.
struct SkyShape {
    double a = 0.0, b = -1.0, c = 0.0, d = -1.0, e = 0.0;
    double base = 1.0;
    double s = 0.0;

    /// Not negative, and finite. Both directions are unit, z upwards; `direction` is above the horizon, the sun may be
    /// below.
    double luminance(const glm::dvec3& direction, const glm::dvec3& towards_sun) const;
};

}  // namespace daylighting
