#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/forest.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

TEST(LightForest, VisitsItsTreesInOrder) {
    Room<glm::vec3> room(1);
    const auto omni = room.omni(3);
    const auto distant = room.distant(4);
    const auto spot = room.spot(5);
    const LightTree a(omni);
    const LightTree b(distant);
    const LightTree c(spot);
    const LightForest forest(a, b, c);
    static_assert(decltype(forest)::kinds == 3);
    static_assert(std::same_as<decltype(forest)::spectrum, glm::vec3>);

    std::vector<std::size_t> sizes;
    forest.for_each([&](std::uint32_t kind, const auto& tree) {
        EXPECT_EQ(kind, sizes.size());
        sizes.push_back(tree.lights().size());
    });
    EXPECT_EQ(sizes, (std::vector<std::size_t>{3, 4, 5}));
    for (std::uint32_t kind = 0; kind < 3; ++kind) {
        EXPECT_EQ(forest.visit(kind, [](const auto& tree) { return tree.lights().size(); }), sizes[kind]);
    }
}

TEST(LightForest, CountsOnlyLitTrees) {
    Room<glm::vec3> room(2);
    auto omni = room.omni(3);
    const LightTree lit(omni);
    const std::vector<DistantLight<>> none;
    const LightTree empty(none);
    std::vector<SpotLight<>> dark(2);
    const LightTree black(dark);
    EXPECT_EQ(LightForest(lit, empty, black).root_count(), 1u);
    EXPECT_EQ(LightForest(empty).root_count(), 0u);
}

TEST(LightForest, TakesThePlaceOfItsTreesOnly) {
    static_assert(sizeof(LightForest<OmniLight<>>) == sizeof(void*));
    static_assert(sizeof(LightForest<OmniLight<>, DistantLight<>>) == 2 * sizeof(void*));
    static_assert(std::is_trivially_copy_constructible_v<LightForest<OmniLight<>>>);
}

}  // namespace
}  // namespace lightcuts::test
