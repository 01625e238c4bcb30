#include <lightcuts/core/cosine.hpp>
#include <lightcuts/core/joint.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "configurations.hpp"

/// Boxes whose farthest point is up to 1e30 times as far as their nearest: sums of squares lose the near coordinates.
namespace {

using namespace lightcuts;
using configurations::Draw;
using configurations::Exact;

/// A box whose coordinates, and whose distances from zero, have sizes that are up to `range` apart.
OffsetBox wide_box(Draw& draw, double range) {
    const double unit = std::pow(10.0, draw.uniform(-30.0, 34.0 - std::log10(range)));
    glm::dvec3 lo, hi;
    for (int i = 0; i < 3; ++i) {
        const auto size = [&] { return unit * (draw.chance(0.2) ? 1.0 : std::pow(range, draw.unit())); };
        const auto end = [&] {
            const int kind = draw.below(5);
            return kind == 0 ? 0.0 : kind == 1 ? unit : kind == 2 ? unit * range : size();
        };
        const double a = draw.chance(0.5) ? end() : -end();
        const double b = draw.chance(0.2) ? a : draw.chance(0.5) ? end() : -end();
        lo[i] = static_cast<double>(static_cast<float>(std::min(a, b)));
        hi[i] = static_cast<double>(static_cast<float>(std::max(a, b)));
    }
    return {lo, hi};
}

/// A unit vector whose coordinates may be of very different sizes.
glm::dvec3 wide_direction(const OffsetBox& b, Draw& draw, double range) {
    if (draw.chance(0.4)) return configurations::hard_direction(b, draw);
    glm::dvec3 v = draw.direction();
    for (int i = 0; i < 3; ++i) v[i] *= std::pow(range, -draw.unit() * draw.below(2));
    return glm::normalize(v);
}

using Point = std::array<long double, 3>;

long double term(const glm::dvec3& v, const Point& p, int k) {
    const long double along = v.x * p[0] + v.y * p[1] + v.z * p[2];
    const long double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    if (!(length > 0.0L)) return k == 0 ? -2.0L : 0.0L;
    switch (k) {
        case 1: return along / length;
        case 2: return along / length / length;
        default: return along / length / length / length;
    }
}

/// The largest (v.p) / |p|^k over the box, as of points that lie in it. Where it is positive it is on the path of the
/// projections of s v: at a breakpoint, where a coordinate meets a side, or between two, where a quadratic equation
/// says; the path, and the vertices, are sampled too.
long double largest_term(const glm::dvec3& v, const OffsetBox& b, int k, Draw& draw) {
    long double best = -std::numeric_limits<long double>::infinity();
    const auto clamped = [](long double x, long double lo, long double hi) { return x < lo ? lo : x > hi ? hi : x; };
    const auto at = [&](long double s) {
        return Point{clamped(s * v.x, b.lo.x, b.hi.x), clamped(s * v.y, b.lo.y, b.hi.y),
                     clamped(s * v.z, b.lo.z, b.hi.z)};
    };
    const auto visit = [&](const Point& p) {
        if (p[0] != 0.0L || p[1] != 0.0L || p[2] != 0.0L) best = std::max(best, term(v, p, k));
    };
    std::vector<long double> breaks{0.0L};
    for (int i = 0; i < 3; ++i) {
        for (const double side : {b.lo[i], b.hi[i]}) {
            const long double s = static_cast<long double>(side) / v[i];
            if (s > 0.0L && std::isfinite(s)) breaks.push_back(s);
        }
    }
    std::sort(breaks.begin(), breaks.end());
    breaks.push_back(4.0L * breaks.back() + 1.0L);
    for (std::size_t j = 0; j + 1 < breaks.size(); ++j) {
        const long double from = breaks[j], to = breaks[j + 1], middle = 0.5L * (from + to);
        long double c = 0, m = 0, a = 0;
        for (int i = 0; i < 3; ++i) {
            const long double vi = v[i], wanted = middle * vi, q = clamped(wanted, b.lo[i], b.hi[i]);
            if (q == wanted) {
                a += vi * vi;
            } else {
                c += q * q;
                m += vi * q;
            }
        }
        visit(at(from));
        visit(at(to));
        const long double root = k == 1 ? c / m
                                        : 2.0L * c / (k * m + std::sqrt(k * k * m * m + 4.0L * (k - 1) * a * c));
        if (root > from && root < to) visit(at(root));
        for (int n = 0; n < 4; ++n) {
            const long double least = std::max(from, 1e-3L * to);
            visit(at(least * std::pow(to / least, static_cast<long double>(draw.unit()))));
        }
    }
    for (int corner = 0; corner < 8; ++corner) {
        visit({(corner & 1) != 0 ? b.hi.x : b.lo.x, (corner & 2) != 0 ? b.hi.y : b.lo.y,
               (corner & 4) != 0 ? b.hi.z : b.lo.z});
    }
    return best;
}

double range_of(Draw& draw) { return std::pow(10.0, draw.uniform(0.0, 30.0)); }

TEST(ExtremeRange, MaxPowerBoundsTheLargestTerm) {
    Draw draw(1);
    int finite = 0;
    for (int i = 0; i < 100000; ++i) {
        const double range = range_of(draw);
        const OffsetBox b = wide_box(draw, range);
        const glm::dvec3 v = wide_direction(b, draw, range);
        const double tolerance = draw.chance(0.5) ? 1e-3 : std::pow(10.0, -draw.below(17));
        const int iterations = draw.chance(0.5) ? 60 : draw.below(6);
        const std::array bounds{max_dot_over_distance<1>(v, b, tolerance, iterations).value,
                                max_dot_over_distance<2>(v, b, tolerance, iterations).value,
                                max_dot_over_distance<3>(v, b, tolerance, iterations).value};
        for (int k = 1; k <= 3; ++k) {
            const double bound = bounds[static_cast<std::size_t>(k - 1)];
            finite += std::isfinite(bound);
            ASSERT_GE(static_cast<long double>(bound), largest_term(v, b, k, draw)) << "k " << k << " draw " << i;
        }
    }
    EXPECT_GT(finite, 150000);
}

// But for a few, whose iteration is cut short: its start is 1e30 times too small.
TEST(ExtremeRange, MaxPowerIsAttained) {
    Draw draw(2);
    int checked = 0, loose = 0;
    for (int i = 0; i < 100000; ++i) {
        const double range = range_of(draw);
        const OffsetBox b = wide_box(draw, range);
        const double d2 = min_distance2(b);
        if (d2 == 0.0) continue;
        const glm::dvec3 v = wide_direction(b, draw, range);
        const auto check = [&](double bound, int k) {
            // Beside the tolerance, what the rounding of v.p may be at the nearest point.
            const long double noise = 1e-14L / std::pow(static_cast<long double>(d2), 0.5L * (k - 1));
            loose += static_cast<long double>(bound) > std::max(largest_term(v, b, k, draw), 0.0L) * 1.0011L + noise;
            ++checked;
        };
        check(max_dot_over_distance<1>(v, b).value, 1);
        check(max_dot_over_distance<2>(v, b).value, 2);
        check(max_dot_over_distance<3>(v, b).value, 3);
    }
    EXPECT_GT(checked, 100000);
    EXPECT_LT(loose, checked / 10000);
}

TEST(ExtremeRange, MaxCosineBoundsTheSignedCosine) {
    Draw draw(3);
    int behind = 0;
    for (int i = 0; i < 100000; ++i) {
        const double range = range_of(draw);
        const OffsetBox b = wide_box(draw, range);
        const glm::dvec3 v = wide_direction(b, draw, range);
        const long double length = std::sqrt(dot(Exact(v), Exact(v)));
        const long double cosine = largest_term(v, b, 1, draw) / length;
        const double bound = max_cosine(v, b);
        behind += bound < 0.0;
        ASSERT_GE(static_cast<long double>(bound), cosine - 4e-16L * std::fabs(cosine)) << "draw " << i;
    }
    EXPECT_GT(behind, 3000);
}

TEST(ExtremeRange, JointBoundHoldsForBothCosines) {
    Draw draw(4);
    for (int i = 0; i < 200000; ++i) {
        const double range = range_of(draw);
        const OffsetBox b = wide_box(draw, range);
        const glm::dvec3 n = wide_direction(b, draw, range), u = wide_direction(b, draw, range);
        const double bound = joint_bound(n, u, b, {1 + draw.below(4), draw.chance(0.5) ? 2e-3 : 1e-9, 0.0});
        for (int j = 0; j < 8; ++j) {
            const double lambda = std::pow(range, draw.uniform(-1.0, 1.0) * draw.below(2));
            const glm::dvec3 p = j < 4 ? configurations::likely_maximum(n * lambda + u / lambda, b, draw)
                                       : glm::dvec3((j & 1) != 0 ? b.hi.x : b.lo.x, draw.chance(0.5) ? b.hi.y : b.lo.y,
                                                    (j & 2) != 0 ? b.hi.z : b.lo.z);
            const Point point{p.x, p.y, p.z};
            if (dot(Exact(p), Exact(p)) == 0.0L) continue;
            const long double value = std::max(term(n, point, 2), 0.0L) * std::max(term(u, point, 2), 0.0L);
            ASSERT_GE(static_cast<long double>(bound), value) << "draw " << i;
        }
    }
}

}  // namespace
