#include <lightcuts/core/box.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "configurations.hpp"
#include "support/contraction.hpp"

namespace {

using namespace lightcuts;
using configurations::Draw;
using test::is_contracted;

static_assert(sizeof(Box) == 6 * sizeof(float));
static_assert(sizeof(OffsetBox) == 6 * sizeof(double));

glm::vec3 random_point(Draw& draw) { return glm::vec3(draw.in_cube(std::exp(draw.uniform(-20.0, 20.0)))); }

TEST(Box, TheDefaultIsEmptyAndTheIdentityOfMerge) {
    constexpr Box empty;
    EXPECT_TRUE(is_empty(empty));
    EXPECT_EQ(diagonal2(empty), 0.0);
    EXPECT_FALSE(contains(empty, glm::vec3(0.0f)));
    const Box b = box_of({1.0f, -2.0f, 3.0f});
    EXPECT_FALSE(is_empty(b));
    EXPECT_EQ(merge(empty, b), b);
    EXPECT_EQ(merge(b, empty), b);
    EXPECT_TRUE(is_empty(merge(empty, empty)));
    EXPECT_TRUE(contains(b, empty));
    EXPECT_FALSE(contains(empty, b));
}

TEST(Box, MergeHoldsBothAndIsSmallest) {
    Draw draw(1);
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 p = random_point(draw);
        const glm::vec3 q = random_point(draw);
        const Box b = merge(box_of(p), box_of(q));
        ASSERT_TRUE(contains(b, p) && contains(b, q));
        for (int k = 0; k < 3; ++k) {
            ASSERT_TRUE((b.lo[k] == p[k] && b.hi[k] == q[k]) || (b.lo[k] == q[k] && b.hi[k] == p[k]));
        }
        ASSERT_TRUE(contains(b, box_of(p)));
        ASSERT_EQ(merge(b, box_of(p)), b);
    }
}

TEST(Box, DiagonalAndCenter) {
    const Box b{{-1.0f, 0.0f, 2.0f}, {1.0f, 4.0f, 3.0f}};
    EXPECT_EQ(diagonal2(b), 4.0 + 16.0 + 1.0);
    EXPECT_EQ(center(b), glm::dvec3(0.0, 2.0, 2.5));
    const float largest = std::numeric_limits<float>::max();
    const Box whole{glm::vec3(-largest), glm::vec3(largest)};
    EXPECT_TRUE(std::isfinite(diagonal2(whole)));
    EXPECT_EQ(center(whole), glm::dvec3(0.0));
}

TEST(OffsetBox, HoldsEveryExactOffset) {
    Draw draw(2);
    int inexact = 0;
    for (int i = 0; i < 200000; ++i) {
        const glm::vec3 p = random_point(draw);
        const glm::vec3 x = random_point(draw);
        const OffsetBox b = offsets(box_of(p), x);
        for (int k = 0; k < 3; ++k) {
            const long double a = p[k];
            const long double exact = a - static_cast<long double>(x[k]);
            const long double part = exact - a;
            const long double lost = (a - (exact - part)) - (static_cast<long double>(x[k]) + part);
            if (lost != 0.0L) continue;  // more than 64 bits
            ASSERT_LE(static_cast<long double>(b.lo[k]), exact);
            ASSERT_GE(static_cast<long double>(b.hi[k]), exact);
            ASSERT_LE(b.hi[k] - b.lo[k], std::fabs(b.hi[k]) * 4.0 * unit_roundoff);
            const bool is_exact = static_cast<long double>(b.hi[k]) == exact;
            inexact += !is_exact;
            // Outward only where needed.
            ASSERT_TRUE(static_cast<long double>(static_cast<double>(exact)) != exact || b.lo[k] == b.hi[k]);
        }
    }
    EXPECT_GT(inexact, 1000) << "the draw must reach differences that double cannot hold";
}

TEST(OffsetBox, ZerosStayZeros) {
    const Box plane{{-1.0f, 0.3f, -1.0f}, {1.0f, 0.3f, 1.0f}};
    const OffsetBox b = offsets(plane, {0.1f, 0.3f, 0.2f});
    EXPECT_EQ(b.lo.y, 0.0);
    EXPECT_EQ(b.hi.y, 0.0);
}

TEST(OffsetBox, TwoBoxesHoldEveryPair) {
    Draw draw(3);
    for (int i = 0; i < 20000; ++i) {
        const Box lights = configurations::make(draw).lights;
        const Box receivers = configurations::make(draw).lights;
        const OffsetBox b = offsets(lights, receivers);
        const configurations::Exact p(configurations::light_in(lights, draw),
                                      configurations::light_in(receivers, draw));
        ASSERT_TRUE(b.lo.x <= p.x && p.x <= b.hi.x && b.lo.y <= p.y && p.y <= b.hi.y && b.lo.z <= p.z && p.z <= b.hi.z);
    }
}

TEST(OffsetBox, DistancesBoundEveryPoint) {
    Draw draw(4);
    for (int i = 0; i < 100000; ++i) {
        const configurations::Configuration c = configurations::make(draw);
        const OffsetBox b = c.box();
        const double near2 = min_distance2(b);
        const double far2 = max_distance2(b);
        const configurations::Exact p(configurations::light_in(c.lights, draw), c.receiver);
        ASSERT_LE(static_cast<long double>(near2), dot(p, p));
        ASSERT_GE(static_cast<long double>(far2), dot(p, p));
        ASSERT_EQ(near2 == 0.0, contains(b, glm::dvec3(0.0)));
        const double twice_rounded = is_contracted ? 4.0 * unit_roundoff : 0.0;
        ASSERT_NEAR(near2, min_distance2(negated(b)), twice_rounded * near2);
        ASSERT_NEAR(far2, max_distance2(negated(b)), twice_rounded * far2);
        const glm::dvec3 nearest = clamp(glm::dvec3(0.0), b);
        ASSERT_TRUE(contains(b, nearest));
        ASSERT_NEAR(near2, glm::dot(nearest, nearest), near2 * 1e-15);
    }
}

TEST(OffsetBox, ScalesLikeItsPoints) {
    const OffsetBox b{{1.0, 2.0, -3.0}, {2.0, 4.0, 5.0}};
    for (const double scale : {1e-12, 1e12}) {
        const OffsetBox scaled{b.lo * scale, b.hi * scale};
        EXPECT_NEAR(min_distance2(scaled) / (scale * scale), 5.0, 1e-14);
        EXPECT_NEAR(max_distance2(scaled) / (scale * scale), 4.0 + 16.0 + 25.0, 1e-13);
    }
}

}  // namespace
