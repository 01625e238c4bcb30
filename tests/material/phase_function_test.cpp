#include <lightcuts/material/phase_function.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "support/random.hpp"

namespace lightcuts::test {
namespace {

static_assert(BoundedMaterial<HenyeyGreenstein<glm::vec3>> && BoundedMaterial<HenyeyGreenstein<float>>);

TEST(HenyeyGreenstein, ScattersItsAlbedoWithItsMeanCosine) {
    for (const float g : {-0.9f, -0.3f, 0.0f, 0.5f, 0.95f}) {
        const glm::vec3 view = glm::normalize(glm::vec3(1.0f, 2.0f, -0.5f));
        const HenyeyGreenstein<float> phase(view, 0.8f, g);
        const glm::dvec3 z(-view), x = glm::normalize(glm::cross(z, glm::dvec3(0.0, 0.0, 1.0)));
        double sum = 0, cosines = 0;
        constexpr int steps = 20'000;
        for (int i = 0; i < steps; ++i) {
            const double c = -1.0 + 2.0 * (i + 0.5) / steps;
            const glm::vec3 to_light(c * z + std::sqrt(1.0 - c * c) * x);
            const double density = static_cast<double>(phase.evaluate(to_light)) * 4.0 * std::numbers::pi / steps;
            sum += density;
            cosines += density * c;
        }
        EXPECT_NEAR(sum, 0.8, 1e-3);
        EXPECT_NEAR(cosines / sum, static_cast<double>(g), 1e-3);
    }
}

TEST(HenyeyGreenstein, IsEvenForNoAsymmetry) {
    Random random(1);
    const HenyeyGreenstein<float> phase(glm::vec3(0.0f, 1.0f, 0.0f), 1.0f, 0.0f);
    for (int i = 0; i < 100; ++i) {
        EXPECT_FLOAT_EQ(phase.evaluate(glm::vec3(random.on_sphere())), 0.25f / std::numbers::pi_v<float>);
    }
}

}  // namespace
}  // namespace lightcuts::test
