#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <daylight/hourly_sky.hpp>
#include <glm/vec3.hpp>

namespace benchmark {

/// The sky in patches of about equal solid angle that are the same for all sensors [Tregenza 1987; Reinhart and
/// Walkenhorst 2001]: 145 of them, or those divided in 4 x 4, 2,305; and one for all that is below the horizon.
class FixedPatches {
public:
    /// `division`: 1 or 4, into how many a side each of the 145 is divided.
    FixedPatches(const daylighting::DirectionTree& directions, const daylighting::Setting& setting, int division);

    std::size_t size() const { return centers_.size(); }

    /// Daylight coefficients of a sensor: of each patch the sum over its directions of visibility x cosine x solid
    /// angle. No way to find them is better.
    std::vector<float> coefficients(const std::vector<float>& visibility, const std::vector<float>& cosines) const;

    /// How a sun is put into patches: not at all, into the nearest, or into the four nearest by how near they are, as
    /// Radiance's gendaymtx does.
    enum class Sun { none, nearest, four };
    /// Luminances of the patches in one hour of a block: means over their directions, and the sun.
    std::vector<float> luminances(const daylighting::SkyBlock& block, std::size_t hour_in_block,
                                  const daylighting::LitHour& hour, Sun sun) const;

private:
    double solid_angle_;
    std::vector<glm::dvec3> centers_;      ///< in the scene's axes
    std::vector<std::uint32_t> patch_of_;  ///< of each direction
    std::vector<double> solid_angles_;     ///< of the patches, by the directions in them
};

}  // namespace benchmark
