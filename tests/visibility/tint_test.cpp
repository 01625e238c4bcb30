// Oracles that answer a fraction for each channel: colored shadows.

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/adaptive_splitting.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/power.hpp>
#include <lightcuts/estimate/stochastic_lightcuts.hpp>
#include <lightcuts/estimate/tree_sampling.hpp>
#include <lightcuts/estimate/ward.hpp>
#include "support/scene.hpp"
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
using R = Receiver<Lambert<V>>;

/// What is hidden is seen through red glass.
constexpr V glass(0.8f, 0.1f, 0.0f);

struct ScalarGlass {
    const Occluders& occluders;

    template <class Receiver, Light L>
    V operator()(const Receiver& receiver, const L& light) const {
        return occluders.block(receiver.shadow_origin, position_or_direction(light), DirectionalLight<L>) ? glass
                                                                                                          : V(1.0f);
    }
};

struct BatchedGlass {
    const Occluders& occluders;

    void many(std::span<const VisibilityQuery> queries, std::span<V> answers) const {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const VisibilityQuery& q = queries[i];
            answers[i] = occluders.block(q.from, q.to, q.distant) ? glass : V(1.0f);
        }
    }
};

/// Would answer in gray as well.
struct GrayOrTinted : BatchedGlass {
    using BatchedGlass::many;
    void many(std::span<const VisibilityQuery>, std::span<float>) const { ADD_FAILURE() << "asked in gray"; }
};

static_assert(ScalarOracle<ScalarGlass, R, OmniLight<V>> && VisibilityOracle<ScalarGlass, R, OmniLight<V>>);
static_assert(!ScalarOracle<ScalarGlass, Receiver<Lambert<float>>, OmniLight<float>>, "of another spectrum");
static_assert(TintingOracle<BatchedGlass, V> && !BatchedOracle<BatchedGlass> && !TintingOracle<BatchedGlass, float>);
static_assert(VisibilityOracle<BatchedGlass, R, OmniLight<V>>);
static_assert(!TintingOracle<BatchedOccluders, V> && !TintingOracle<BatchedOccluders, float>);

static_assert(detail::is_fraction(0.0f) && detail::is_fraction(1.0f) && detail::is_fraction(glass));
static_assert(!detail::is_fraction(1.25f) && !detail::is_fraction(-1.0f) && !detail::is_fraction(V(0.0f, 0.0f, 2.0f)));
static_assert(!detail::is_fraction(std::numeric_limits<float>::quiet_NaN()));

struct GlassRoom {
    explicit GlassRoom(std::uint64_t seed)
        : room(seed), occluders(room.occluders()), omni(room.omni(200)), oriented(room.oriented(200)),
          distant(room.distant(60)), a(omni), b(oriented), c(distant), lights(a, b, c),
          receivers(room.diffuse_receivers(20)) {}

    Room<V> room;
    Occluders occluders;
    std::vector<OmniLight<V>> omni;
    std::vector<OrientedPointLight<V>> oriented;
    std::vector<DistantLight<V>> distant;
    LightTree<OmniLight<V>> a;
    LightTree<OrientedPointLight<V>> b;
    LightTree<DistantLight<V>> c;
    LightForest<OmniLight<V>, OrientedPointLight<V>, DistantLight<V>> lights;
    std::vector<R> receivers;
};

/// Channel by channel a tint is a gray fraction.
V exact_by_channels(const GlassRoom& scene, const R& receiver) {
    V sum(0.0f);
    for (int k = 0; k < 3; ++k) {
        sum[k] = exhaustive(scene.lights, receiver, ScalarOccluders{scene.occluders, glass[k]}).radiance[k];
    }
    return sum;
}

void expect_near(const V& found, const V& expected, float tolerance) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], tolerance * expected[k]);
}

TEST(TintingOracle, IsAFractionForEachChannel) {
    GlassRoom scene(31);
    const ScalarGlass scalar{scene.occluders};
    const BatchedGlass batched{scene.occluders};
    const LightcutOptions all{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0};
    EstimateScratch<V> scratch;
    for (const R& receiver : scene.receivers) {
        const V exact = exact_by_channels(scene, receiver);
        expect_near(exhaustive(scene.lights, receiver, scalar, scratch).radiance, exact, 1e-5f);
        expect_near(exhaustive(scene.lights, receiver, batched, scratch).radiance, exact, 1e-5f);
        expect_near(shade(scene.lights, receiver, scalar, all).radiance, exact, 1e-5f);
        expect_near(shade(scene.lights, receiver, batched, all).radiance, exact, 1e-5f);
        expect_near(shade(scene.lights, receiver, GrayOrTinted{batched}, all).radiance, exact, 1e-5f);
        expect_near(ward(scene.lights, receiver, scalar, 0.0f, scratch).radiance, exact, 1e-5f);
        expect_near(ward(scene.lights, receiver, batched, 0.0f, scratch).radiance, exact, 1e-5f);
        expect_near(adaptive_splitting(scene.lights, receiver, batched, 0.0f, 2000, 1, scratch).radiance, exact, 1e-5f);
    }
    std::vector<CutResult<V>> results;
    LightcutScratch<V> cuts;
    shade(scene.lights, scene.receivers, batched, results, cuts, all);
    for (std::size_t i = 0; i < results.size(); ++i) {
        expect_near(results[i].radiance, exact_by_channels(scene, scene.receivers[i]), 1e-5f);
    }
}

TEST(TintingOracle, KeepsTheErrorOfACutWithinItsBound) {
    GlassRoom scene(32);
    for (const R& receiver : scene.receivers) {
        const V exact = exact_by_channels(scene, receiver);
        const CutResult<V> scalar = shade(scene.lights, receiver, ScalarGlass{scene.occluders},
                                          {.max_cut = 0, .exhaustive_below = 0});
        const CutResult<V> batched = shade(scene.lights, receiver, BatchedGlass{scene.occluders},
                                           {.max_cut = 0, .exhaustive_below = 0});
        EXPECT_EQ(scalar.radiance, batched.radiance);
        for (int k = 0; k < 3; ++k) {
            EXPECT_LE(std::fabs(batched.radiance[k] - exact[k]), batched.error_bound[k] + 1e-5f * exact[k]);
        }
    }
}

TEST(TintingOracle, LeavesSamplingUnbiased) {
    GlassRoom scene(33);
    const BatchedGlass batched{scene.occluders};
    const PowerDistribution powers(scene.lights);
    EstimateScratch<V> scratch;
    for (std::size_t r = 0; r < 4; ++r) {
        const R& receiver = scene.receivers[r];
        const V exact = exact_by_channels(scene, receiver);
        std::vector<Mean> means(9);
        for (std::uint64_t seed = 0; seed < 300; ++seed) {
            const V found[] = {power_sampling(scene.lights, powers, receiver, batched, 64, seed, scratch).radiance,
                               tree_sampling(scene.lights, receiver, batched, 32, seed, scratch).radiance,
                               stochastic_lightcuts(scene.lights, receiver, batched, 32, seed, scratch).radiance};
            for (std::size_t k = 0; k < 9; ++k)
                means[k].add(static_cast<double>(found[k / 3][static_cast<int>(k % 3)]));
        }
        // 36 means at 5 standard errors: one false alarm in some 50,000 sets of seeds; these are fixed.
        for (std::size_t k = 0; k < 9; ++k) {
            EXPECT_LT(means[k].standard_errors_from(static_cast<double>(exact[static_cast<int>(k % 3)])), 5.0)
                << "method " << k / 3 << ", channel " << k % 3;
        }
    }
}

/// Glass that gives light.
struct Glowing {
    template <class Receiver, class L>
    V operator()(const Receiver&, const L&) const {
        return V(0.5f, 2.0f, 1.0f);
    }
};
struct ManyGlowing {
    void many(std::span<const VisibilityQuery> queries, std::span<V> answers) const {
        for (std::size_t i = 0; i < queries.size(); ++i) answers[i] = Glowing()(0, 0);
    }
};

TEST(TintingOracle, ThatGivesLightIsStoppedInDebugBuilds) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    GlassRoom scene(34);
    EXPECT_DEBUG_DEATH(exhaustive(scene.lights, scene.receivers[0], Glowing{}), "is_fraction");
    EXPECT_DEBUG_DEATH(exhaustive(scene.lights, scene.receivers[0], ManyGlowing{}), "is_fraction");
}

}  // namespace
}  // namespace lightcuts::test
