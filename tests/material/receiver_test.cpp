#include <lightcuts/shading/receiver.hpp>

#include <limits>

#include <gtest/gtest.h>
#include <lightcuts/material/above_horizon.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/phong.hpp>
#include <lightcuts/material/ward.hpp>

namespace {

using namespace lightcuts;

constexpr glm::vec3 up(0.0f, 0.0f, 1.0f), nearly_up(0.0f, 0.0f, 1.00001f);

TEST(Receiver, StartsShadowRaysAtItsPositionUnlessToldOtherwise) {
    const Lambert<float> material{up, 0.5f};
    const glm::vec3 at(1.0f, 2.0f, 3.0f), off(1.0f, 2.0f, 3.5f);
    EXPECT_EQ(Receiver(at, material).shadow_origin, at);
    EXPECT_EQ(Receiver(at, material).id, 0u);
    const Receiver receiver(at, material, off, 7);
    EXPECT_EQ(receiver.position, at);
    EXPECT_EQ(receiver.shadow_origin, off);
    EXPECT_EQ(receiver.id, 7u);
}

TEST(Receiver, NormalsNeedToBeUnitWithinRounding) {
    EXPECT_GT((Lambert<float>{nearly_up, 0.5f}.evaluate(up)), 0.0f);
    EXPECT_GT(Ggx<float>(nearly_up, nearly_up, 0.5f, 0.3f).evaluate(up), 0.0f);
}

#ifndef NDEBUG
TEST(ReceiverDeathTest, NumbersThatAreNoneAreNoticed) {
    const Lambert<float> material{up, 0.5f};
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_DEATH(Receiver(glm::vec3(0.0f, nan, 0.0f), material), "is_finite");
    EXPECT_DEATH(Receiver(glm::vec3(0.0f), material, glm::vec3(nan)), "is_finite");
}

TEST(ReceiverDeathTest, NormalsThatAreNotUnitAreNoticed) {
    const glm::vec3 shorter(0.0f, 0.0f, 0.99f);
    EXPECT_DEATH((Lambert<float>{shorter, 0.5f}.evaluate(up)), "is_unit");
    EXPECT_DEATH((AboveHorizon{Lambert<float>{up, 0.5f}, shorter}.evaluate(up)), "is_unit");
    EXPECT_DEATH(Ggx<float>(shorter, up, 0.5f, 0.3f), "is_unit");
    EXPECT_DEATH(Ward<float>(up, shorter, 0.5f, 0.3f), "is_unit");
    EXPECT_DEATH(ModifiedPhong<float>(glm::vec3(0.0f), up, 0.5f, 3.0f), "is_unit");
}
#endif

}  // namespace
