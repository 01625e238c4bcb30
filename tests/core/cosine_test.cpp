#include <lightcuts/core/cosine.hpp>

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

long double power_term(const Exact& v, const Exact& p, long double k) {
    const long double p2 = dot(p, p);
    const long double along = dot(v, p);
    if (!(along > 0.0L)) return 0.0L;
    if (k == 2.0L) return along / p2;
    const long double length = std::sqrt(p2);
    if (k == 1.0L) return along / length;
    return along / (p2 * length);
}

double bound_of(int k, const glm::dvec3& v, const OffsetBox& b, double tolerance, int iterations) {
    switch (k) {
        case 1: return max_dot_over_distance<1>(v, b, tolerance, iterations).value;
        case 2: return max_dot_over_distance<2>(v, b, tolerance, iterations).value;
        default: return max_dot_over_distance<3>(v, b, tolerance, iterations).value;
    }
}

TEST(MaxDotOverDistance, BoundsEveryLight) {
    Draw draw(1);
    int finite = 0;
    for (int i = 0; i < 500000; ++i) {
        const Configuration c = configurations::make(draw);
        const OffsetBox b = c.box();
        const glm::dvec3 v = configurations::hard_direction(b, draw) * (draw.chance(0.1) ? 1e3 : 1.0);
        const int k = 1 + draw.below(3);
        const double tolerance = std::pow(10.0, -draw.below(17));
        const int iterations = draw.chance(0.5) ? 60 : draw.below(4);
        const double bound = bound_of(k, v, b, tolerance, iterations);
        ASSERT_GE(bound, 0.0);
        finite += std::isfinite(bound);
        for (int s = 0; s < 8; ++s) {
            const Exact p = s < 5 ? Exact(configurations::light_in(c.lights, draw), c.receiver)
                                  : Exact(configurations::likely_maximum(v, b, draw));
            ASSERT_GE(static_cast<long double>(bound), power_term(Exact(v), p, k))
                << "shape " << static_cast<int>(c.shape) << " k " << k << " draw " << i;
        }
    }
    EXPECT_GT(finite, 380000);
}

TEST(MaxDotOverDistance, IsAttainedWithinTheTolerance) {
    Draw draw(2);
    for (int i = 0; i < 150000; ++i) {
        const Configuration c = configurations::make(draw);
        const OffsetBox b = c.box();
        if (min_distance2(b) == 0.0) continue;
        const glm::dvec3 v = configurations::hard_direction(b, draw);
        const double tolerance = draw.chance(0.5) ? 1e-3 : 1e-9;
        const double d = std::sqrt(min_distance2(b));
        const auto check = [&](const AttainedBound& bound, double k) {
            if (bound.value == 0.0) return;
            ASSERT_TRUE(contains(b, bound.at));
            const double attained = static_cast<double>(power_term(Exact(v), Exact(bound.at), k));
            ASSERT_LE(bound.value, attained * (1.0 + 2.0 * tolerance) + 1e-14 / std::pow(d, k - 1.0))
                << "shape " << static_cast<int>(c.shape) << " k " << k << " draw " << i;
        };
        check(max_dot_over_distance<1>(v, b, tolerance), 1.0);
        check(max_dot_over_distance<2>(v, b, tolerance), 2.0);
        check(max_dot_over_distance<3>(v, b, tolerance), 3.0);
    }
}

TEST(MaxDotOverDistance, OneStepIsMostlyTight) {
    Draw draw(3);
    std::vector<double> ratios;
    for (int i = 0; i < 20000; ++i) {
        const OffsetBox b = configurations::make(Shape::ordinary, draw, 2.0).box();
        const glm::dvec3 v = draw.direction();
        const double exact = max_dot_over_distance<3>(v, b, 1e-12).value;
        if (min_distance2(b) == 0.0 || exact == 0.0) continue;
        ratios.push_back(max_dot_over_distance<3>(v, b, 0.1, 0).value / exact);
    }
    std::sort(ratios.begin(), ratios.end());
    EXPECT_LT(ratios[ratios.size() / 2], 1.02);
    EXPECT_LT(ratios[ratios.size() * 9 / 10], 1.5);
}

TEST(MaxDotOverDistance, ZerosAreExact) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    const Box plane{{-1.0f, 0.3f, -1.0f}, {1.0f, 0.3f, 1.0f}};
    const Box below{{-1.0f, -2.0f, -1.0f}, {1.0f, -1.0f, 1.0f}};
    for (const Box& lights : {plane, below}) {
        for (const glm::vec3 x : {glm::vec3(0.2f, 0.3f, 0.1f), glm::vec3(4.0f, 0.3f, 0.1f)}) {
            const OffsetBox b = offsets(lights, x);
            EXPECT_EQ(max_dot_over_distance<1>(up, b).value, 0.0);
            EXPECT_EQ(max_dot_over_distance<2>(up, b).value, 0.0);
            EXPECT_EQ(max_dot_over_distance<3>(up, b).value, 0.0);
            EXPECT_EQ(clamped_max_cosine(up, b), 0.0);
            EXPECT_LE(max_cosine(up, b), 0.0);
            EXPECT_TRUE(is_behind(up, b));
        }
    }
    // All lights at the receiver.
    const OffsetBox nothing = offsets(box_of({1.0f, 2.0f, 3.0f}), {1.0f, 2.0f, 3.0f});
    EXPECT_EQ(max_dot_over_distance<3>(up, nothing).value, 0.0);
    EXPECT_EQ(max_cosine(up, nothing), 0.0);
    EXPECT_EQ(min_cosine(up, nothing), 0.0);
}

TEST(MaxDotOverDistance, IsInfiniteAroundTheReceiver) {
    Draw draw(5);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 1000; ++i) {
        const OffsetBox b = configurations::make(Shape::containing, draw).box();
        const glm::dvec3 v = draw.direction();
        EXPECT_EQ(max_dot_over_distance<2>(v, b).value, infinity);
        EXPECT_EQ(max_dot_over_distance<3>(v, b).value, infinity);
        EXPECT_NEAR(max_dot_over_distance<1>(v, b).value, 1.0, 1e-15);
        EXPECT_EQ(clamped_max_cosine(v * 1.0000001, b), 1.0);
    }
}

TEST(MaxDotOverDistance, ScalesAsAPowerOfTheDistance) {
    Draw draw(6);
    for (int i = 0; i < 5000; ++i) {
        const OffsetBox b = configurations::make(Shape::ordinary, draw, 1.0).box();
        const glm::dvec3 v = draw.direction();
        for (const double scale : {1e-12, 1e12}) {
            const OffsetBox scaled{b.lo * scale, b.hi * scale};
            const double at_one = max_dot_over_distance<3>(v, b, 1e-12).value;
            const double elsewhere = max_dot_over_distance<3>(v, scaled, 1e-12).value * scale * scale;
            if (at_one == elsewhere) continue;  // both may be infinite
            ASSERT_NEAR(elsewhere, at_one, 1e-9 * at_one);
        }
    }
}

TEST(MaxDotOverDistance, ALightTooCloseIsFinite) {
    const OffsetBox b = offsets(box_of({1e-20f, 0.0f, 0.0f}), glm::vec3(0.0f));
    const double bound = max_dot_over_distance<3>({1.0, 0.0, 0.0}, b).value;
    EXPECT_TRUE(std::isfinite(bound));
    EXPECT_NEAR(bound * 1e-40, 1.0, 1e-5);
}

TEST(MaxCosine, BoundsTheSignedCosine) {
    Draw draw(7);
    for (int i = 0; i < 500000; ++i) {
        const Configuration c = configurations::make(draw);
        const OffsetBox b = c.box();
        const glm::dvec3 v = configurations::hard_direction(b, draw);
        const double tolerance = draw.chance(0.5) ? 1e-3 : 1e-12;
        const double largest = max_cosine(v, b, tolerance);
        const double least = min_cosine(v, b, tolerance);
        ASSERT_LE(largest, 1.0);
        ASSERT_GE(least, -1.0);
        ASSERT_EQ(std::max(0.0, largest), clamped_max_cosine(v, b, tolerance));
        // The length of v, which differs from 1 by its rounding, belongs to the cosine.
        const long double length = std::sqrt(dot(Exact(v), Exact(v)));
        for (int s = 0; s < 8; ++s) {
            const Exact p = s < 6 ? Exact(configurations::light_in(c.lights, draw), c.receiver)
                                  : Exact(configurations::likely_maximum(v, b, draw));
            const long double p2 = dot(p, p);
            if (p2 == 0.0L) continue;
            const long double cosine = dot(Exact(v), p) / (length * std::sqrt(p2));
            ASSERT_GE(static_cast<long double>(largest), cosine - 4e-16L * std::fabs(cosine))
                << "shape " << static_cast<int>(c.shape) << " draw " << i;
            ASSERT_LE(static_cast<long double>(least), cosine + 4e-16L * std::fabs(cosine))
                << "shape " << static_cast<int>(c.shape) << " draw " << i;
        }
    }
}

TEST(MaxCosine, IsTightOnBothSidesOfTheHorizon) {
    Draw draw(8);
    for (int i = 0; i < 50000; ++i) {
        const OffsetBox b = configurations::make(Shape::ordinary, draw).box();
        if (min_distance2(b) == 0.0) continue;
        const glm::dvec3 v = configurations::hard_direction(b, draw);
        const double largest = max_cosine(v, b, 1e-12);
        // The maximum is on the path of projections, or, behind, at a vertex.
        double found = -1.0;
        const auto visit = [&](const glm::dvec3& p) { found = std::max(found, glm::dot(v, p) / glm::length(p)); };
        visit(max_dot_over_distance<1>(v, b, 1e-12).at);
        for (int corner = 0; corner < 8; ++corner) {
            visit({(corner & 1) != 0 ? b.hi.x : b.lo.x, (corner & 2) != 0 ? b.hi.y : b.lo.y,
                   (corner & 4) != 0 ? b.hi.z : b.lo.z});
        }
        ASSERT_NEAR(largest, found, 1e-11);
    }
}

/// The box of -p.
OffsetBox opposite(const Box& directions) {
    return negated(OffsetBox{glm::dvec3(directions.lo), glm::dvec3(directions.hi)});
}

TEST(MaxCosine, OfDirectionsUsesTheirLength) {
    Draw draw(9);
    double sum_plain = 0.0;
    double sum_better = 0.0;
    for (int i = 0; i < 50000; ++i) {
        const glm::dvec3 middle = draw.direction();
        const double spread = draw.chance(0.3) ? 0.0 : draw.uniform(0.0, 1.0);
        std::vector<glm::vec3> travels;
        Box box;
        for (int j = 0; j < 6; ++j) {
            travels.push_back(glm::vec3(glm::normalize(middle + draw.in_cube(spread))));
            box = merge(box, box_of(travels.back()));
        }
        const OffsetBox b = opposite(box);
        const glm::dvec3 v = draw.direction();
        const double bound = clamped_max_cosine_of_directions(v, b);
        for (const glm::vec3& d : travels) {
            const Exact p(-glm::dvec3(d));
            ASSERT_GE(static_cast<long double>(bound), std::min(1.0L, dot(Exact(v), p)) - 1e-15L);
            ASSERT_GE(static_cast<long double>(bound), dot(Exact(v), p) / std::sqrt(dot(p, p)) - 1e-15L);
        }
        sum_better += bound;
        sum_plain += clamped_max_cosine(v, b);
    }
    EXPECT_LT(sum_better, sum_plain);
    const OffsetBox side = opposite(box_of({1.0f, 0.0f, 0.0f}));
    EXPECT_EQ(clamped_max_cosine_of_directions({0.0, 1.0, 0.0}, side), 0.0);
}

}  // namespace
