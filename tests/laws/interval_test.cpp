// Interval arithmetic as an oracle that shares nothing with the bounds: branch and bound proves that they hold on
// every point of a box, not only on samples.

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <CGAL/Interval_nt.h>
#include <gtest/gtest.h>

#include <lightcuts/core/cosine.hpp>
#include <lightcuts/core/joint.hpp>

#include "../core/configurations.hpp"

namespace {

using Interval = CGAL::Interval_nt<true>;
using Intervals = std::array<Interval, 3>;
using lightcuts::OffsetBox;

enum class Verdict { proved, refuted, undecided };

Intervals intervals_of(const OffsetBox& b) {
    return {Interval(b.lo.x, b.hi.x), Interval(b.lo.y, b.hi.y), Interval(b.lo.z, b.hi.z)};
}

Interval dot(const glm::dvec3& v, const Intervals& p) {
    return Interval(v.x) * p[0] + Interval(v.y) * p[1] + Interval(v.z) * p[2];
}

Interval norm2(const Intervals& p) { return CGAL::square(p[0]) + CGAL::square(p[1]) + CGAL::square(p[2]); }

Interval positive(const Interval& x) { return Interval(std::max(0.0, x.inf()), std::max(0.0, x.sup())); }

/// Whether value(p) <= limit for every p of the box.
template <class Value>
Verdict prove(const Value& value, double limit, const OffsetBox& box) {
    std::vector<OffsetBox> open{box};
    for (int step = 0; !open.empty(); ++step) {
        if (step == 40000) return Verdict::undecided;
        const OffsetBox b = open.back();
        open.pop_back();
        const Interval range = value(intervals_of(b));
        if (range.sup() <= limit) continue;
        const glm::dvec3 middle = center(b);
        if (value(intervals_of({middle, middle})).inf() > limit) return Verdict::refuted;
        int longest = 0;
        const glm::dvec3 size = b.hi - b.lo;
        for (int i = 1; i < 3; ++i) longest = size[i] > size[longest] ? i : longest;
        OffsetBox left = b;
        OffsetBox right = b;
        left.hi[longest] = right.lo[longest] = 0.5 * (b.lo[longest] + b.hi[longest]);
        if (value(intervals_of(left)).sup() > value(intervals_of(right)).sup()) std::swap(left, right);
        open.push_back(left);
        open.push_back(right);
    }
    return Verdict::proved;
}

struct Tally {
    int proved = 0;
    int refuted = 0;
    int undecided = 0;

    void add(Verdict v) { ++(v == Verdict::proved ? proved : v == Verdict::refuted ? refuted : undecided); }
};

/// Boxes of all shapes that do not hold the receiver, in front of `v`.
template <class Check>
void for_some_boxes(std::uint64_t seed, int count, const Check& check) {
    configurations::Draw draw(seed);
    while (count > 0) {
        const OffsetBox b = configurations::make(draw, 1.2).box();
        const glm::dvec3 v = configurations::hard_direction(b, draw);
        if (lightcuts::min_distance2(b) == 0.0 || lightcuts::is_behind(v, b)) continue;
        check(v, b, draw);
        --count;
    }
}

constexpr double margin = 1.0 + 1e-2;

TEST(Intervals, ProveMaxPowerOnWholeBoxes) {
    Tally tally;
    for_some_boxes(1, 300, [&](const glm::dvec3& v, const OffsetBox& b, configurations::Draw& draw) {
        const int iterations = draw.below(3);
        const double p1 = lightcuts::max_dot_over_distance<1>(v, b, 1e-3, iterations).value * margin;
        const double p2 = lightcuts::max_dot_over_distance<2>(v, b, 1e-3, iterations).value * margin;
        const double p3 = lightcuts::max_dot_over_distance<3>(v, b, 1e-3, iterations).value * margin;
        const double scale = std::sqrt(lightcuts::max_distance2(b));  // near zeros, an absolute margin
        tally.add(prove([&](const Intervals& p) { return dot(v, p) / CGAL::sqrt(norm2(p)); }, p1 + 1e-9, b));
        tally.add(prove([&](const Intervals& p) { return dot(v, p) / norm2(p); }, p2 + 1e-9 / scale, b));
        tally.add(prove([&](const Intervals& p) { return dot(v, p) / (norm2(p) * CGAL::sqrt(norm2(p))); },
                        p3 + 1e-9 / (scale * scale), b));
    });
    EXPECT_EQ(tally.refuted, 0);
    EXPECT_GE(tally.proved, 880) << tally.undecided << " undecided";
}

TEST(Intervals, ProveTheJointBoundOnWholeBoxes) {
    Tally tally;
    for_some_boxes(2, 300, [&](const glm::dvec3& n, const OffsetBox& b, configurations::Draw& draw) {
        const glm::dvec3 u = draw.direction();
        const double scale2 = lightcuts::max_distance2(b);
        const double limit = lightcuts::joint_bound(n, u, b) * margin + 1e-9 / scale2;
        tally.add(prove(
            [&](const Intervals& p) { return positive(dot(n, p)) * positive(dot(u, p)) / CGAL::square(norm2(p)); },
            limit, b));
    });
    EXPECT_EQ(tally.refuted, 0);
    EXPECT_GE(tally.proved, 290) << tally.undecided << " undecided";
}

TEST(Intervals, RefuteALimitBelowTheMaximum) {
    Tally tally;
    for_some_boxes(3, 100, [&](const glm::dvec3& v, const OffsetBox& b, configurations::Draw&) {
        const lightcuts::AttainedBound bound = lightcuts::max_dot_over_distance<2>(v, b, 1e-6);
        if (bound.value * std::sqrt(lightcuts::max_distance2(b)) < 1e-3) return;  // rounding noise
        tally.add(prove([&](const Intervals& p) { return dot(v, p) / norm2(p); }, bound.value * 0.9, b));
    });
    EXPECT_EQ(tally.proved, 0);
    EXPECT_GE(tally.refuted, 70) << tally.undecided << " undecided";
}

}  // namespace
