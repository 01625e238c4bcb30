#include <lightcuts/product/gather.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include "product/gather_scene.hpp"

namespace lightcuts::test {
namespace {

constexpr ProductOptions exact{.cut = {.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0}};

void expect_near(const V& found, const glm::dvec3& truth, double tolerance) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<double>(found[c]), truth[c], tolerance * (truth[c] + 1e-30)) << c;
}

/// |found - truth| is at most the stated bound, and rounding.
template <class R>
void expect_within_bound(const R& result, const glm::dvec3& truth) {
    for (int c = 0; c < 3; ++c) {
        const double error = std::abs(static_cast<double>(result.radiance[c]) - truth[c]);
        EXPECT_LE(error, static_cast<double>(result.error_bound[c]) + 2e-5 * truth[c]) << c;
    }
}

TEST(Gather, RatioZeroIsTheSumOverAllPairs) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        Room<V> room(seed);
        const auto lights = room.oriented(60);
        const auto occluders = room.occluders();
        const ScalarOccluders oracle{occluders};
        const LightTree tree(lights);
        const auto points = diffuse_points(random, 1 + random.below(40), random.decades(-3, 0), random.between(0, 1.5));
        const auto result = gather(tree, points, oracle, exact);
        expect_near(result.radiance, sum_of_pairs(points, lights, oracle), 2e-5);
        EXPECT_EQ(result.error_bound, V(0.0f));
        EXPECT_EQ(result.stop, StopReason::converged);
    }
}

/// Whichever side is split, the sum is within its bound, and exact for a ratio of 0.
TEST(Gather, SidesMayBeChosenBySize) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        Room<V> room(seed);
        const auto lights = room.oriented(400);
        const auto occluders = room.occluders();
        const ScalarOccluders oracle{occluders};
        const LightTree tree(lights);
        const auto points = diffuse_points(random, 200, random.decades(-2, 0), random.between(0, 1.5));
        const glm::dvec3 truth = sum_of_pairs(points, lights, oracle);
        ProductOptions options{.cut = {.error_ratio = 0.02f, .max_cut = 0, .exhaustive_below = 0}};
        const std::uint32_t by_bounds = gather(tree, points, oracle, options).cut_size;
        options.side_rule = SideRule::sizes;
        const auto result = gather(tree, points, oracle, options);
        expect_within_bound(result, truth);
        EXPECT_NE(result.cut_size, by_bounds) << "other sides, another cut";
        options.cut.error_ratio = 0.0f;
        expect_near(gather(tree, points, oracle, options).radiance, truth, 2e-5);
    }
}

template <class Points, class Lights>
void expect_bounded(const Points& points, const Lights& lights, const Occluders& occluders, float ratio) {
    const ScalarOccluders oracle{occluders};
    const LightTree tree(lights);
    const glm::dvec3 truth = sum_of_pairs(points, lights, oracle);
    ProductOptions options{.cut = {.error_ratio = ratio, .max_cut = 0, .exhaustive_below = 0}};
    const auto result = gather(tree, points, oracle, options);
    expect_within_bound(result, truth);
    for (int c = 0; c < 3; ++c) EXPECT_LE(result.largest_bound[c], 1.0001f * ratio * result.radiance[c]);
    EXPECT_LE(result.queries, result.pairs);
}

TEST(Gather, ErrorIsAtMostItsBound) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        Room<V> room(seed);
        const auto occluders = room.occluders();
        const double spread = random.decades(-4, 0), turn = random.between(0, 2);
        const std::size_t n = 1 + random.below(60);
        const auto ratio = static_cast<float>(random.decades(-2, -0.3));
        expect_bounded(diffuse_points(random, n, spread, turn), room.oriented(200), occluders, ratio);
        expect_bounded(diffuse_points(random, n, spread, turn), room.omni(200), occluders, ratio);
        expect_bounded(diffuse_points(random, n, spread, turn), room.distant(100), occluders, ratio);
        expect_bounded(glossy_points(random, n, spread, turn), room.oriented(100), occluders, ratio);
        expect_bounded(glossy_points(random, n, spread, turn), room.spot(100), occluders, ratio);
    }
}

TEST(Gather, LightReachesOnlyItsInstant) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        Room<V> room(seed);
        const auto instants = static_cast<std::uint32_t>(1 + random.below(16));
        const auto lights = at_instants(room.oriented(120), instants);
        const auto occluders = room.occluders();
        const ScalarOccluders oracle{occluders};
        const LightTree tree(lights);
        const LightForest forest(tree);
        const TimedForest timed(forest, instants);
        const auto points = at_instants(diffuse_points(random, 1 + random.below(40), 0.3, 1.0), instants);
        const glm::dvec3 truth = sum_of_pairs(points, lights, oracle);
        expect_near(gather(timed, points, oracle, exact).radiance, truth, 2e-5);
        ProductOptions options = exact;
        options.cut.error_ratio = 0.1f;
        expect_within_bound(gather(timed, points, oracle, options), truth);
    }
}

/// In scalars: intensities of several channels that are not proportional bias a cluster's estimate.
struct ScalarScene {
    std::vector<OmniLight<float>> lights;
    std::vector<GatherPoint<Lambert<float>, float>> points;
    Occluders occluders;

    ScalarScene() {
        Random random(5);
        Room<float> room(5);
        lights = room.omni(60);
        occluders = room.occluders();
        for (const DiffusePoint& p : diffuse_points(random, 30, 0.3, 1.0)) {
            const Receiver<Lambert<V>>& r = p.receiver;
            points.push_back(
                {{r.position, Lambert<float>{r.material.normal, 1.0f}, r.shadow_origin, r.id}, p.strength.x});
        }
    }
};

/// The mean over seeds is within four standard deviations of `truth`, and these are small. `estimate(seed)`.
template <class Estimate>
void expect_mean(double truth, const Estimate& estimate) {
    double sum = 0, squares = 0;
    constexpr int seeds = 3000;
    for (int seed = 0; seed < seeds; ++seed) {
        const auto x = static_cast<double>(estimate(static_cast<std::uint64_t>(seed)));
        sum += x;
        squares += x * x;
    }
    const double mean = sum / seeds, deviation = std::sqrt((squares / seeds - mean * mean) / seeds);
    EXPECT_NEAR(mean, truth, 4 * deviation);
    EXPECT_LT(deviation, 0.02 * truth);
}

/// A cut of so many clusters whatever the estimate: its shape follows from bounds alone.
ProductOptions fixed_cut(std::uint64_t seed, bool redraw) {
    return {.cut = {.error_ratio = 1e-6f, .max_cut = 40, .exhaustive_below = 0, .seed = hash_keys(7, seed)},
            .redraw = redraw};
}

TEST(Gather, EstimateOfAFixedCutIsUnbiasedOverSeeds) {
    const ScalarScene scene;
    const ScalarOccluders oracle{scene.occluders};
    double truth = 0;
    for (const auto& p : scene.points) {
        for (const auto& l : scene.lights) {
            truth += static_cast<double>(unshadowed_transfer(p.receiver, l) * oracle(p.receiver, l) * p.strength *
                                         l.intensity);
        }
    }
    for (const bool redraw : {false, true}) {
        for (const unsigned several : {1u, 32u}) {
            expect_mean(truth, [&](std::uint64_t seed) {
                const LightTree tree(scene.lights, {.representatives = several, .seed = hash_keys(9, seed)});
                return gather(tree, scene.points, oracle, fixed_cut(seed, redraw)).radiance;
            });
        }
    }
}

TEST(Gather, EstimateOfAFixedCutOverInstantsIsUnbiasedOverSeeds) {
    const ScalarScene scene;
    const ScalarOccluders oracle{scene.occluders};
    std::vector<InstantLight<OmniLight<float>>> lights;
    for (const auto& l : scene.lights) lights.push_back({l, static_cast<std::uint32_t>(lights.size() % 4)});
    std::vector<InstantGatherPoint<Lambert<float>, float>> points;
    for (const auto& p : scene.points) points.push_back({p, static_cast<std::uint32_t>(points.size() % 4)});
    double truth = 0;
    for (const auto& p : points) {
        for (const auto& l : lights) {
            if (p.instant != l.instant) continue;
            truth += static_cast<double>(unshadowed_transfer(p.receiver, l) * oracle(p.receiver, l) * p.strength *
                                         l.intensity);
        }
    }
    const LightTree tree(lights);
    const LightForest forest(tree);
    const TimedForest timed(forest, 4);
    for (const bool redraw : {false, true}) {
        expect_mean(
            truth, [&](std::uint64_t seed) { return gather(timed, points, oracle, fixed_cut(seed, redraw)).radiance; });
    }
}

TEST(Gather, OfOnePointIsItsLightcut) {
    Random random(3);
    Room<V> room(3);
    const auto lights = room.oriented(500);
    const LightTree tree(lights);
    const auto occluders = room.occluders();
    const ScalarOccluders oracle{occluders};
    for (const DiffusePoint& p : diffuse_points(random, 30, 1.0, 3.0)) {
        if (channel_sum(p.strength) == 0.0) continue;
        const LightcutOptions options{.max_cut = 300};
        const auto cut = shade(tree, p.receiver, oracle, options);
        const auto result = gather(tree, std::vector{p}, oracle, ProductOptions{.cut = options});
        for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(result.radiance[c], cut.radiance[c] * p.strength[c]);
        EXPECT_EQ(result.cut_size, cut.cut_size);
        EXPECT_EQ(result.queries, cut.queries);
        EXPECT_EQ(result.pairs, 500.0);
    }
}

TEST(Gather, AdaptationOfOnePointIsThatOfTheSum) {
    Random random(3);
    Room<V> room(3);
    const auto lights = room.oriented(500);
    const LightTree tree(lights);
    for (const DiffusePoint& p : diffuse_points(random, 10, 1.0, 3.0)) {
        if (channel_sum(p.strength) == 0.0) continue;
        LightcutOptions options{.adaptation = 0.02f};
        const auto result = gather(tree, std::vector{p}, AlwaysVisible{}, ProductOptions{.cut = options});
        options.adaptation /= channel_max(p.strength);
        EXPECT_EQ(result.cut_size, shade(tree, p.receiver, AlwaysVisible{}, options).cut_size);
    }
}

TEST(Gather, VirtualLightsAreClampedByTransfer) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Random random(seed);
        Room<V> room(seed);
        std::vector<VirtualPointLight<V>> lights;
        for (const auto& l : room.oriented(150)) lights.push_back({l});
        const LightTree tree(lights);
        const auto occluders = room.occluders();
        const ScalarOccluders oracle{occluders};
        const auto points = diffuse_points(random, 12, 0.3, 1.0);
        constexpr float limit = 0.05f;
        glm::dvec3 truth(0.0);
        for (const auto& p : points) {
            for (const auto& l : lights) {
                truth += glm::dvec3(glm::min(unshadowed_transfer(p.receiver, l), V(limit))) *
                         static_cast<double>(oracle(p.receiver, l)) * glm::dvec3(p.strength) * glm::dvec3(l.intensity);
            }
        }
        EXPECT_LT(truth.x, sum_of_pairs(points, lights, oracle).x);
        ProductOptions options = exact;
        options.cut.clamp.transfer = limit;
        expect_near(gather(tree, points, oracle, options).radiance, truth, 2e-5);
        options.cut.error_ratio = 0.1f;
        expect_within_bound(gather(tree, points, oracle, options), truth);
        // Nothing is known of the only pair but that no light adds more.
        options.cut.max_cut = 1;
        const V bound = gather(tree, points, oracle, options).error_bound;
        const V weight = tree.clusters()[tree.topology().root()].intensity;
        V strength(0.0f);
        for (const auto& p : points) strength += p.strength;
        for (int c = 0; c < 3; ++c) EXPECT_LE(bound[c], 1.0001f * limit * weight[c] * strength[c]);
    }
}

TEST(Gather, SeparatePointsAreACutToo) {
    Random random(4);
    Room<V> room(4);
    const auto lights = room.oriented(300);
    const LightTree tree(lights);
    const auto occluders = room.occluders();
    const ScalarOccluders oracle{occluders};
    const auto points = diffuse_points(random, 20, 0.2, 0.5);
    const glm::dvec3 truth = sum_of_pairs(points, lights, oracle);
    const auto together = gather(tree, points, oracle);
    const auto separate = gather(tree, points, oracle, ProductOptions{.separate_points = true});
    expect_within_bound(together, truth);
    expect_within_bound(separate, truth);
    EXPECT_LT(together.cut_size, separate.cut_size);
}

/// Whether a point is in the shadow of everything, by a hash of its id.
struct RandomShadow {
    template <class R, class L>
    bool operator()(const R& receiver, const L&) const {
        return mix_bits(receiver.id) % 2 == 0;
    }
};

/// Where instants do not matter, the error is what it is without them: pairs of a cluster do not share one point.
TEST(Gather, ErrorDoesNotDependOnTheNumberOfInstants) {
    Random random(7);
    Room<V> room(7);
    const auto lights = room.omni(800);
    auto points = diffuse_points(random, 200, 0.1, 0.3);
    for (auto& p : points) p.strength = V(0.005f);
    const LightTree plain(lights, {.representatives = 32});
    const auto error_over_ids = [&](const auto& tree, const auto& of, const auto& all, double truth) {
        double squares = 0.0;
        constexpr std::uint32_t ids = 40;
        for (std::uint32_t id = 0; id < ids; ++id) {
            const auto result = gather(tree, of, RandomShadow{}, ProductOptions{.id = id}, all);
            const double off = static_cast<double>(result.radiance.x) / truth - 1.0;
            squares += off * off / ids;
        }
        return std::sqrt(squares);
    };
    const double untimed = error_over_ids(plain, points, GatherTreeOptions{},
                                          sum_of_pairs(points, lights, RandomShadow{}).x);
    EXPECT_GT(untimed, 0.0);
    // All at the first of two instants.
    std::vector<InstantLight<OmniLight<V>>> timed_lights;
    for (const auto& l : lights) timed_lights.push_back({l, 0});
    std::vector<InstantGatherPoint<Lambert<V>, V>> timed_points;
    for (const auto& p : points) timed_points.push_back({p, 0});
    const LightTree tree(timed_lights);
    const LightForest forest(tree);
    const TimedForest timed(forest, 2);
    const double of_instants = error_over_ids(timed, timed_points, GatherTreeOptions{},
                                              sum_of_pairs(timed_points, timed_lights, RandomShadow{}).x);
    EXPECT_LT(of_instants, 2.0 * untimed);
    EXPECT_GT(of_instants, 0.5 * untimed);
}

TEST(Gather, ChoicesOfDifferentIdsDiffer) {
    Random random(9);
    Room<V> room(9);
    const auto lights = room.omni(800);
    const LightTree tree(lights, {.representatives = 8});
    const auto points = diffuse_points(random, 20, 0.1, 0.3);
    std::vector<DiffusePoint> one{points[0]};
    one[0].strength = V(1.0f);
    for (const auto& some : {points, one}) {
        EXPECT_NE(gather(tree, some, AlwaysVisible{}, ProductOptions{.id = 0}).radiance,
                  gather(tree, some, AlwaysVisible{}, ProductOptions{.id = 1}).radiance);
    }
}

TEST(Gather, InstantsOfLightsAndPointsHaveToAgree) {
    Random random(9);
    Room<V> room(9);
    const auto lights = at_instants(room.omni(80), 8);
    const LightTree tree(lights);
    const LightForest forest(tree);
    const TimedForest timed(forest, 8);
    const auto points = at_instants(diffuse_points(random, 20, 0.1, 0.3), 8);
    GatherForest<InstantGatherPoint<Lambert<V>, V>> trees;
    gather_scratch_of<decltype(timed)> scratch;
    trees.build(points, {});
    EXPECT_THROW(gather(timed, trees, AlwaysVisible{}, scratch), invalid_input);
    // What cannot be built leaves nothing to be gathered.
    trees.build(points, {.instants = 8});
    EXPECT_NE(gather(timed, trees, AlwaysVisible{}, scratch).radiance, V(0.0f));
    EXPECT_THROW(trees.build(points, {.instants = 4}), invalid_input);
    EXPECT_EQ(trees.point_count(), 0u);
}

TEST(Gather, CutsAreNoLargerThanAskedFor) {
    Random random(4);
    Room<V> room(4);
    const auto lights = room.oriented(300);
    const LightTree tree(lights);
    for (const std::size_t count : {8u, 20u}) {
        const auto points = diffuse_points(random, count, 0.2, 0.5);
        for (const std::size_t most : {1u, 10u, 100u}) {
            const ProductOptions options{.cut = {.error_ratio = 0.001f, .max_cut = most, .exhaustive_below = 10'000}};
            const auto result = gather(tree, points, AlwaysVisible{}, options);
            EXPECT_LE(result.cut_size, most);
            EXPECT_EQ(result.stop, StopReason::limit);
        }
        ProductOptions separate{.cut = {.error_ratio = 0.05f, .max_cut = 100}, .separate_points = true};
        EXPECT_LE(gather(tree, points, AlwaysVisible{}, separate).cut_size, 100u);
    }
}

TEST(Gather, RedrawingLeavesSinglePairsAlone) {
    Random random(4);
    Room<V> room(4);
    const auto lights = room.oriented(20);
    const LightTree tree(lights);
    const auto occluders = room.occluders();
    const auto points = diffuse_points(random, 10, 0.2, 0.5);
    ProductOptions options{.cut = {.exhaustive_below = 1000}};
    const auto once = gather(tree, points, ScalarOccluders{occluders}, options);
    options.redraw = true;
    const auto again = gather(tree, points, ScalarOccluders{occluders}, options);
    EXPECT_EQ(once.queries, again.queries);
    EXPECT_EQ(once.radiance, again.radiance);
}

TEST(Gather, TightBoundsAreAskedForIfWanted) {
    Random random(4);
    Room<V> room(4);
    const auto lights = room.oriented(300);
    const LightTree tree(lights);
    const auto points = diffuse_points(random, 20, 0.2, 0.5);
    const auto loose = gather(tree, points, AlwaysVisible{});
    const auto tight = gather(tree, points, AlwaysVisible{}, {}, {}, TwoStageBounds{.tight_band = 3.0});
    EXPECT_LT(tight.cut_size, loose.cut_size);
}

TEST(Gather, BatchedAndScalarOraclesAgree) {
    Random random(6);
    Room<V> room(6);
    const auto lights = room.oriented(300);
    const LightTree tree(lights);
    const auto occluders = room.occluders();
    const auto points = glossy_points(random, 20, 0.2, 0.5);
    const auto scalar = gather(tree, points, ScalarOccluders{occluders});
    const auto batched = gather(tree, points, BatchedOccluders{occluders});
    EXPECT_EQ(scalar.radiance, batched.radiance);
    EXPECT_EQ(scalar.error_bound, batched.error_bound);
    EXPECT_EQ(scalar.queries, batched.queries);
}

TEST(Gather, DegenerateSumsAreRight) {
    Room<V> room(2);
    const auto lights = room.oriented(50);
    const LightTree tree(lights);
    const LightTree<OrientedPointLight<V>> dark;
    const auto no_points = std::vector<DiffusePoint>{};
    EXPECT_EQ(gather(tree, no_points).radiance, V(0.0f));
    EXPECT_EQ(gather(tree, no_points).stop, StopReason::converged);
    Random random(2);
    auto points = diffuse_points(random, 10, 0.0, 0.0);  // all at one place, facing one way
    EXPECT_EQ(gather(dark, points).radiance, V(0.0f));
    expect_near(gather(tree, points, AlwaysVisible{}, exact).radiance,
                sum_of_pairs(points, lights, [](const auto&, const auto&) { return 1.0; }), 2e-5);
    for (DiffusePoint& p : points) p.strength = V(0.0f);
    EXPECT_EQ(gather(tree, points).radiance, V(0.0f));
    points[3].strength = V(0.0f, -1.0f, 0.0f);
    EXPECT_THROW(gather(tree, points), invalid_input);
    points[3].strength = V(0.0f, INFINITY, 0.0f);
    EXPECT_THROW(gather(tree, points), invalid_input);
}

}  // namespace
}  // namespace lightcuts::test
