#include <lightcuts/core/rounding.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "configurations.hpp"

namespace {

using lightcuts::next_down;
using lightcuts::next_up;
using lightcuts::round_down;
using lightcuts::round_up;

constexpr float float_max = std::numeric_limits<float>::max();
constexpr float float_min = std::numeric_limits<float>::min();
constexpr float float_inf = std::numeric_limits<float>::infinity();
constexpr double double_inf = std::numeric_limits<double>::infinity();

static_assert(next_up(1.0f) == 1.0f + 0x1p-23f);
static_assert(round_up(1.0) == 1.0f && round_down(1.0) == 1.0f);

TEST(Rounding, NeighborsAreThoseOfTheStandardLibrary) {
    configurations::Draw draw(1);
    for (int i = 0; i < 200000; ++i) {
        const double x = (draw.chance(0.5) ? 1.0 : -1.0) * std::ldexp(draw.unit(), draw.below(280) - 150);
        const float f = static_cast<float>(x);
        ASSERT_EQ(next_up(f), std::nextafter(f, float_inf));
        ASSERT_EQ(next_down(f), std::nextafter(f, -float_inf));
        ASSERT_EQ(next_up(x), std::nextafter(x, double_inf));
        ASSERT_EQ(next_down(x), std::nextafter(x, -double_inf));
    }
}

TEST(Rounding, NeighborsOfSpecialValues) {
    for (const float f : {0.0f, -0.0f, float_max, -float_max, float_min, -float_min, float_inf, -float_inf}) {
        EXPECT_EQ(next_up(f), std::nextafter(f, float_inf)) << f;
        EXPECT_EQ(next_down(f), std::nextafter(f, -float_inf)) << f;
        const double d = static_cast<double>(f);
        EXPECT_EQ(next_up(d), std::nextafter(d, double_inf)) << f;
        EXPECT_EQ(next_down(d), std::nextafter(d, -double_inf)) << f;
    }
    EXPECT_TRUE(std::isnan(next_up(std::nanf(""))) && std::isnan(next_down(std::nanf(""))));
    EXPECT_TRUE(std::isnan(next_up(std::nan(""))) && std::isnan(next_down(std::nan(""))));
}

TEST(Rounding, OutwardAndTight) {
    configurations::Draw draw(2);
    for (int i = 0; i < 200000; ++i) {
        const double x = (draw.chance(0.5) ? 1.0 : -1.0) * std::ldexp(1.0 + draw.unit(), draw.below(250) - 126);
        const float above = round_up(x);
        const float below = round_down(x);
        ASSERT_GE(static_cast<double>(above), x);
        ASSERT_LE(static_cast<double>(below), x);
        ASSERT_LE(above, next_up(below));
        const float f = static_cast<float>(x);
        ASSERT_EQ(round_up(static_cast<double>(f)), f);
        ASSERT_EQ(round_down(static_cast<double>(f)), f);
    }
}

TEST(Rounding, PositiveBoundsNeverVanishAndNeverTurnFinite) {
    EXPECT_EQ(round_up(0.0), 0.0f);
    EXPECT_EQ(round_up(1e-300), float_min);
    EXPECT_EQ(round_up(1e-40), float_min);
    EXPECT_EQ(round_up(-1e-300), -0.0f);
    EXPECT_EQ(round_down(1e-300), 0.0f);
    EXPECT_EQ(round_down(-1e-300), -float_min);
    EXPECT_EQ(round_up(1e39), float_inf);
    EXPECT_EQ(round_up(next_up(static_cast<double>(float_max))), float_inf);
    EXPECT_EQ(round_down(1e39), float_max);
    EXPECT_EQ(round_up(-1e39), -float_max);
    EXPECT_EQ(round_up(double_inf), float_inf);
    EXPECT_EQ(round_up(-double_inf), -float_inf);
    EXPECT_TRUE(std::isnan(round_up(std::nan(""))) && std::isnan(round_down(std::nan(""))));
}

}  // namespace
