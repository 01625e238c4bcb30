#include <lightcuts/core/joint.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "configurations.hpp"

namespace {

using namespace lightcuts;
using configurations::Configuration;
using configurations::Draw;
using configurations::Exact;
using configurations::Shape;

constexpr double infinity = std::numeric_limits<double>::infinity();

long double positive(long double x) { return x > 0.0L ? x : 0.0L; }

long double both_cosines(const Exact& n, const Exact& u, const Exact& p) {
    const long double p2 = dot(p, p);
    const long double product = positive(dot(n, p)) * positive(dot(u, p));
    return product > 0.0L ? product / (p2 * p2) : 0.0L;
}

/// cos(max(0, theta - beta)) from the sine and cosine of both angles.
long double widened(const Exact& axis, const Exact& p, long double sin2_half) {
    const long double c = dot(axis, p) / std::sqrt(dot(p, p) * dot(axis, axis));
    const long double cone = 1.0L - 2.0L * sin2_half;
    if (c >= cone) return 1.0L;
    const long double s = std::sqrt(std::max(0.0L, (1.0L - c) * (1.0L + c)));
    return c * cone + s * 2.0L * std::sqrt(sin2_half * (1.0L - sin2_half));
}

JointEffort random_effort(Draw& draw) {
    return {.iterations = 1 + draw.below(5), .tolerance = draw.chance(0.5) ? 2e-3 : 1e-9};
}

TEST(JointBound, BoundsEveryLight) {
    Draw draw(1);
    for (int i = 0; i < 300000; ++i) {
        const Configuration c = configurations::make(draw);
        const OffsetBox b = c.box();
        const glm::dvec3 n = configurations::hard_direction(b, draw);
        const glm::dvec3 u = draw.chance(0.1) ? n : draw.chance(0.1) ? -n : configurations::hard_direction(b, draw);
        const double bound = joint_bound(n, u, b, random_effort(draw));
        ASSERT_GE(bound, 0.0);
        for (int s = 0; s < 8; ++s) {
            const Exact p = s < 5 ? Exact(configurations::light_in(c.lights, draw), c.receiver)
                                  : Exact(configurations::likely_maximum(n + u * draw.uniform(0.1, 4.0), b, draw));
            ASSERT_GE(static_cast<long double>(bound), both_cosines(Exact(n), Exact(u), p))
                << "shape " << static_cast<int>(c.shape) << " draw " << i;
        }
    }
}

TEST(JointBound, IsNearlyExact) {
    Draw draw(2);
    for (const double nearest : {0.6, 2.0, 6.0}) {
        std::vector<double> ratios;
        while (ratios.size() < 4000) {
            const OffsetBox b = configurations::make(Shape::ordinary, draw, nearest).box();
            if (min_distance2(b) == 0.0) continue;
            const glm::dvec3 n = draw.direction();
            const glm::dvec3 u = draw.direction();
            long double exact = 0.0L;
            for (int s = 0; s < 200; ++s) {
                const glm::dvec3 v = n + u * std::exp(draw.uniform(-3.0, 3.0));
                exact = std::max(exact, both_cosines(Exact(n), Exact(u), Exact(max_power<2>(v, b).at)));
            }
            if (exact == 0.0L) continue;
            ratios.push_back(static_cast<double>(joint_bound(n, u, b) / exact));
        }
        std::sort(ratios.begin(), ratios.end());
        EXPECT_LT(ratios[ratios.size() / 2], 1.02) << nearest;
        EXPECT_LT(ratios[ratios.size() * 9 / 10], nearest < 1.0 ? 2.0 : 1.15) << nearest;
        EXPECT_GE(ratios.front(), 1.0) << nearest;
    }
}

TEST(JointBound, ZerosAreExactAndTouchingBoxesInfinite) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    const glm::dvec3 right(1.0, 0.0, 0.0);
    const OffsetBox coplanar{{-1.0, 0.0, -1.0}, {1.0, 0.0, 1.0}};
    const OffsetBox above{{1.0, 1.0, 1.0}, {2.0, 2.0, 2.0}};
    const OffsetBox around{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}};
    EXPECT_EQ(joint_bound(up, right, coplanar), 0.0);
    EXPECT_EQ(joint_bound(right, up, coplanar), 0.0);
    EXPECT_EQ(joint_bound(up, -up, above), 0.0);
    EXPECT_EQ(joint_bound(-up, up, above), 0.0);
    EXPECT_EQ(joint_bound(up, right, around), infinity);
    const Cone wide{{1.0f, 0.0f, 0.0f}, 0.3f};
    EXPECT_EQ(joint_bound(up, wide, coplanar), 0.0);
    EXPECT_EQ(joint_bound(up, wide, around), infinity);
    EXPECT_EQ(joint_bound(-up, wide, above), 0.0);
    const Cone away{{0.0f, -1.0f, 0.0f}, 0.01f};
    EXPECT_EQ(joint_bound(up, away, above), 0.0);
    EXPECT_EQ(joint_power_bound({up, right}, {1.0, 1.0}, 4.0, coplanar), 0.0);
    EXPECT_EQ(joint_power_bound({up, right}, {1.0, 1.0}, 4.0, around), infinity);
}

TEST(JointBound, ScalesAsDistanceToMinusTwo) {
    Draw draw(3);
    for (int i = 0; i < 3000; ++i) {
        const OffsetBox b = configurations::make(Shape::ordinary, draw, 1.5).box();
        const glm::dvec3 n = draw.direction();
        const Cone u{glm::vec3(draw.direction()), draw.chance(0.5) ? 0.0f : 0.05f};
        const double at_one = joint_bound(n, u, b);
        for (const double scale : {0x1p-40, 0x1p40}) {
            const double elsewhere = joint_bound(n, u, {b.lo * scale, b.hi * scale}) * scale * scale;
            if (at_one == elsewhere) continue;  // both may be infinite
            ASSERT_NEAR(elsewhere, at_one, 1e-12 * at_one);
        }
    }
}

TEST(JointBound, StopsWhenItIsEnough) {
    Draw draw(4);
    for (int i = 0; i < 3000; ++i) {
        const OffsetBox b = configurations::make(Shape::ordinary, draw, 1.5).box();
        const glm::dvec3 n = draw.direction();
        const Cone u{glm::vec3(draw.direction()), draw.chance(0.5) ? 0.0f : 0.05f};
        const double tight = joint_bound(n, u, b);
        const double enough = tight * draw.uniform(0.5, 2.0);
        const double stopped = joint_bound(n, u, b, {.enough = enough});
        ASSERT_GE(stopped, tight);
        ASSERT_EQ(stopped <= enough, tight <= enough);
    }
}

TEST(JointBound, OfConesBoundsEveryLight) {
    Draw draw(5);
    for (int i = 0; i < 300000; ++i) {
        const Configuration c = configurations::make(draw);
        const OffsetBox b = c.box();
        const glm::dvec3 n = configurations::hard_direction(b, draw);
        const double half = 0.5 * (draw.chance(0.2) ? 1.5707963267948966 : std::exp(draw.uniform(-12.0, 1.14)));
        const Cone u{glm::vec3(configurations::hard_direction(b, draw)),
                     static_cast<float>(std::sin(half) * std::sin(half))};
        const double bound = joint_bound(n, u, b, random_effort(draw));
        ASSERT_GE(bound, 0.0);
        for (int s = 0; s < 8; ++s) {
            const glm::dvec3 likely = n + glm::dvec3(u.axis) * draw.uniform(0.0, 4.0);
            const Exact p = s < 5 ? Exact(configurations::light_in(c.lights, draw), c.receiver)
                                  : Exact(configurations::likely_maximum(likely, b, draw));
            const long double p2 = dot(p, p);
            if (p2 == 0.0L) continue;
            const long double cosines = positive(dot(Exact(n), p)) / std::sqrt(p2) *
                                        positive(widened(Exact(glm::dvec3(u.axis)), p, u.sin2_half));
            ASSERT_GE(static_cast<long double>(bound), cosines / p2 * (1.0L - 1e-15L))
                << "shape " << static_cast<int>(c.shape) << " beta " << 2.0 * half << " draw " << i;
        }
    }
}

TEST(JointBound, OfConesIsAtMostTheProduct) {
    Draw draw(6);
    std::vector<double> gains;
    for (int i = 0; i < 20000; ++i) {
        const OffsetBox b = configurations::make(Shape::ordinary, draw, 2.0).box();
        const glm::dvec3 n = draw.direction();
        const Cone u{glm::vec3(draw.direction()), static_cast<float>(std::pow(draw.uniform(0.025, 0.56), 2.0))};
        const double joint = joint_bound(n, u, b);
        const double product = clamped_max_cosine(n, b) *
                               std::max(0.0, widen_cosine(max_cosine(glm::dvec3(u.axis), b), u)) / min_distance2(b);
        ASSERT_LE(joint, product * 1.01);
        if (joint > 0.0) gains.push_back(product / joint);
    }
    std::sort(gains.begin(), gains.end());
    EXPECT_GT(gains[gains.size() / 2], 1.1);
}

TEST(JointPowerBound, BoundsEveryLight) {
    Draw draw(7);
    for (int i = 0; i < 60000; ++i) {
        const Configuration c = configurations::make(draw);
        const OffsetBox b = c.box();
        const glm::dvec3 directions[3] = {configurations::hard_direction(b, draw),
                                          configurations::hard_direction(b, draw),
                                          configurations::hard_direction(b, draw)};
        const double exponent = std::pow(10.0, draw.below(7)) * draw.uniform(0.1, 1.0);
        const double bound = joint_power_bound(directions, {1.0, 1.0, exponent}, exponent + 4.0, b, 1 + draw.below(5));
        ASSERT_GE(bound, 0.0);
        for (int s = 0; s < 6; ++s) {
            const glm::dvec3 likely = s == 4 ? directions[2] : directions[0] + directions[1] + directions[2];
            const Exact p = s < 4 ? Exact(configurations::light_in(c.lights, draw), c.receiver)
                                  : Exact(configurations::likely_maximum(likely, b, draw));
            const long double p2 = dot(p, p);
            if (p2 == 0.0L) continue;
            const long double cosine = positive(dot(Exact(directions[2]), p)) / std::sqrt(p2);
            const long double value = both_cosines(Exact(directions[0]), Exact(directions[1]), p) *
                                      std::pow(cosine, static_cast<long double>(exponent));
            ASSERT_GE(static_cast<long double>(bound), value)
                << "shape " << static_cast<int>(c.shape) << " exponent " << exponent << " draw " << i;
        }
    }
}

TEST(JointPowerBound, IsNearlyExact) {
    Draw draw(8);
    for (const double exponent : {1.0, 30.0, 1000.0}) {
        std::vector<double> ratios;
        while (ratios.size() < 1000) {
            const OffsetBox b = configurations::make(Shape::ordinary, draw, 2.0).box();
            if (min_distance2(b) == 0.0) continue;
            const glm::dvec3 directions[3] = {draw.direction(), draw.direction(), draw.direction()};
            const double bound = joint_power_bound(directions, {1.0, 1.0, exponent}, exponent + 4.0, b, 12);
            const double loose = joint_power_bound(directions, {1.0, 1.0, exponent}, exponent + 4.0, b);
            if (!(bound > 1e-200)) continue;
            ratios.push_back(loose / bound);
        }
        std::sort(ratios.begin(), ratios.end());
        EXPECT_LT(ratios[ratios.size() / 2], 1.02) << exponent;
    }
}

TEST(JointPowerBound, WithTwoWeightsIsTheJointBound) {
    Draw draw(9);
    std::vector<double> ratios;
    for (int i = 0; i < 5000; ++i) {
        const OffsetBox b = configurations::make(Shape::ordinary, draw, 3.0).box();
        const glm::dvec3 n = draw.direction();
        const glm::dvec3 u = draw.direction();
        const double general = joint_power_bound({n, u}, {1.0, 1.0}, 4.0, b, 40, 1e-6);
        const double special = joint_bound(n, u, b, {.iterations = 60, .tolerance = 1e-6});
        if (general == special) continue;  // both may be zero or infinite
        ratios.push_back(general / special);
    }
    std::sort(ratios.begin(), ratios.end());
    EXPECT_GT(ratios.front(), 0.97);
    EXPECT_LT(ratios[ratios.size() * 9 / 10], 1.01);
}

}  // namespace
