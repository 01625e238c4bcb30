// The equation that an automatic threshold solves, and what clamping takes from those who do not use it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/light/clampable.hpp>
#include <lightcuts/light/oriented.hpp>
#include "support/random.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

// Kinds are clamped by their mark alone, and forests without such kinds carry nothing.
static_assert(!ClampableLight<OrientedPointLight<>> && ClampableLight<VirtualPointLight<>>);
static_assert(OrientedLight<VirtualPointLight<>> && sizeof(VirtualPointLight<>) == sizeof(OrientedPointLight<>));
static_assert(sizeof(LightCluster<VirtualPointLight<>>) == sizeof(LightCluster<OrientedPointLight<>>));
static_assert(!LightForest<OrientedPointLight<>>::clamps &&
              LightForest<OrientedPointLight<>, VirtualPointLight<>>::clamps);
static_assert(sizeof(CutNode<V>) == 60 && sizeof(CutNode<V, true>) == 64);
static_assert(sizeof(detail::RunningTotal<V>) == 4 * sizeof(detail::RunningTotal<V>::Sums));
static_assert(std::is_same_v<scratch_of<LightTree<OrientedPointLight<>>>, LightcutScratch<V>>);
static_assert(std::is_same_v<scratch_of<LightTree<VirtualPointLight<>>>, LightcutScratch<V, true>>);

struct MarkedByTraits {
    V position{}, intensity{};
};
struct MarkedAsNot {
    V position{}, intensity{};
    static constexpr bool clampable = false;
};

}  // namespace
}  // namespace lightcuts::test

template <>
struct lightcuts::light_traits<lightcuts::test::MarkedByTraits> {
    static constexpr bool clampable = true;
};

namespace lightcuts::test {
namespace {

static_assert(ClampableLight<MarkedByTraits> && !ClampableLight<MarkedAsNot>);

struct Contribution {
    float raw;
    double lights;
};

constexpr double infinity = std::numeric_limits<double>::infinity();

double sum_under(double fixed, const std::vector<Contribution>& all, double threshold) {
    double sum = fixed;
    for (const Contribution& c : all) sum += std::min(static_cast<double>(c.raw), c.lights * threshold);
    return sum;
}

/// The threshold that is stated: a share of the total, but twice the mean of few lights; none where none arrives.
double stated_threshold(const ClampingOptions& clamp, const std::vector<Contribution>& all, double total,
                        double whole = 0.0) {
    double lights = 0.0;
    for (const Contribution& c : all) {
        if (c.raw > 0.0f && c.lights < infinity) lights += std::min(c.lights, static_cast<double>(c.raw) / whole);
    }
    const double ratio = std::max(static_cast<double>(clamp.ratio), 2.0 / lights);
    return std::min(ratio < infinity ? ratio * total : infinity, static_cast<double>(clamp.radiance));
}

/// `whole`: radiance of a light that counts as one. By default, each that arrives.
detail::ClampedTotal<float> solve(const ClampingOptions& clamp, double fixed, const std::vector<Contribution>& all,
                                  double guess = 0.0, double tolerance = 1e-9, double whole = 0.0) {
    const auto visit = [&](auto&& f) {
        for (const Contribution& c : all) f(c.raw, c.lights);
    };
    return detail::clamped_total<float>(clamp, detail::effective_ratios<float>(clamp, {1.0 / whole}, visit), {fixed},
                                        {guess}, tolerance, visit);
}

// k spikes among n lights of 1 beside a fixed D: total = D + n - k + k ratio total.
TEST(ClampedTotal, WithSpikesIsTheClosedForm) {
    const auto stated = static_cast<double>(automatic_clamping.ratio);
    for (const int n : {3, 4, 10, 99, 199, 200, 201, 1000}) {
        for (const int k : {1, 2, n / 3}) {
            for (const double fixed : {0.0, 2.0}) {
                const double ratio = std::max(stated, 2.0 / n);
                const double total = (fixed + n - k) / (1.0 - k * ratio);
                if (2 * k >= n || 1.0 - k * stated <= 0.0) continue;  // so many are no spikes
                std::vector<Contribution> all(static_cast<std::size_t>(n - k), {1.0f, 1.0});
                const std::vector<Contribution> dark(50, {0.0f, 1.0});
                all.insert(all.end(), dark.begin(), dark.end());
                all.push_back({0.0f, infinity});
                std::vector<Contribution> cluster = all;
                all.insert(all.end(), static_cast<std::size_t>(k), {1e6f, 1.0});
                const auto solved = solve(automatic_clamping, fixed, all);
                EXPECT_NEAR(solved.total[0], total, 1e-6 * total) << n << " " << k;
                EXPECT_NEAR(solved.threshold[0], ratio * total, 1e-6 * ratio * total) << n << " " << k;
                // A cluster of k is k lights.
                cluster.push_back({1e6f * static_cast<float>(k), static_cast<double>(k)});
                EXPECT_NEAR(solve(automatic_clamping, fixed, cluster).total[0], total, 1e-6 * total) << n << " " << k;
            }
        }
    }
}

// Lights that are alike are no spikes, however few.
TEST(ClampedTotal, OfEqualLightsIsTheirSum) {
    for (int n = 0; n <= 300; ++n) {
        for (const double fixed : {0.0, 2.0, 1e9}) {
            std::vector<Contribution> all(static_cast<std::size_t>(n), {3.0f, 1.0});
            all.resize(400, {0.0f, 1.0});
            const auto solved = solve(automatic_clamping, fixed, all);
            EXPECT_DOUBLE_EQ(solved.total[0], fixed + 3.0 * n) << n;
            EXPECT_GE(solved.threshold[0], 6.0 - 1e-5) << n;
            if (n < 3) {
                EXPECT_GE(solved.threshold[0], solved.total[0]) << "of the least there is no spike";
                EXPECT_EQ(solved.threshold_at_receiver(automatic_clamping), std::numeric_limits<float>::infinity());
            }
        }
    }
}

// One light among few adds no more than some twice the mean of the others.
TEST(ClampedTotal, OfFewLightsHoldsASpike) {
    for (int n = 3; n < 200; ++n) {
        std::vector<Contribution> all(static_cast<std::size_t>(n - 1), {3.0f, 1.0});
        all.push_back({1e9f, 1.0});
        const auto solved = solve(automatic_clamping, 0.0, all);
        const double most = 2.0 * 3.0 * (n - 1) / (n - 2);
        EXPECT_NEAR(solved.threshold[0], most, 1e-5 * most) << n;
        EXPECT_NEAR(solved.total[0], 3.0 * (n - 1) + most, 1e-5 * solved.total[0]) << n;
    }
}

// From 2 / ratio lights on, the stated ratio, to the last bit.
TEST(ClampedTotal, OfManyLightsHasTheStatedRatio) {
    for (const auto& [ratio, enough] : {std::pair(0.01f, 200), {0.002f, 1000}, {0.1f, 20}, {0.003f, 667}}) {
        const ClampingOptions clamp{.ratio = ratio};
        EXPECT_GT(detail::effective_ratio(clamp, enough - 1), static_cast<double>(ratio));
        for (const int n : {enough, enough + 1, 3 * enough, 1 << 30}) {
            EXPECT_EQ(detail::effective_ratio(clamp, n), static_cast<double>(ratio)) << n;
        }
        std::vector<Contribution> all(static_cast<std::size_t>(enough), {1.0f, 1.0});
        EXPECT_EQ(solve(clamp, 0.0, all).ratio[0], static_cast<double>(ratio));
        all.back().raw = 0.0f;
        EXPECT_GT(solve(clamp, 0.0, all).ratio[0], static_cast<double>(ratio));
    }
}

// Brighter lights or larger limits never darken.
TEST(ClampedTotal, IncreasesWithContributionsAndLimits) {
    Random random(3);
    int grown = 0;
    for (int i = 0; i < 1000; ++i) {
        std::vector<Contribution> all(1 + random.below(random.chance(0.5) ? 10 : 300));
        for (auto& c : all) {
            c.raw = random.chance(0.2) ? 0.0f : static_cast<float>(random.decades(-3.0, 3.0));
            c.lights = random.chance(0.1) ? infinity : static_cast<double>(1 + random.below(5));
        }
        const ClampingOptions clamp{.radiance = random.chance(0.5) ? std::numeric_limits<float>::infinity()
                                                                   : static_cast<float>(random.decades(-3.0, 3.0)),
                                    .ratio = static_cast<float>(random.decades(-3.0, -0.5))};
        const double total = solve(clamp, 0.0, all).total[0];
        ClampingOptions larger = clamp;
        larger.ratio *= random.real(1.0, 3.0);
        larger.radiance *= random.real(1.0, 3.0);
        EXPECT_GE(solve(larger, 0.0, all).total[0], total * (1.0 - 1e-7));
        std::vector<Contribution> brighter = all;
        for (auto& c : brighter) c.raw *= random.chance(0.2) ? random.real(1.0, 10.0) : 1.0f;
        const double more = solve(clamp, 0.0, brighter).total[0];
        EXPECT_GE(more, total * (1.0 - 1e-7));
        if (more > 1.01 * total) ++grown;
    }
    EXPECT_GT(grown, 200);
}

TEST(ClampedTotal, SolvesItsEquationFromAnyGuess) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        std::vector<Contribution> all(1 + random.below(random.chance(0.5) ? 20 : 400));
        for (auto& c : all) {
            c.raw = random.chance(0.2) ? 0.0f : static_cast<float>(random.decades(-6.0, 6.0));
            c.lights = random.chance(0.1) ? infinity : static_cast<double>(1 + random.below(20));
        }
        const double fixed = random.chance(0.3) ? 0.0 : random.decades(-3.0, 3.0);
        const ClampingOptions clamp{.radiance = random.chance(0.5) ? std::numeric_limits<float>::infinity()
                                                                   : static_cast<float>(random.decades(-3.0, 3.0)),
                                    .ratio = static_cast<float>(random.decades(-4.0, -0.5))};
        const double whole = random.chance(0.3) ? 0.0 : random.decades(-8.0, 4.0);
        const auto solved = solve(clamp, fixed, all, 0.0, 1e-9, whole);
        const double total = solved.total[0];
        const double expected = stated_threshold(clamp, all, total, whole);
        if (expected < infinity) {
            EXPECT_NEAR(solved.threshold[0], expected, 2e-7 * expected);
        } else {
            EXPECT_EQ(solved.threshold[0], infinity);
        }
        EXPECT_NEAR(total, sum_under(fixed, all, expected), 2e-7 * total);
        EXPECT_TRUE(total > 0.0 || sum_under(fixed, all, infinity) == 0.0) << "light is not clamped to nothing";
        // The largest root: beyond it the sum is below the total.
        const double beyond = 1.001 * total + 1e-9;
        EXPECT_LT(sum_under(fixed, all, stated_threshold(clamp, all, beyond, whole)), beyond);
        for (const double guess : {1e-9, 0.3 * total, 0.999 * total, total, 1.5 * total, 1e12}) {
            EXPECT_NEAR(solve(clamp, fixed, all, guess, 1e-9, whole).total[0], total, 1e-6 * total) << guess;
        }
    }
}

// Half of the lights at the threshold, the others next to nothing: every smaller total is nearly a solution too.
TEST(ClampedTotal, IsTheLargestOfWhatSolvesTheEquation) {
    for (const int n : {8, 16, 64, 128}) {
        std::vector<Contribution> all(static_cast<std::size_t>(n / 2), {1.0f, 1.0});
        all.resize(static_cast<std::size_t>(n), {1e-9f, 1.0});
        for (const double guess : {0.0, 0.03 * n, 0.3 * n, 0.5 * n, 1e9}) {
            EXPECT_NEAR(solve(automatic_clamping, 0.0, all, guess, 1e-2).total[0], 0.5 * n, 1e-5 * n) << guess;
        }
    }
}

/// A node of a cut and what it stands for.
struct Node {
    float estimate, bound;
    double lights;
    std::vector<float> truth;
};

/// Of a single light, or a cluster whose lights add no more than its bound, and whose representative shows whether it
/// arrives. `crowded`: all of its lights arrive.
Node random_node(Random& random, double exact, bool full, bool crowded) {
    const bool marked = random.chance(0.8), single = random.chance(exact);
    const std::size_t count = single ? 1 : 2 + random.below(9);
    const auto size = static_cast<float>(random.decades(-3.0, 2.0));
    Node n{0.0f, size, marked ? static_cast<double>(count) : infinity, std::vector<float>(count)};
    n.estimate = full ? size : random.chance(0.2) ? 0.0f : size * random.real(0.0, 1.0);
    if (single) {
        n.truth[0] = n.estimate;
        n.bound = 0.0f;
        return n;
    }
    // All from one light, from some, or next to nothing from each.
    const float share = random.chance(0.3) ? 1e-6f : random.chance(0.5) ? 0.999f : random.real(0.0, 0.999);
    for (float& light : n.truth) {
        light = random.chance(0.3) ? 0.0f : share * size / static_cast<float>(count);
        if (crowded) light = 1e-6f * size;
    }
    if (random.chance(0.3) && !crowded) {
        n.truth.assign(count, 0.0f);
        n.truth[0] = size;
    }
    if (n.estimate > 0.0f && n.truth[0] == 0.0f) n.truth[0] = 1e-9f * size;
    return n;
}

// Whatever lies between nothing and a bound in place of each estimate, and however many lights of a cluster arrive, the
// totals differ by no more than is said.
TEST(ClampedError, BoundsTheDifferenceOfTotalsWithThresholdsOfTheirOwn) {
    Random random(2);
    int tight = 0, tight_of_few = 0;
    for (int i = 0; i < 6000; ++i) {
        const bool few = random.chance(0.5), full = random.chance(0.3), crowded = random.chance(0.2);
        const double exact = random.chance(0.2) ? 0.95 : random.real(0.0, 1.0);
        std::vector<Node> nodes;
        for (std::size_t n = 1 + random.below(few ? 12 : 200); n > 0; --n) {
            nodes.push_back(random_node(random, exact, full, crowded));
        }
        const ClampingOptions clamp{.radiance = random.chance(0.7) ? std::numeric_limits<float>::infinity()
                                                                   : static_cast<float>(random.decades(-2.0, 1.0)),
                                    .ratio = static_cast<float>(random.decades(-3.0, -1.0))};
        std::vector<Contribution> estimates, lights;
        for (const Node& n : nodes) {
            estimates.push_back({n.estimate, n.lights});
            for (const float light : n.truth) lights.push_back({light, n.lights < infinity ? 1.0 : infinity});
        }
        const double whole = random.chance(0.3) ? 0.0 : random.decades(-8.0, 1.0);
        const auto cut = solve(clamp, 0.0, estimates, 0.0, 1e-9, whole);
        const auto sum = solve(clamp, 0.0, lights, 0.0, 1e-9, whole);
        const detail::LightCount<float> none(clamp, {1.0 / whole});
        detail::ArrivingLights<float> arriving{none, none};
        for (const Node& n : nodes) {
            if (n.lights == infinity) continue;
            // Of a cluster its representative is known, the first of those that arrive.
            arriving.least.add(n.estimate > 0.0f ? n.truth[0] : 0.0f, 1.0);
            arriving.most.add(n.bound > 0.0f ? n.bound : n.estimate, n.lights);
        }
        const double truth = sum.total[0];
        const double error = detail::clamped_error<float>(clamp, cut, arriving, 0.0, [&](auto&& f) {
            for (const Node& n : nodes) f(n.estimate, n.bound, n.lights);
        })[0];
        EXPECT_LE(std::fabs(truth - cut.total[0]), error + 1e-6 * (truth + cut.total[0])) << i;
        if (error < cut.total[0]) ++(few ? tight_of_few : tight);
    }
    EXPECT_GT(tight, 500) << "it says something";
    EXPECT_GT(tight_of_few, 500);
}

}  // namespace
}  // namespace lightcuts::test
