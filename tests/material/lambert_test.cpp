#include <lightcuts/material/lambert.hpp>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <lightcuts/material/material.hpp>

#include "configurations.hpp"

namespace {

using namespace lightcuts;
using material_test::quick_bound;

static_assert(Material<Lambert<float>>);
static_assert(BoundedMaterial<Lambert<glm::vec3>>);
static_assert(QuicklyBoundedMaterial<Lambert<material_test::Bands>>);
static_assert(CosineLobeMaterial<Lambert<glm::vec3>>);
static_assert(!CompositeMaterial<Lambert<glm::vec3>>);
static_assert(std::same_as<material_spectrum<Lambert<float>>, float>);
static_assert(sizeof(Lambert<float>) == 16);

constexpr glm::vec3 up(0.0f, 0.0f, 1.0f);

TEST(Lambert, IsAlbedoOverPiTimesCosine) {
    const Lambert m{up, glm::vec3(0.5f, 0.25f, 0.0f)};
    const glm::vec3 value = m.evaluate({0.6f, 0.0f, 0.8f});
    EXPECT_FLOAT_EQ(0.8f * 0.5f / 3.14159265f, value.x);
    EXPECT_FLOAT_EQ(0.8f * 0.25f / 3.14159265f, value.y);
    EXPECT_EQ(0.0f, value.z);
    EXPECT_EQ(glm::vec3(0.0f), m.evaluate({0.6f, 0.0f, -0.8f}));
}

TEST(Lambert, EqualsItsCosineLobe) {
    material_test::Numbers numbers(1);
    for (int i = 0; i < 10000; ++i) {
        const Lambert m{material_test::unit(numbers.direction()), 0.7f};
        const glm::vec3 o = material_test::unit(numbers.direction());
        const CosineLobe<float> lobe = m.cosine_lobe();
        const float cosine = glm::dot(lobe.normal, o);
        EXPECT_EQ(cosine > 0.0f ? lobe.scale * cosine : 0.0f, m.evaluate(o));
    }
}

TEST(Lambert, BoundOfWhatLiesBelowOrInThePlaneIsZero) {
    const Lambert m{up, 1.0f};
    for (const OffsetBox& box : {OffsetBox{{-1, -1, -2}, {1, 1, -1e-3}}, OffsetBox{{-1, -1, 0}, {1, 1, 0}},
                                 OffsetBox{{-1, -1, -1}, {1, 1, 0}}, OffsetBox{{1, 0, 0}, {1, 0, 0}}}) {
        EXPECT_EQ(0.0f, m.upper_bound(box));
    }
    for (const OffsetBox& box :
         {OffsetBox{{-1, -1, -2}, {1, 1, -1e-3}}, OffsetBox{{-1, -1, 0}, {1, 1, 0}}, OffsetBox{{1, 0, 0}, {1, 0, 0}}}) {
        EXPECT_EQ(0.0f, quick_bound(m, box));
    }
}

TEST(Lambert, BoundOfASurroundingBoxIsThePeak) {
    const Lambert m{up, 1.0f};
    EXPECT_NEAR(0.31830989f, m.upper_bound({{-1, -1, -1}, {1, 1, 1}}), 2e-5f);
    EXPECT_NEAR(0.31830989f, quick_bound(m, {{-1, -1, -1}, {1, 1, 1}}), 2e-5f);
}

TEST(Lambert, BlackChannelsStayBlack) {
    const Lambert m{up, glm::vec3(1e-38f, 0.0f, 1.0f)};
    const glm::vec3 bound = m.upper_bound({{-1, -1, 1e-9}, {1, 1, 1e-9}});
    EXPECT_GT(bound.x, 0.0f);
    EXPECT_EQ(0.0f, bound.y);
}

}  // namespace
