#include <lightcuts/material/direction_cap.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include "configurations.hpp"

namespace {

using namespace lightcuts;
using material_test::Numbers;

TEST(DirectionCap, HoldsTheBoxAndItsEdgeTouchesAVertex) {
    Numbers numbers(1);
    for (int i = 0; i < 100000; ++i) {
        const OffsetBox box = material_test::random_box(numbers, material_test::random_surface(numbers));
        const detail::DirectionCap cap = detail::cap_of(box);
        if (!cap.is_narrow) continue;
        const double angle = std::atan2(cap.across, cap.along);
        double widest = 0.0;
        for (int k = 0; k < 8; ++k) {
            const glm::dvec3 p((k & 1) != 0 ? box.hi.x : box.lo.x, (k & 2) != 0 ? box.hi.y : box.lo.y,
                               (k & 4) != 0 ? box.hi.z : box.lo.z);
            const double a = std::atan2(glm::length(glm::cross(cap.centre, p)), glm::dot(cap.centre, p));
            widest = a > widest ? a : widest;
        }
        EXPECT_LE(widest, angle);
        EXPECT_NEAR(widest, angle, 1e-6);
    }
}

TEST(DirectionCap, IsWideWhereTheBoxIsNotInFront) {
    EXPECT_FALSE(detail::cap_of({{-1, -1, -1}, {1, 1, 1}}).is_narrow);
    EXPECT_FALSE(detail::cap_of({{0, 0, 0}, {0, 0, 0}}).is_narrow);
    EXPECT_FALSE(detail::cap_of({{-1, -1, 0}, {1, 1, 1}}).is_narrow);
    EXPECT_TRUE(detail::cap_of({{-1, -1, 3}, {1, 1, 4}}).is_narrow);
}

TEST(DirectionCap, BoundsCosines) {
    Numbers numbers(2);
    for (int i = 0; i < 100000; ++i) {
        const OffsetBox box = material_test::random_box(numbers, material_test::random_surface(numbers));
        const detail::DirectionCap cap = detail::cap_of(box);
        if (!cap.is_narrow) continue;
        const glm::dvec3 v = numbers.direction();
        const double most = detail::clamped_max_cosine(v, cap);
        const double least = detail::clamped_min_cosine(v, cap);
        for (int k = 0; k < 8; ++k) {
            const glm::dvec3 p((k & 1) != 0 ? box.hi.x : box.lo.x, (k & 2) != 0 ? box.hi.y : box.lo.y,
                               (k & 4) != 0 ? box.hi.z : box.lo.z);
            const double c = glm::dot(v, glm::normalize(p));
            EXPECT_LE(c > 0.0 ? c : 0.0, most > 0.0 ? most : 0.0);
            EXPECT_GE(c > 0.0 ? c : 0.0, least);
        }
    }
}

}  // namespace
