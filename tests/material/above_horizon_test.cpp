#include <lightcuts/material/above_horizon.hpp>

#include <gtest/gtest.h>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/sum.hpp>

#include "configurations.hpp"

namespace {

using namespace lightcuts;
using material_test::quick_bound;

struct Unbounded {
    float evaluate(const glm::vec3&) const { return 1.0f; }
};

static_assert(QuicklyBoundedMaterial<AboveHorizon<Ggx<float>>>);
static_assert(CosineLobeMaterial<AboveHorizon<Lambert<float>>>);
static_assert(!CosineLobeMaterial<AboveHorizon<Ggx<float>>>);
static_assert(!CompositeMaterial<AboveHorizon<Lambert<float>>>);
static_assert(CompositeMaterial<AboveHorizon<Sum<Lambert<float>, Ggx<float>>>>);
static_assert(Material<AboveHorizon<Unbounded>>);
static_assert(!BoundedMaterial<AboveHorizon<Unbounded>>);
static_assert(sizeof(AboveHorizon<Unbounded>) == sizeof(glm::vec3));

constexpr glm::vec3 shading(0.6f, 0.0f, 0.8f);
constexpr glm::vec3 geometric(0.0f, 0.0f, 1.0f);

TEST(AboveHorizon, IsBlackForLightsBehindTheSurface) {
    const Lambert inner{shading, 1.0f};
    const AboveHorizon m{inner, geometric};
    const glm::vec3 behind(0.8f, 0.0f, -0.6f);
    EXPECT_GT(inner.evaluate(glm::vec3(1.0f, 0.0f, 0.0f)), 0.0f);
    EXPECT_EQ(0.0f, m.evaluate(glm::vec3(1.0f, 0.0f, 0.0f)));
    EXPECT_EQ(0.0f, m.evaluate(glm::normalize(behind + shading * 0.1f)));
    EXPECT_EQ(inner.evaluate(shading), m.evaluate(shading));
}

TEST(AboveHorizon, BoundIsTheMaterialsUnlessTheBoxLiesBelow) {
    const Lambert inner{shading, 1.0f};
    const AboveHorizon m{inner, geometric};
    const OffsetBox astride{{1, -1, -1}, {2, 1, 1}};
    const OffsetBox below{{1, -1, -1}, {2, 1, 0}};
    EXPECT_EQ(inner.upper_bound(astride), m.upper_bound(astride));
    EXPECT_EQ(quick_bound(inner, astride), quick_bound(m, astride));
    EXPECT_GT(inner.upper_bound(below), 0.0f);
    EXPECT_EQ(0.0f, m.upper_bound(below));
    EXPECT_EQ(0.0f, quick_bound(m, {{1, -1, -1}, {2, 1, -1e-5}})) << "in float a box that touches is not below";
}

TEST(AboveHorizon, ShowsTheComponentsOfASumAboveTheSameHorizon) {
    const Sum inner{Lambert{shading, 1.0f}, Ggx{shading, geometric, 0.04f, 0.5f}};
    const AboveHorizon m{inner, geometric};
    const OffsetBox below{{1, -1, -1}, {2, 1, 0}};
    const OffsetBox astride{{1, -1, -1}, {2, 1, 1}};
    float sum_below = 0.0f;
    float sum_astride = 0.0f;
    float value = 0.0f;
    int lobes = 0;
    m.for_each_component([&]<class M>(const M& component) {
        static_assert(QuicklyBoundedMaterial<M>);
        lobes += CosineLobeMaterial<M>;
        sum_below += component.upper_bound(below);
        sum_astride += component.upper_bound(astride);
        value += component.evaluate(shading);
    });
    EXPECT_EQ(1, lobes);
    EXPECT_EQ(0.0f, sum_below);
    EXPECT_EQ(inner.upper_bound(astride), sum_astride);
    EXPECT_EQ(inner.evaluate(shading), value);
}

}  // namespace
