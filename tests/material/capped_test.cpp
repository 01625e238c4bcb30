#include <lightcuts/material/capped.hpp>

#include <gtest/gtest.h>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/material.hpp>

#include "configurations.hpp"

namespace {

using namespace lightcuts;

/// Has no bound, and a pole.
struct Peaked {
    glm::vec3 evaluate(const glm::vec3& o) const {
        return o.z > 0.0f ? glm::vec3(0.5f, 1.0f, 2.0f) / (1.0f - o.z) : glm::vec3(0.0f);
    }
};
static_assert(Material<Peaked>);
static_assert(!BoundedMaterial<Peaked>);
static_assert(BoundedMaterial<Capped<Peaked>>);
static_assert(!QuicklyBoundedMaterial<Capped<Peaked>>);
static_assert(sizeof(Capped<Peaked>) == sizeof(glm::vec3));

TEST(Capped, BoundsByItsCap) {
    const Capped m{Peaked{}, glm::vec3(4.0f, 5.0f, 6.0f)};
    EXPECT_EQ(m.cap, m.upper_bound({{-1, -1, 1}, {1, 1, 2}}));
    EXPECT_EQ(m.cap, m.upper_bound({{-1, -1, -2}, {1, 1, -1}}));
    EXPECT_EQ(m.cap, material_test::quick_bound(m, {{-1, -1, 1}, {1, 1, 2}}));
}

TEST(Capped, CutsOffChannelByChannel) {
    const Capped m{Peaked{}, glm::vec3(4.0f, 5.0f, 6.0f)};
    EXPECT_EQ(glm::vec3(1.0f, 2.0f, 4.0f), m.evaluate({0.0f, 0.8660254f, 0.5f}));
    EXPECT_EQ(glm::vec3(2.0f, 4.0f, 6.0f), m.evaluate({0.0f, 0.66143783f, 0.75f}));
    EXPECT_EQ(m.cap, m.evaluate({0.0f, 0.0f, 1.0f}));
    EXPECT_EQ(glm::vec3(0.0f), m.evaluate({0.0f, 0.0f, -1.0f}));
}

}  // namespace
