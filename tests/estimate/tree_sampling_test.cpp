#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/tree_sampling.hpp>
#include "estimate/unbiasedness.hpp"
#include "support/scene.hpp"
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

/// Of every leaf of every tree, kind by kind.
template <class Forest, class R>
std::vector<std::vector<double>> probabilities_of(const Forest& forest, const R& receiver) {
    std::vector<std::vector<double>> all;
    as_forest(forest).for_each([&](std::uint32_t kind, const auto& tree) {
        std::vector<double>& own = all.emplace_back(tree.lights().size(), 0.0);
        const auto leaves = leaves_of(tree);
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (leaves[i] != no_leaf) own[i] = probability_of(forest, receiver, kind, leaves[i]);
        }
    });
    return all;
}

/// What is drawn has the stated probability, as often as that says: false alarms one in a million.
template <class Forest, class R>
void expect_probabilities(const Forest& forest, const R& receiver, std::uint64_t seed) {
    const auto probabilities = probabilities_of(forest, receiver);
    double sum = 0.0;
    for (const auto& kind : probabilities) {
        for (const double p : kind) sum += p;
    }
    EXPECT_LE(sum, 1.0 + 1e-9);

    constexpr std::size_t draws = 15000;
    std::vector<std::vector<std::size_t>> found;
    for (const auto& kind : probabilities) found.emplace_back(kind.size(), 0);
    std::size_t nothing = 0;
    Random random(seed);
    for (std::size_t i = 0; i < draws; ++i) {
        const LightSample sample = sample_light(forest, receiver, random.unit());
        if (sample.probability == 0.0) {
            ++nothing;
            continue;
        }
        ++found[sample.kind][sample.light];
        ASSERT_EQ(sample.probability, probabilities[sample.kind][sample.light]) << "the same, sampled or asked for";
        ASSERT_EQ(sample.probability, probability_of(forest, receiver, sample.kind, sample.leaf));
    }
    // Classes expected fewer than 20 times are thrown together.
    double chi_square = 0.0, rare = 1.0 - sum;
    std::size_t classes = 0, rare_found = nothing;
    const auto add = [&](double expected, std::size_t count) {
        const double off = static_cast<double>(count) - expected;
        chi_square += off * off / expected;
        ++classes;
    };
    for (std::size_t k = 0; k < probabilities.size(); ++k) {
        for (std::size_t i = 0; i < probabilities[k].size(); ++i) {
            if (probabilities[k][i] * draws < 20.0) {
                rare += probabilities[k][i];
                rare_found += found[k][i];
            } else {
                add(probabilities[k][i] * draws, found[k][i]);
            }
        }
    }
    if (rare * draws >= 20.0) add(rare * draws, rare_found);
    if (rare < 1e-9) { EXPECT_EQ(rare_found, 0u); }
    ASSERT_GT(classes, 1u);
    EXPECT_LT(chi_square, chi_square_limit(classes - 1));
}

TEST(SampleLight, DrawsByTheProbabilitiesThatAreStated) {
    Room<V> room(1);
    auto omni = room.omni(60);
    omni[3].intensity = omni[59].intensity = V(0.0f);
    const auto oriented = room.oriented(80);
    const auto distant = room.distant(20);
    const LightTree a(omni);
    const LightTree b(oriented);
    const LightTree c(distant);
    std::uint64_t seed = 0;
    for (const auto& receiver : room.diffuse_receivers(2)) {
        expect_probabilities(LightForest(a, b, c), receiver, ++seed);
        expect_probabilities(a, receiver, ++seed);
        expect_probabilities(b, receiver, ++seed);
        expect_probabilities(c, receiver, ++seed);
    }
    for (const auto& receiver : room.glossy_receivers(4)) expect_probabilities(LightForest(a, b, c), receiver, ++seed);
}

TEST(SampleLight, CanDrawWhateverCanContribute) {
    Room<V> room(2);
    const auto oriented = room.oriented(300);
    const auto spot = room.spot(300);
    const LightTree a(oriented);
    const LightTree b(spot);
    const LightForest forest(a, b);
    for (const auto& receiver : room.glossy_receivers(20)) {
        const auto probabilities = probabilities_of(forest, receiver);
        double sum = 0.0;
        const auto expect = [&](const auto& lights, const auto& of_lights) {
            for (std::size_t i = 0; i < lights.size(); ++i) {
                sum += of_lights[i];
                if (!is_black(unshadowed_transfer(receiver, lights[i]))) { EXPECT_GT(of_lights[i], 0.0); }
            }
        };
        expect(oriented, probabilities[0]);
        expect(spot, probabilities[1]);
        EXPECT_LE(sum, 1.0 + 1e-9);
    }
}

// Without dead ends nothing is lost: omni lights in front of the surface can all contribute.
TEST(SampleLight, HasProbabilitiesThatSumToOneInFrontOfTheSurface) {
    Random random(3);
    std::vector<OmniLight<float>> lights(1000);
    for (auto& l : lights) {
        l.position = V(random.in_box({-1, -1, 0.01}, {1, 1, 2}));
        l.intensity = random.real(0.1, 1.0);
    }
    const LightTree tree(lights);
    for (const float x : {0.0f, 0.9f, 5.0f, 500.0f}) {
        const Receiver receiver(V(x, 0.0f, 0.0f), Lambert<float>{{0.0f, 0.0f, 1.0f}, 0.5f});
        double sum = 0.0;
        const auto probabilities = probabilities_of(tree, receiver);
        for (const double p : probabilities[0]) sum += p;
        EXPECT_NEAR(sum, 1.0, 1e-9) << x;
    }
}

TEST(SampleLight, OfNothingHasNoProbability) {
    const Receiver receiver(V(0.0f), Lambert<V>{{0.0f, 0.0f, 1.0f}, V(1.0f)});
    const LightTree<OmniLight<>> empty;
    EXPECT_EQ(sample_light(empty, receiver, 0.5).probability, 0.0);
    const std::vector<OmniLight<>> dark(3);
    const LightTree tree(dark);
    EXPECT_EQ(sample_light(tree, receiver, 0.5).probability, 0.0);
    EXPECT_EQ(leaves_of(tree), std::vector<std::uint32_t>(3, no_leaf));
    const std::vector<OmniLight<>> behind(4, {{1.0f, 0.0f, -1.0f}, V(1.0f), {}});
    EXPECT_EQ(sample_light(LightTree(behind), receiver, 0.5).probability, 0.0);
}

// A number that has come down a narrow path has no random bits left to choose with: it is drawn afresh.
TEST(TreeSampling, DoesNotRunOutOfRandomBits) {
    const std::vector<OmniLight<float>> lights(64, {{0.0f, 0.0f, 1.0f}, 1.0f, {}});
    const LightTree tree(lights);
    const Receiver receiver(V(0.0f), Lambert<float>{{0.0f, 0.0f, 1.0f}, 1.0f});
    EstimateScratch<float> scratch;
    const auto found_over_seeds = [&](double chance) {
        std::set<std::uint32_t> found;
        for (std::uint64_t seed = 0; seed < 1000; ++seed) {
            std::array<double, 3> numbers{0.0, 0.25, 0.5};
            scratch.draws.clear();
            scratch.visits.push_back({tree.topology().root(), 0, 3, 1.0, chance});
            detail::descend(tree, 0, receiver, TwoStageBounds{}, std::span(numbers), seed, scratch);
            double weight = 0.0;
            for (const auto& draw : scratch.draws) {
                found.insert(draw.light);
                weight += draw.weight;
            }
            EXPECT_NEAR(weight, 3.0 * 64.0, 1e-9);
        }
        return found.size();
    };
    EXPECT_EQ(found_over_seeds(1.0), 3u);
    EXPECT_EQ(found_over_seeds(1e-12), 64u);
}

TEST(TreeSampling, IsUnbiased) {
    expect_unbiased([](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed,
                       auto& scratch) { return tree_sampling(forest, receiver, oracle, 8, seed, scratch); });
}

// Many nodes are bounded at once: that must not change what the probability of a light is.
TEST(TreeSampling, WeighsLightsByTheProbabilitiesThatAreStated) {
    Room<V> room(4);
    Random random(4);
    auto oriented = room.oriented(400);
    for (std::size_t i = 0; i < oriented.size(); i += 2) oriented[i].axis = V(random.on_sphere());
    const auto omni = room.omni(200);
    const LightTree a(oriented);
    const LightTree b(omni);
    const LightForest forest(a, b);
    EstimateScratch<V> scratch;
    std::size_t several = 0;
    for (const auto& receiver : room.glossy_receivers(20)) {
        const auto probabilities = probabilities_of(forest, receiver);
        tree_sampling(forest, receiver, AlwaysVisible{}, 64, 1, scratch);
        for (const auto& draw : scratch.draws) {
            const double count = draw.weight * 64.0 * probabilities[draw.kind][draw.light];
            EXPECT_NEAR(count, std::round(count), 1e-9);
            EXPECT_GE(count, 0.5);
            if (count > 1.5) ++several;
        }
    }
    EXPECT_GT(several, 0u);
}

TEST(TreeSampling, IsExactWithOneLight) {
    const std::vector<OmniLight<>> one(1, {{0.5f, 0.0f, 2.0f}, V(1.0f, 2.0f, 3.0f), {}});
    expect_exact_sum(one, [](const auto& forest, const auto& receiver, auto& scratch) {
        return tree_sampling(forest, receiver, AlwaysVisible{}, 7, 1, scratch);
    });
}

TEST(TreeSampling, AsksOnceForALightThatIsDrawnTwice) {
    const std::vector<OmniLight<>> one(1, {{0.5f, 0.0f, 2.0f}, V(1.0f), {}});
    const Receiver receiver(V(0.0f), Lambert<V>{{0.0f, 0.0f, 1.0f}, V(1.0f)});
    const LightTree tree(one);
    const auto open = [](const auto&, const auto&) { return true; };
    EXPECT_EQ(tree_sampling(tree, receiver, open, 64, 1).queries, 1u);
    EXPECT_EQ(tree_sampling(tree, receiver, AlwaysVisible{}, 64, 1).queries, 0u) << "that question is not asked";
}

TEST(TreeSampling, IsDeterministic) {
    expect_deterministic([](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed,
                            auto& scratch) { return tree_sampling(forest, receiver, oracle, 16, seed, scratch); });
}

TEST(TreeSampling, OfDarknessIsBlack) {
    expect_black_where_nothing_shines([](const auto& forest, const auto& receiver, auto& scratch) {
        return tree_sampling(forest, receiver, AlwaysVisible{}, 16, 1, scratch);
    });
}

// Lights of a compact cluster are drawn by intensity alone, also where some of them are below the horizon.
TEST(TreeSampling, IsUnbiasedOverDistantClusters) {
    Random random(21);
    std::vector<OmniLight<float>> lights(256);
    for (auto& l : lights) {
        l = {glm::vec3(random.in_box({-0.5, 9.5, -0.2}, {0.5, 10.5, 0.8})), random.real(0.01, 1.0), {}};
    }
    const LightTree tree(lights);
    const std::vector receivers{Receiver(glm::vec3(0.0f), Lambert<float>{{0.0f, 0.0f, 1.0f}, 1.0f})};
    EXPECT_TRUE(detail::is_compact(tree.clusters()[tree.topology().root()], glm::vec3(0.0f)));
    const auto every_second = [](const auto&, const OmniLight<float>& light) { return light.intensity > 0.5f; };
    expect_mean_is_exact<float>(
        LightForest(tree), receivers, every_second,
        [](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed, auto& scratch) {
            return tree_sampling(forest, receiver, oracle, 4, seed, scratch);
        });
}

// The mean over a grid of points, and the least, of boxes that hold the point or not, at any scale.
TEST(Distances2, AreThoseOfPointsOfTheBox) {
    Random random(22);
    for (const float scale : {1e-18f, 1e-3f, 1.0f, 1e18f}) {
        LaneVectors lo, hi;
        std::vector<Box> boxes;
        const glm::vec3 point = scale * glm::vec3(random.in_box({-1, -1, -1}, {1, 1, 1}));
        for (int i = 0; i < lane_count; ++i) {
            const glm::vec3 corner = scale * glm::vec3(random.in_box({-2, -2, -2}, {2, 2, 2}));
            boxes.push_back({corner, corner + scale * glm::vec3(random.in_box({0, 0, 0}, {3, 3, 3}))});
            lo.set(i, boxes.back().lo);
            hi.set(i, boxes.back().hi);
        }
        alignas(32) Lanes mean, least_share;
        detail::distances2(lo, hi, point, mean, least_share);
        for (int i = 0; i < lane_count; ++i) {
            const Box& box = boxes[static_cast<std::size_t>(i)];
            double sum = 0.0;
            constexpr int cells = 40;
            for (int k = 0; k < 3; ++k) {
                for (int j = 0; j < cells; ++j) {
                    const double low = static_cast<double>(box.lo[k]), high = static_cast<double>(box.hi[k]);
                    const double x = low + (high - low) * (j + 0.5) / cells - static_cast<double>(point[k]);
                    sum += x * x / cells;
                }
            }
            const double least = min_distance2(offsets(box, point));
            const detail::Distances2 found = detail::distances2(box, point);
            EXPECT_NEAR(found.mean, sum, 1e-3 * sum);
            EXPECT_NEAR(found.least_share * found.mean, least, 1e-6 * sum);
            if (!detail::in_range_of_lanes(mean[i])) continue;
            EXPECT_NE(scale, 1e-18f);
            EXPECT_NEAR(static_cast<double>(mean[i]), found.mean, 1e-5 * found.mean);
            EXPECT_NEAR(static_cast<double>(least_share[i]), found.least_share, 1e-5);
        }
    }
}

}  // namespace
}  // namespace lightcuts::test
