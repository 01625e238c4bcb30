#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "reinhart_patches.hpp"

namespace daylighting {

/// Deals the light of the sky's patches out to directions: that of a patch evenly to those in it, or, if there are
/// none, to the one nearest to its middle. So a patch gives what its solid angle says, however few directions it has.
class PatchLight {
public:
    /// `directions`: unit, x to the east, y to the north, z upwards; one at least is above the horizon.
    PatchLight(const ReinhartPatches& patches, std::span<const glm::dvec3> directions);

    /// Makes `light` of each direction above the horizon luminance x solid angle, of the others 0. `luminances`: one a
    /// patch, that below the horizon first, which is passed over.
    void spread(std::span<const float> luminances, std::vector<double>& light) const;

private:
    struct Share {
        std::uint32_t direction = 0;
        std::uint32_t patch = 0;
        double solid_angle = 0.0;
    };
    std::vector<Share> shares_;
};

}  // namespace daylighting
