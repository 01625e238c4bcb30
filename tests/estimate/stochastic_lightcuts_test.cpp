#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/estimate/stochastic_lightcuts.hpp>
#include "estimate/unbiasedness.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

TEST(StochasticLightcuts, IsUnbiased) {
    for (const std::uint32_t samples : {3u, 16u}) {
        expect_unbiased(
            [&](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed, auto& scratch) {
                return stochastic_lightcuts(forest, receiver, oracle, samples, seed, scratch);
            });
    }
}

// The cut is all leaves then.
TEST(StochasticLightcuts, IsExactWithASampleForEachLight) {
    Random random(4);
    std::vector<OmniLight<>> lights(40);
    for (auto& l : lights) l = {V(random.in_box({-1, -1, -1}, {1, 1, 3})), V(random.real(0.1, 1.0)), {}};
    expect_exact_sum(lights, [](const auto& forest, const auto& receiver, auto& scratch) {
        return stochastic_lightcuts(forest, receiver, AlwaysVisible{}, 40, 1, scratch);
    });
}

// Clusters that cannot contribute take no room of the cut: half of the lights are behind the surface.
TEST(StochasticLightcuts, SpendsNoSamplesOnWhatCannotContribute) {
    std::vector<OmniLight<>> lights(64);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const float z = i % 2 == 0 ? 1.0f : -1.0f;
        lights[i] = {{0.1f * static_cast<float>(i), 0.0f, z}, V(1.0f), {}};
    }
    expect_exact_sum(lights, [](const auto& forest, const auto& receiver, auto& scratch) {
        return stochastic_lightcuts(forest, receiver, AlwaysVisible{}, 33, 1, scratch);
    });
}

// What the oracle answers changes nothing in the choice of the cut and of the lights.
TEST(StochasticLightcuts, ChoosesByBoundsAlone) {
    Room<V> room(6);
    const auto lights = room.oriented(500);
    const LightTree tree(lights);
    for (const auto& receiver : room.glossy_receivers(5)) {
        std::vector<const OrientedPointLight<V>*> seen, unseen;
        const auto visible = [&](const auto&, const auto& light) { return seen.push_back(&light), true; };
        const auto hidden = [&](const auto&, const auto& light) { return unseen.push_back(&light), false; };
        stochastic_lightcuts(tree, receiver, visible, 32, 1);
        EXPECT_EQ(stochastic_lightcuts(tree, receiver, hidden, 32, 1).radiance, V(0.0f));
        EXPECT_EQ(seen, unseen);
    }
}

TEST(StochasticLightcuts, IsDeterministic) {
    expect_deterministic(
        [](const auto& forest, const auto& receiver, const auto& oracle, std::uint64_t seed, auto& scratch) {
            return stochastic_lightcuts(forest, receiver, oracle, 16, seed, scratch);
        });
}

TEST(StochasticLightcuts, OfDarknessIsBlack) {
    expect_black_where_nothing_shines([](const auto& forest, const auto& receiver, auto& scratch) {
        return stochastic_lightcuts(forest, receiver, AlwaysVisible{}, 16, 1, scratch);
    });
}

}  // namespace
}  // namespace lightcuts::test
