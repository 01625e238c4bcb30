#include <span>

#include <gtest/gtest.h>

#include "archetypes/unset_scene.hpp"

// Nothing that is not set is ever read: the default constructor of these spectra leaves what is no number.
namespace lightcuts::test {
namespace {

template <class L, class M>
void expect_estimates(const std::vector<L>& lights, const M& material) {
    const LightTree<L> tree(lights);
    const Receiver receiver(glm::vec3(0.0f), material, glm::vec3(0.0f, 0.0f, 0.01f));
    const Unset expected = brute_force(lights, receiver);
    const auto scalar = [](const auto&, const auto&) { return true; };
    expect_near(exhaustive(tree, receiver).radiance, expected);
    expect_near(exhaustive(tree, receiver, scalar).radiance, expected);
    expect_near(exhaustive(tree, receiver, LeastBatchedOracle()).radiance, expected);
    expect_near(ward(tree, receiver, scalar, 0.0f).radiance, expected);
    const Unset sampled = power_sampling(tree, PowerDistribution(tree), receiver, scalar, 16, 1).radiance;
    for (int c = 0; c < 2; ++c) EXPECT_GE(sampled[c], 0.0f);
}

TEST(UnsetSpectrum, IsSummedUpByEveryMaterial) {
    const UnsetScene scene;
    for_each_unset_material([&](const auto& material) {
        expect_estimates(scene.bulbs, material);
        expect_estimates(scene.lamps, material);
        expect_estimates(scene.suns, material);
    });
}

TEST(UnsetSpectrum, BoundsAreNumbersAndDominate) {
    const OffsetBox boxes[] = {{glm::dvec3(0.5), glm::dvec3(1.0)},
                               {glm::dvec3(-1.0), glm::dvec3(1.0)},
                               {glm::dvec3(-1.0, -1.0, -2.0), glm::dvec3(1.0, 1.0, -1.0)}};
    for_each_unset_material([&](const auto& material) {
        for (const OffsetBox& box : boxes) {
            const Unset bound = material.upper_bound(box);
            for (int i = 0; i < 64; ++i) {
                const glm::dvec3 at((i & 3) / 3.0, (i >> 2 & 3) / 3.0, (i >> 4) / 3.0);
                const Unset value = material.evaluate(glm::vec3(glm::normalize(box.lo + at * (box.hi - box.lo))));
                for (int c = 0; c < 2; ++c) EXPECT_LE(value[c], bound[c]);
            }
        }
    });
}

TEST(UnsetSpectrum, ResultsOfNoLightsAreBlack) {
    const std::vector<OmniLight<Unset>> none(3);
    const LightTree tree(none);
    const Receiver receiver(glm::vec3(0.0f), Lambert<Unset>{{0.0f, 0.0f, 1.0f}, {0.5f, 0.5f}});
    EXPECT_TRUE(tree.empty());
    EXPECT_TRUE(is_black(exhaustive(tree, receiver).radiance));
    EXPECT_TRUE(is_black(power_sampling(tree, PowerDistribution(tree), receiver, AlwaysVisible{}, 4, 1).radiance));
    EXPECT_TRUE(is_black(tree_sampling(tree, receiver, AlwaysVisible{}, 4, 1).radiance));
}

}  // namespace
}  // namespace lightcuts::test
