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
#include "support/allocations.hpp"
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

TEST(Allocation, DoesNotHappenOnceTheScratchIsWarm) {
    using V = glm::vec3;
    Room<V> room(1);
    const auto lights = room.oriented(500);
    const LightTree tree(lights, {.representatives = 4});
    const LightForest forest(tree);
    const PowerDistribution distribution(forest);
    const Occluders occluders = room.occluders();
    const BatchedOccluders batched{occluders};
    const ScalarOccluders scalar{occluders};
    const auto receivers = room.glossy_receivers(32);
    const std::span all(receivers);
    std::vector<CutResult<V>> results(receivers.size());
    LightcutScratch<V> one, other;
    EstimateScratch<V> estimates;
    const auto everything = [&] {
        shade(forest, all, batched, std::span(results), one);
        shade(forest, all, scalar, std::span(results), other);
        for (const auto& receiver : receivers) {
            exhaustive(forest, receiver, batched, estimates);
            ward(forest, receiver, batched, 0.1f, estimates);
            power_sampling(forest, distribution, receiver, batched, 64, 1, estimates);
            tree_sampling(forest, receiver, batched, 64, 1, estimates);
            resampled_sampling(forest, receiver, batched, {16, 8}, 1, estimates);
            adaptive_splitting(forest, receiver, batched, 0.1f, 64, 1, estimates);
            stochastic_lightcuts(forest, receiver, batched, 64, 1, estimates);
        }
    };
    everything();
    const std::size_t before = allocations;
    everything();
    EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace lightcuts::test
