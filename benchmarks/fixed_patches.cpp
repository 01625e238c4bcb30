#include "fixed_patches.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

namespace benchmark {

using namespace daylighting;

FixedPatches::FixedPatches(const DirectionTree& directions, const Setting& setting, int division)
    : patches_(division), up_(setting.up), solid_angle_(directions.solid_angle()), solid_angles_(patches_.size()) {
    for (const glm::vec3& direction : directions.directions) {
        patch_of_.push_back(patches_.of(to_compass(glm::dvec3(direction), up_)));
        solid_angles_[patch_of_.back()] += solid_angle_;
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
        const glm::dvec3 to_sun = to_compass(glm::dvec3(hour.towards_sun), up_);
        std::vector<std::pair<double, std::size_t>> nearest;
        for (std::size_t p = 1; p < size(); ++p) { nearest.emplace_back(-glm::dot(patches_.center(p), to_sun), p); }
        const std::ptrdiff_t count = sun == Sun::nearest ? 1 : 4;
        std::partial_sort(nearest.begin(), nearest.begin() + count, nearest.end());
        double total = 0.0;
        for (std::ptrdiff_t i = 0; i < count; ++i) total += 1.0 / (1.002 + nearest[static_cast<std::size_t>(i)].first);
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const auto [cosine, p] = nearest[static_cast<std::size_t>(i)];
            light[p] += hour.direct_illuminance / (1.002 + cosine) / total / std::max(solid_angles_[p], solid_angle_);
        }
    }
    return {light.begin(), light.end()};
}

}  // namespace benchmark
