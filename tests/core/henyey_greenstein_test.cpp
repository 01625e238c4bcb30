#include <lightcuts/core/henyey_greenstein.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lightcuts::test {
namespace {

/// The share of what is scattered by less than a drawn cosine is the number it was drawn by.
TEST(HenyeyGreensteinCosine, InvertsTheDistribution) {
    for (const double g : {0.0, 1e-9, 0.3, 0.9, 0.999, -0.5, -0.999}) {
        for (const double u : {0.0, 1e-6, 0.1, 0.5, 0.77, 0.999999}) {
            const double cosine = henyey_greenstein_cosine(g, u);
            ASSERT_GE(cosine, -1.0);
            ASSERT_LE(cosine, 1.0);
            double below = 0.0;
            constexpr int steps = 200000;
            // Even steps of the angle, which resolve the peak.
            const double from = std::acos(cosine);
            for (int i = 0; i < steps; ++i) {
                const double angle = from + (std::numbers::pi - from) * (i + 0.5) / steps;
                below += henyey_greenstein(g, 2.0 * std::pow(std::sin(0.5 * angle), 2.0)) * 2.0 * std::numbers::pi *
                         std::sin(angle) * (std::numbers::pi - from) / steps;
            }
            EXPECT_NEAR(below, u, 3e-5) << g << ' ' << u;
        }
    }
}

TEST(HenyeyGreensteinCosine, StaysBetweenMinusOneAndOne) {
    for (const double g : {1.0 - 0x1p-24, -1.0 + 0x1p-24, 0.0}) {
        for (const double u : {0.0, 0x1p-32, 0.5, 1.0 - 0x1p-32}) {
            const double cosine = henyey_greenstein_cosine(g, u);
            EXPECT_GE(cosine, -1.0);
            EXPECT_LE(cosine, 1.0);
        }
    }
}

}  // namespace
}  // namespace lightcuts::test
