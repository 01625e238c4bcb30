#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/product/gather.hpp>
#include "product/gather_scene.hpp"
#include "support/allocations.hpp"

namespace lightcuts::test {
namespace {

TEST(GatherAllocation, DoesNotHappenOnceTreesAndScratchAreWarm) {
    Random random(1);
    Room<V> room(1);
    const auto still = room.oriented(300);
    const auto moving = at_instants(room.omni(300), 4);
    std::vector<InstantLight<VirtualPointLight<V>>> moving_virtual;
    for (std::uint32_t i = 0; i < still.size(); ++i) moving_virtual.push_back({{still[i]}, i % 4});
    const LightTree still_tree(still), other_tree(still);
    const LightTree moving_tree(moving);
    const LightTree virtual_tree(moving_virtual);
    const LightForest forest(still_tree, moving_tree, virtual_tree);
    const TimedForest timed(forest, 4);
    const auto occluders = room.occluders();
    const ScalarOccluders scalar{occluders};
    const BatchedOccluders batched{occluders};
    const auto diffuse = at_instants(diffuse_points(random, 60, 0.2, 0.5), 4);
    const auto glossy = at_instants(glossy_points(random, 60, 0.2, 0.5), 4);
    GatherForest<InstantGatherPoint<Lambert<V>, V>, InstantGatherPoint<ModifiedPhong<V>, V>> points;
    gather_scratch_of<decltype(timed)> one, other;
    gather_scratch_of<decltype(other_tree)> still_scratch;
    const ProductOptions redraw{.redraw = true};
    const ProductOptions clamped{.cut = {.clamp = automatic_clamping}};
    const auto everything = [&] {
        points.build(diffuse, glossy, {.instants = 4});
        gather(timed, points, scalar, one);
        gather(timed, points, batched, other);
        gather(timed, points, batched, other, redraw);
        gather(timed, points, batched, other, clamped);
        gather(other_tree, points, batched, still_scratch);
    };
    everything();
    const std::size_t before = allocations;
    everything();
    EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace lightcuts::test
