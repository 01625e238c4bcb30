#include <lightcuts/visibility/shaft.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <lightcuts/core/box.hpp>
#include <lightcuts/visibility/oracle.hpp>

#include "support/random.hpp"

namespace lightcuts::test {
namespace {

/// A box that is flat along some axes, and whose coordinates may coincide with those of others.
Box any_box(Random& random, double lo, double hi) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const bool even = random.chance(0.3);
        const auto coordinate = [&] {
            return static_cast<float>(even ? std::floor(random.between(lo, hi)) : random.between(lo, hi));
        };
        const float a = coordinate(), b = random.chance(0.3) ? a : coordinate();
        box.lo[axis] = std::min(a, b);
        box.hi[axis] = std::max(a, b);
    }
    return box;
}

glm::dvec3 inside(Random& random, const Box& box) {
    glm::dvec3 p;
    for (int axis = 0; axis < 3; ++axis) {
        const double part = random.chance(0.5) ? static_cast<double>(random.below(2)) : random.between(0, 1);
        p[axis] = static_cast<double>(box.lo[axis]) +
                  part * (static_cast<double>(box.hi[axis]) - static_cast<double>(box.lo[axis]));
    }
    return p;
}

/// To a multiple of a 32nd.
glm::dvec3 on_grid(const glm::dvec3& p) { return glm::round(32.0 * p) / 32.0; }

TEST(Shaft, HoldsEverySegmentBetweenItsBoxes) {
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        Box receivers = any_box(random, -4, 4), lights = any_box(random, -4, 4);
        for (Box* box : {&receivers, &lights}) {
            box->lo = glm::vec3(on_grid(glm::dvec3(box->lo)));
            box->hi = glm::vec3(on_grid(glm::dvec3(box->hi)));
        }
        const Shaft shaft(receivers, lights, 8.0);
        for (int k = 0; k < 20; ++k) {
            // Places of the grid, and what is between them by parts of a 64th, are floats.
            const glm::dvec3 a = on_grid(inside(random, receivers)), b = on_grid(inside(random, lights));
            const double at = static_cast<double>(random.below(65)) / 64.0;
            const glm::vec3 between(a + at * (b - a));
            ASSERT_EQ(shaft.outside(between), 0u);
            ASSERT_TRUE(shaft.may_hold(between, glm::vec3(random.in_box({-9, -9, -9}, {9, 9, 9}))));
            // From far on one side to far on the other.
            const glm::vec3 step(on_grid(8.0 * random.on_sphere()));
            ASSERT_TRUE(shaft.may_hold(between - step, between + step));
        }
    }
}

TEST(Shaft, HoldsEveryRayInItsDirections) {
    Random random(2);
    int tested = 0;
    for (int i = 0; i < 20000; ++i) {
        const Box receivers = any_box(random, -4, 4);
        const DirectionBox lights{any_box(random, -1, 1)};
        if (!(min_distance2({glm::dvec3(lights.box.lo), glm::dvec3(lights.box.hi)}) > 1e-4)) continue;
        ++tested;
        const Shaft shaft(receivers, lights, 8.0);
        for (int k = 0; k < 20; ++k) {
            const glm::dvec3 a = inside(random, receivers), way = inside(random, lights.box);
            const double length = random.between(0, 2) / glm::length(way);
            ASSERT_TRUE(shaft.may_hold(glm::vec3(a), glm::vec3(a + length * way)));
        }
    }
    EXPECT_GT(tested, 5000);
}

TEST(Shaft, LeavesOutWhatIsBeside) {
    const Box receivers{{-1, -1, 0}, {1, 1, 0}}, lights{{-2, -2, 4}, {2, 2, 4}};
    const Shaft shaft(receivers, lights, 8.0);
    // Half-way it is 3 wide.
    EXPECT_TRUE(shaft.may_hold({-9, 1.49f, 2}, {9, 1.49f, 2}));
    EXPECT_FALSE(shaft.may_hold({-9, 1.51f, 2}, {9, 1.51f, 2}));
    EXPECT_FALSE(shaft.may_hold({1.51f, -9, 2}, {1.51f, 9, 2}));
    EXPECT_FALSE(shaft.may_hold({0, 0, -1}, {0.5f, 0, -0.01f})) << "behind the receivers";
    EXPECT_FALSE(shaft.may_hold({0, 0, 4.01f}, {0.5f, 0, 9})) << "behind the lights";
    // Past a corner: both ends outside of different planes.
    EXPECT_FALSE(shaft.may_hold({0.0f, 3.1f, 2}, {3.1f, 0.0f, 2}));
    EXPECT_TRUE(shaft.may_hold({0.0f, 2.9f, 2}, {2.9f, 0.0f, 2}));
    Shaft above = shaft;
    above.cut_below({0, 0, 1}, 3.0, receivers, lights);
    EXPECT_TRUE(above.may_hold({0, 0, 1}, {0.5f, 0, 1})) << "never above the receivers";
}

}  // namespace
}  // namespace lightcuts::test
