#include <lightcuts/material/phong.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <lightcuts/material/material.hpp>

#include "configurations.hpp"
#include "reference.hpp"

namespace {

using namespace lightcuts;
using material_test::Numbers;
using material_test::quick_bound;
using material_test::Surface;

static_assert(QuicklyBoundedMaterial<ModifiedPhong<float>>);
static_assert(QuicklyBoundedMaterial<ModifiedPhong<glm::vec3>>);
static_assert(QuicklyBoundedMaterial<ModifiedPhong<material_test::Bands>>);

constexpr glm::vec3 up(0.0f, 0.0f, 1.0f);

TEST(ModifiedPhong, AgreesWithExtendedPrecision) {
    Numbers numbers(1);
    for (const float e : {0.0f, 1.0f, 7.5f, 100.0f, 1e4f, 1e6f}) {
        for (int i = 0; i < 20000; ++i) {
            const Surface s = material_test::random_surface(numbers);
            const double spread = numbers.magnitude(1e-4, 1.0);
            const glm::vec3 o = material_test::unit(material_test::mirror_of(s) + spread * numbers.direction());
            const auto expected = static_cast<double>(material_test::phong(s.normal, s.view, o, e));
            if (expected < 1e-30 || glm::dot(s.normal, o) < 1e-5f) continue;
            EXPECT_NEAR(1.0, static_cast<double>(ModifiedPhong{s.normal, s.view, 1.0f, e}.evaluate(o)) / expected,
                        2e-6);
        }
    }
}

TEST(ModifiedPhong, IsReciprocal) {
    Numbers numbers(2);
    for (int i = 0; i < 20000; ++i) {
        const Surface s = material_test::random_surface(numbers);
        const glm::vec3 o = material_test::unit(numbers.direction());
        const float cos_o = glm::dot(s.normal, o);
        const float cos_i = glm::dot(s.normal, s.view);
        if (cos_o < 0.01f || cos_i < 0.01f) continue;
        const float forth = ModifiedPhong{s.normal, s.view, 1.0f, 5.0f}.evaluate(o) / cos_o;
        const float back = ModifiedPhong{s.normal, o, 1.0f, 5.0f}.evaluate(s.view) / cos_i;
        EXPECT_NEAR(forth, back, 2e-5f * forth + 1e-6f);
    }
}

TEST(ModifiedPhong, ReflectsAtMostItsShare) {
    for (const float e : {0.0f, 1.0f, 20.0f, 300.0f}) {
        for (const float cosine : {1.0f, 0.7f, 0.2f, 0.01f}) {
            const glm::vec3 view(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
            EXPECT_LE(material_test::reflectance(ModifiedPhong{up, view, 1.0f, e}, up), 1.001) << e << ' ' << cosine;
        }
    }
    EXPECT_NEAR(1.0, material_test::reflectance(ModifiedPhong{up, up, 1.0f, 20.0f}, up), 1e-3);
}

TEST(ModifiedPhong, IsBlackFromBelow) {
    const ModifiedPhong m{up, glm::vec3(0.6f, 0.0f, -0.8f), 1.0f, 10.0f};
    const OffsetBox box{{-1, -1, -1}, {1, 1, 1}};
    EXPECT_EQ(0.0f, m.evaluate({0.6f, 0.0f, 0.8f}));
    EXPECT_EQ(0.0f, m.upper_bound(box));
    EXPECT_EQ(0.0f, quick_bound(m, box));
}

TEST(ModifiedPhong, BoundIsZeroBelowTheHorizonAndBehindTheMirrorDirection) {
    const glm::vec3 view(0.6f, 0.0f, 0.8f);
    const ModifiedPhong m{up, view, 1.0f, 10.0f};
    EXPECT_EQ(0.0f, m.upper_bound({{-1, -1, -2}, {1, 1, 0}}));
    EXPECT_EQ(0.0f, quick_bound(m, {{-1, -1, -2}, {1, 1, -1e-5}}));
    EXPECT_EQ(0.0f, m.upper_bound({{2, -1, 0.1}, {3, 1, 0.2}}));
    EXPECT_EQ(0.0f, quick_bound(m, {{2, -1, 0.1}, {3, 1, 0.2}}));
}

TEST(ModifiedPhong, BoundOfOneDirectionIsNearlyExactEvenForAMillion) {
    const glm::vec3 view(0.6f, 0.0f, 0.8f);
    const ModifiedPhong m{up, view, 1.0f, 1e6f};
    for (const double aside : {0.0, 1e-4, 1e-3, 2e-3}) {
        const glm::dvec3 p(-0.6, aside, 0.8);
        const float value = m.evaluate(material_test::as_given(p));
        EXPECT_GT(value, 0.0f);
        EXPECT_NEAR(1.0f, m.upper_bound({p, p}) / value, 2e-2f);
        EXPECT_GE(quick_bound(m, {p, p}), value) << "tight up to an exponent of some ten thousand";
    }
}

}  // namespace
