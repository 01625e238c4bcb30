#include <lightcuts/material/thin_sheet.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <lightcuts/material/capped.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/sum.hpp>
#include <lightcuts/shading/receiver.hpp>

#include "configurations.hpp"

namespace {

using namespace lightcuts;
using material_test::Numbers;
using material_test::quick_bound;
using material_test::unit;
using material_test::value_in_lane;

struct Unbounded {
    float evaluate(const glm::vec3&) const { return 1.0f; }
};

using Leaf = ThinSheet<Lambert<float>, Lambert<float>>;
static_assert(TwoSidedMaterial<Leaf> && CompositeMaterial<Leaf> && QuicklyBoundedMaterial<Leaf>);
static_assert(!BoundedMaterial<ThinSheet<Lambert<float>, Unbounded>>);
static_assert(!TwoSidedMaterial<Lambert<float>> && !TwoSidedMaterial<Sum<Lambert<float>, Ggx<float>>>);
static_assert(TwoSidedMaterial<ThinSheet<Sum<Lambert<float>, Ggx<float>>, Lambert<float>>> &&
              TwoSidedMaterial<Capped<Leaf>>);
static_assert(!TwoSidedMaterial<AboveHorizon<Leaf>>, "what is black from behind has one side");
static_assert(Receiver<Leaf>::two_sided && Receiver<const Leaf&>::two_sided && !Receiver<Lambert<float>>::two_sided);
static_assert(sizeof(Receiver<Leaf>) == sizeof(Leaf) + 2 * sizeof(glm::vec3) + sizeof(Receiver<Leaf>::id));

constexpr glm::vec3 shading(0.6f, 0.0f, 0.8f);
constexpr glm::vec3 geometric(0.0f, 0.0f, 1.0f);

TEST(ThinSheet, ReflectsFromAboveAndTransmitsFromBehind) {
    const ThinSheet leaf{Lambert{geometric, glm::vec3(0.2f, 0.4f, 0.1f)}, Lambert{-geometric, glm::vec3(0.1f, 0.5f, 0)},
                         geometric};
    const glm::vec3 above = leaf.evaluate({0.6f, 0.0f, 0.8f});
    const glm::vec3 behind = leaf.evaluate({0.0f, 0.8f, -0.6f});
    EXPECT_FLOAT_EQ(above.y, 0.8f * 0.4f / 3.14159265f);
    EXPECT_FLOAT_EQ(behind.x, 0.6f * 0.1f / 3.14159265f);
    EXPECT_FLOAT_EQ(behind.y, 0.6f * 0.5f / 3.14159265f);
    EXPECT_EQ(behind.z, 0.0f);
    EXPECT_EQ(leaf.evaluate({1.0f, 0.0f, 0.0f}), glm::vec3(0.0f));
}

TEST(ThinSheet, LeaksNothingBetweenItsSidesWhereTheShadingNormalLeans) {
    const ThinSheet leaf{Lambert{shading, 0.3f}, Lambert{-shading, 0.6f}, geometric};
    const glm::vec3 above_but_behind_shading = unit(glm::dvec3(-0.9, 0.0, 0.2));
    const glm::vec3 behind_but_above_shading = unit(glm::dvec3(0.9, 0.0, -0.2));
    EXPECT_EQ(leaf.evaluate(above_but_behind_shading), 0.0f);
    EXPECT_EQ(leaf.evaluate(behind_but_above_shading), 0.0f);
    EXPECT_FALSE(leaf.is_behind(above_but_behind_shading));
    EXPECT_TRUE(leaf.is_behind(behind_but_above_shading));
    EXPECT_TRUE(leaf.is_behind(100.0f * behind_but_above_shading)) << "of any length";
}

TEST(ThinSheet, IsOneOfItsSidesInEveryDirection) {
    Numbers numbers(3);
    for (int i = 0; i < 20000; ++i) {
        const auto s = material_test::random_surface(numbers);
        const glm::vec3 n = unit(glm::dvec3(s.normal) + 0.5 * numbers.direction());
        const Sum front{Lambert{s.normal, 0.3f}, Ggx{s.normal, s.view, 0.04f, 0.3f}};
        const Lambert back{-s.normal, 0.6f};
        const ThinSheet leaf{front, back, n};
        const glm::vec3 o = unit(numbers.direction());
        const float side = glm::dot(n, o);
        if (std::fabs(side) < 1e-6f) continue;
        const float expected = side > 0.0f ? front.evaluate(o) : back.evaluate(o);
        EXPECT_EQ(leaf.evaluate(o), expected);
        EXPECT_EQ(leaf.is_behind(o), side < 0.0f);
        EXPECT_NEAR(value_in_lane(leaf, o), expected, 1e-4f * expected + 1e-6f);
        float parts = 0.0f;
        leaf.for_each_component([&](const auto& part) { parts += part.evaluate(o); });
        EXPECT_NEAR(parts, expected, 1e-6f * expected);
    }
}

TEST(ThinSheet, BoundsWhatIsBelowByItsBackAndWhatStraddlesByTheBrighterSide) {
    const ThinSheet leaf{Lambert{geometric, 0.2f}, Lambert{-geometric, 0.6f}, geometric};
    const float peak = 0.6f / 3.14159265f;
    EXPECT_NEAR(leaf.upper_bound({{-1, -1, -3}, {1, 1, -1}}), peak, 1e-4f);
    EXPECT_NEAR(leaf.upper_bound({{-1, -1, 1}, {1, 1, 3}}), peak / 3, 1e-4f);
    EXPECT_NEAR(leaf.upper_bound({{-1, -1, -1}, {1, 1, 1}}), peak, 1e-4f);
    EXPECT_NEAR(quick_bound(leaf, {{-1, -1, -1}, {1, 1, 1}}), peak, 1e-4f);
    EXPECT_EQ(leaf.upper_bound({{-1, -1, 0}, {1, 1, 0}}), 0.0f);
}

TEST(Receiver, OfATwoSidedMaterialStartsShadowRaysOnTheLightsSide) {
    const ThinSheet leaf{Lambert{geometric, 0.2f}, Lambert{-geometric, 0.6f}, geometric};
    const glm::vec3 at(1.0f, 2.0f, 3.0f), off(1.0f, 2.0f, 3.25f);
    const Receiver<const decltype(leaf)&> thin(at, leaf, off);
    EXPECT_EQ(thin.shadow_origin_towards({0.0f, 0.0f, 5.0f}), off);
    EXPECT_EQ(thin.shadow_origin_towards({9.0f, 0.0f, -0.1f}), glm::vec3(1.0f, 2.0f, 2.75f));
    const Receiver opaque(at, Lambert{geometric, 0.2f}, off);
    EXPECT_EQ(opaque.shadow_origin_towards({9.0f, 0.0f, -0.1f}), off);
}

}  // namespace
