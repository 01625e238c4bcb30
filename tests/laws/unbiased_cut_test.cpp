#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include "support/scene.hpp"
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

// With error ratio 0 and one channel a cut of a given size is the same whatever the representatives are: its nodes go
// by their bounds alone. Such a fixed cut is unbiased over seeds. Each test fails by chance once in a million runs
// (of other seeds than these).
template <class MakeForestAndShade>
void expect_unbiased(double exact, int seeds, MakeForestAndShade&& estimate) {
    Mean mean;
    for (int seed = 0; seed < seeds; ++seed) mean.add(estimate(static_cast<std::uint64_t>(seed)));
    EXPECT_LT(mean.standard_errors_from(exact), one_in_a_million)
        << "mean " << mean.value() << " of " << seeds << " seeds, exact " << exact << ", deviation of one "
        << mean.deviation();
    EXPECT_GT(mean.deviation(), 1e-4 * exact) << "the seeds make no difference, so the test tests nothing";
}

template <class L>
void expect_fixed_cut_unbiased(const std::vector<L>& lights, const Receiver<Lambert<float>>& receiver,
                               const Occluders& occluders, unsigned representatives, std::size_t cut_size, int seeds) {
    const ScalarOccluders oracle{occluders};
    EstimateScratch<float> scratch;
    const LightTree<L> reference(lights);
    const double exact = static_cast<double>(exhaustive(LightForest(reference), receiver, oracle, scratch).radiance);
    ASSERT_GT(exact, 0.0);
    std::uint32_t size = 0;
    expect_unbiased(exact, seeds, [&](std::uint64_t seed) {
        const LightTree<L> tree(lights, {.representatives = representatives, .seed = 2 * seed + 1});
        const auto result = shade(tree, receiver, oracle,
                                  {.error_ratio = 0.0f, .max_cut = cut_size, .seed = 77 * seed});
        size = result.cut_size;
        return static_cast<double>(result.radiance);
    });
    EXPECT_EQ(size, cut_size);
}

TEST(FixedCut, IsUnbiasedWithOneRepresentative) {
    Room<float> room(11);
    const auto lights = room.omni(150);
    const auto receivers = room.diffuse_receivers(3);
    const Occluders occluders = room.occluders();
    for (const auto& receiver : receivers) expect_fixed_cut_unbiased(lights, receiver, occluders, 1, 1, 6000);
    for (const auto& receiver : receivers) expect_fixed_cut_unbiased(lights, receiver, occluders, 1, 12, 6000);
}

TEST(FixedCut, IsUnbiasedWithSeveralRepresentatives) {
    Room<float> room(12);
    const auto lights = room.oriented(150);
    const auto receivers = room.diffuse_receivers(4);
    const Occluders occluders = room.occluders();
    for (const auto& receiver : receivers) expect_fixed_cut_unbiased(lights, receiver, occluders, 8, 1, 4000);
    for (const auto& receiver : receivers) expect_fixed_cut_unbiased(lights, receiver, occluders, 8, 12, 4000);
    for (const auto& receiver : receivers) expect_fixed_cut_unbiased(lights, receiver, occluders, 32, 7, 2000);
}

TEST(FixedCut, IsUnbiasedForDirectionalLights) {
    Room<float> room(13);
    const auto lights = room.distant(100);
    const auto receivers = room.diffuse_receivers(2);
    for (const auto& receiver : receivers) expect_fixed_cut_unbiased(lights, receiver, room.occluders(), 1, 9, 4000);
}

TEST(FixedCut, IsUnbiasedForSeveralTrees) {
    Room<float> room(14);
    const auto omni = room.omni(80);
    const auto oriented = room.oriented(80);
    const Occluders occluders = room.occluders();
    const ScalarOccluders oracle{occluders};
    for (const auto& receiver : room.diffuse_receivers(3)) {
        EstimateScratch<float> scratch;
        const LightTree a(omni);
        const LightTree b(oriented);
        const double exact = static_cast<double>(exhaustive(LightForest(a, b), receiver, oracle, scratch).radiance);
        expect_unbiased(exact, 4000, [&](std::uint64_t seed) {
            const LightTree one(omni, {.representatives = 1, .seed = seed});
            const LightTree other(oriented, {.representatives = 4, .seed = seed});
            const LightcutOptions options{.error_ratio = 0.0f, .max_cut = 10, .seed = seed};
            return static_cast<double>(shade(LightForest(one, other), receiver, oracle, options).radiance);
        });
    }
}

// One tree with many representatives, drawn anew for every receiver: only nearly unbiased, since the lists are fixed.
// What the adaptive cut adds is small too, and stated in the documentation.
TEST(AdaptiveCut, HasLessThanHalfAPerCentOfBias) {
    Room<float> room(15);
    const auto lights = room.oriented(600);
    const Occluders occluders = room.occluders();
    const ScalarOccluders oracle{occluders};
    for (const unsigned representatives : {1u, 8u}) {
        Mean bias;
        for (const auto& receiver : room.diffuse_receivers(60)) {
            EstimateScratch<float> scratch;
            const LightTree reference(lights);
            const double exact = static_cast<double>(
                exhaustive(LightForest(reference), receiver, oracle, scratch).radiance);
            if (!(exact > 1e-3)) continue;
            Mean mean;
            for (std::uint64_t seed = 0; seed < 40; ++seed) {
                const LightTree tree(lights, {.representatives = representatives, .seed = seed});
                mean.add(
                    static_cast<double>(shade(tree, receiver, oracle, {.exhaustive_below = 0, .seed = seed}).radiance));
            }
            bias.add(mean.value() / exact - 1.0);
        }
        std::printf(
            "[ FIGURE   ] bias of adaptive cuts at 2 %%, %u representatives: %+.3f %% (receivers vary by %.3f %%)\n",
            representatives, 100.0 * bias.value(), 100.0 * bias.deviation());
        EXPECT_LT(std::fabs(bias.value()), 0.005);
    }
}

}  // namespace
}  // namespace lightcuts::test
