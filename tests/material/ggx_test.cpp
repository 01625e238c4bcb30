#include <lightcuts/material/ggx.hpp>

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

static_assert(QuicklyBoundedMaterial<Ggx<float>>);
static_assert(QuicklyBoundedMaterial<Ggx<glm::vec3>>);
static_assert(QuicklyBoundedMaterial<Ggx<material_test::Bands, SeparableShadowing>>);

constexpr glm::vec3 up(0.0f, 0.0f, 1.0f);

glm::vec3 view_at(float cosine) { return {std::sqrt(1.0f - cosine * cosine), 0.0f, cosine}; }

template <class Shadowing>
void expect_agreement(bool is_correlated) {
    Numbers numbers(1);
    for (const float alpha : {1e-4f, 1e-3f, 0.03f, 0.3f, 1.0f, 2.0f}) {
        for (int i = 0; i < 20000; ++i) {
            const Surface s = material_test::random_surface(numbers);
            const double spread = numbers.magnitude(1e-4, 1.0);
            const glm::vec3 o = material_test::unit(material_test::mirror_of(s) + spread * numbers.direction());
            // Closer to the horizon n . o itself, of unit vectors, is the less accurate.
            if (glm::dot(s.normal, o) < 1e-6f) continue;
            const material_test::Cosines cosines(s.normal, s.view, o);
            const auto expected = static_cast<double>(material_test::ggx(cosines, 0.04f, alpha, is_correlated));
            const Ggx<float, Shadowing> m{s.normal, s.view, 0.04f, alpha};
            EXPECT_NEAR(1.0, static_cast<double>(m.evaluate(o)) / expected, 3e-6)
                << alpha << ' ' << static_cast<double>(cosines.ni) << ' ' << static_cast<double>(cosines.no);
        }
    }
}

TEST(Ggx, AgreesWithExtendedPrecision) { expect_agreement<HeightCorrelated>(true); }
TEST(Ggx, WithSeparableShadowingAgreesWithExtendedPrecision) { expect_agreement<SeparableShadowing>(false); }

TEST(Ggx, IsReciprocal) {
    Numbers numbers(2);
    for (int i = 0; i < 20000; ++i) {
        const Surface s = material_test::random_surface(numbers);
        const glm::vec3 o = material_test::unit(numbers.direction());
        const float cos_o = glm::dot(s.normal, o);
        const float cos_i = glm::dot(s.normal, s.view);
        if (cos_o < 0.01f || cos_i < 0.01f) continue;
        const float forth = Ggx{s.normal, s.view, 0.3f, 0.4f}.evaluate(o) / cos_o;
        const float back = Ggx{s.normal, o, 0.3f, 0.4f}.evaluate(s.view) / cos_i;
        EXPECT_NEAR(forth, back, 2e-5f * forth);
    }
}

TEST(Ggx, ReflectsNoMoreThanItReceives) {
    for (const float alpha : {0.1f, 0.3f, 0.7f, 1.0f}) {
        for (const float cosine : {1.0f, 0.7f, 0.3f, 0.1f, 0.01f}) {
            const Ggx correlated{up, view_at(cosine), 1.0f, alpha};
            const Ggx<float, SeparableShadowing> separable{up, view_at(cosine), 1.0f, alpha};
            const double most = material_test::reflectance(correlated, up);
            EXPECT_LE(most, 1.002) << alpha << ' ' << cosine;
            EXPECT_LE(material_test::reflectance(separable, up), most + 1e-6);
        }
    }
    EXPECT_NEAR(1.0, material_test::reflectance(Ggx{up, view_at(0.9f), 1.0f, 0.1f}, up), 0.02);
    EXPECT_NEAR(0.04, material_test::reflectance(Ggx{up, view_at(0.9f), 0.04f, 0.1f}, up), 0.002);
}

TEST(Ggx, TreatsChannelsAlike) {
    Numbers numbers(3);
    for (int i = 0; i < 2000; ++i) {
        const Surface s = material_test::random_surface(numbers);
        const OffsetBox box = material_test::random_box(numbers, s);
        const glm::vec3 o = material_test::unit(numbers.direction());
        const float f0[] = {0.0f, 0.1f, 0.5f, 0.9f, 1.0f};
        const Ggx bands{s.normal, s.view, material_test::Bands{{f0[0], f0[1], f0[2], f0[3], f0[4]}}, 0.2f};
        for (int c = 0; c < 5; ++c) {
            const Ggx one{s.normal, s.view, f0[c], 0.2f};
            EXPECT_EQ(one.evaluate(o), bands.evaluate(o)[c]);
            EXPECT_EQ(one.upper_bound(box), bands.upper_bound(box)[c]);
            EXPECT_EQ(quick_bound(one, box), quick_bound(bands, box)[c]);
        }
    }
}

TEST(Ggx, OfLessAtGrazingAnglesIsASmallerShareOfAnother) {
    // F0 + (F90 - F0) w is F90 times what F0 / F90 and 1 give.
    Numbers numbers(5);
    for (const float alpha : {0.01f, 0.3f}) {
        for (int i = 0; i < 5000; ++i) {
            const Surface s = material_test::random_surface(numbers);
            const OffsetBox box = material_test::random_box(numbers, s);
            const glm::vec3 o = material_test::unit(numbers.direction());
            const Ggx less{s.normal, s.view, 0.1f, alpha, 0.4f};
            const Ggx whole{s.normal, s.view, 0.25f, alpha};
            EXPECT_NEAR(less.evaluate(o), 0.4f * whole.evaluate(o), 1e-5f * less.evaluate(o));
            EXPECT_NEAR(less.upper_bound(box), 0.4f * whole.upper_bound(box), 1e-5f * less.upper_bound(box));
            EXPECT_NEAR(quick_bound(less, box), 0.4f * quick_bound(whole, box), 1e-5f * quick_bound(less, box));
            EXPECT_NEAR(material_test::value_in_lane(less, o), 0.4f * material_test::value_in_lane(whole, o),
                        1e-5f * less.evaluate(o) + 1e-30f);
        }
    }
    EXPECT_EQ(0.0f, (Ggx{up, view_at(0.5f), 0.0f, 0.3f, 0.0f}.evaluate(view_at(0.3f))));
}

TEST(Ggx, IsBlackFromBelowAndForLightsBelow) {
    const OffsetBox around{{-1, -1, -1}, {1, 1, 1}};
    const Ggx below{up, glm::vec3(0.6f, 0.0f, -0.8f), 0.5f, 0.3f};
    EXPECT_EQ(0.0f, below.evaluate({0.6f, 0.0f, 0.8f}));
    EXPECT_EQ(0.0f, below.upper_bound(around));
    EXPECT_EQ(0.0f, quick_bound(below, around));
    const Ggx above{up, view_at(0.8f), 0.5f, 0.3f};
    EXPECT_EQ(0.0f, above.evaluate({0.6f, 0.0f, -0.8f}));
    EXPECT_EQ(0.0f, above.upper_bound({{-1, -1, -2}, {1, 1, 0}}));
    EXPECT_EQ(0.0f, quick_bound(above, {{-1, -1, -2}, {1, 1, -1e-5}}));
}

TEST(Ggx, NeverIsNaN) {
    for (const float alpha : {0.0f, 1e-30f, 1e-4f, 1.0f}) {
        for (const float f0 : {0.0f, 1.0f}) {
            for (const float cosine : {1.0f, 1e-6f, 1e-20f}) {
                const Ggx m{up, view_at(cosine), f0, alpha};
                for (const glm::vec3& o :
                     {up, view_at(0.5f), glm::vec3(-1.0f, 0.0f, 1e-6f), glm::vec3(-1.0f, 0.0f, 1e-30f)}) {
                    EXPECT_GE(m.evaluate(o), 0.0f) << alpha << ' ' << f0 << ' ' << cosine;
                }
                for (const OffsetBox& box :
                     {OffsetBox{{-1, -1, -1}, {1, 1, 1}}, OffsetBox{{-1, 0, 0}, {-1, 0, 1}},
                      OffsetBox{{-1, 0, 1e-30}, {-1, 0, 1e-30}}, OffsetBox{{0, 0, 0}, {0, 0, 1}}}) {
                    EXPECT_GE(m.upper_bound(box), 0.0f);
                    EXPECT_GE(quick_bound(m, box), 0.0f);
                }
            }
        }
    }
}

TEST(Ggx, BoundOfOneDirectionIsNearlyExact) {
    Numbers numbers(4);
    for (const float alpha : {1e-3f, 0.03f, 0.3f, 1.0f}) {
        for (int i = 0; i < 5000; ++i) {
            const Surface s = material_test::random_surface(numbers);
            if (glm::dot(s.normal, s.view) < 0.1f) continue;
            const glm::dvec3 p = material_test::mirror_of(s) + numbers.magnitude(1e-6, 1.0) * numbers.direction();
            const float value = Ggx{s.normal, s.view, 0.04f, alpha}.evaluate(material_test::as_given(p));
            if (glm::dot(glm::dvec3(s.normal), p) < 0.05) continue;
            const Ggx m{s.normal, s.view, 0.04f, alpha};
            EXPECT_NEAR(1.0f, m.upper_bound({p, p}) / value, 1e-2f) << alpha;
            if (alpha < 0.01f) continue;  // too sharp for float
            EXPECT_NEAR(1.0f, quick_bound(m, {p, p}) / value, 1e-2f) << alpha;
        }
    }
}

}  // namespace
