#include <lightcuts/tree/validate.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/light/omni.hpp>
#include <lightcuts/tree/light_tree.hpp>
#include <lightcuts/tree/summary.hpp>

#include "tree/build/item_sets.hpp"

namespace {

using namespace lightcuts;
using lightcuts::test::refusal;

constexpr std::uint32_t leaf(std::uint32_t item) { return ClusterTree::leaf_word(item); }

std::string message(const std::vector<std::uint32_t>& words) {
    return refusal([&] { validate(ClusterTree(words)); });
}

TEST(Validate, AcceptsValidTrees) {
    EXPECT_EQ(message({}), "");
    EXPECT_EQ(message({leaf(0)}), "");
    EXPECT_EQ(message({leaf(1), leaf(0), 0}), "");
    EXPECT_EQ(message({leaf(0), leaf(3), 0, leaf(2), leaf(1), 3, 0}), "");
    EXPECT_EQ(message({leaf(0), leaf(1), leaf(2), 1, 0}), "");
    EXPECT_EQ(message({leaf(0), leaf(1), leaf(2), 0}), "");
    EXPECT_EQ(message({leaf(0), leaf(1), leaf(3), leaf(2), 2, 0}), "");
}

TEST(Validate, NamesTheFirstNodeThatIsWrong) {
    EXPECT_EQ(message({leaf(0), leaf(1)}), "cluster tree, node 1: the last node is not the root of all others");
    EXPECT_EQ(message({0}), "cluster tree, node 0: an inner node needs two complete subtrees before it");
    EXPECT_EQ(message({leaf(0), 0, leaf(1)}),
              "cluster tree, node 1: an inner node needs two complete subtrees before it");
    EXPECT_EQ(message({leaf(0), leaf(2), 0}), "cluster tree, node 1: item 2 is out of range");
    EXPECT_EQ(message({leaf(1), leaf(1), 0}), "cluster tree, node 1: item 1 occurs twice");
    EXPECT_EQ(message({leaf(0), leaf(1), 1}),
              "cluster tree, node 2: its first leaf is said to be node 1, which leaves it one child");
    EXPECT_EQ(message({leaf(0), leaf(1), 0, leaf(2), 1}),
              "cluster tree, node 4: its first leaf is said to be node 1, which is not that of a complete subtree");
    EXPECT_EQ(message({leaf(0), leaf(1), 7}),
              "cluster tree, node 2: its first leaf is said to be node 7, which is not that of a complete subtree");
    EXPECT_EQ(message({leaf(0), leaf(1), leaf(2), 0, 0}),
              "cluster tree, node 4: an inner node needs two complete subtrees before it");
}

TEST(Validate, AcceptsTreesOfSomeOfTheItems) {
    const auto message = [](const std::vector<std::uint32_t>& words, std::size_t bound) {
        return refusal([&] { validate(ClusterTree(words, bound)); });
    };
    EXPECT_EQ(message({leaf(0), leaf(2), 0}, 3), "");
    EXPECT_EQ(message({leaf(7)}, 1000), "");
    EXPECT_EQ(message({leaf(0), leaf(3), 0}, 3), "cluster tree, node 1: item 3 is out of range");
    EXPECT_EQ(message({leaf(2), leaf(2), 0}, 3), "cluster tree, node 1: item 2 occurs twice");
}

TEST(Validate, AcceptsLightTreesWithDarkLights) {
    for (unsigned lit = 0; lit < 32; ++lit) {
        std::vector<OmniLight<>> lights(5);
        for (unsigned i = 0; i < lights.size(); ++i) {
            lights[i].position = {static_cast<float>(i), static_cast<float>(i * i), 0.0f};
            lights[i].intensity = glm::vec3((lit >> i & 1u) != 0 ? 1.0f : 0.0f);
        }
        const LightTree tree(lights);
        EXPECT_EQ(refusal([&] { validate(tree.topology()); }), "") << lit;
        EXPECT_LE(tree.topology().item_bound(), lights.size());
        const auto sums = summarize(
            tree.topology(), [&](std::uint32_t light) { return lights[light].position.x; },
            [](float a, float b) { return a + b; });
        const auto agrees = [](float sum, float left, float right) { return sum == left + right; };
        EXPECT_EQ(refusal([&] { validate(tree.topology(), sums, agrees); }), "") << lit;
    }
}

TEST(Validate, AnUnfinishedTreeIsRefused) {
    // Three leaves need two inner nodes; a leaf in the place of the root also repeats or exceeds the items.
    EXPECT_NE(message({leaf(0), leaf(1), leaf(2)}), "");
}

TEST(Validate, ChecksSummaries) {
    const ClusterTree tree({leaf(0), leaf(3), 0, leaf(2), leaf(1), 3, 0});
    auto sums = summarize(
        tree, [](std::uint32_t item) { return static_cast<int>(item) + 1; }, [](int a, int b) { return a + b; });
    const auto agrees = [](int sum, int left, int right) { return sum == left + right; };
    EXPECT_NO_THROW(validate(tree, sums, agrees));
    sums[5] += 1;
    EXPECT_EQ(refusal([&] { validate(tree, sums, agrees); }),
              "cluster tree, node 5: its summary disagrees with its children");
    sums.pop_back();
    EXPECT_EQ(refusal([&] { validate(tree, sums, agrees); }), "cluster tree: 7 nodes, but 6 summaries");
}

}  // namespace
