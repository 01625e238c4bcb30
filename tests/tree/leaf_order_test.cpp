#include <lightcuts/tree/leaf_order.hpp>

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/build/longest_axis.hpp>
#include <lightcuts/tree/validate.hpp>
#include "support/random.hpp"

namespace lightcuts::test {
namespace {

TEST(LeafOrder, NumbersItemsFromLeftToRightAndKeepsTheTree) {
    Random random(1);
    for (const std::size_t count : {0u, 1u, 2u, 100u}) {
        std::vector<PointItem> points;
        for (std::size_t i = 0; i < count; ++i) points.push_back({glm::vec3(random.on_sphere()), 1.0f});
        const ClusterTree tree = divide(points, LongestAxis{});
        const LeafOrder ordered = in_leaf_order(tree);
        validate(ordered.tree);
        ASSERT_EQ(ordered.tree.size(), tree.size());
        ASSERT_EQ(ordered.items.size(), count);
        std::uint32_t next = 0;
        for (ClusterTree::node_index n = 0; n < tree.size(); ++n) {
            ASSERT_EQ(ordered.tree.is_leaf(n), tree.is_leaf(n));
            ASSERT_EQ(ordered.tree.left_leaf(n), tree.left_leaf(n));
            if (!tree.is_leaf(n)) continue;
            EXPECT_EQ(ordered.tree.item(n), next);
            EXPECT_EQ(ordered.items[next++], tree.item(n));
        }
    }
}

}  // namespace
}  // namespace lightcuts::test
