#include <array>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/learned_visibility.hpp>
#include <lightcuts/estimate/adaptive_splitting.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/power.hpp>
#include <lightcuts/estimate/resampled.hpp>
#include <lightcuts/estimate/stochastic_lightcuts.hpp>
#include <lightcuts/estimate/tree_sampling.hpp>
#include <lightcuts/estimate/ward.hpp>
#include "archetypes/archetypes.hpp"

namespace lightcuts::test {
namespace {

Bands bands(float k) { return Bands(std::array<float, 5>{k, 2 * k, 3 * k, 4 * k, 5 * k}); }

struct Scene {
    std::array<LeastLight, 4> bulbs{LeastLight{{0, 0, 2}, bands(1)}, LeastLight{{1, 0, 2}, bands(2)},
                                    LeastLight{{0, 1, 3}, bands(0)}, LeastLight{{4, 1, -3}, bands(3)}};
    std::array<ForeignLight, 3> lamps{ForeignLight{{0, 0, 2}, {0, 0, -1}, bands(1)},
                                      ForeignLight{{1, 1, 2}, {0, 0, -1}, bands(2)},
                                      ForeignLight{{2, 1, 2}, {1, 0, 0}, bands(2)}};
    std::array<LeastSun, 2> suns{LeastSun{{0, 0, -1}, bands(1)}, LeastSun{{0, -0.6f, -0.8f}, bands(1)}};
};

/// The oracles let the same share of each light through, `visible`.
template <class Forest, class Material, class Scalar, class Batched>
void expect_shading(const Forest& forest, float visible) {
    const Material material;
    const Receiver<const Material&> receiver(glm::vec3(0.0f), material, glm::vec3(0.0f, 0.0f, 0.01f));
    const Scalar scalar;
    const Batched batched;
    EstimateScratch<Bands> scratch;
    const Bands unshadowed = exhaustive(forest, receiver, AlwaysVisible{}, scratch).radiance;
    const Bands exact = unshadowed * visible;
    ASSERT_GT(exact[0], 0.0f);
    const auto expect_near = [](const Bands& radiance, const Bands& expected) {
        for (int c = 0; c < 5; ++c) EXPECT_NEAR(radiance[c], expected[c], 1e-5f * expected[c]);
    };
    const auto expect_exact = [&](const Bands& radiance) { expect_near(radiance, exact); };
    expect_exact(exhaustive(forest, receiver, scalar, scratch).radiance);
    expect_exact(exhaustive(forest, receiver, batched, scratch).radiance);
    expect_exact(ward(forest, receiver, scalar, 0.0f, scratch).radiance);
    expect_exact(ward(forest, receiver, batched, 0.0f, scratch).radiance);
    const PowerDistribution distribution(forest);
    EXPECT_GT(power_sampling(forest, distribution, receiver, scalar, 64, 1, scratch).radiance[0], 0.0f);
    EXPECT_GT(power_sampling(forest, distribution, receiver, batched, 64, 1, scratch).radiance[0], 0.0f);

    // With a sample for each light, splitting goes down to single lights.
    const auto estimate_all = [&](const Bands& expected, const auto& oracle, const auto&... policy) {
        EXPECT_GT(tree_sampling(forest, receiver, oracle, 64, 1, scratch, policy...).radiance[0], 0.0f);
        EXPECT_GT(resampled_sampling(forest, receiver, oracle, {16, 4}, 1, scratch, policy...).radiance[0], 0.0f);
        expect_near(adaptive_splitting(forest, receiver, oracle, 0.0f, 64, 1, scratch, policy...).radiance, expected);
        expect_near(stochastic_lightcuts(forest, receiver, oracle, 64, 1, scratch, policy...).radiance, expected);
        EXPECT_GT(sample_light(forest, receiver, 0.5, policy...).probability, 0.0);
    };
    estimate_all(unshadowed, AlwaysVisible{});
    estimate_all(exact, scalar);
    estimate_all(exact, batched);
    estimate_all(exact, scalar, SeparateBounds{});
    estimate_all(exact, batched, LeastPolicy{});

    const LightcutOptions all{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0};
    expect_near(shade(forest, receiver, AlwaysVisible{}, all).radiance, unshadowed);
    expect_exact(shade(forest, receiver, scalar, all).radiance);
    expect_exact(shade(forest, receiver, batched, all).radiance);
    expect_exact(shade(forest, receiver, scalar, all, SeparateBounds{}).radiance);
    expect_exact(shade(forest, receiver, scalar, all, LeastPolicy{}).radiance);

    const std::array<Receiver<const Material&>, 2> receivers{receiver, receiver};
    std::array<CutResult<Bands>, 2> results;
    LightcutScratch<Bands> cut_scratch;
    shade(forest, std::span<const Receiver<const Material&>>(receivers), batched, std::span<CutResult<Bands>>(results),
          cut_scratch, all);
    expect_exact(results[1].radiance);
    shade(forest, std::span<const Receiver<const Material&>>(receivers), scalar, std::span<CutResult<Bands>>(results),
          cut_scratch, all);
    expect_exact(results[0].radiance);

    Lightcut cut(forest, receiver, scalar, all);
    while (cut.step()) {}
    expect_exact(cut.result().radiance);
}

template <class Forest>
void expect_shading(const Forest& forest) {
    expect_shading<Forest, LeastMaterial, LeastOracle, LeastBatchedOracle>(forest, 1.0f);
    expect_shading<Forest, LeastMaterial, LeastPredictingOracle, LeastBatchedPredictingOracle>(forest, 1.0f);
    expect_shading<Forest, LeastMaterial, LeastTint, LeastTintingOracle>(forest, 0.5f);
    expect_shading<Forest, LeastLeaf, LeastBlade, LeastBatchedBlade>(forest, 1.0f);
}

TEST(Archetype, OfALightIsShadedByEveryAlgorithm) {
    const Scene scene;
    const LightTree bulbs{std::span(scene.bulbs)};
    expect_shading(LightForest(bulbs));
}

TEST(Archetype, OfAForeignLightIsShadedByEveryAlgorithm) {
    const Scene scene;
    const LightTree lamps{std::span(scene.lamps)};
    expect_shading(LightForest(lamps));
}

TEST(Archetype, OfADirectionalLightIsShadedByEveryAlgorithm) {
    const Scene scene;
    const LightTree suns{std::span(scene.suns)};
    expect_shading(LightForest(suns));
}

TEST(Archetype, OfEachKindMayBeRefinedTogether) {
    const Scene scene;
    LightTree bulbs(std::span(scene.bulbs), {.representatives = 4});
    const LightTree lamps{std::span(scene.lamps)};
    const LightTree suns{std::span(scene.suns)};
    bulbs.refit();
    expect_shading(LightForest(bulbs, lamps, suns));
}

template <class Forest, class Oracle>
void expect_learning(const Forest& forest) {
    const LeastMaterial material;
    const std::array<Receiver<const LeastMaterial&>, 2> pilots{
        Receiver<const LeastMaterial&>(glm::vec3(0.0f), material),
        Receiver<const LeastMaterial&>(glm::vec3(0.1f), material)};
    const Oracle oracle;
    const LearnedVisibility learned(forest, std::span<const Receiver<const LeastMaterial&>>(pilots), oracle);
    EXPECT_GT(learned.rays(), 0u);
    EXPECT_EQ(learned.likely_visible(pilots[0])(0, forest.template tree<0>().topology().root()), 1.0f);
}

TEST(Archetype, OfAnOracleIsLearnedFrom) {
    const Scene scene;
    const LightTree bulbs{std::span(scene.bulbs)};
    const LightTree lamps{std::span(scene.lamps)};
    const LightForest forest(bulbs, lamps);
    expect_learning<decltype(forest), LeastOracle>(forest);
    expect_learning<decltype(forest), LeastBatchedOracle>(forest);
    expect_learning<decltype(forest), LeastTintingOracle>(forest);
    expect_learning<decltype(forest), LeastPredictingOracle>(forest);
}

TEST(Archetype, OfABuilderAndAnExecutorMakeATree) {
    const Scene scene;
    std::size_t tasks = 0;
    const auto executor = [&tasks](std::size_t count, auto&& task) {
        for (std::size_t i = count; i-- > 0;) task(i), ++tasks;
    };
    const LightTree by_executor(std::span(scene.bulbs), {}, BinnedBuilder{}, executor);
    EXPECT_EQ(by_executor.topology(), LightTree(std::span(scene.bulbs)).topology());
    EXPECT_GT(tasks, 0u);

    // A builder is any function of items and executor: here one that makes a chain.
    const auto chain = [](const auto& items, const auto&) {
        std::vector<std::uint32_t> words;
        for (std::uint32_t i = 0; i < items.size(); ++i) {
            words.push_back(ClusterTree::leaf_word(i));
            if (i > 0) words.push_back(0);
        }
        return ClusterTree(words);
    };
    const LightTree chained(std::span(scene.bulbs), {}, chain);
    expect_shading(LightForest(chained));
}

// Executors that are not lambdas.
static_assert(Executor<Sequential>);
static_assert(Executor<std::function<void(std::size_t, std::function<void(std::size_t)>)>>);

}  // namespace
}  // namespace lightcuts::test
