// The ends of what float holds: radiance above its largest number, distances up to 1e18.

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/material/lambert.hpp>
#include "support/random.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

/// A fraction of each light, by its place.
constexpr auto fraction = [](const auto&, const OmniLight<float>& light) {
    const std::uint64_t bits = hash_keys(1, static_cast<std::uint64_t>(static_cast<std::int64_t>(
                                                1000.0f * light.position.x / (1.0f + std::fabs(light.position.x)))));
    return 0.25f * static_cast<float>(bits % 5);
};

// Shadows come first: then no light adds more than the largest float, in a cut as in the sum.
TEST(Range, RadianceSaturatesAfterItsShadow) {
    Random random(1);
    int saturated = 0;
    for (int i = 0; i < 3000; ++i) {
        std::vector<OmniLight<float>> lights(2 + random.below(6));
        for (auto& light : lights) {
            light.position = V(random.on_sphere() * random.decades(-12.0, 0.0));
            light.intensity = static_cast<float>(random.decades(0.0, 37.0));
        }
        const LightTree tree(lights);
        const Receiver<Lambert<float>> receiver(V(0.0f), Lambert<float>{V(random.on_sphere()), 0.5f});
        const float exact = exhaustive(tree, receiver, fraction).radiance;
        const auto cut = shade(tree, receiver, fraction, {.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0});
        EXPECT_TRUE(std::isfinite(exact));
        EXPECT_NEAR(static_cast<double>(cut.radiance), static_cast<double>(exact), 1e-5 * static_cast<double>(exact));
        saturated += exact > 1e37f && exact < std::numeric_limits<float>::max() ? 1 : 0;
    }
    EXPECT_GT(saturated, 50);
}

TEST(Range, ErrorsAreBoundedUpToDistancesOf1e18) {
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
        const double scale = random.decades(-16.0, 17.5);
        std::vector<OmniLight<float>> lights(2 + random.below(30));
        double sum = 0.0;
        for (auto& light : lights) {
            light.position = V(random.in_box(glm::dvec3(-scale), glm::dvec3(scale)));
            light.intensity = static_cast<float>(scale * random.decades(-3.0, 0.0));
            sum += static_cast<double>(light.intensity);
        }
        const LightTree tree(lights);
        const V at(random.in_box(glm::dvec3(-scale), glm::dvec3(scale)));
        const Receiver<Lambert<float>> receiver(at, Lambert<float>{V(random.on_sphere()), 0.5f});
        const auto exact = static_cast<double>(exhaustive(tree, receiver, fraction).radiance);
        // A cosine near zero is a difference: two evaluations of it are apart by some roundoffs of 1, not of itself.
        double noise = 0.0;
        for (const auto& light : lights) {
            const glm::dvec3 offset = glm::dvec3(light.position) - glm::dvec3(at);
            noise += 0x1p-22 * 0.5 * 0.3184 * static_cast<double>(light.intensity) / glm::dot(offset, offset);
        }
        for (const float ratio : {0.0f, 0.02f, 0.3f}) {
            const auto cut = shade(tree, receiver, fraction,
                                   {.error_ratio = ratio, .max_cut = 0, .exhaustive_below = 0});
            EXPECT_LE(std::fabs(static_cast<double>(cut.radiance) - exact),
                      static_cast<double>(cut.error_bound) + 1e-5 * exact + noise + 0x1p-126 * sum)
                << scale;
        }
    }
}

}  // namespace
}  // namespace lightcuts::test
