#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace daylighting {

/// The sky in patches of about equal solid angle [Tregenza 1987; Reinhart and Walkenhorst 2001], numbered as Radiance
/// does: 0 is all that is below the horizon; then rows from the horizon up, each from north over east, its first patch
/// centered at north; the last one is about the zenith. Tregenza's 145 patches divided m x m, but for that about the
/// zenith, are 144 m^2 + 1. Directions are unit vectors: x to the east, y to the north, z upwards.
class ReinhartPatches {
public:
    /// pre: division >= 1.
    explicit ReinhartPatches(int division);

    /// The division of which there are so many patches, that below the horizon among them; none if there is none up to
    /// 16.
    static std::optional<int> division_of(std::size_t patches);

    /// Of the patches, that below the horizon among them.
    std::size_t size() const { return solid_angles_.size(); }
    /// The direction of a patch's middle.
    const glm::dvec3& center(std::size_t patch) const { return centers_[patch]; }
    /// sr
    double solid_angle(std::size_t patch) const { return solid_angles_[patch]; }
    /// The integral of the height's sine over a patch of the sky: what it lights level ground by, lux per cd/m^2. Of
    /// all together it is pi; 0 for that below the horizon.
    double projected(std::size_t patch) const { return projected_[patch]; }
    /// The patch that has `direction`.
    std::uint32_t of(const glm::dvec3& direction) const;

private:
    int in_row(int row) const;

    int division_;
    int rows_;
    double row_height_;  ///< radians
    std::vector<std::uint32_t> first_in_row_;
    std::vector<glm::dvec3> centers_;
    std::vector<double> solid_angles_;
    std::vector<double> projected_;
};

}  // namespace daylighting
