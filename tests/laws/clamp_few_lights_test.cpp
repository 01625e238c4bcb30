// Automatic clamping where few lights arrive, and cuts that find out how many do.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/light/clampable.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/shading/receiver.hpp>

namespace lightcuts::test {
namespace {

using V = glm::vec3;
using Direct = OrientedPointLight<V>;
using Virtual = VirtualPointLight<V>;

const Receiver<Lambert<V>> floor_point(V(0.0f), Lambert<V>{{0.0f, 0.0f, 1.0f}, V(0.5f)});

/// n lights that are alike, on a ring above the origin, `size` from it. In pairs, if `gap` is small.
std::vector<Virtual> ring(int n, double size = 1.5, double gap = 1.0) {
    std::vector<Virtual> lights;
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * 3.14159265358979 * (i % 2 == 0 ? i : i - 1 + gap) / n;
        const V direction = glm::normalize(V(std::cos(angle), std::sin(angle), 1.0));
        lights.push_back({{static_cast<float>(size) * direction, -direction, V(1.0f, 0.5f, 0.25f), {}}});
    }
    return lights;
}

// By a hundredth of the total, fewer than a hundred lights would all be clamped to nothing, and 101 to next to it.
TEST(ClampingOfFewLights, DoesNotDarkenLightsThatAreAlike) {
    const auto half = [](const auto&, const Virtual& light) { return light.position.x > 0.01f; };
    const auto compare = [&](const auto& tree, const auto& oracle, int n) {
        const V all = exhaustive(tree, floor_point, oracle).radiance;
        const V clamped = exhaustive(tree, floor_point, oracle, automatic_clamping).radiance;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(clamped[c], all[c], 1e-5f * all[c]) << n;
        for (const LightcutOptions& options :
             {LightcutOptions{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0},
              LightcutOptions{.exhaustive_below = 0}, LightcutOptions{.exhaustive_below = 300}}) {
            LightcutOptions with = options;
            with.clamp = automatic_clamping;
            const V cut = shade(tree, floor_point, oracle, with).radiance;
            const V reference = shade(tree, floor_point, oracle, options).radiance;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(cut[c], reference[c], 0.05f * reference[c]) << n;
            if (options.error_ratio > 0.0f && options.exhaustive_below == 0) continue;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(cut[c], all[c], 1e-5f * all[c]) << n;
        }
    };
    for (int n = 1; n <= 300; ++n) {
        const auto lights = ring(n);
        const LightTree tree(lights);
        compare(tree, AlwaysVisible{}, n);
        compare(tree, half, n);
    }
}

// One light among few, a thousand times as bright, adds some twice the mean of the others.
TEST(ClampingOfFewLights, HoldsASpikeAmongFewLights) {
    for (int n = 3; n <= 300; ++n) {
        auto lights = ring(n);
        const V one = exhaustive(LightTree(lights), floor_point).radiance / static_cast<float>(n);
        lights.back().intensity *= 1000.0f;
        const LightTree tree(lights);
        const auto others = static_cast<float>(n - 1);
        const float ratio = std::max(0.01f, 2.0f / static_cast<float>(n));
        const V sum = exhaustive(tree, floor_point, AlwaysVisible{}, automatic_clamping).radiance;
        const auto exact = LightcutOptions{
            .error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0, .clamp = automatic_clamping};
        const V cut = shade(tree, floor_point, AlwaysVisible{}, exact).radiance;
        for (int c = 0; c < 3; ++c) {
            const float expected = others * one[c] / (1.0f - ratio);
            EXPECT_NEAR(sum[c], expected, 1e-4f * expected) << n;
            EXPECT_NEAR(cut[c], expected, 1e-4f * expected) << n;
        }
    }
}

/// Direct light beside which all far lights are little, and one near light would be much.
const std::vector<Direct> glow{{{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, -1.0f}, V(60.0f), {}}};

/// Lights that are far and seen, and pairs that are near and hidden: by bounds they might be the brightest. `power`: of
/// a far light, whatever its light on the floor.
std::vector<Virtual> far_and_near(int far, int near, float power) {
    std::vector<Virtual> lights = ring(far, 10.0 * std::sqrt(power), 1e-3);
    for (Virtual& light : lights) light.intensity *= power;
    const std::vector<Virtual> more = ring(near, 0.3, 1e-3);
    lights.insert(lights.end(), more.begin(), more.end());
    return lights;
}
constexpr auto is_far = [](const auto&, const auto& light) { return light.position.z > 0.5f; };

/// Cuts of which the first look at the cluster of all finds a far light or a near one, each about as often.
template <class F>
void for_each_first_look(int far, int near, const ClampingOptions& clamp, F&& f) {
    const auto lights = far_and_near(far, near, static_cast<float>(near) / static_cast<float>(far));
    const LightTree direct(glow);
    const LightTree tree(lights, {.representatives = 8});
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const LightForest forest(direct, tree);
        const LightcutOptions options{.max_cut = 0, .exhaustive_below = 0, .seed = seed, .clamp = clamp};
        Lightcut cut(forest, floor_point, is_far, options);
        while (cut.step()) {}
        f(cut);
    }
}

// Of 500 lights that seem to arrive, 100 do, and may each add more than was thought: clusters are refined until none is
// off by more than the error ratio all the same.
TEST(ClampingOfFewLights, RefinesForThoseThatArrive) {
    int refined = 0;
    for_each_first_look(100, 400, {.ratio = 0.005f}, [&](const auto& cut) {
        const CutResult<V> result = cut.result();
        EXPECT_EQ(result.stop, StopReason::converged);
        cut.for_each([&](const auto& node) {
            for (int c = 0; c < 3; ++c) {
                const float bound = std::min(node.bound[c], node.lights * result.clamp_threshold[c]);
                EXPECT_LE(bound, 1.0101f * 0.02f * result.radiance[c]) << node.lights;
            }
            refined += node.lights == 1.0f ? 1 : 0;
        });
    });
    EXPECT_GT(refined, 1000) << "pairs are split";
}

// Two lights of at most a hundredth each are within an error ratio of two hundredths.
TEST(ClampingOfFewLights, SplitsNoPairsOfMany) {
    for_each_first_look(250, 50, automatic_clamping, [&](const auto& cut) {
        cut.for_each([](const auto& node) { EXPECT_GE(node.lights, 2.0f); });
        const CutResult<V> result = cut.result();
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(result.clamp_threshold[c], 0.01f * result.radiance[c], 1e-5f * result.radiance[c]);
        }
    });
}

// A spike that is found before the lights which show that it is one does not pass for all the light there is.
TEST(ClampingOfFewLights, AreLookedForBesideASpike) {
    auto lights = ring(3000);
    lights.push_back({{{0.0f, 0.0f, 0.02f}, {0.0f, 0.0f, -1.0f}, V(1.0f), {}}});
    std::vector<V> places;
    for (std::size_t i = 0; i < lights.size(); i += 30) places.push_back(lights[i].position);
    const auto seen = [&](const auto&, const Virtual& light) {
        return std::find(places.begin(), places.end(), light.position) != places.end();
    };
    const LightTree tree(lights);
    const V exact = exhaustive(tree, floor_point, seen, automatic_clamping).radiance;
    for (const std::size_t max_cut : {0u, 1000u}) {
        const CutResult<V> result = shade(tree, floor_point, seen, {.max_cut = max_cut, .clamp = automatic_clamping});
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(result.radiance[c], exact[c], 0.3f * exact[c]) << max_cut;
    }
}

// In the dark, whatever arrives first may be all there is.
TEST(ClampingOfFewLights, FindsTheOnlyOneThatArrives) {
    const auto lights = ring(300, 1.5, 1e-3);
    const LightTree tree(lights);
    for (const Virtual& only : lights) {
        const auto seen = [&](const auto&, const Virtual& light) { return light.position == only.position; };
        const Estimate<V> exact = exhaustive(tree, floor_point, seen, automatic_clamping);
        const CutResult<V> result = shade(tree, floor_point, seen,
                                          {.max_cut = 0, .exhaustive_below = 0, .clamp = automatic_clamping});
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(exact.radiance[c], 0.0f);
            EXPECT_NEAR(result.radiance[c], exact.radiance[c], 1e-5f * exact.radiance[c]);
        }
    }
}

}  // namespace
}  // namespace lightcuts::test
