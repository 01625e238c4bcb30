#include "patch_light.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

namespace daylighting {

PatchLight::PatchLight(const ReinhartPatches& patches, std::span<const glm::dvec3> directions) {
    std::vector<std::uint32_t> members(patches.size());
    for (std::uint32_t i = 0; i < directions.size(); ++i) {
        const std::uint32_t patch = patches.of(directions[i]);
        if (patch == 0) continue;
        shares_.push_back({i, patch, patches.solid_angle(patch)});
        ++members[patch];
    }
    for (Share& share : shares_) share.solid_angle /= members[share.patch];
    for (std::uint32_t patch = 1; patch < patches.size(); ++patch) {
        if (members[patch] > 0) continue;
        double largest = -2.0;
        Share share{0, patch, patches.solid_angle(patch)};
        for (std::uint32_t i = 0; i < directions.size(); ++i) {
            const double cosine = glm::dot(directions[i], patches.center(patch));
            if (directions[i].z > 0.0 && cosine > largest) {
                largest = cosine;
                share.direction = i;
            }
        }
        shares_.push_back(share);
    }
}

void PatchLight::spread(std::span<const float> luminances, std::vector<double>& light) const {
    std::fill(light.begin(), light.end(), 0.0);
    for (const Share& share : shares_) {
        light[share.direction] += static_cast<double>(luminances[share.patch]) * share.solid_angle;
    }
}

}  // namespace daylighting
