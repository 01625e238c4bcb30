#include <lightcuts/material/direction_caps.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include "configurations.hpp"

namespace {

using namespace lightcuts;
using material_test::Numbers;

/// A block of random boxes with corners that are floats.
struct RandomBlock {
    OffsetBox boxes[lane_count];
    OffsetBlock block;
    detail::DirectionCaps caps;

    explicit RandomBlock(Numbers& numbers) {
        for (int i = 0; i < lane_count; ++i) {
            const OffsetBox box = material_test::random_box(numbers, material_test::random_surface(numbers));
            const glm::vec3 lo(box.lo), hi(box.hi);
            boxes[i] = {glm::dvec3(lo), glm::dvec3(hi)};
            block.set(i, lo, hi);
        }
        block.finish(lane_count);
        detail::caps_of(block, caps);
    }

    bool is_narrow(int i) const { return caps.narrow[i] == 1.0f; }
    glm::dvec3 center(int i) const { return {caps.center[0][i], caps.center[1][i], caps.center[2][i]}; }
    glm::dvec3 corner(int i, int k) const {
        const OffsetBox& b = boxes[i];
        return {(k & 1) != 0 ? b.hi.x : b.lo.x, (k & 2) != 0 ? b.hi.y : b.lo.y, (k & 4) != 0 ? b.hi.z : b.lo.z};
    }
};

TEST(DirectionCaps, HoldTheBoxesAndTheirEdgesNearlyTouchAVertex) {
    Numbers numbers(1);
    int narrow = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const RandomBlock r(numbers);
        for (int i = 0; i < lane_count; ++i) {
            if (!r.is_narrow(i)) continue;
            ++narrow;
            const double angle = std::atan2(r.caps.sin[i], r.caps.cos[i]);
            double widest = 0.0;
            for (int k = 0; k < 8; ++k) {
                const glm::dvec3 p = r.corner(i, k);
                const double a = std::atan2(glm::length(glm::cross(r.center(i), p)), glm::dot(r.center(i), p));
                widest = a > widest ? a : widest;
            }
            EXPECT_LE(widest, angle);
            const double length = glm::length(r.boxes[i].hi - r.boxes[i].lo) /
                                  glm::length(r.boxes[i].hi + r.boxes[i].lo);
            // A needle that points at the receiver loses the root of the 4.6e-6 by which roundings are covered, over
            // the distance of its near end.
            if (length > 0.5) continue;
            EXPECT_NEAR(widest, angle, 5e-3 * length + 1e-5);
        }
    }
    EXPECT_GT(narrow, 40000);
}

bool is_narrow(const glm::vec3& lo, const glm::vec3& hi) {
    OffsetBlock block;
    detail::DirectionCaps caps;
    block.set(0, lo, hi);
    block.finish(1);
    detail::caps_of(block, caps);
    return caps.narrow[0] == 1.0f;
}

TEST(DirectionCaps, AreWideWhereTheBoxIsNotInFront) {
    EXPECT_FALSE(is_narrow({-1, -1, -1}, {1, 1, 1}));
    EXPECT_FALSE(is_narrow({0, 0, 0}, {0, 0, 0}));
    EXPECT_FALSE(is_narrow({-1, -1, 0}, {1, 1, 1}));
    EXPECT_TRUE(is_narrow({-1, -1, 3}, {1, 1, 4}));
    EXPECT_FALSE(is_narrow({1e-30f, 0, 0}, {1e-30f, 0, 0})) << "out of float's range";
    EXPECT_FALSE(is_narrow({1e30f, 0, 0}, {1e30f, 0, 0}));
}

TEST(DirectionCaps, BoundCosines) {
    Numbers numbers(2);
    for (int trial = 0; trial < 20000; ++trial) {
        const RandomBlock r(numbers);
        const glm::vec3 v = material_test::unit(numbers.direction());
        alignas(32) Lanes most, least;
        detail::clamped_max_cosines(v, r.caps, most);
        detail::clamped_min_cosines(v, r.caps, least);
        for (int i = 0; i < lane_count; ++i) {
            if (!r.is_narrow(i)) {
                EXPECT_EQ(1.0f, most[i]);
                EXPECT_EQ(0.0f, least[i]);
                continue;
            }
            for (int k = 0; k < 8; ++k) {
                const double c = glm::dot(glm::dvec3(v), glm::normalize(r.corner(i, k)));
                EXPECT_LE(c, static_cast<double>(most[i]));
                EXPECT_GE(c > 0.0 ? c : 0.0, static_cast<double>(least[i]));
            }
        }
    }
}

}  // namespace
