// Cuts with lights that are clamped against exhaustive sums that clamp them alike.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/light/clampable.hpp>
#include "support/cut_results.hpp"
#include "support/scene.hpp"
#include "support/threads.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
using Direct = OrientedPointLight<V>;
using Virtual = VirtualPointLight<V>;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr ClampingOptions every_clamping[] = {{},
                                              {.radiance = 1e-3f},
                                              {.radiance = 0.0f},
                                              automatic_clamping,
                                              {.ratio = 0.002f},
                                              {.radiance = 3e-3f, .ratio = 0.01f},
                                              {.transfer = 0.05f},
                                              {.ratio = 0.01f, .transfer = 0.05f}};

std::vector<Virtual> marked(const std::vector<Direct>& lights) {
    std::vector<Virtual> all(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) all[i] = {lights[i]};
    return all;
}

template <class M>
V normal_of(const Receiver<M>& receiver) {
    return glm::normalize(receiver.shadow_origin - receiver.position);
}

/// Many virtual lights, few others, and some of the former in front of receivers.
template <class M>
std::vector<Virtual> virtual_lights(Room<V>& room, std::size_t n, const std::vector<Receiver<M>>& receivers) {
    std::vector<Virtual> lights = marked(room.oriented(n));
    for (std::size_t i = 0; i < receivers.size(); i += 2) {
        Virtual& light = lights[i];
        const V normal = normal_of(receivers[i]);
        light.position = receivers[i].position + 1e-3f * normal;
        light.axis = -normal;
    }
    return lights;
}

/// How many of `lights` arrive, one after the other, each as one, or as a part if it adds next to nothing.
template <class M, class Oracle>
std::array<double, 3> arriving(const std::vector<Virtual>& lights, const Receiver<M>& receiver, const Oracle& oracle,
                               float limit) {
    Box box;
    glm::dvec3 intensity(0.0);
    for (const Virtual& light : lights) {
        box = merge(box, box_of(light.position));
        intensity += glm::dvec3(light.intensity);
    }
    const glm::dvec3 whole = 1e-9 * intensity / diagonal2(box);
    std::array<double, 3> count{};
    for (const Virtual& light : lights) {
        const V transfer = glm::min(unshadowed_transfer(receiver, light), V(limit)) * oracle(receiver, light);
        for (int c = 0; c < 3; ++c) {
            const double radiance = static_cast<double>(transfer[c] * light.intensity[c]);
            count[static_cast<std::size_t>(c)] += radiance > 0.0 ? std::min(1.0, radiance / whole[c]) : 0.0;
        }
    }
    return count;
}

/// The share of the total that one of `lights` may add, as it is stated; infinite if it may add all.
float stated_ratio(const ClampingOptions& clamp, double lights) {
    const float ratio = std::max(clamp.ratio, static_cast<float>(2.0 / lights));
    return ratio < 1.0f ? ratio : infinity;
}

/// `through`: of the light, by occluders.
template <class Forest, class M>
void expect_error_within_bound(const Forest& forest, const std::vector<Virtual>& indirect,
                               const std::vector<Receiver<M>>& receivers, const Occluders& occluders,
                               const LightcutOptions& options, float through) {
    const BatchedOccluders batched{occluders, through};
    const ScalarOccluders scalar{occluders, through};
    EstimateScratch<V> scratch;
    for (const auto& receiver : receivers) {
        const Estimate<V> exact = exhaustive(forest, receiver, scalar, scratch, options.clamp);
        const std::array<double, 3> lights = arriving(indirect, receiver, scalar, options.clamp.transfer);
        Lightcut cut(forest, receiver, batched, options);
        // At every step, not only at the last.
        for (bool more = true; more; more = cut.step()) {
            const CutResult<V> result = cut.result();
            for (int c = 0; c < 3; ++c) {
                EXPECT_LE(std::fabs(result.radiance[c] - exact.radiance[c]),
                          result.error_bound[c] + 1e-4f * exact.radiance[c])
                    << receiver.id << " " << result.cut_size;
            }
        }
        const CutResult<V> result = cut.result();
        const CutResult<V> one_by_one = shade(forest, receiver, scalar, options);
        EXPECT_EQ(one_by_one.radiance, result.radiance);
        EXPECT_EQ(one_by_one.error_bound, result.error_bound);
        EXPECT_EQ(one_by_one.clamp_threshold, result.clamp_threshold);
        EXPECT_EQ(one_by_one.cut_size, result.cut_size);
        for (int c = 0; c < 3; ++c) {
            if (!options.clamp.is_automatic()) {
                EXPECT_EQ(result.clamp_threshold[c], options.clamp.radiance);
                EXPECT_EQ(exact.clamp_threshold[c], options.clamp.radiance);
                continue;
            }
            // A cut does not know how many lights arrive: from none to all.
            const float ratio = stated_ratio(options.clamp, lights[static_cast<std::size_t>(c)]);
            const float least = stated_ratio(options.clamp, static_cast<double>(indirect.size()));
            if (ratio < infinity) {
                EXPECT_NEAR(exact.clamp_threshold[c], std::min(ratio * exact.radiance[c], options.clamp.radiance),
                            1e-5f * exact.clamp_threshold[c]);
            } else {
                EXPECT_EQ(exact.clamp_threshold[c], options.clamp.radiance);
            }
            EXPECT_GE(result.clamp_threshold[c],
                      0.99999f * std::min(least * result.radiance[c], options.clamp.radiance));
            EXPECT_LE(result.clamp_threshold[c], options.clamp.radiance);
            if (options.error_ratio == 0.0f && options.max_cut == 0 && ratio < infinity) {
                EXPECT_NEAR(result.clamp_threshold[c], exact.clamp_threshold[c], 1e-4f * exact.clamp_threshold[c]);
            }
        }
        if (options.error_ratio == 0.0f && options.max_cut == 0) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(result.radiance[c], exact.radiance[c], 1e-4f * exact.radiance[c]) << receiver.id;
                EXPECT_EQ(result.error_bound[c], 0.0f);
            }
        }
        if (result.stop == StopReason::converged) {
            cut.for_each([&](const auto& node) {
                for (int c = 0; c < 3; ++c) {
                    const float bound = std::min(node.bound[c], node.lights * result.clamp_threshold[c]);
                    const float reference = result.radiance[c] + 0.1f * options.adaptation;
                    EXPECT_LE(bound, 1.0101f * options.error_ratio * reference + 1e-30f);
                }
            });
        }
    }
}

/// `count` virtual lights, each without one channel if there are few of them.
template <class MakeReceivers>
void expect_errors_within_bounds(Room<V>& room, std::size_t count, MakeReceivers&& make_receivers) {
    const auto receivers = make_receivers();
    const auto direct = room.oriented(40);
    auto indirect = virtual_lights(room, count, receivers);
    const bool few = count < 200;
    for (std::size_t i = 0; few && i < count; ++i) indirect[i].intensity[static_cast<int>(i % 3)] = 0.0f;
    const float through = few ? 0.0f : 0.2f;
    const Occluders occluders = room.occluders();
    const LightTree a(direct);
    const LightTree b(indirect, {.representatives = 4});
    for (const ClampingOptions& clamp : every_clamping) {
        for (const LightcutOptions& options :
             {LightcutOptions{.exhaustive_below = 0, .clamp = clamp},
              LightcutOptions{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0, .clamp = clamp},
              LightcutOptions{.error_ratio = 0.1f, .max_cut = 30, .exhaustive_below = 0, .clamp = clamp},
              LightcutOptions{.max_cut = 0, .exhaustive_below = 0, .adaptation = 0.05f, .clamp = clamp}}) {
            expect_error_within_bound(LightForest(a, b), indirect, receivers, occluders, options, through);
            expect_error_within_bound(LightForest(b), indirect, receivers, occluders, options, through);
        }
    }
}

TEST(Clamping, KeepsTheErrorWithinItsBoundOnDiffuseSurfaces) {
    Room<V> room(61);
    expect_errors_within_bounds(room, 600, [&] { return room.diffuse_receivers(12); });
}

TEST(Clamping, KeepsTheErrorWithinItsBoundOnGlossySurfaces) {
    Room<V> room(62);
    expect_errors_within_bounds(room, 600, [&] { return room.glossy_receivers(12); });
}

TEST(Clamping, KeepsTheErrorWithinItsBoundWhereFewLightsArrive) {
    Room<V> room(68);
    for (const std::size_t count : {12u, 15u, 30u, 60u, 150u}) {
        expect_errors_within_bounds(room, count, [&] { return room.diffuse_receivers(12); });
    }
}

// The lights in front of the receivers would outshine everything.
TEST(Clamping, TamesLightsAtTheReceiver) {
    Room<V> room(63);
    const auto receivers = room.diffuse_receivers(20);
    const auto direct = room.oriented(100);
    const auto indirect = virtual_lights(room, 1000, receivers);
    const LightTree a(direct);
    const LightTree b(indirect);
    const LightForest forest(a, b);
    for (std::size_t i = 0; i < receivers.size(); i += 2) {
        const auto wild = shade(forest, receivers[i]);
        const auto tame = shade(forest, receivers[i], AlwaysVisible{},
                                {.exhaustive_below = 0, .clamp = automatic_clamping});
        const auto fixed = shade(forest, receivers[i], AlwaysVisible{}, {.clamp = {.radiance = 1e-3f}});
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(wild.radiance[c], 10.0f * tame.radiance[c]);
            EXPECT_GT(wild.radiance[c], 10.0f * fixed.radiance[c]);
            EXPECT_LT(tame.error_bound[c], 1e3f);
        }
        // A limit may leave an unbounded cluster on the cut, whose error is bounded nonetheless.
        EXPECT_EQ(shade(b, receivers[i], AlwaysVisible{}, {.max_cut = 1}).error_bound.x, infinity);
        EXPECT_LE(shade(b, receivers[i], AlwaysVisible{}, {.max_cut = 1, .clamp = {.radiance = 1e-3f}}).error_bound.x,
                  1.00001f * 1e-3f * 1000.0f);
    }
}

TEST(Clamping, ChangesNoBitIfItIsOff) {
    Room<V> room(64);
    const auto receivers = room.glossy_receivers(60);
    const auto lights = virtual_lights(room, 900, receivers);
    const std::vector<Direct> plain(lights.begin(), lights.end());
    const auto direct = room.oriented(50);
    const LightTree a(direct), b(plain);
    const LightTree c(lights);
    const Occluders occluders = room.occluders();
    const BatchedOccluders oracle{occluders, 0.1f};
    for (const LightcutOptions& options :
         {LightcutOptions{.exhaustive_below = 0},
          LightcutOptions{.error_ratio = 0.005f, .max_cut = 60, .exhaustive_below = 0}}) {
        std::vector<CutResult<V>> unmarked(receivers.size()), off(receivers.size());
        LightcutScratch<V> scratch;
        LightcutScratch<V, true> clamping;
        shade(LightForest(a, b), std::span(receivers), oracle, std::span(unmarked), scratch, options);
        shade(LightForest(a, c), std::span(receivers), oracle, std::span(off), clamping, options);
        expect_same(unmarked, off);
    }
    for (const auto& receiver : receivers) {
        EXPECT_EQ(exhaustive(LightForest(a, b), receiver, oracle).radiance,
                  exhaustive(LightForest(a, c), receiver, oracle).radiance);
    }
}

TEST(Clamping, DoesNotDependOnTilesOrThreads) {
    Room<V> room(65);
    const auto receivers = room.glossy_receivers(60);
    const auto lights = virtual_lights(room, 900, receivers);
    const auto direct = room.oriented(50);
    const LightTree a(direct);
    const LightTree b(lights, {.representatives = 8});
    const LightForest forest(a, b);
    const Occluders occluders = room.occluders();
    const auto in_tiles = [&](const auto& oracle, std::size_t tile, const auto& execute) {
        std::vector<CutResult<V>> results(receivers.size());
        execute(receivers.size() / tile, [&](std::size_t t) {
            scratch_of<decltype(forest)> scratch;
            shade(forest, std::span(receivers).subspan(t * tile, tile), oracle,
                  std::span(results).subspan(t * tile, tile), scratch,
                  {.exhaustive_below = 0, .clamp = automatic_clamping});
        });
        return results;
    };
    const auto alone = in_tiles(ScalarOccluders{occluders}, 1, Sequential{});
    for (const std::size_t tile : {1u, 5u, 60u}) {
        expect_same(alone, in_tiles(BatchedOccluders{occluders}, tile, Sequential{}));
        expect_same(alone, in_tiles(BatchedOccluders{occluders}, tile, FourThreads{}));
    }
}

// Where the first look finds darkness, there may still be light.
TEST(Clamping, IsNotFooledByDarkRepresentatives) {
    Room<V> room(66);
    const auto lights = marked(room.oriented(2000));
    const LightTree tree(lights);
    // Only lights at one end are visible.
    const auto slit = [](const auto&, const Virtual& light) { return light.position.z > 1.5f; };
    for (const auto& receiver : room.diffuse_receivers(30)) {
        const auto exact = exhaustive(tree, receiver, slit, automatic_clamping);
        const auto result = shade(tree, receiver, slit,
                                  {.max_cut = 0, .exhaustive_below = 0, .clamp = automatic_clamping});
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(result.radiance[c], 0.5f * exact.radiance[c]);
            EXPECT_LE(std::fabs(result.radiance[c] - exact.radiance[c]),
                      result.error_bound[c] + 1e-4f * exact.radiance[c]);
        }
    }
}

// A limited cut, too, finds the only lights that are seen where bounds point to them: those near the receiver.
TEST(Clamping, OfALimitedCutFindsTheLightNearby) {
    std::vector<Virtual> lights;
    for (int i = 0; i < 200 * 200; ++i) {
        lights.push_back(
            {{{0.1f * static_cast<float>(i % 200) + 0.05f, 0.1f * static_cast<float>(i / 200) + 0.05f, 2.0f},
              {0.0f, 0.0f, -1.0f},
              V(1.0f),
              {}}});
    }
    const std::vector<Direct> glow{{{10.0f, 7.0f, 4.0f}, {0.0f, 0.0f, -1.0f}, V(1e-6f), {}}};
    const LightTree tree(lights);
    const LightTree dim(glow);
    const LightForest forest(dim, tree);
    for (int i = 0; i < 10; ++i) {
        const V point(2.0f + 1.7f * static_cast<float>(i), 7.3f, 0.0f);
        const Receiver<Lambert<V>> receiver(point, Lambert<V>{{0.0f, 0.0f, 1.0f}, V(0.5f)});
        const auto nearby = [&](const auto&, const auto& light) {
            return glm::distance(light.position, point + V(0.0f, 0.0f, 2.0f)) < 0.8f ||  // some 200 of 40,000
                   light.position == glow[0].position;
        };
        const V exact = exhaustive(forest, receiver, nearby, automatic_clamping).radiance;
        for (const float adaptation : {0.0f, 0.01f}) {
            const LightcutOptions options{.max_cut = 400, .adaptation = adaptation, .clamp = automatic_clamping};
            const auto result = shade(forest, receiver, nearby, options);
            EXPECT_EQ(result.stop, StopReason::limit);
            EXPECT_NEAR(result.radiance.x, exact.x, 0.5f * exact.x);
        }
    }
}

TEST(Clamping, LeavesDarknessDark) {
    Room<V> room(67);
    auto lights = marked(room.oriented(300));
    const auto direct = room.oriented(20);
    for (std::size_t i = 0; i < lights.size(); ++i) lights[i].intensity.z = 0.0f;  // a channel without light
    const LightTree a(direct);
    const LightTree b(lights);
    const auto blocked = [](const auto&, const auto&) { return false; };
    for (const ClampingOptions& clamp : every_clamping) {
        for (const auto& receiver : room.diffuse_receivers(10)) {
            const auto result = shade(LightForest(a, b), receiver, blocked, {.exhaustive_below = 0, .clamp = clamp});
            EXPECT_EQ(result.radiance, V(0.0f));
            for (int c = 0; c < 3; ++c) EXPECT_FALSE(std::isnan(result.error_bound[c] + result.clamp_threshold[c]));
            const auto exact = exhaustive(LightForest(a, b), receiver, blocked, clamp);
            EXPECT_EQ(exact.radiance, V(0.0f));
            EXPECT_EQ(exact.clamp_threshold, V(clamp.radiance)) << "a share of nothing is no limit";
            const auto lit = shade(b, receiver, AlwaysVisible{}, {.exhaustive_below = 0, .clamp = clamp});
            EXPECT_EQ(lit.radiance.z, 0.0f);
            for (int c = 0; c < 3; ++c) EXPECT_TRUE(lit.radiance[c] >= 0.0f && lit.radiance[c] < infinity);
        }
    }
}

}  // namespace
}  // namespace lightcuts::test
