#include <lightcuts/core/offset_block.hpp>

#include <lightcuts/core/cosine.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "support/random.hpp"

namespace lightcuts::test {
namespace {

/// A coordinate of any size that a float can have, often zero or ordinary.
float coordinate(Random& random) {
    const float sign = random.real(0.0, 1.0) < 0.5f ? -1.0f : 1.0f;
    const float choice = random.real(0.0, 1.0);
    if (choice < 0.2f) return 0.0f;
    return sign * static_cast<float>(choice < 0.5f ? random.decades(-2.0, 2.0) : random.decades(-39.0, 38.3));
}

struct Boxes {
    std::array<glm::vec3, lane_count> lo, hi;
    OffsetBlock block;

    explicit Boxes(Random& random) {
        for (std::size_t i = 0; i < lo.size(); ++i) {
            for (int k = 0; k < 3; ++k) {
                const float a = coordinate(random), b = coordinate(random);
                lo[i][k] = a < b ? a : b;
                hi[i][k] = a < b ? b : a;
            }
            block.set(static_cast<int>(i), lo[i], hi[i]);
        }
        block.finish(lane_count);
    }
};

template <int K>
void expect_bounds(const Boxes& boxes, const glm::vec3& v, Random& random) {
    LaneVectors directions;
    detail::LaneSupport support;
    alignas(32) Lanes bound;
    detail::broadcast(v, directions);
    detail::support(v, boxes.block, support);
    detail::max_dots_over_distance<K>(directions, support, boxes.block, bound);
    for (std::size_t i = 0; i < boxes.lo.size(); ++i) {
        for (int sample = 0; sample < 24; ++sample) {
            std::array<long double, 3> p{};
            for (int k = 0; k < 3; ++k) {
                const long double low = boxes.lo[i][k], high = boxes.hi[i][k];
                // Corners first. Elsewhere also points that are tiny in a vast box.
                const long double share = sample < 8    ? ((sample >> k) & 1)
                                          : sample < 16 ? static_cast<long double>(random.real(0.0, 1.0))
                                                        : static_cast<long double>(random.decades(-30.0, 0.0));
                p[static_cast<std::size_t>(k)] = std::clamp(low + share * (high - low), low, high);  // rounding apart
            }
            const long double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            const long double along = v.x * p[0] + v.y * p[1] + v.z * p[2];
            if (!(along > 0.0L)) continue;
            const long double value = along / std::pow(length, static_cast<long double>(K));
            if (bound[i] == std::numeric_limits<float>::infinity()) continue;
            EXPECT_LE(value, static_cast<long double>(bound[i])) << "K = " << K << ", lane " << i;
        }
    }
}

TEST(OffsetBlock, BoundsHoldForBoxesOfAnySize) {
    Random random(1);
    for (int trial = 0; trial < 4000; ++trial) {
        const Boxes boxes(random);
        glm::vec3 v(random.on_sphere());
        if (trial % 4 == 0) v = glm::vec3(0.70710678f, 0.70710678f, 0.0f);
        expect_bounds<1>(boxes, v, random);
        expect_bounds<2>(boxes, v, random);
        expect_bounds<3>(boxes, v, random);
    }
}

TEST(OffsetBlock, WhatIsNoNumberIsBoundedByThePeak) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    OffsetBlock block;
    block.set(0, glm::vec3(-infinity), glm::vec3(infinity));
    block.set(1, {-infinity, 1.0f, 1.0f}, {infinity, 2.0f, 2.0f});
    block.set(2, glm::vec3(3e38f), glm::vec3(infinity));
    block.finish(3);
    alignas(32) Lanes cosines;
    detail::clamped_max_cosines(glm::vec3(0.0f, 0.0f, 1.0f), block, cosines);
    for (const float c : cosines) EXPECT_EQ(c, 1.0f);
}

TEST(OffsetBlock, RepeatsTheLastBoxInTheLanesBehind) {
    OffsetBlock block;
    block.set(0, {1.0f, 2.0f, 3.0f}, {2.0f, 3.0f, 4.0f});
    block.set(1, {5.0f, 6.0f, 7.0f}, {5.0f, 6.0f, 8.0f});
    block.finish(2);
    for (int i = 2; i < lane_count; ++i) {
        EXPECT_EQ(block.lo.at(i), block.lo.at(1));
        EXPECT_EQ(block.hi.at(i), block.hi.at(1));
        EXPECT_EQ(block.inverse[i], block.inverse[1]);
    }
    EXPECT_GE(block.inverse[0], 1.0f / std::sqrt(14.0f));
    EXPECT_NEAR(block.inverse[0], 1.0f / std::sqrt(14.0f), 1e-5f);
}

}  // namespace
}  // namespace lightcuts::test
