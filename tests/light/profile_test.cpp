#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <lightcuts/light/falloff.hpp>
#include <lightcuts/light/scattering.hpp>
#include <lightcuts/light/spot.hpp>
#include "support/random.hpp"

namespace lightcuts::test {
namespace {

TEST(SpotProfile, IsOneInsideZeroOutsideAndASquaredRampBetween) {
    const SpotProfile p{0.9f, 0.5f};
    EXPECT_EQ(p(1.0f), 1.0f);
    EXPECT_EQ(p(0.9f), 1.0f);
    EXPECT_EQ(p(0.5f), 0.0f);
    EXPECT_EQ(p(-1.0f), 0.0f);
    EXPECT_NEAR(p(0.7f), 0.25f, 1e-6f);
}

TEST(SpotProfile, WithoutARampIsAStep) {
    const SpotProfile step{0.5f, 0.5f};
    EXPECT_EQ(step(0.5f), 1.0f);
    EXPECT_EQ(step(0.75f), 1.0f);
    EXPECT_EQ(step(0.25f), 0.0f);
    EXPECT_EQ(step.emission_bound(-1.0f, 0.5f), 1.0f);
    EXPECT_EQ(step.emission_bound(-1.0f, 0.25f), 0.0f);
    const SpotProfile merged = merge(step, SpotProfile{0.9f, 0.1f});
    for (const float c : {0.1f, 0.3f, 0.5f, 0.9f}) EXPECT_GE(merged(c), step(c));
}

TEST(SpotProfile, MergedIsNowhereBelowEither) {
    Random random(1);
    for (int trial = 0; trial < 20000; ++trial) {
        const auto profile = [&] {
            const float outer = random.real(-1.0, 0.99);
            const float inner = outer + static_cast<float>(random.decades(-6.0, 0.0)) * (1.0f - outer);
            return inner > outer ? SpotProfile{inner, outer} : SpotProfile{1.0f, outer};
        };
        const SpotProfile a = profile(), b = profile(), both = merge(a, b);
        EXPECT_LT(both.cos_outer, both.cos_inner);
        for (int i = 0; i < 20; ++i) {
            const float c = i == 0 ? a.cos_outer : i == 1 ? b.cos_inner : i == 2 ? a.cos_inner : random.real(-1.0, 1.0);
            EXPECT_LE(a(c), both.emission_bound(c, c));
            EXPECT_LE(b(c), both.emission_bound(-1.0f, c));
            EXPECT_LE(both.emission_bound(-1.0f, c), 1.0f);
        }
    }
}

TEST(ScatteringProfile, MergedIsNowhereBelowEither) {
    Random random(3);
    for (int trial = 0; trial < 20000; ++trial) {
        const auto profile = [&] {
            return ScatteringProfile{random.chance(0.1) ? 0.0f : static_cast<float>(1.0 - random.decades(-6.0, 0.0))};
        };
        const ScatteringProfile a = profile(), b = profile(), both = merge(a, b);
        for (int i = 0; i < 20; ++i) {
            const float c = i == 0 ? 1.0f : i == 1 ? -1.0f : random.real(-1.0, 1.0);
            EXPECT_GE(a(c), 0.0f);
            EXPECT_LE(a(c), both.emission_bound(-1.0f, c));
            EXPECT_LE(b(c), both.emission_bound(c, c));
            EXPECT_LE(both.emission_bound(-1.0f, c), 1.0f);
        }
        EXPECT_EQ(a(1.0f), 1.0f);
        EXPECT_EQ(a(1.0f + 1e-7f), 1.0f);
    }
}

/// The integral of its intensity over all directions is what it scatters, and the mean cosine that of the medium.
TEST(ScatteringPointLight, EmitsItsPowerByThePhaseFunction) {
    const glm::vec3 along(0.0f, 0.0f, 1.0f);
    for (const float g : {0.0f, 0.5f, 0.9f, -0.3f, -0.99f}) {
        const ScatteringPointLight<> light = scattering_point_light(glm::vec3(1.0f), along, glm::vec3(2.0f, 1.0f, 0.0f),
                                                                    g);
        EXPECT_EQ(light.axis.z, g < 0.0f ? -1.0f : 1.0f);
        double power = 0.0, turned = 0.0;
        constexpr int steps = 2000000;
        for (int i = 0; i < steps; ++i) {
            const double cosine = -1.0 + 2.0 * (i + 0.5) / steps;
            const double sent = double(light.emission(float(cosine))) * 4.0 * std::numbers::pi / steps;
            power += sent;
            turned += sent * cosine * double(light.axis.z);
        }
        EXPECT_NEAR(power * double(light.intensity.x), 2.0, 2e-3) << g;
        EXPECT_NEAR(power * double(light.intensity.y), 1.0, 1e-3) << g;
        EXPECT_EQ(light.intensity.z, 0.0f);
        EXPECT_NEAR(turned / power, double(g), 2e-3);
    }
}

TEST(PolynomialFalloff, IsTheInverseOfItsPolynomial) {
    EXPECT_EQ((PolynomialFalloff{1.0f, 0.0f, 0.0f}(7.0f)), 1.0f);
    EXPECT_EQ((PolynomialFalloff{}(2.0f)), 0.25f);
    EXPECT_EQ((PolynomialFalloff{1.0f, 2.0f, 3.0f}(2.0f)), 1.0f / 17.0f);
}

TEST(PolynomialFalloff, MergedIsNowhereBelowEither) {
    Random random(2);
    for (int trial = 0; trial < 20000; ++trial) {
        const auto falloff = [&] {
            const auto coefficient = [&] {
                return random.chance(0.3) ? 0.0f : static_cast<float>(random.decades(-6.0, 6.0));
            };
            return PolynomialFalloff{coefficient(), coefficient(), coefficient() + 1e-9f};
        };
        const PolynomialFalloff a = falloff(), b = falloff();
        const FalloffEnvelope<PolynomialFalloff> both = merge(FalloffEnvelope<PolynomialFalloff>{a}, {b});
        for (int i = 0; i < 20; ++i) {
            const float d = static_cast<float>(random.decades(-20.0, 15.0));
            const float nearest = d * random.real(0.0, 1.0);
            EXPECT_LE(a(d), both.falloff_bound(nearest));
            EXPECT_LE(b(d), both.falloff_bound(d));
        }
        EXPECT_GE(both.falloff_bound(0.0f), a(0.0f));
    }
}

}  // namespace
}  // namespace lightcuts::test
