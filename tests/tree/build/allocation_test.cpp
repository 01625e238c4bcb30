#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/representatives.hpp>
#include "support/allocations.hpp"
#include "tree/build/item_sets.hpp"

namespace lightcuts::test {
namespace {

TEST(DivideInto, AndRepresentativesDoNotAllocateOnceWarm) {
    Random random(1);
    const NormalizedSpace space{{0, 0, 0}, 0.1, 1};
    std::vector<BuildItem<6>> items;
    DivideScratch<6> scratch;
    ClusterTree tree;
    Representatives representatives;
    const std::vector<double> weights(40000, 1.0);
    const auto everything = [&] {
        for (const std::size_t count : {std::size_t{256}, std::size_t{1}, std::size_t{20000}, std::size_t{0}}) {
            items.clear();
            for (std::uint32_t i = 0; i < count; ++i) {
                const glm::vec3 position(random.in_box(glm::dvec3(0.0), glm::dvec3(10.0)));
                items.push_back(build_item(OrientedItem{position, glm::vec3(random.on_sphere()), 1.0f}, i, space));
            }
            divide_into(std::span(items), Binned{}, space, scratch, tree);
            divide_into(std::span(items), LongestAxis{}, space, scratch, tree);
            for (const unsigned limit : {1u, 4u}) {
                representatives.choose(tree, std::span(weights).first(tree.size()), limit, 1);
            }
        }
    };
    everything();
    const std::size_t before = allocations;
    everything();
    EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace lightcuts::test
