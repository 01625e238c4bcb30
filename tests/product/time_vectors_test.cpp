#include <lightcuts/product/time_vectors.hpp>

#include <cstdint>
#include <map>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include <lightcuts/product/gather.hpp>
#include "product/gather_scene.hpp"

namespace lightcuts::test {
namespace {

struct Leaves {
    std::vector<PointItem> items;
    std::vector<std::uint32_t> instants;
    std::vector<float> values;

    Leaves(std::size_t n, std::uint32_t t, std::uint64_t seed) {
        Random random(seed);
        for (std::size_t i = 0; i < n; ++i) {
            values.push_back(random.real(0.1, 2.0));
            instants.push_back(static_cast<std::uint32_t>(random.below(t)));
            items.push_back({V(random.in_box({0, 0, 0}, {1, 1, 1})), values.back()});
        }
    }
    TimeVectors<float> vectors(const ClusterTree& tree, std::uint32_t t) const {
        TimeVectors<float> vectors;
        vectors.build(
            tree, t, [&](std::uint32_t i) { return instants[i]; }, [&](std::uint32_t i) { return values[i]; });
        return vectors;
    }
    /// What stands below `n` at each instant.
    std::map<std::uint32_t, double> below(const ClusterTree& tree, std::uint32_t n) const {
        std::map<std::uint32_t, double> sum;
        for (std::uint32_t d = tree.left_leaf(n); d <= n; ++d) {
            if (tree.is_leaf(d)) sum[instants[tree.item(d)]] += static_cast<double>(values[tree.item(d)]);
        }
        return sum;
    }
};

TEST(TimeVectors, AreTheSumsOfTheLeavesAtEachInstant) {
    for (const std::uint32_t t : {1u, 3u, 16u, 200u}) {
        const Leaves leaves(150, t, t);
        const ClusterTree tree = divide(std::span<const PointItem>(leaves.items));
        const auto vectors = leaves.vectors(tree, t);
        for (std::uint32_t n = 0; n < tree.size(); ++n) {
            const auto sums = leaves.below(tree, n);
            ASSERT_EQ(vectors.count(n), sums.size());
            for (std::uint32_t i = 0; i < t; ++i) {
                const auto at = sums.find(i);
                const double expected = at == sums.end() ? 0.0 : at->second;
                EXPECT_NEAR(static_cast<double>(vectors.at(n, i)), expected, 1e-5 * expected);
            }
        }
    }
}

TEST(TimeVectors, CommonInstantsAreThoseOfBoth) {
    const Leaves a(60, 24, 1), b(300, 24, 2);
    const ClusterTree tree_a = divide(std::span<const PointItem>(a.items)),
                      tree_b = divide(std::span<const PointItem>(b.items));
    const auto of_a = a.vectors(tree_a, 24), of_b = b.vectors(tree_b, 24);
    for (std::uint32_t m = 0; m < tree_a.size(); m += 3) {
        for (std::uint32_t n = 0; n < tree_b.size(); n += 7) {
            double expected = 0, found = 0;
            for (const auto& [t, value] : a.below(tree_a, m)) {
                const auto sums = b.below(tree_b, n);
                if (sums.contains(t)) expected += value * sums.at(t);
            }
            detail::for_each_common(of_a, m, of_b, n, [&](std::uint32_t, float x, float y) {
                found += static_cast<double>(x) * static_cast<double>(y);
            });
            EXPECT_NEAR(found, expected, 1e-4 * expected);
        }
    }
}

TEST(TimeVectors, OfMovingLightsNeedLittleMemory) {
    Random random(4);
    std::vector<InstantLight<OmniLight<V>>> lights;
    for (int i = 0; i < 100'000; ++i) {
        lights.push_back({{V(random.in_box({0, 0, 0}, {1, 1, 1})), V(1.0f), {}}, static_cast<std::uint32_t>(i % 256)});
    }
    const LightTree tree(lights);
    const LightForest forest(tree);
    const TimedForest timed(forest, 256);
    EXPECT_LE(timed.memory_bytes(), 64u << 20);
    EXPECT_GE(timed.memory_bytes(), 100'000u * sizeof(V));
}

TEST(TimeVectors, RefuseAnInstantThatThereIsNot) {
    const Leaves leaves(5, 8, 1);
    const ClusterTree tree = divide(std::span<const PointItem>(leaves.items));
    EXPECT_THROW(leaves.vectors(tree, 1), invalid_input);
    EXPECT_THROW(leaves.vectors(tree, 0), invalid_input);
    EXPECT_THROW(leaves.vectors(tree, 70'000), invalid_input);
}

// Where there is one instant, nothing of time is stored.
static_assert(std::same_as<gather_scratch_of<LightTree<OmniLight<V>>>,
                           gather_scratch_of<TimedForest<InstantLight<OmniLight<V>>>>>);
static_assert(sizeof(TimedForest<OmniLight<V>>) <= sizeof(LightForest<OmniLight<V>>) + 8);

}  // namespace
}  // namespace lightcuts::test
