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
                exact = std::max(exact, both_cosines(Exact(n), Exact(u), Exact(max_dot_over_distance<2>(v, b).at)));
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
    EXPECT_EQ(joint_bound(cone_of(glm::vec3(up)), wide, coplanar), 0.0);
    EXPECT_EQ(joint_bound(cone_of(glm::vec3(up)), wide, around), infinity);
    EXPECT_EQ(joint_bound(cone_of(-glm::vec3(up)), wide, above), 0.0);
    const Cone away{{0.0f, -1.0f, 0.0f}, 0.01f};
    EXPECT_EQ(joint_bound(cone_of(glm::vec3(up)), away, above), 0.0);
}

TEST(JointBound, ScalesAsDistanceToMinusTwo) {
    Draw draw(3);
    for (int i = 0; i < 3000; ++i) {
        const OffsetBox b = configurations::make(Shape::ordinary, draw, 1.5).box();
        const Cone n = cone_of(glm::vec3(draw.direction()));
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
        const Cone n = cone_of(glm::vec3(draw.direction()));
        const Cone u{glm::vec3(draw.direction()), draw.chance(0.5) ? 0.0f : 0.05f};
        const double tight = joint_bound(n, u, b);
        const double enough = tight * draw.uniform(0.5, 2.0);
        const double stopped = joint_bound(n, u, b, {.enough = enough});
        ASSERT_GE(stopped, tight);
        ASSERT_EQ(stopped <= enough, tight <= enough);
    }
}

/// Axes of cones are unit vectors within float rounding, and cosines with them so many times as large at most.
constexpr long double float_axis = 2e-7L;

TEST(JointBound, OfConesBoundsEveryLight) {
    Draw draw(5);
    for (int i = 0; i < 300000; ++i) {
        const Configuration c = configurations::make(draw);
        const OffsetBox b = c.box();
        const glm::dvec3 n(glm::vec3(configurations::hard_direction(b, draw)));
        const double half = 0.5 * (draw.chance(0.2) ? 1.5707963267948966 : std::exp(draw.uniform(-12.0, 1.14)));
        const Cone u{glm::vec3(configurations::hard_direction(b, draw)),
                     static_cast<float>(std::sin(half) * std::sin(half))};
        const double bound = joint_bound(cone_of(glm::vec3(n)), u, b, random_effort(draw));
        ASSERT_GE(bound, 0.0);
        for (int s = 0; s < 8; ++s) {
            const glm::dvec3 likely = n + glm::dvec3(u.axis) * draw.uniform(0.0, 4.0);
            const Exact p = s < 5 ? Exact(configurations::light_in(c.lights, draw), c.receiver)
                                  : Exact(configurations::likely_maximum(likely, b, draw));
            const long double p2 = dot(p, p);
            if (p2 == 0.0L) continue;
            const long double cosines = positive(dot(Exact(n), p)) / std::sqrt(p2) *
                                        positive(widened(Exact(glm::dvec3(u.axis)), p, u.sin2_half));
            ASSERT_GE(static_cast<long double>(bound), cosines / p2 * (1.0L - float_axis))
                << "shape " << static_cast<int>(c.shape) << " beta " << 2.0 * half << " draw " << i;
        }
    }
}

TEST(JointBound, OfConesIsAtMostTheProduct) {
    Draw draw(6);
    std::vector<double> gains;
    for (int i = 0; i < 20000; ++i) {
        const OffsetBox b = configurations::make(Shape::ordinary, draw, 2.0).box();
        const Cone n = cone_of(glm::vec3(draw.direction()));
        const Cone u{glm::vec3(draw.direction()), static_cast<float>(std::pow(draw.uniform(0.025, 0.56), 2.0))};
        const double joint = joint_bound(n, u, b);
        const double product = clamped_max_cosine(glm::dvec3(n.axis), b) *
                               std::max(0.0, widen_cosine(max_cosine(glm::dvec3(u.axis), b), u)) / min_distance2(b);
        ASSERT_LE(joint, product * 1.01);
        if (joint > 0.0) gains.push_back(product / joint);
    }
    std::sort(gains.begin(), gains.end());
    EXPECT_GT(gains[gains.size() / 2], 1.1);
}

TEST(JointBound, OfTwoConesBoundsEveryLightAndNormal) {
    Draw draw(7);
    const auto some_cone = [&](const OffsetBox& b) {
        const double half = 0.5 * (draw.chance(0.2) ? 1.5707963267948966 : std::exp(draw.uniform(-12.0, 1.14)));
        const float sin2_half = draw.chance(0.1) ? 0.0f : static_cast<float>(std::sin(half) * std::sin(half));
        // The sum with zero keeps g++ 12 from leaving out the rounding to float.
        return Cone{glm::vec3(configurations::hard_direction(b, draw)) + 0.0f, sin2_half};
    };
    for (int i = 0; i < 200000; ++i) {
        const Configuration c = configurations::make(draw);
        const OffsetBox b = c.box();
        const Cone n = some_cone(b), u = some_cone(b);
        const double bound = joint_bound(n, u, b, random_effort(draw));
        ASSERT_GE(bound, 0.0);
        for (int s = 0; s < 8; ++s) {
            const glm::dvec3 likely = glm::dvec3(n.axis) + glm::dvec3(u.axis) * draw.uniform(0.0, 4.0);
            const Exact p = s < 5 ? Exact(configurations::light_in(c.lights, draw), c.receiver)
                                  : Exact(configurations::likely_maximum(likely, b, draw));
            const long double p2 = dot(p, p);
            if (p2 == 0.0L) continue;
            const auto cosine = [&](const Cone& cone) {
                const Exact axis{glm::dvec3(cone.axis)};
                return positive(is_single(cone) ? dot(axis, p) / std::sqrt(p2) : widened(axis, p, cone.sin2_half));
            };
            ASSERT_GE(static_cast<long double>(bound), cosine(n) * cosine(u) / p2 * (1.0L - 2.0L * float_axis))
                << "shape " << static_cast<int>(c.shape) << " draw " << i;
        }
    }
}

}  // namespace
