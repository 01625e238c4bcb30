#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <daylight/hourly_sky.hpp>
#include <daylight/reinhart_patches.hpp>

namespace benchmark {

/// A sensor's light by the sky's patches, see ReinhartPatches, that are the same for all sensors: daylight
/// coefficients, and skies as they are multiplied by.
class FixedPatches {
public:
    /// `division`: into how many a side each of the 145 is divided.
    FixedPatches(const daylighting::DirectionTree& directions, const daylighting::Setting& setting, int division);

    std::size_t size() const { return patches_.size(); }

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
    daylighting::ReinhartPatches patches_;
    daylighting::UpAxis up_;
    double solid_angle_;
    std::vector<std::uint32_t> patch_of_;  ///< of each direction
    std::vector<double> solid_angles_;     ///< of the patches, by the directions in them
};

}  // namespace benchmark
