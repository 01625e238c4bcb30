#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <ranges>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

TEST(Shade, OfOneOmniLightOverAPlaneIsTheClosedForm) {
    const V intensity(10.0f, 20.0f, 30.0f), albedo(0.2f, 0.5f, 0.8f);
    const float height = 1.5f;
    const std::vector<OmniLight<>> lights{{{0.0f, height, 0.0f}, intensity, {}}};
    const LightTree tree(lights);
    for (float x = 0.0f; x < 5.0f; x += 0.25f) {
        const auto result = shade(tree, Receiver({x, 0.0f, 0.0f}, Lambert<V>{{0.0f, 1.0f, 0.0f}, albedo}));
        const double d2 = static_cast<double>(x) * static_cast<double>(x) + static_cast<double>(height * height);
        for (int c = 0; c < 3; ++c) {
            const double exact = static_cast<double>(albedo[c] * intensity[c]) / std::numbers::pi *
                                 static_cast<double>(height) / (d2 * std::sqrt(d2));
            EXPECT_NEAR(result.radiance[c], exact, 1e-5 * exact);
        }
        EXPECT_EQ(result.error_bound, V(0.0f));
        EXPECT_EQ(result.cut_size, 1u);
        EXPECT_EQ(result.stop, StopReason::converged);
    }
}

// An infinite row of lights close together, far longer than high, is a line: radiance albedo / pi * pi / 2 * I' / h.
TEST(Shade, OfALongRowOfLightsIsThatOfALine) {
    std::vector<OmniLight<float>> lights;
    for (int i = -20000; i <= 20000; ++i) lights.push_back({{0.01f * static_cast<float>(i), 0.0f, 1.0f}, 0.01f, {}});
    const LightTree tree(lights);
    const auto result = shade(tree, Receiver(V(0.0f), Lambert<float>{{0.0f, 0.0f, 1.0f}, 1.0f}), AlwaysVisible{},
                              {.error_ratio = 1e-3f, .max_cut = 0});
    EXPECT_NEAR(result.radiance, 2.0f / std::numbers::pi_v<float>, 1e-3f);  // the integral of 1 / (1 + x^2)^(3/2) is 2
    EXPECT_LT(result.cut_size, 4000u);
}

/// Expects what a material is promised, and counts.
struct Expectant {
    std::size_t* calls;

    float evaluate(const V& to_light) const {
        ++*calls;
        EXPECT_NEAR(glm::length(to_light), 1.0f, 1e-6f);
        return 1.0f;
    }
    float upper_bound(const OffsetBox&) const { return 1.0f; }
};

// Lights at the receiver, and where the squares of floats are no numbers.
TEST(Shade, GivesMaterialsUnitVectorsOnly) {
    std::vector<OmniLight<float>> lights;
    for (const float x : {0.0f, 1e-30f, 1e-12f, 1.0f, 1e12f, 3e19f, 1e38f}) lights.push_back({{x, 0.0f, x}, 1.0f, {}});
    const LightTree tree(lights);
    std::size_t calls = 0;
    const Receiver receiver(V(0.0f), Expectant{&calls});
    EXPECT_GT(
        shade(tree, receiver, AlwaysVisible{}, {.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0}).radiance,
        0.0f);
    EXPECT_GT(exhaustive(tree, receiver).radiance, 0.0f);
    EXPECT_GT(calls, 0u);
}

TEST(Shade, EvaluatesAMaterialOnceALight) {
    const std::vector<OmniLight<float>> one(1, {{0.0f, 0.0f, 1.0f}, 1.0f, {}});
    const LightTree tree(one);
    std::size_t calls = 0;
    const Receiver receiver(V(0.0f), Expectant{&calls});
    shade(tree, receiver);
    EXPECT_EQ(calls, 1u);
    exhaustive(tree, receiver);
    EXPECT_EQ(calls, 2u);
}

// Whatever holds lights, receivers and results side by side.
TEST(Shade, TakesAnyContiguousRanges) {
    Room<V> room(5);
    const auto vector = room.omni(300);
    std::array<OmniLight<>, 300> array;
    std::copy(vector.begin(), vector.end(), array.begin());
    OmniLight<> plain[300];
    std::copy(vector.begin(), vector.end(), plain);
    const std::span<const OmniLight<>> span(vector);
    const LightTree a(vector), b(array), c(plain), d(span);
    auto receivers = room.glossy_receivers(3);
    using R = std::ranges::range_value_t<decltype(receivers)>;
    const LightcutOptions options{.exhaustive_below = 0};
    std::vector<CutResult<V>> expected;
    scratch_of<LightTree<OmniLight<>>> scratch;
    shade(a, receivers, AlwaysVisible{}, expected, scratch, options);
    ASSERT_EQ(expected.size(), receivers.size());
    const auto expect_same_radiance = [&](const auto& results) {
        for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(results[i].radiance, expected[i].radiance);
    };
    const std::array<R, 3> some{receivers[0], receivers[1], receivers[2]};
    std::array<CutResult<V>, 3> results;
    shade(b, some, AlwaysVisible{}, results, scratch, options);
    expect_same_radiance(results);
    std::vector<CutResult<V>> more(5);
    shade(c, std::span(receivers), AlwaysVisible{}, std::span(more), scratch, options);
    expect_same_radiance(more);
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        EXPECT_EQ(shade(d, receivers[i], AlwaysVisible{}, scratch, options).radiance, expected[i].radiance);
    }
}

#ifndef NDEBUG
/// Claims the cosine lobe of a Lambert material, and evaluates without the cosine.
struct WithoutCosine : Lambert<V> {
    V evaluate(const glm::vec3&) const { return albedo * 0.31830989f; }
    void evaluate_many(const LaneVectors&, int, LaneSpectra<V>&) const = delete;
};

TEST(ShadeDeathTest, NoticesABoundBelowWhatTheMaterialReturns) {
    std::vector<OmniLight<>> lights;
    for (int i = 0; i < 64; ++i) lights.push_back({{3.0f + 0.1f * static_cast<float>(i), 0.0f, 0.1f}, V(1.0f), {}});
    const LightTree tree(lights);
    const WithoutCosine material{{{0.0f, 0.0f, 1.0f}, V(0.5f)}};
    const Receiver receiver(V(0.0f), material);
    EXPECT_DEATH(shade(tree, receiver, AlwaysVisible{}, {.exhaustive_below = 0}), "a bound is below");
}
#endif

TEST(Shade, OfSeveralTreesIsTheSumOverThem) {
    Room<V> room(1);
    const auto omni = room.omni(50);
    const auto distant = room.distant(50);
    const LightTree a(omni);
    const LightTree b(distant);
    const LightcutOptions all{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0};
    for (const auto& receiver : room.diffuse_receivers(10)) {
        const V sum = shade(a, receiver, AlwaysVisible{}, all).radiance +
                      shade(b, receiver, AlwaysVisible{}, all).radiance;
        const V both = shade(LightForest(a, b), receiver, AlwaysVisible{}, all).radiance;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(both[c], sum[c], 1e-5f * sum[c]);
    }
}

TEST(Shade, KeepsOneClusterATreeWhateverTheLimit) {
    Room<V> room(2);
    const auto omni = room.omni(50);
    const auto oriented = room.oriented(50);
    const LightTree a(omni);
    const LightTree b(oriented);
    const LightForest forest(a, b);
    for (const auto& receiver : room.diffuse_receivers(5)) {
        EXPECT_EQ(shade(forest, receiver, AlwaysVisible{}, {.max_cut = 1}).cut_size, 2u);
        EXPECT_EQ(shade(forest, receiver, AlwaysVisible{}, {.error_ratio = 0.0f, .max_cut = 3}).cut_size, 3u);
        // Beyond the number of lights a limit does not matter.
        const auto result = shade(forest, receiver, AlwaysVisible{},
                                  {.error_ratio = 0.0f, .max_cut = 1000, .exhaustive_below = 0});
        EXPECT_LE(result.cut_size, 100u);
        EXPECT_EQ(result.stop, StopReason::converged);
    }
}

/// For cuts that need no bound.
struct NoBounds {
    static constexpr bool two_stages = false;

    template <class M, Light L>
    material_spectrum<M> quick(const M&, const LightCluster<L>&, const Box&) const {
        ADD_FAILURE() << "a bound was asked for";
        return {};
    }
};

// What shades so few is the sum itself, light by light.
TEST(Shade, StartsWithAllLightsWhereTheyAreFew) {
    Room<V> room(12);
    auto omni = room.omni(60);
    omni[7].intensity = V(0.0f);
    const auto oriented = room.oriented(68);
    const LightTree a(omni);
    const LightTree b(oriented);
    const LightForest forest(a, b);
    const Occluders occluders = room.occluders();
    const BatchedOccluders oracle{occluders};
    EstimateScratch<V> scratch;
    for (const auto& receiver : room.diffuse_receivers(10)) {
        const auto exact = exhaustive(forest, receiver, oracle, scratch);
        const auto cut = shade(forest, receiver, oracle, LightcutOptions{}, NoBounds{});
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(cut.radiance[c], exact.radiance[c], 1e-6f * exact.radiance[c]);
        EXPECT_EQ(cut.error_bound, V(0.0f));
        EXPECT_EQ(cut.cut_size, 127u) << "one is dark";
        EXPECT_EQ(cut.queries, exact.queries);
        EXPECT_EQ(cut.stop, StopReason::converged);

        EXPECT_LT(shade(forest, receiver, oracle, {.exhaustive_below = 126}).cut_size, 127u);
        EXPECT_LE(shade(forest, receiver, oracle, {.max_cut = 126}).cut_size, 126u);
        EXPECT_EQ(shade(forest, receiver, oracle, {.max_cut = 127}).cut_size, 127u);
    }
}

// In tiles, one by one and clamped, and with several representatives, each of which is the light itself.
TEST(Shade, OfFewLightsIsTheSumHoweverItIsAskedFor) {
    Room<V> room(13);
    const auto omni = room.omni(40);
    std::vector<VirtualPointLight<V>> reflected;
    for (const auto& light : room.oriented(200)) reflected.push_back({light});
    const LightTree a(omni, {.representatives = 8});
    const LightTree b(reflected, {.representatives = 8});
    const LightForest forest(a, b);
    const auto receivers = room.diffuse_receivers(40);
    const Occluders occluders = room.occluders();
    EstimateScratch<V> sums;
    scratch_of<decltype(forest)> scratch;
    for (const ClampingOptions& clamp : {ClampingOptions{}, automatic_clamping, ClampingOptions{.radiance = 1e-3f}}) {
        const LightcutOptions options{.clamp = clamp};
        std::vector<CutResult<V>> batched, scalar;
        shade(forest, receivers, BatchedOccluders{occluders}, batched, scratch, options);
        shade(forest, receivers, ScalarOccluders{occluders}, scalar, scratch, options);
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            const V exact = exhaustive(forest, receivers[i], BatchedOccluders{occluders}, sums, clamp).radiance;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(batched[i].radiance[c], exact[c], 1e-5f * exact[c]);
            EXPECT_EQ(batched[i].radiance, scalar[i].radiance);
            EXPECT_EQ(batched[i].error_bound, V(0.0f));
            EXPECT_EQ(batched[i].cut_size, 240u);
        }
    }
}

/// Hides all, and knows it of whole clusters.
struct Wall {
    bool operator()(const auto&, const auto&) const { return false; }
    float upper_bound(const auto&, const Box&) const { return 0.0f; }
};

// An oracle that bounds clusters is asked about them, however few their lights are.
TEST(Shade, AsksABoundedOracleAboutFewLights) {
    Room<V> room(14);
    const auto omni = room.omni(100);
    const LightTree tree(omni);
    for (const auto& receiver : room.diffuse_receivers(5)) {
        EXPECT_LE(shade(tree, receiver, Wall{}).queries, 1u) << "that of the root's representative";
    }
}

// Where all is dark, what adaptation tolerates need not be refined.
TEST(Shade, RefinesDarknessLessWithAdaptation) {
    Room<V> room(3);
    const auto lights = room.omni(1000);
    const LightTree tree(lights);
    const auto blocked = [](const auto&, const auto&) { return false; };
    for (const auto& receiver : room.diffuse_receivers(5)) {
        const auto plain = shade(tree, receiver, blocked, {.max_cut = 200});
        EXPECT_EQ(plain.radiance, V(0.0f));
        EXPECT_EQ(plain.stop, StopReason::limit) << "every bound is above a ratio of nothing";
        const auto adapted = shade(tree, receiver, blocked, {.max_cut = 200, .adaptation = 1e4f});
        EXPECT_LT(adapted.cut_size, 30u) << "only what may touch the receiver is refined";
        EXPECT_EQ(adapted.stop, StopReason::converged);
    }
}

// The child that holds the parent's representative takes its transfer over: a refined cut needs no ray twice.
TEST(Shade, TracesOneRayALightAtMost) {
    struct Remembering {
        std::vector<int>& asked;
        void many(std::span<const VisibilityQuery> queries, std::span<float> answers) const {
            for (std::size_t i = 0; i < queries.size(); ++i) {
                ++asked[queries[i].light];
                answers[i] = 1.0f;
            }
        }
    };
    Room<V> room(4);
    const auto lights = room.omni(300);
    for (const auto& receiver : room.diffuse_receivers(5)) {
        for (const LightcutOptions& options :
             {LightcutOptions{.exhaustive_below = 0},
              LightcutOptions{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0}}) {
            const LightTree tree(lights);  // one representative a node: each light is asked about once
            std::vector<int> asked(lights.size(), 0);
            const auto result = shade(tree, receiver, Remembering{asked}, options);
            EXPECT_LE(*std::max_element(asked.begin(), asked.end()), 1);
            int rays = 0;
            for (const int a : asked) rays += a;
            EXPECT_EQ(static_cast<std::uint32_t>(rays), result.queries);
        }
    }
}

TEST(Shade, DrawsOtherRepresentativesForOtherSeedsAndReceivers) {
    Room<V> room(5);
    const auto lights = room.omni(500);
    const LightTree several(lights, {.representatives = 16});
    const LightTree single(lights);
    auto receivers = room.diffuse_receivers(1);
    const auto& receiver = receivers[0];
    const auto by = [&](const LightTree<OmniLight<>>& tree, std::uint64_t seed, std::uint32_t id) {
        Receiver<Lambert<V>> renamed = receiver;
        renamed.id = id;
        return shade(tree, renamed, AlwaysVisible{}, {.max_cut = 5, .seed = seed}).radiance;
    };
    EXPECT_EQ(by(several, 1, 1), by(several, 1, 1));
    EXPECT_NE(by(several, 1, 1), by(several, 2, 1));
    EXPECT_NE(by(several, 1, 1), by(several, 1, 2));
    EXPECT_EQ(by(single, 1, 1), by(single, 2, 3)) << "with one there is nothing to draw";
}

TEST(Lightcut, CanBeStoppedAnywhere) {
    Room<V> room(6);
    const auto lights = room.omni(400);
    const LightTree tree(lights);
    const LightForest forest(tree);
    const Occluders occluders = room.occluders();
    const ScalarOccluders oracle{occluders};
    for (const auto& receiver : room.diffuse_receivers(10)) {
        EstimateScratch<V> scratch;
        const V exact = exhaustive(forest, receiver, oracle, scratch).radiance;
        Lightcut cut(forest, receiver, oracle,
                     LightcutOptions{.error_ratio = 0.01f, .max_cut = 0, .exhaustive_below = 0});
        do {
            const CutResult<V> result = cut.result();
            for (int c = 0; c < 3; ++c) {
                EXPECT_LE(std::fabs(result.radiance[c] - exact[c]), result.error_bound[c] + 1e-5f * exact[c]);
            }
            double sum = 0.0;
            std::size_t leaves = 0;
            cut.for_each([&](const auto& node) {
                sum += static_cast<double>(node.estimate.x);
                leaves += tree.topology().leaf_count(node.node);
            });
            EXPECT_NEAR(sum, result.radiance.x, 1e-6 * sum);
            EXPECT_EQ(leaves, lights.size()) << "a cut holds every light once";
        } while (cut.step());
        EXPECT_EQ(cut.result().stop, StopReason::converged);
    }
}

// One channel is nearly dark: its own error counts, not only the bright one's.
TEST(Shade, LooksAtEveryChannel) {
    Room<V> room(7);
    auto lights = room.omni(1000);
    for (std::size_t i = 0; i < lights.size(); ++i)
        lights[i].intensity = i % 100 == 7 ? V(0.0f, 0.0f, 1e-3f) : V(1.0f, 1.0f, 0.0f);
    const LightTree tree(lights);
    EstimateScratch<V> scratch;
    for (const auto& receiver : room.diffuse_receivers(20)) {
        const V exact = exhaustive(LightForest(tree), receiver, AlwaysVisible{}, scratch).radiance;
        const auto result = shade(tree, receiver, AlwaysVisible{},
                                  {.error_ratio = 0.01f, .max_cut = 0, .exhaustive_below = 0});
        EXPECT_NEAR(result.radiance.z, exact.z, 0.1f * exact.z);
    }
}

}  // namespace
}  // namespace lightcuts::test
