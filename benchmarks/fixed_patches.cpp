#include "fixed_patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace benchmark {

using namespace daylighting;

namespace {

constexpr std::array<int, 7> in_row = {30, 30, 24, 24, 18, 12, 6};

}  // namespace

FixedPatches::FixedPatches(const DirectionTree& directions, const Setting& setting, int division)
    : solid_angle_(directions.solid_angle()) {
    const int rows = static_cast<int>(in_row.size()) * division;
    const double height = std::numbers::pi / 2.0 / (rows + 0.5);
    centers_.push_back(from_compass(glm::dvec3(0.0, 0.0, -1.0), setting.up));
    std::vector<std::uint32_t> first;
    for (int row = 0; row < rows; ++row) {
        const int count = in_row[static_cast<std::size_t>(row / division)] * division;
        first.push_back(static_cast<std::uint32_t>(centers_.size()));
        for (int i = 0; i < count; ++i) {
            const double up = height * (row + 0.5), turn = 2.0 * std::numbers::pi * i / count;
            centers_.push_back(from_compass(
                glm::dvec3(std::cos(up) * std::sin(turn), std::cos(up) * std::cos(turn), std::sin(up)), setting.up));
        }
    }
    const auto zenith = static_cast<std::uint32_t>(centers_.size());
    centers_.push_back(from_compass(glm::dvec3(0.0, 0.0, 1.0), setting.up));
    solid_angles_.resize(centers_.size());
    for (const glm::vec3& direction : directions.directions) {
        const glm::dvec3 d = to_compass(glm::dvec3(direction), setting.up);
        std::uint32_t patch = 0;
        if (d.z > 0.0) {
            const int row = static_cast<int>(std::asin(d.z) / height);
            patch = zenith;
            if (row < rows) {
                const int count = in_row[static_cast<std::size_t>(row / division)] * division;
                const double turn = std::atan2(d.x, d.y) / (2.0 * std::numbers::pi) * count;
                const int at = (static_cast<int>(std::lround(turn)) % count + count) % count;
                patch = first[static_cast<std::size_t>(row)] + static_cast<std::uint32_t>(at);
            }
        }
        patch_of_.push_back(patch);
        solid_angles_[patch] += solid_angle_;
    }
}

std::vector<float> FixedPatches::coefficients(const std::vector<float>& visibility,
                                              const std::vector<float>& cosines) const {
    std::vector<double> sums(size());
    for (std::size_t i = 0; i < visibility.size(); ++i) {
        sums[patch_of_[i]] += static_cast<double>(visibility[i] * cosines[i]) * solid_angle_;
    }
    return {sums.begin(), sums.end()};
}

std::vector<float> FixedPatches::luminances(const SkyBlock& block, std::size_t h, const LitHour& hour, Sun sun) const {
    std::vector<double> light(size());
    for (std::size_t i = 0; i < patch_of_.size(); ++i) light[patch_of_[i]] += static_cast<double>(block.light()[i][h]);
    for (std::size_t p = 0; p < size(); ++p) light[p] /= std::max(solid_angles_[p], solid_angle_);
    if (sun != Sun::none && hour.has_sun()) {
        std::vector<std::pair<double, std::size_t>> nearest;
        for (std::size_t p = 1; p < size(); ++p) {
            nearest.emplace_back(-glm::dot(centers_[p], glm::dvec3(hour.towards_sun)), p);
        }
        const std::ptrdiff_t count = sun == Sun::nearest ? 1 : 4;
        std::partial_sort(nearest.begin(), nearest.begin() + count, nearest.end());
        double total = 0.0;
        for (std::ptrdiff_t i = 0; i < count; ++i) total += 1.0 / (1.002 + nearest[static_cast<std::size_t>(i)].first);
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const auto [cosine, p] = nearest[static_cast<std::size_t>(i)];
            light[p] += hour.sky.direct_illuminance() / (1.002 + cosine) / total /
                        std::max(solid_angles_[p], solid_angle_);
        }
    }
    return {light.begin(), light.end()};
}

}  // namespace benchmark
