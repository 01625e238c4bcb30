#include <lightcuts/tree/build/divide.hpp>

#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/tree/build/agglomerate.hpp>
#include <lightcuts/tree/statistics.hpp>
#include <lightcuts/tree/summary.hpp>
#include <lightcuts/tree/validate.hpp>

#include "tree/build/item_sets.hpp"

namespace {

using namespace lightcuts;
using namespace lightcuts::test;

std::size_t ceil_log2(std::size_t n) { return static_cast<std::size_t>(std::bit_width(n - 1)); }

TEST(Divide, NoItemsMakeAnEmptyTree) {
    EXPECT_TRUE(divide(std::vector<PointItem>{}).empty());
    EXPECT_TRUE(divide(std::vector<OrientedItem>{}, LongestAxis{}).empty());
}

TEST(Divide, OneItemIsALeaf) {
    const ClusterTree tree = divide(std::vector<PointItem>{{{1, 2, 3}, 1}});
    ASSERT_EQ(tree.size(), 1u);
    EXPECT_EQ(tree.item(tree.root()), 0u);
}

TEST(Divide, TreesAreValid) {
    Random random(1);
    for (int round = 0; round < 300; ++round) {
        const ItemSet set = random_items(random, 1 + random.below(round % 10 == 0 ? 3000 : 100));
        SCOPED_TRACE(set.name);
        const std::vector<PointItem> points = without_axes(set.items);
        for (const ClusterTree& tree :
             {divide(set.items), divide(points), divide(set.items, Binned{16}), divide(points, Binned{16}),
              divide(set.items, LongestAxis{}), divide(points, LongestAxis{})}) {
            ASSERT_EQ(tree.item_count(), set.items.size());
            ASSERT_NO_THROW(validate(tree));
            ASSERT_LE(statistics(tree, points).depth_max, 3 * ceil_log2(set.items.size()) + 20);
        }
    }
}

TEST(Divide, DoesNotDependOnTheExecutor) {
    Random random(2);
    const std::vector<OrientedItem> items = room_items(random, 30000, 0.2);
    const std::vector<PointItem> points = without_axes(items);
    EXPECT_EQ(divide(items), divide(items, Binned{}, TwoThreads{}));
    EXPECT_EQ(divide(items), divide(items, Binned{}, Backwards{}));
    EXPECT_EQ(divide(points), divide(points, Binned{}, TwoThreads{}));
    EXPECT_EQ(divide(points, LongestAxis{}), divide(points, LongestAxis{}, TwoThreads{}));
}

TEST(Divide, CoincidentItemsMakeABalancedTree) {
    for (const std::size_t count : {2u, 3u, 1000u, 40000u}) {
        const std::vector<OrientedItem> items(count, {{1, 2, 3}, {0, 1, 0}, 2});
        const std::vector<PointItem> points = without_axes(items);
        EXPECT_EQ(statistics(divide(items), points).depth_max, ceil_log2(count));
        EXPECT_EQ(statistics(divide(points), points).depth_max, ceil_log2(count));
    }
}

TEST(Divide, SetsMadeToBePeeledStayShallow) {
    // Each item is a sixteenth of the way to the next, and heavier: the binned splitter takes off one at a time.
    std::vector<PointItem> items;
    for (int i = 0; i < 120; ++i) items.push_back({{std::exp2(static_cast<float>(i - 60)), 0, 0}, 1});
    for (int i = 0; i < 120; ++i) items.push_back({{0, std::exp2(static_cast<float>(i - 60)), 0}, 1});
    const ClusterTree tree = divide(items);
    validate(tree);
    EXPECT_LE(statistics(tree, items).depth_max, 3 * ceil_log2(items.size()) + 20);
}

TEST(Divide, DenormalExtentsTerminate) {
    std::vector<PointItem> items(40, {{0, 0, 0}, 1});
    for (std::size_t i = 0; i < items.size(); ++i) items[i].position.x = 1e-44f * static_cast<float>(i);
    items.push_back({{1, 1, 1}, 1});
    const ClusterTree tree = divide(items);
    EXPECT_NO_THROW(validate(tree));
    std::vector<OrientedItem> oriented;
    for (const PointItem& i : items) oriented.push_back({{0, 0, 0}, {i.position.x, 0, 1}, 1});
    oriented.back().axis = {0, 1, 0};
    EXPECT_NO_THROW(validate(divide(oriented)));
}

TEST(Divide, LargestCoordinatesDoNotOverflow) {
    constexpr float huge = std::numeric_limits<float>::max();
    const std::vector<PointItem> items{{{-huge, 0, 0}, huge}, {{huge, 1, 0}, huge}, {{huge, 0, huge}, 1e-40f}};
    EXPECT_NO_THROW(validate(divide(items)));
    EXPECT_NO_THROW(validate(agglomerate(items)));
}

TEST(Divide, FarGroupsPartAtTheRoot) {
    Random random(3);
    std::vector<PointItem> items;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 p(random.in_box(glm::dvec3(0.0), glm::dvec3(1.0)));
        items.push_back({i % 3 == 0 ? p : p + glm::vec3(0, 50, 0), 1});
    }
    const ClusterTree tree = divide(items);
    EXPECT_EQ(std::min(tree.leaf_count(tree.left(tree.root())), tree.leaf_count(tree.right(tree.root()))), 100u);
}

TEST(Divide, OppositeLightsAtTheSamePlacesPart) {
    Random random(4);
    std::vector<OrientedItem> items;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 p(random.in_box(glm::dvec3(0.0), glm::dvec3(1.0, 1.0, 0.0)));
        items.push_back({p, {0, 0, i % 2 == 0 ? 1.0f : -1.0f}, 1});
    }
    items.push_back({{20, 20, 20}, {0, 0, 1}, 1});
    const ClusterTree tree = divide(items);
    ClusterTree::node_index near = tree.left(tree.root());
    if (tree.is_leaf(near)) near = tree.right(tree.root());
    ASSERT_EQ(tree.leaf_count(near), 200u);
    std::size_t odd = 0;
    for (ClusterTree::node_index k = tree.left_leaf(tree.left(near)); k <= tree.left(near); ++k) {
        if (tree.is_leaf(k)) odd += tree.item(k) % 2;
    }
    EXPECT_EQ(tree.leaf_count(tree.left(near)), 100u);
    EXPECT_EQ(odd % 100, 0u);
}

/// What Binned makes small: the sum over the inner nodes of intensity x (diagonal of the positions' box + a twentieth
/// of that of the axes'), in units of all items' diagonal.
double oriented_cost(const ClusterTree& tree, const std::vector<OrientedItem>& items) {
    struct Extent {
        Box positions, axes;
        double weight;
    };
    const auto extents = summarize(
        tree,
        [&](std::uint32_t i) {
            return Extent{box_of(items[i].position), box_of(items[i].axis), static_cast<double>(items[i].weight)};
        },
        [](const Extent& a, const Extent& b) {
            return Extent{merge(a.positions, b.positions), merge(a.axes, b.axes), a.weight + b.weight};
        });
    const double unit = std::sqrt(diagonal2(extents[tree.root()].positions));
    double cost = 0;
    for (const Extent& e : extents) {
        cost += e.weight * (std::sqrt(diagonal2(e.positions)) / unit + 0.05 * std::sqrt(diagonal2(e.axes)));
    }
    return cost;
}

TEST(Divide, BinnedTreesAreSmall) {
    Random random(5);
    for (const double jitter : {0.0, 0.3}) {
        const std::vector<OrientedItem> items = room_items(random, 3000, jitter);
        const double binned = oriented_cost(divide(items), items);
        EXPECT_LT(binned, 0.95 * oriented_cost(divide(items, LongestAxis{}), items));
        EXPECT_LT(binned, oriented_cost(agglomerate(items), items));
        const std::vector<PointItem> points = without_axes(items);
        EXPECT_LT(statistics(divide(points), points).cost, statistics(agglomerate(points), points).cost);
    }
}

TEST(Divide, ASampleIsAsGoodAsAllItems) {
    Random random(6);
    const std::vector<OrientedItem> items = room_items(random, 20000, 0.1);
    const double all = oriented_cost(divide(items, Binned{0}), items);
    EXPECT_LT(oriented_cost(divide(items, Binned{1024}), items), 1.05 * all);
}

TEST(Divide, LongestAxisHalvesTheNumberOfItems) {
    Random random(7);
    for (const std::size_t count : {2u, 5u, 64u, 65u, 1000u}) {
        const std::vector<OrientedItem> items = room_items(random, count, 1.0);
        EXPECT_EQ(statistics(divide(items, LongestAxis{}), items).depth_max, ceil_log2(count));
    }
}

TEST(Divide, ReportsProgressUpToTheNumberOfItems) {
    Random random(8);
    const std::vector<OrientedItem> items = room_items(random, 20000, 0.0);
    std::atomic<std::size_t> done = 0, calls = 0;
    divide(items, Binned{}, TwoThreads{}, [&](std::size_t n) {
        done += n;
        ++calls;
    });
    EXPECT_EQ(done, items.size());
    EXPECT_GT(calls, 2u);
    done = 0;
    agglomerate(items, ClusterSize{}, TwoThreads{}, [&](std::size_t n) { done += n; });
    EXPECT_EQ(done, items.size());
}

TEST(Divide, RefusesBadItemsByIndex) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const OrientedItem good{{0, 0, 0}, {0, 0, 1}, 1};
    const auto message = [&](const OrientedItem& bad) {
        const std::vector<OrientedItem> items{good, good, bad, good};
        std::string divided = refusal([&] { divide(items); });
        EXPECT_EQ(divided, refusal([&] { agglomerate(items); }));
        return divided;
    };
    EXPECT_EQ(message(good), "");
    for (const float x : {inf, -inf, nan}) {
        EXPECT_EQ(message({{0, x, 0}, {0, 0, 1}, 1}), "item 2: the position is not finite");
    }
    for (const float w : {0.0f, -1.0f, inf, nan}) {
        EXPECT_EQ(message({{0, 0, 0}, {0, 0, 1}, w}),
                  "item 2: the weight is not positive and finite; leave out lights that are dark");
    }
    for (const glm::vec3 a : {glm::vec3(0, 0, 0), glm::vec3(0, 0, 2), glm::vec3(0, nan, 1), glm::vec3(inf, 0, 0)}) {
        EXPECT_EQ(message({{0, 0, 0}, a, 1}), "item 2: the axis is not a unit vector");
    }
}

}  // namespace
