#include <lightcuts/product/gather.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "product/gather_scene.hpp"

namespace lightcuts::test {
namespace {

constexpr ProductOptions exact{.cut = {.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0}};

void expect_near(const V& found, const glm::dvec3& truth, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(static_cast<double>(found[c]), truth[c], tolerance * (truth[c] + 1e-30)) << c;
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

TEST(Gather, FixedCutIsUnbiasedOverSeedsWhenRedrawn) {
    Random random(5);
    Room<float> room(5);
    std::vector<InstantLight<OmniLight<float>>> lights;
    for (const auto& l : room.omni(60)) lights.push_back({l, static_cast<std::uint32_t>(lights.size() % 4)});
    const auto occluders = room.occluders();
    const ScalarOccluders oracle{occluders};
    std::vector<InstantGatherPoint<Lambert<float>, float>> points;
    for (const DiffusePoint& p : diffuse_points(random, 30, 0.3, 1.0)) {
        points.push_back({{{p.receiver.position, Lambert<float>{p.receiver.material.normal, 1.0f},
                            p.receiver.shadow_origin, p.receiver.id},
                           p.strength.x},
                          static_cast<std::uint32_t>(points.size() % 4)});
    }
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
    // A fixed cut: as many nodes as fit whatever the estimate, so that the bounds alone decide.
    double sum = 0, squares = 0;
    constexpr int seeds = 3000;
    for (int seed = 0; seed < seeds; ++seed) {
        const TimedForest timed(forest, 4, hash_keys(9, seed));
        ProductOptions options{.cut = {.error_ratio = 1e-6f, .max_cut = 40, .exhaustive_below = 0, .seed = hash_keys(7, seed)},
                               .redraw = true};
        const auto result = gather(timed, points, oracle, options, {.seed = hash_keys(8, seed)});
        const auto x = static_cast<double>(result.radiance);
        sum += x;
        squares += x * x;
    }
    const double mean = sum / seeds, deviation = std::sqrt((squares / seeds - mean * mean) / seeds);
    EXPECT_NEAR(mean, truth, 4 * deviation);
    EXPECT_LT(deviation, 0.02 * truth);
}

}  // namespace
}  // namespace lightcuts::test
