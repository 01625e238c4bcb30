#include <vector>

#include <gtest/gtest.h>

#include "archetypes/unset_scene.hpp"

// As unset_estimate_test.cpp, of what goes by bounds.
namespace lightcuts::test {
namespace {

template <class L, class M>
void expect_cuts(const std::vector<L>& lights, const M& material) {
    const LightTree<L> tree(lights);
    const Receiver receiver(glm::vec3(0.0f), material, glm::vec3(0.0f, 0.0f, 0.01f));
    const Unset expected = brute_force(lights, receiver);
    const auto scalar = [](const auto&, const auto&) { return true; };
    const LeastBatchedOracle batched;
    const auto check = [&](const auto& policy) {
        const LightcutOptions all{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0};
        expect_near(shade(tree, receiver, scalar, all, policy).radiance, expected);
        expect_near(shade(tree, receiver, batched, all, policy).radiance, expected);

        const LightcutOptions loose{.error_ratio = 0.1f, .exhaustive_below = 0};
        const auto cut = shade(tree, receiver, scalar, loose, policy);
        for (int c = 0; c < 2; ++c) {
            const float error = std::fabs(cut.radiance[c] - expected[c]);
            EXPECT_LE(error, cut.error_bound[c] + 1e-5f * expected[c]);
        }
        expect_near(stochastic_lightcuts(tree, receiver, scalar, 64, 1, policy).radiance, expected);
        expect_near(adaptive_splitting(tree, receiver, scalar, 0.0f, 64, 1, policy).radiance, expected);
        const Unset sampled = tree_sampling(tree, receiver, scalar, 16, 1, policy).radiance;
        for (int c = 0; c < 2; ++c) EXPECT_GE(sampled[c], 0.0f);
    };
    check(TwoStageBounds{});
    check(TwoStageBounds{.tight_band = 2.0});
    check(SeparateBounds{});
}

TEST(UnsetSpectrum, IsShadedByCutsOfEveryMaterial) {
    const UnsetScene scene;
    for_each_unset_material([&](const auto& material) {
        expect_cuts(scene.bulbs, material);
        expect_cuts(scene.lamps, material);
        expect_cuts(scene.suns, material);
    });
}

TEST(UnsetSpectrum, CutsThroughNoLightsAreBlack) {
    const std::vector<OmniLight<Unset>> none(3);
    const LightTree tree(none);
    const Receiver receiver(glm::vec3(0.0f), Lambert<Unset>{{0.0f, 0.0f, 1.0f}, {0.5f, 0.5f}});
    const auto cut = shade(tree, receiver);
    EXPECT_TRUE(is_black(cut.radiance));
    EXPECT_TRUE(is_black(cut.error_bound));
}

TEST(UnsetSpectrum, IsClampedInCuts) {
    std::vector<VirtualPointLight<Unset>> lights(32);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].position = {0.1f * static_cast<float>(i % 5), 0.2f, 0.3f + 0.1f * static_cast<float>(i)};
        lights[i].axis = {0.0f, 0.0f, -1.0f};
        lights[i].intensity = {1.0f, 2.0f};
    }
    const LightTree tree(lights);
    const Receiver receiver(glm::vec3(0.0f), Lambert<Unset>{{0.0f, 0.0f, 1.0f}, {0.5f, 0.5f}});
    const LightcutOptions all{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0};
    expect_near(shade(tree, receiver, AlwaysVisible{}, all).radiance, exhaustive(tree, receiver).radiance);
}

}  // namespace
}  // namespace lightcuts::test
