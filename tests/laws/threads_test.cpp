// Trees, distributions and forests are shared, scratches are not: whatever threads do, no bit of a result changes.
// Under ThreadSanitizer these tests also show that nothing is written behind the caller's back.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/adaptive_splitting.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/power.hpp>
#include <lightcuts/estimate/resampled.hpp>
#include <lightcuts/estimate/stochastic_lightcuts.hpp>
#include <lightcuts/estimate/tree_sampling.hpp>
#include <lightcuts/estimate/ward.hpp>
#include <lightcuts/tree/build/agglomerate.hpp>
#include <lightcuts/tree/build/divide.hpp>
#include "support/cut_results.hpp"
#include "support/scene.hpp"
#include "support/threads.hpp"
#include "tree/build/item_sets.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

struct GreedyBuilder {
    template <class Item, Executor E>
    ClusterTree operator()(std::span<const Item> items, const E& execute) const {
        return agglomerate(items, ClusterSize{}, execute);
    }
};

/// Lights of four kinds in a room, their trees, and what stands in between.
struct Scene {
    Room<V> room;
    std::vector<OmniLight<V>> omni = room.omni(400);
    std::vector<OrientedPointLight<V>> oriented = room.oriented(400);
    std::vector<SpotLight<V>> spot = room.spot(200);
    std::vector<DistantLight<V>> distant = room.distant(100);
    Occluders occluders = room.occluders();
    LightTree<OmniLight<V>> a{omni, {.representatives = 8}};
    LightTree<OrientedPointLight<V>> b{oriented};
    LightTree<SpotLight<V>> c{spot};
    LightTree<DistantLight<V>> d{distant};
    LightForest<OmniLight<V>, OrientedPointLight<V>, SpotLight<V>, DistantLight<V>> forest{a, b, c, d};

    explicit Scene(std::uint64_t seed) : room(seed) {}
};

/// `estimate(receiver index, scratch)` of all receivers by one thread and by four, which share everything but scratch.
template <class Estimate>
void expect_same_by_threads(std::size_t count, Estimate&& estimate) {
    constexpr std::size_t part = 5;
    ASSERT_EQ(count % part, 0u);
    const auto all = [&](const auto& execute) {
        std::vector<lightcuts::Estimate<V>> results(count);
        execute(count / part, [&](std::size_t p) {
            EstimateScratch<V> scratch;
            for (std::size_t i = part * p; i < part * (p + 1); ++i) results[i] = estimate(i, scratch);
        });
        return results;
    };
    const auto alone = all(Sequential{}), together = all(FourThreads{});
    float sum = 0.0f;
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(alone[i].radiance, together[i].radiance) << i;
        EXPECT_EQ(alone[i].queries, together[i].queries) << i;
        sum += alone[i].radiance.g;
    }
    EXPECT_GT(sum, 0.0f);
}

TEST(Threads, BuildTheSameTopology) {
    Random random(41);
    const std::vector<OrientedItem> items = room_items(random, 20000, 0.2);
    const std::vector<PointItem> points = without_axes(items);
    EXPECT_EQ(divide(items), divide(items, Binned{}, FourThreads{}));
    EXPECT_EQ(divide(items, Binned{0}), divide(items, Binned{0}, FourThreads{}));
    EXPECT_EQ(divide(points), divide(points, Binned{}, FourThreads{}));
    EXPECT_EQ(divide(points, LongestAxis{}), divide(points, LongestAxis{}, FourThreads{}));
    EXPECT_EQ(agglomerate(items), agglomerate(items, ClusterSize{}, FourThreads{}));
    EXPECT_EQ(agglomerate(points), agglomerate(points, ClusterSize{}, FourThreads{}));
}

TEST(Threads, ReportTheWholeProgress) {
    Random random(42);
    const std::vector<PointItem> points = without_axes(room_items(random, 20000, 0.2));
    std::atomic<std::size_t> divided = 0, merged = 0;
    divide(points, Binned{}, FourThreads{}, [&](std::size_t n) { divided += n; });
    agglomerate(points, ClusterSize{}, FourThreads{}, [&](std::size_t n) { merged += n; });
    std::size_t divided_alone = 0, merged_alone = 0;
    divide(points, Binned{}, Sequential{}, [&](std::size_t n) { divided_alone += n; });
    agglomerate(points, ClusterSize{}, Sequential{}, [&](std::size_t n) { merged_alone += n; });
    EXPECT_EQ(divided, divided_alone);
    EXPECT_EQ(merged, merged_alone);
}

TEST(Threads, BuildTheSameLightTree) {
    Room<V> room(43);
    const auto lights = room.oriented(6000);
    const auto expect_same_tree = [](const auto& one, const auto& other) {
        ASSERT_EQ(one.topology(), other.topology());
        for (ClusterTree::node_index n = 0; n < one.topology().size(); ++n) {
            EXPECT_EQ(one.clusters()[n].box, other.clusters()[n].box);
            EXPECT_EQ(one.clusters()[n].cone, other.clusters()[n].cone);
            EXPECT_EQ(one.clusters()[n].intensity, other.clusters()[n].intensity);
        }
    };
    const LightTreeOptions options{.representatives = 4};
    expect_same_tree(LightTree(lights, options), LightTree(lights, options, BinnedBuilder{}, FourThreads{}));
    expect_same_tree(LightTree(lights, options, GreedyBuilder{}),
                     LightTree(lights, options, GreedyBuilder{}, FourThreads{}));
}

// Builders have no hidden state: several may run at once over the same items.
TEST(Threads, BuildTreesOfTheSameLightsAtOnce) {
    Room<V> room(44);
    const auto lights = room.oriented(3000);
    const ClusterTree divided = LightTree(lights).topology(),
                      merged = LightTree(lights, {}, GreedyBuilder{}).topology();
    std::vector<ClusterTree> trees(8);
    FourThreads{}(trees.size(), [&](std::size_t i) {
        trees[i] = i % 2 == 0 ? LightTree(lights).topology() : LightTree(lights, {}, GreedyBuilder{}).topology();
    });
    for (std::size_t i = 0; i < trees.size(); ++i) EXPECT_EQ(trees[i], i % 2 == 0 ? divided : merged) << i;
}

TEST(Threads, ShadeTheSameWithAScratchEach) {
    Scene scene(45);
    const auto receivers = scene.room.glossy_receivers(96);
    const auto shade_all = [&](const auto& oracle, const auto& execute) {
        constexpr std::size_t tile = 8;
        std::vector<CutResult<V>> results(receivers.size());
        execute(4, [&](std::size_t worker) {
            LightcutScratch<V> scratch;  // used for several tiles
            for (std::size_t begin = tile * worker; begin < receivers.size(); begin += 4 * tile) {
                shade(scene.forest, std::span(receivers).subspan(begin, tile), oracle,
                      std::span(results).subspan(begin, tile), scratch);
            }
        });
        return results;
    };
    const BatchedOccluders batched{scene.occluders, 0.2f};
    const ScalarOccluders scalar{scene.occluders, 0.2f};
    const auto alone = shade_all(batched, Sequential{});
    expect_same(alone, shade_all(batched, FourThreads{}));
    expect_same(alone, shade_all(scalar, FourThreads{}));
}

TEST(Threads, RefineTheSameStepByStep) {
    Scene scene(46);
    const auto receivers = scene.room.diffuse_receivers(40);
    const ScalarOccluders oracle{scene.occluders};
    const auto refine_all = [&](const auto& execute) {
        std::vector<CutResult<V>> results(receivers.size());
        execute(receivers.size(), [&](std::size_t i) {
            Lightcut cut(scene.forest, receivers[i], oracle);
            while (cut.step()) {}
            results[i] = cut.result();
        });
        return results;
    };
    expect_same(refine_all(Sequential{}), refine_all(FourThreads{}));
}

TEST(Threads, EstimateTheSameLightByLight) {
    Scene scene(47);
    const auto receivers = scene.room.glossy_receivers(40);
    const PowerDistribution distribution(scene.forest);
    const auto by_oracle = [&](const auto& oracle) {
        expect_same_by_threads(receivers.size(), [&](std::size_t i, EstimateScratch<V>& scratch) {
            return exhaustive(scene.forest, receivers[i], oracle, scratch);
        });
        expect_same_by_threads(receivers.size(), [&](std::size_t i, EstimateScratch<V>& scratch) {
            return ward(scene.forest, receivers[i], oracle, 0.1f, scratch);
        });
        expect_same_by_threads(receivers.size(), [&](std::size_t i, EstimateScratch<V>& scratch) {
            return power_sampling(scene.forest, distribution, receivers[i], oracle, 32, 7, scratch);
        });
        expect_same_by_threads(receivers.size(), [&](std::size_t i, EstimateScratch<V>& scratch) {
            return tree_sampling(scene.forest, receivers[i], oracle, 32, 7, scratch);
        });
        expect_same_by_threads(receivers.size(), [&](std::size_t i, EstimateScratch<V>& scratch) {
            return resampled_sampling(scene.forest, receivers[i], oracle, {8, 16}, 7, scratch);
        });
        expect_same_by_threads(receivers.size(), [&](std::size_t i, EstimateScratch<V>& scratch) {
            return adaptive_splitting(scene.forest, receivers[i], oracle, 0.1f, 32, 7, scratch);
        });
        expect_same_by_threads(receivers.size(), [&](std::size_t i, EstimateScratch<V>& scratch) {
            return stochastic_lightcuts(scene.forest, receivers[i], oracle, 32, 7, scratch);
        });
    };
    by_oracle(ScalarOccluders{scene.occluders});
    by_oracle(BatchedOccluders{scene.occluders, 0.3f});
}

}  // namespace
}  // namespace lightcuts::test
