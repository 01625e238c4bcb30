#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/core/box.hpp>
#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/summary.hpp>
#include <lightcuts/tree/validate.hpp>
#include "tree/build/item_sets.hpp"

namespace {

using namespace lightcuts;
using namespace lightcuts::test;

template <class Item>
auto built(const std::vector<Item>& items, const NormalizedSpace& space) {
    std::vector<decltype(build_item(items[0], 0, space))> all;
    for (const Item& item : items) all.push_back(build_item(item, static_cast<std::uint32_t>(all.size()), space));
    return all;
}

template <class Item, class S>
ClusterTree tree_in(const NormalizedSpace& space, const std::vector<Item>& items, const S& splitter) {
    auto all = built(items, space);
    DivideScratch<detail::HasAxis<Item> ? 6 : 3> scratch;
    ClusterTree tree;
    divide_into(std::span(all), splitter, space, scratch, tree);
    return tree;
}

/// Points of six dimensions as gather points are: directions of any length, weights that may be zero.
std::vector<OrientedItem> gather_points(Random& random, std::size_t count) {
    std::vector<OrientedItem> items;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 direction(random.on_sphere());
        items.push_back({glm::vec3(random.in_box(glm::dvec3(-3.0), glm::dvec3(5.0))), direction * random.real(0, 4),
                         random.chance(0.4) ? 0.0f : random.real(0, 2)});
    }
    return items;
}

TEST(DivideInto, IsDivideInTheItemsOwnSpace) {
    Random random(1);
    DivideScratch<6> scratch;
    DivideScratch<3> point_scratch;
    ClusterTree tree, point_tree;
    for (int round = 0; round < 100; ++round) {
        const ItemSet set = random_items(random, 1 + random.below(round % 10 == 0 ? 9000 : 300));
        SCOPED_TRACE(set.name);
        const auto space = NormalizedSpace::of(std::span<const OrientedItem>(set.items));
        const std::vector<PointItem> points = without_axes(set.items);
        const auto expect_same = [&](const auto& splitter) {
            auto all = built(set.items, space);
            divide_into(std::span(all), splitter, space, scratch, tree);
            ASSERT_EQ(tree, divide(set.items, splitter));
            auto all_points = built(points, space);
            divide_into(std::span(all_points), splitter, space, point_scratch, point_tree);
            ASSERT_EQ(point_tree, divide(points, splitter));
        };
        expect_same(Binned{});
        expect_same(LongestAxis{});
    }
    divide_into(std::span<BuildItem<6>>(), Binned{}, NormalizedSpace{}, scratch, tree);
    EXPECT_TRUE(tree.empty());
}

/// Checks that each inner node of `tree` is the median split of its items along the longest axis of their box, where a
/// unit of direction counts for `direction_length`. Sorts in world units.
void expect_medians(const ClusterTree& tree, const std::vector<OrientedItem>& items, double direction_length) {
    const auto coordinates = [&](std::uint32_t i) {
        const OrientedItem& item = items[i];
        std::array<double, 6> at{};
        for (int a = 0; a < 3; ++a) {
            at[static_cast<std::size_t>(a)] = static_cast<double>(item.position[a]);
            at[static_cast<std::size_t>(a + 3)] = static_cast<double>(item.axis[a]) * direction_length;
        }
        return at;
    };
    for (ClusterTree::node_index n = 0; n < tree.size(); ++n) {
        if (tree.is_leaf(n)) continue;
        const auto items_of = [&](ClusterTree::node_index root) {
            std::vector<std::uint32_t> below;
            for (ClusterTree::node_index k = tree.left_leaf(root); k <= root; ++k) {
                if (tree.is_leaf(k)) below.push_back(tree.item(k));
            }
            std::sort(below.begin(), below.end());
            return below;
        };
        std::vector<std::uint32_t> all = items_of(n);
        if (all.size() < 3) continue;
        std::size_t longest = 0;
        double length = -1;
        for (std::size_t a = 0; a < 6; ++a) {
            const auto [lo, hi] = std::minmax_element(all.begin(), all.end(), [&](std::uint32_t i, std::uint32_t j) {
                return coordinates(i)[a] < coordinates(j)[a];
            });
            const double extent = coordinates(*hi)[a] - coordinates(*lo)[a];
            if (extent > length) {
                length = extent;
                longest = a;
            }
        }
        std::sort(all.begin(), all.end(),
                  [&](std::uint32_t i, std::uint32_t j) { return coordinates(i)[longest] < coordinates(j)[longest]; });
        all.resize(all.size() / 2);
        std::sort(all.begin(), all.end());
        ASSERT_EQ(items_of(tree.left(n)), all) << n;
    }
}

TEST(DivideInto, MeasuresSixFreeCoordinatesInTheSpaceThatIsGiven) {
    Random random(2);
    for (int round = 0; round < 40; ++round) {
        const std::vector<OrientedItem> items = gather_points(random, 3 + random.below(200));
        const double scene = random.decades(0, 2);
        const NormalizedSpace space{{-3, -3, -3}, 1 / scene, 0.5};
        expect_medians(tree_in(space, items, LongestAxis{}), items, scene / 8);
        expect_medians(tree_in(space, items, LongestAxis{0.7}), items, 0.7);
        expect_medians(tree_in(space, items, LongestAxis{0.0}), items, 0);
    }
}

TEST(DivideInto, TakesZeroWeights) {
    Random random(3);
    for (int round = 0; round < 40; ++round) {
        const std::size_t count = 1 + random.below(500);
        std::vector<OrientedItem> items = gather_points(random, count);
        const NormalizedSpace space{{-3, -3, -3}, 0.05, 0.5};
        const ClusterTree tree = tree_in(space, items, Binned{});
        ASSERT_NO_THROW(validate(tree));
        ASSERT_EQ(tree.item_count(), count);
        // Items that are all dark are split as items that are all alike.
        for (OrientedItem& item : items) item.weight = 0;
        const ClusterTree dark = tree_in(space, items, Binned{});
        for (OrientedItem& item : items) item.weight = 2;
        ASSERT_EQ(dark, tree_in(space, items, Binned{}));
    }
}

TEST(DivideInto, DoesNotDependOnTheExecutor) {
    Random random(4);
    const std::vector<OrientedItem> items = gather_points(random, 30000);
    const NormalizedSpace space{{-3, -3, -3}, 0.05, 0.5};
    auto all = built(items, space);
    DivideScratch<6> scratch;
    ClusterTree tree;
    divide_into(std::span(all), Binned{}, space, scratch, tree, Backwards{});
    EXPECT_EQ(tree, tree_in(space, items, Binned{}));
}

TEST(DivideInto, RefusesImpossibleDirectionLengths) {
    Random random(5);
    const std::vector<OrientedItem> items = gather_points(random, 10);
    for (const double length : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        const std::string message = "direction_length: a length in world units, 0 or more, is needed";
        EXPECT_EQ(refusal([&] { tree_in({}, items, LongestAxis{length}); }), message);
        EXPECT_EQ(refusal([&] { tree_in({}, items, Binned{.direction_length = length}); }), message);
    }
}

/// What Binned makes small: the sum over the inner nodes of weight x (diagonal of the positions' box + `length` x that
/// of the directions').
double cost(const ClusterTree& tree, const std::vector<OrientedItem>& items, double length) {
    struct Extent {
        Box positions, directions;
        double weight;
    };
    const auto extents = summarize(
        tree,
        [&](std::uint32_t i) {
            return Extent{box_of(items[i].position), box_of(items[i].axis), static_cast<double>(items[i].weight)};
        },
        [](const Extent& a, const Extent& b) {
            return Extent{merge(a.positions, b.positions), merge(a.directions, b.directions), a.weight + b.weight};
        });
    double sum = 0;
    for (const Extent& e : extents) {
        sum += e.weight * (std::sqrt(diagonal2(e.positions)) + length * std::sqrt(diagonal2(e.directions)));
    }
    return sum;
}

TEST(Binned, TakesTheSizeOfDirectionsInWorldUnits) {
    Random random(6);
    for (int round = 0; round < 10; ++round) {
        const std::vector<OrientedItem> items = room_items(random, 1000, 0.3);
        const double diagonal = 1 / NormalizedSpace::of(std::span<const OrientedItem>(items)).per_length;
        const double own = diagonal / 20, of_scene = diagonal;
        const ClusterTree alone = divide(items), in_scene = divide(items, Binned{.direction_length = of_scene});
        EXPECT_LT(cost(alone, items, own), cost(in_scene, items, own));
        EXPECT_LT(cost(in_scene, items, of_scene), cost(alone, items, of_scene));
        // The same lights where the scene is the unit of the space.
        const NormalizedSpace space{{0, 0, 0}, 1 / (20 * of_scene), 1};
        const double in_space = cost(tree_in(space, items, Binned{}), items, of_scene);
        EXPECT_NEAR(in_space, cost(in_scene, items, of_scene), 0.01 * in_space);
    }
}

}  // namespace
