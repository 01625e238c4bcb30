#include <lightcuts/core/cone.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/core/vector.hpp>

#include "configurations.hpp"

namespace {

using namespace lightcuts;
using configurations::Draw;
constexpr double pi = 3.141592653589793;

static_assert(sizeof(Cone) == 4 * sizeof(float));

/// A direction at the angle `angle` from `axis`.
glm::dvec3 tilted(const glm::dvec3& axis, double angle, Draw& draw) {
    const glm::dvec3 a = glm::normalize(axis);
    const glm::dvec3 side = glm::normalize(glm::cross(a, draw.direction()));
    return a * std::cos(angle) + side * std::sin(angle);
}

Cone cone_with(const glm::dvec3& axis, double beta) {
    const double s = std::sin(0.5 * beta);
    return {glm::vec3(axis), static_cast<float>(s * s)};
}

/// beta in radians.
double half_angle(const Cone& c) {
    const double s2 = static_cast<double>(c.sin2_half);
    return 2.0 * std::atan2(std::sqrt(s2), std::sqrt(1.0 - s2));
}

/// In radians, accurate from 0 to pi.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 s = glm::normalize(a);
    const glm::dvec3 t = glm::normalize(b);
    return 2.0 * std::atan2(glm::length(s - t), glm::length(s + t));
}

/// Half-angles from 0 over 1e-9 to pi, the degenerate ones often.
double random_half_angle(Draw& draw) {
    switch (draw.below(6)) {
        case 0: return 0.0;
        case 1: return std::exp(draw.uniform(-20.0, 0.0));
        case 2: return 0.5 * pi;
        case 3: return pi - std::exp(draw.uniform(-20.0, 0.0));
        default: return draw.uniform(0.0, pi);
    }
}

Cone random_cone(Draw& draw) { return cone_with(draw.direction(), random_half_angle(draw)); }

/// Often nearly equal or nearly opposite to `a`, or along the same line.
Cone partner_of(const Cone& a, Draw& draw) {
    Cone b = random_cone(draw);
    const double small = std::exp(draw.uniform(-22.0, -1.0));
    switch (draw.below(6)) {
        case 0: b.axis = glm::vec3(tilted(glm::dvec3(a.axis), small, draw)); break;
        case 1: b.axis = glm::vec3(tilted(-glm::dvec3(a.axis), small, draw)); break;
        case 2: b.axis = a.axis; break;
        case 3: b.axis = -a.axis; break;
        default: break;
    }
    return b;
}

TEST(Cone, TheDefaultIsEmptyAndTheIdentityOfMerge) {
    constexpr Cone empty;
    EXPECT_TRUE(is_empty(empty));
    const Cone c = cone_with({1.0, 0.0, 0.0}, 0.3);
    EXPECT_EQ(merge(empty, c), c);
    EXPECT_EQ(merge(c, empty), c);
    EXPECT_TRUE(is_empty(merge(empty, empty)));
    EXPECT_TRUE(is_whole_sphere(merge(whole_sphere(), c)));
    EXPECT_TRUE(is_whole_sphere(merge(c, whole_sphere())));
}

TEST(Cone, EqualDirectionsStayOneDirection) {
    Draw draw(1);
    for (int i = 0; i < 1000; ++i) {
        const Cone c = cone_of(glm::vec3(draw.direction()));
        const Cone merged = merge(merge(c, c), c.axis);
        ASSERT_EQ(merged, c);
        ASSERT_TRUE(is_single(merged));
        ASSERT_EQ(cos_half_angle(merged), 1.0);
        ASSERT_EQ(sin_half_angle(merged), 0.0);
        ASSERT_EQ(one_minus_cos(merged), 0.0);
        ASSERT_TRUE(contains(merged, glm::dvec3(c.axis)));
    }
}

TEST(Cone, AnglesAreAccurateWithinTheirStorage) {
    Draw draw(2);
    for (int i = 0; i < 50000; ++i) {
        const double beta = std::min(std::exp(draw.uniform(-25.0, 1.0)), 0.5 * pi);
        const Cone c = cone_with(draw.direction(), beta);
        const double half_sine = std::sin(0.5 * beta);
        ASSERT_NEAR(one_minus_cos(c), 2.0 * half_sine * half_sine, 2e-7 * one_minus_cos(c)) << beta;
        ASSERT_NEAR(sin_half_angle(c), std::sin(beta), 2e-7 * sin_half_angle(c)) << beta;
        ASSERT_NEAR(cos_half_angle(c), std::cos(beta), 2e-7) << beta;
    }
    const Cone narrow = cone_with({0.0, 0.0, 1.0}, 1e-6);
    EXPECT_NEAR(one_minus_cos(narrow), 0.5e-12, 1e-19);
    EXPECT_NEAR(sin_half_angle(narrow), 1e-6, 1e-13);
}

TEST(Cone, MergeHoldsBothConesInDegeneratePairs) {
    Draw draw(3);
    for (int i = 0; i < 500000; ++i) {
        const Cone a = random_cone(draw);
        const Cone b = partner_of(a, draw);
        const Cone merged = merge(a, b);
        ASSERT_TRUE(contains(merged, glm::dvec3(a.axis))) << i;
        ASSERT_TRUE(contains(merged, glm::dvec3(b.axis))) << i;
        if (is_whole_sphere(merged)) continue;
        // The farthest direction of each cone, not only its axis.
        for (const Cone& c : {a, b}) {
            const double reach = angle_between(glm::dvec3(merged.axis), glm::dvec3(c.axis)) + half_angle(c);
            ASSERT_LE(reach, half_angle(merged) + 1e-7 * (half_angle(merged) > 3.0)) << i;
        }
    }
}

TEST(Cone, MergeHoldsSampledDirections) {
    Draw draw(4);
    for (int i = 0; i < 100000; ++i) {
        const Cone a = random_cone(draw);
        const Cone b = partner_of(a, draw);
        const Cone merged = merge(a, b);
        for (const Cone& c : {a, b}) {
            if (is_single(c)) continue;  // its axis, see above
            const glm::dvec3 d = tilted(glm::dvec3(c.axis), half_angle(c) * (1.0 - 1e-6) * std::sqrt(draw.unit()),
                                        draw);
            ASSERT_TRUE(contains(merged, d)) << i;
        }
    }
}

TEST(Cone, MergeIsMinimal) {
    Draw draw(5);
    for (int i = 0; i < 1000000; ++i) {
        const Cone a = random_cone(draw);
        const Cone b = partner_of(a, draw);
        const double between = angle_between(glm::dvec3(a.axis), glm::dvec3(b.axis));
        double beta = 0.5 * (half_angle(a) + half_angle(b) + between);
        beta = std::min(pi, std::max({beta, half_angle(a), half_angle(b)}));
        // Float axes and sin^2 cost some 1e-7 rad; towards pi, where the sine is flat, more.
        const double allowed = 3e-7 / std::max(std::cos(0.5 * beta), 1e-4);
        ASSERT_LE(half_angle(merge(a, b)), beta + allowed) << i << ' ' << half_angle(a) << ' ' << half_angle(b);
    }
}

TEST(Cone, MergeIsANumberForAxesOfAnyLengthAndAnyWidth) {
    // Axes are unit up to the rounding of their coordinates: one direction may be stored in several lengths.
    Draw draw(9);
    const float widths[] = {0.0f, 1e-45f, 1e-42f, 1e-38f, 1e-30f, 1e-25f, 1e-22f, 1e-21f, 1e-15f, 0.5f, 1.0f};
    for (int i = 0; i < 20000; ++i) {
        const Cone a{glm::vec3(draw.direction()), widths[draw.below(11)]};
        const Cone b{a.axis * (draw.below(2) == 0 ? 0.99999994f : -1.0000001f), widths[draw.below(11)]};
        for (const Cone& merged : {merge(a, b), merge(b, a)}) {
            ASSERT_TRUE(is_unit(merged.axis)) << i;
            ASSERT_GE(merged.sin2_half, std::max(a.sin2_half, b.sin2_half)) << i;
            ASSERT_TRUE(contains(merged, glm::dvec3(a.axis)) && contains(merged, glm::dvec3(b.axis))) << i;
        }
    }
}

TEST(Cone, OppositeAxesMakeAHemisphere) {
    Draw draw(6);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 a(draw.direction());
        const Cone merged = merge(cone_of(a), -a);
        ASSERT_NEAR(half_angle(merged), 0.5 * pi, 1e-6);
        ASSERT_NEAR(glm::dot(glm::dvec3(merged.axis), glm::dvec3(a)), 0.0, 1e-6);
        ASSERT_FALSE(is_whole_sphere(merged));
    }
}

TEST(Cone, LongChainsStayConservative) {
    Draw draw(7);
    for (const double spread : {0.0, 1e-7, 1e-3, 0.5, 3.0}) {
        const glm::dvec3 middle = draw.direction();
        std::vector<glm::vec3> axes;
        Cone all;
        for (int i = 0; i < 2000; ++i) {
            axes.emplace_back(tilted(middle, spread * std::sqrt(draw.unit()), draw));
            all = merge(all, axes.back());
        }
        for (const glm::vec3& a : axes) ASSERT_TRUE(contains(all, glm::dvec3(a)));
        EXPECT_LE(half_angle(all), std::min(pi, 1.5 * spread + 3e-7)) << spread;
    }
}

TEST(Cone, NegatedHoldsOppositeDirections) {
    const Cone c = cone_with({0.0, 1.0, 0.0}, 0.4);
    EXPECT_TRUE(contains(negated(c), glm::dvec3(0.3, -1.0, 0.0)));
    EXPECT_FALSE(contains(negated(c), glm::dvec3(0.3, 1.0, 0.0)));
}

TEST(WidenCosine, OneDirectionReturnsItsArgument) {
    const Cone single = cone_of({0.0f, 1.0f, 0.0f});
    for (const double c : {0.0, -0.0, 1.0, -1.0, 0.3, -1e-300}) EXPECT_EQ(widen_cosine(c, single), c);
}

TEST(WidenCosine, BoundsEveryDirectionOfTheCone) {
    Draw draw(8);
    double worst = 0.0;
    for (int i = 0; i < 500000; ++i) {
        const Cone c = random_cone(draw);
        const glm::dvec3 axis = unit_axis(c);
        const glm::dvec3 o = draw.chance(0.2) ? glm::normalize(tilted(axis, half_angle(c), draw)) : draw.direction();
        const double theta = angle_between(axis, o);
        const double wide = widen_cosine(glm::dot(axis, o) + 4e-16, c);  // not below the true cosine
        const double exact = std::cos(std::max(0.0, theta - half_angle(c)));
        ASSERT_GE(wide, exact - 4e-16) << theta << ' ' << half_angle(c);
        ASSERT_TRUE(wide <= 1.0 || is_single(c));
        worst = std::max(worst, wide - exact);
    }
    EXPECT_LT(worst, 1e-7);
    EXPECT_EQ(widen_cosine(-1.0, whole_sphere()), 1.0);
    EXPECT_EQ(widen_cosine(0.0, cone_with({1.0, 0.0, 0.0}, 0.5 * pi)), 1.0);
}

}  // namespace
