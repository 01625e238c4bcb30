// The equation that an automatic threshold solves, and what clamping takes from those who do not use it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/light/clamped.hpp>
#include <lightcuts/light/oriented.hpp>
#include "support/random.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

// Kinds are clamped by their mark alone, and forests without such kinds carry nothing.
static_assert(!ClampedLight<OrientedPointLight<>> && ClampedLight<VirtualLight<>>);
static_assert(OrientedLight<VirtualLight<>> && sizeof(VirtualLight<>) == sizeof(OrientedPointLight<>));
static_assert(sizeof(LightCluster<VirtualLight<>>) == sizeof(LightCluster<OrientedPointLight<>>));
static_assert(!LightForest<OrientedPointLight<>>::clamps && LightForest<OrientedPointLight<>, VirtualLight<>>::clamps);
static_assert(sizeof(CutNode<V>) == 60 && sizeof(CutNode<V, true>) == 64);
static_assert(sizeof(CutTotals<V>) == 4 * sizeof(CutTotals<V>::Sums) + sizeof(double));
static_assert(std::is_same_v<scratch_of<LightTree<OrientedPointLight<>>>, LightcutScratch<V>>);
static_assert(std::is_same_v<scratch_of<LightTree<VirtualLight<>>>, LightcutScratch<V, true>>);

struct MarkedByTraits {
    V position{}, intensity{};
};
struct MarkedAsNot {
    V position{}, intensity{};
    static constexpr bool clamped = false;
};

}  // namespace
}  // namespace lightcuts::test

template <>
struct lightcuts::light_traits<lightcuts::test::MarkedByTraits> {
    static constexpr bool clamped = true;
};

namespace lightcuts::test {
namespace {

static_assert(ClampedLight<MarkedByTraits> && !ClampedLight<MarkedAsNot>);

struct Contribution {
    float raw;
    double lights;
};

double sum_under(double fixed, const std::vector<Contribution>& all, double threshold) {
    double sum = fixed;
    for (const Contribution& c : all) sum += std::min(static_cast<double>(c.raw), c.lights * threshold);
    return sum;
}

detail::ClampedTotal<float> solve(const ClampOptions& clamp, double fixed, const std::vector<Contribution>& all,
                                  double guess = 0.0, double tolerance = 1e-9) {
    return detail::clamped_total<float>(clamp, {fixed}, {guess}, tolerance, [&](auto&& f) {
        for (const Contribution& c : all) f(c.raw, c.lights);
    });
}

// n equal lights above the threshold beside a fixed D: total = D + n r total.
TEST(ClampedTotal, OfEqualLightsIsTheClosedForm) {
    const double ratio = static_cast<double>(automatic_clamping.ratio);
    for (const int n : {1, 10, 99}) {
        const std::vector<Contribution> all(static_cast<std::size_t>(n), {1e6f, 1.0});
        const auto solved = solve(automatic_clamping, 2.0, all);
        EXPECT_NEAR(solved.total[0], 2.0 / (1.0 - ratio * n), 1e-6 * solved.total[0]) << n;
        EXPECT_NEAR(solved.threshold[0], ratio * solved.total[0], 1e-8 * solved.total[0]) << n;
    }
    // A cluster of n is n lights.
    EXPECT_NEAR(solve(automatic_clamping, 2.0, {{1e6f, 50.0}}).total[0], 4.0, 1e-6);
    // So many that none gives more than its share.
    const std::vector<Contribution> many(1000, {3.0f, 1.0});
    EXPECT_DOUBLE_EQ(solve(automatic_clamping, 0.0, many).total[0], 3000.0);
    // So few that all would give more than theirs of any total.
    const std::vector<Contribution> few(50, {3.0f, 1.0});
    EXPECT_EQ(solve(automatic_clamping, 0.0, few).total[0], 0.0);
    EXPECT_EQ(solve(automatic_clamping, 0.0, {}).total[0], 0.0);
}

TEST(ClampedTotal, SolvesItsEquationFromAnyGuess) {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        std::vector<Contribution> all(1 + random.below(400));
        for (auto& c : all) {
            c.raw = random.chance(0.2) ? 0.0f : static_cast<float>(random.decades(-6.0, 6.0));
            c.lights = random.chance(0.1) ? std::numeric_limits<double>::infinity()
                                          : static_cast<double>(1 + random.below(20));
        }
        const double fixed = random.chance(0.3) ? 0.0 : random.decades(-3.0, 3.0);
        const ClampOptions clamp{.radiance = random.chance(0.5) ? std::numeric_limits<float>::infinity()
                                                                : static_cast<float>(random.decades(-3.0, 3.0)),
                                 .ratio = static_cast<float>(random.decades(-4.0, -0.5))};
        const auto solved = solve(clamp, fixed, all);
        const double total = solved.total[0];
        const double expected = std::min(static_cast<double>(clamp.ratio) * total, static_cast<double>(clamp.radiance));
        EXPECT_NEAR(solved.threshold[0], expected, 1e-7 * expected);
        EXPECT_NEAR(total, sum_under(fixed, all, expected), 1e-7 * total);
        // The largest root: beyond it the sum is below the total.
        const double beyond = 1.001 * total + 1e-9;
        EXPECT_LT(sum_under(fixed, all,
                            std::min(static_cast<double>(clamp.ratio) * beyond, static_cast<double>(clamp.radiance))),
                  beyond);
        for (const double guess : {1e-9, 0.3 * total, 0.999 * total, total, 1.5 * total, 1e12}) {
            EXPECT_NEAR(solve(clamp, fixed, all, guess).total[0], total, 1e-6 * total) << guess;
        }
    }
}

// Whatever lies between nothing and a bound in place of each estimate, the totals differ by no more than is said.
TEST(ClampedError, BoundsTheDifferenceOfTotalsWithThresholdsOfTheirOwn) {
    Random random(2);
    int tight = 0;
    for (int i = 0; i < 2000; ++i) {
        struct Node {
            float estimate, bound, truth;
            double lights;
        };
        std::vector<Node> nodes(1 + random.below(200));
        const double exact = random.real(0.0, 1.0);
        const bool full = random.chance(0.3);
        for (Node& n : nodes) {
            n.lights = random.chance(0.2) ? std::numeric_limits<double>::infinity()
                                          : static_cast<double>(1 + random.below(10));
            n.bound = static_cast<float>(random.decades(-3.0, 2.0));
            n.estimate = full ? n.bound : n.bound * random.real(0.0, 1.0);
            n.truth = random.chance(0.3) ? 0.0f : random.chance(0.4) ? n.bound : n.bound * random.real(0.0, 1.0);
            if (random.chance(exact)) {
                n.truth = n.estimate;
                n.bound = 0.0f;
            }
        }
        const ClampOptions clamp{.radiance = random.chance(0.7) ? std::numeric_limits<float>::infinity()
                                                                : static_cast<float>(random.decades(-2.0, 1.0)),
                                 .ratio = static_cast<float>(random.decades(-3.0, -1.0))};
        const auto total_of = [&](float Node::*value) {
            return detail::clamped_total<float>(clamp, {}, {}, 1e-9, [&](auto&& f) {
                for (const Node& n : nodes) f(n.*value, n.lights);
            });
        };
        const auto cut = total_of(&Node::estimate);
        const double truth = total_of(&Node::truth).total[0];
        const double error = detail::clamped_error<float>(clamp, cut, [&](auto&& f) {
            for (const Node& n : nodes) f(n.estimate, n.bound, n.lights);
        })[0];
        EXPECT_LE(std::fabs(truth - cut.total[0]), error + 1e-6 * (truth + cut.total[0])) << i;
        if (error < cut.total[0]) ++tight;
    }
    EXPECT_GT(tight, 200) << "it says something";
}

}  // namespace
}  // namespace lightcuts::test
