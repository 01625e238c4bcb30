// Sums over pairs with lights that may add no more than a share of the sum, against all pairs one by one.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/product/gather.hpp>
#include "product/gather_scene.hpp"
#include "support/threads.hpp"

namespace lightcuts::test {
namespace {

using Virtual = VirtualPointLight<V>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr ProductOptions exact{.cut = {.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0}};

ProductOptions clamped(ProductOptions options, float ratio) {
    options.cut.clamp.ratio = ratio;
    return options;
}

std::vector<Virtual> marked(const std::vector<OrientedPointLight<V>>& lights) {
    std::vector<Virtual> all(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) all[i] = {lights[i]};
    return all;
}

/// Some lights of a room, the first few right in front of some of the points.
template <class Points>
std::vector<Virtual> with_spikes(Room<V>& room, std::size_t n, const Points& points) {
    std::vector<Virtual> lights = marked(room.oriented(n));
    for (std::size_t i = 0; i < std::min<std::size_t>(4, n); ++i) {
        const auto& receiver = points[(i * 7) % points.size()].receiver;
        const V normal = glm::normalize(receiver.shadow_origin - receiver.position);
        lights[i].position = receiver.position + 3e-3f * normal;
        lights[i].axis = -normal;
    }
    return lights;
}

/// What one light adds at one gather point, in one channel.
struct Addition {
    double radiance;
    double weight;  ///< the point's share of the strength that the light reaches
    std::size_t light;
};

/// The sum over all pairs, of which those of `additions` are clamped.
struct Pairs {
    double fixed = 0.0;
    double whole = 0.0;  ///< radiance per strength from which a light counts as one that arrives
    double strength = 0.0;
    std::vector<Addition> additions;

    double under(double threshold) const {
        double sum = fixed;
        for (const Addition& a : additions) sum += std::min(a.radiance, a.weight * threshold);
        return sum;
    }
    /// How many lights arrive, each by the strength that it reaches.
    double arriving() const {
        double count = 0.0;
        for (const Addition& a : additions) {
            if (a.radiance > 0.0) count += std::min(a.weight, a.radiance / (whole * strength));
        }
        return count;
    }
    double share(double ratio) const { return std::max(ratio, 2.0 / arriving()); }
    /// The largest total that is the sum under its own threshold, by bisection: below it the sum is larger.
    double total(double ratio) const {
        const double share_of_one = share(ratio);
        double above = under(infinity), below = 0.0;
        if (share_of_one == infinity) return above;
        for (int i = 0; i < 200; ++i) {
            const double middle = 0.5 * (below + above);
            (under(share_of_one * middle) > middle ? below : above) = middle;
        }
        return above;
    }
    /// The most that one light adds in all.
    double largest_light(double threshold) const {
        std::vector<double> of;
        for (const Addition& a : additions) {
            of.resize(std::max(of.size(), a.light + 1));
            of[a.light] += std::min(a.radiance, a.weight * threshold);
        }
        return of.empty() ? 0.0 : *std::max_element(of.begin(), of.end());
    }
};

/// All pairs of points and virtual lights in channel `c`, one by one.
template <class Points, class Lights, class Oracle>
Pairs pairs_of(const Points& points, const Lights& lights, const Oracle& oracle, int c) {
    using L = std::remove_cvref_t<decltype(lights.front())>;
    Pairs pairs;
    Box box;
    for (const auto& l : lights) {
        box = merge(box, box_of(l.position));
        pairs.whole += 1e-9 * static_cast<double>(l.intensity[c]);
    }
    pairs.whole /= diagonal2(box);
    for (const auto& p : points) pairs.strength += static_cast<double>(p.strength[c]);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const auto reaches = [&](const auto& p) {
            if constexpr (TimedLight<L>) return p.instant == lights[i].instant;
            return true;
        };
        double reached = 0.0;
        for (const auto& p : points) reached += reaches(p) ? static_cast<double>(p.strength[c]) : 0.0;
        for (const auto& p : points) {
            const auto strength = static_cast<double>(p.strength[c]);
            if (!reaches(p) || strength == 0.0) continue;
            pairs.additions.push_back({static_cast<double>(unshadowed_transfer(p.receiver, lights[i])[c]) *
                                           static_cast<double>(oracle(p.receiver, lights[i])) * strength *
                                           static_cast<double>(lights[i].intensity[c]),
                                       strength / reached, i});
        }
    }
    return pairs;
}

template <class R>
void expect_exact(const R& result, const Pairs& pairs, float ratio, int c) {
    const double share = pairs.share(static_cast<double>(ratio)), total = pairs.total(static_cast<double>(ratio));
    EXPECT_NEAR(static_cast<double>(result.radiance[c]), total, 1e-4 * total) << c;
    if (share < infinity) {
        EXPECT_NEAR(static_cast<double>(result.clamp_threshold[c]), share * total, 2e-4 * share * total) << c;
        EXPECT_LE(pairs.largest_light(static_cast<double>(result.clamp_threshold[c])), 1.001 * share * total);
    } else {
        EXPECT_EQ(result.clamp_threshold[c], std::numeric_limits<float>::infinity());
    }
}

/// At an error ratio of 0, and within the bound at others and for limited cuts.
template <class Lights, class Points, class Oracle, class Truth>
void expect_right(const Lights& lights, const Points& points, const Oracle& oracle, const Truth& pairs_in) {
    for (const float ratio : {0.5f, 0.05f, 0.01f, 0.002f}) {
        const auto found = gather(lights, points, oracle, clamped(exact, ratio));
        EXPECT_EQ(found.stop, StopReason::converged);
        std::vector<ProductOptions> others;
        for (const float error_ratio : {0.02f, 0.2f}) {
            for (const std::size_t most : {0u, 20u, 1u}) {
                others.push_back({.cut = {.error_ratio = error_ratio, .max_cut = most, .exhaustive_below = 0}});
            }
        }
        others.push_back({.cut = {.exhaustive_below = 0, .adaptation = 0.01f, .clamp = {.transfer = 1e6f}}});
        others.push_back({.cut = {.exhaustive_below = 0}, .redraw = true});
        ProductOptions exact_redrawn = clamped(exact, ratio);
        exact_redrawn.redraw = true;
        const auto redrawn = gather(lights, points, oracle, exact_redrawn);
        for (int c = 0; c < 3; ++c) {
            expect_exact(found, pairs_in(c), ratio, c);
            expect_exact(redrawn, pairs_in(c), ratio, c);
        }
        for (const ProductOptions& options : others) {
            const auto result = gather(lights, points, oracle, clamped(options, ratio));
            for (int c = 0; c < 3; ++c) {
                const double truth = pairs_in(c).total(static_cast<double>(ratio));
                EXPECT_LE(std::abs(static_cast<double>(result.radiance[c]) - truth),
                          static_cast<double>(result.error_bound[c]) + 1e-4 * truth)
                    << c << " " << ratio << " " << options.cut.max_cut;
                EXPECT_GE(result.clamp_threshold[c], 0.99999f * ratio * result.radiance[c]);
                if (result.stop == StopReason::converged && !options.redraw) {
                    EXPECT_LE(result.largest_bound[c],
                              1.0101f * options.cut.error_ratio *
                                  (result.radiance[c] + 0.1f * options.cut.adaptation + 1e-30f));
                }
            }
        }
    }
}

TEST(GatherClamping, IsTheFixedPointOfTheSumOverAllPairs) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        Random random(seed);
        Room<V> room(seed);
        const auto points = diffuse_points(random, 1 + random.below(30), random.decades(-3, 0), random.between(0, 1.5));
        if (std::all_of(points.begin(), points.end(), [](const auto& p) { return p.strength.x == 0.0f; })) continue;
        const auto indirect = with_spikes(room, 20 + random.below(300), points);
        const auto direct = room.oriented(30);
        const auto occluders = room.occluders();
        const ScalarOccluders oracle{occluders};
        const LightTree some(direct);
        const LightTree tree(indirect);
        expect_right(tree, points, oracle, [&](int c) { return pairs_of(points, indirect, oracle, c); });
        expect_right(LightForest(some, tree), points, oracle, [&](int c) {
            Pairs pairs = pairs_of(points, indirect, oracle, c);
            pairs.fixed = sum_of_pairs(points, direct, oracle)[c];
            return pairs;
        });
    }
}

TEST(GatherClamping, OfGlossyPointsIsTheFixedPointToo) {
    for (std::uint64_t seed = 20; seed < 23; ++seed) {
        Random random(seed);
        Room<V> room(seed);
        const auto points = glossy_points(random, 20, 0.2, 0.7);
        const auto indirect = with_spikes(room, 250, points);
        const auto occluders = room.occluders();
        const ScalarOccluders oracle{occluders};
        const LightTree tree(indirect);
        expect_right(tree, points, oracle, [&](int c) { return pairs_of(points, indirect, oracle, c); });
    }
}

TEST(GatherClamping, OfLightsAtInstantsIsByTheStrengthThen) {
    for (std::uint64_t seed = 40; seed < 46; ++seed) {
        Random random(seed);
        Room<V> room(seed);
        const auto instants = static_cast<std::uint32_t>(1 + random.below(12));
        const auto still_points = diffuse_points(random, 24, 0.3, 1.0);
        const auto points = at_instants(still_points, instants);
        const auto moving = at_instants(with_spikes(room, 240, points), instants);
        const auto still = with_spikes(room, 60, points);
        const auto occluders = room.occluders();
        const ScalarOccluders oracle{occluders};
        const LightTree moving_tree(moving);
        const LightTree still_tree(still);
        const LightForest only(moving_tree);
        const LightForest both(moving_tree, still_tree);
        expect_right(TimedForest(only, instants), points, oracle,
                     [&](int c) { return pairs_of(points, moving, oracle, c); });
        expect_right(TimedForest(both, instants), points, oracle, [&](int c) {
            Pairs pairs = pairs_of(points, moving, oracle, c);
            const Pairs others = pairs_of(points, still, oracle, c);
            for (Addition a : others.additions) {
                a.light += moving.size();
                pairs.additions.push_back(a);
            }
            Box box;
            double sum = 0.0;
            const auto look_at = [&](const auto& lights) {
                for (const auto& l : lights) {
                    box = merge(box, box_of(l.position));
                    sum += static_cast<double>(l.intensity[c]);
                }
            };
            look_at(moving);
            look_at(still);
            pairs.whole = 1e-9 * sum / diagonal2(box);
            return pairs;
        });
    }
}

TEST(GatherClamping, OfOnePointIsThatOfItsLightcut) {
    Random random(3);
    Room<V> room(3);
    for (const DiffusePoint& p : diffuse_points(random, 20, 1.0, 3.0)) {
        if (channel_sum(p.strength) == 0.0) continue;
        const auto lights = with_spikes(room, 500, std::vector{p});
        const LightTree tree(lights);
        const LightcutOptions options{.max_cut = 300, .clamp = automatic_clamping};
        const auto cut = shade(tree, p.receiver, AlwaysVisible{}, options);
        const auto result = gather(tree, std::vector{p}, AlwaysVisible{}, ProductOptions{.cut = options});
        for (int c = 0; c < 3; ++c) {
            EXPECT_FLOAT_EQ(result.radiance[c], cut.radiance[c] * p.strength[c]);
            EXPECT_FLOAT_EQ(result.error_bound[c], cut.error_bound[c] * p.strength[c]);
            EXPECT_FLOAT_EQ(result.clamp_threshold[c], cut.clamp_threshold[c] * p.strength[c]);
            EXPECT_LE(result.largest_bound[c], 1.0101f * options.error_ratio * result.radiance[c]);
        }
        EXPECT_EQ(result.cut_size, cut.cut_size);
        EXPECT_EQ(result.queries, cut.queries);
    }
}

/// A receiver that is cut into gather points, of unlike strengths in each channel, is clamped as the whole.
TEST(GatherClamping, OfManyPointsAtOnePlaceIsThatOfTheLightcut) {
    Random random(5);
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Room<V> room(seed);
        const DiffusePoint whole = diffuse_points(random, 20, 1.0, 3.0)[random.below(20)];
        std::vector<DiffusePoint> parts;
        V sum(0.0f);
        for (int i = 0; i < 13; ++i) {
            parts.push_back({whole.receiver, V(random.real(0, 1), random.chance(0.3) ? 0.0f : 1.0f, 0.2f)});
            sum += parts.back().strength;
        }
        const auto lights = with_spikes(room, seed % 2 == 0 ? 60 : 400, parts);
        const LightTree tree(lights);
        const auto occluders = room.occluders();
        const ScalarOccluders oracle{occluders};
        const auto one = exhaustive(tree, whole.receiver, oracle, automatic_clamping);
        const auto many = gather(tree, parts, oracle, clamped(exact, 0.01f));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(many.radiance[c], one.radiance[c] * sum[c], 1e-4f * one.radiance[c] * sum[c]);
            if (one.clamp_threshold[c] < std::numeric_limits<float>::infinity()) {
                EXPECT_NEAR(many.clamp_threshold[c], one.clamp_threshold[c] * sum[c],
                            1e-4f * one.clamp_threshold[c] * sum[c]);
            } else {
                EXPECT_GE(many.clamp_threshold[c], 0.9999f * many.radiance[c]) << "no limit at one place";
            }
        }
    }
}

/// Lights that are alike are no spikes, however few; nor does a scale of strengths, or of intensities, make them ones.
TEST(GatherClamping, ChangesNothingWhereLightsAreAlike) {
    Random random(6);
    std::vector<DiffusePoint> points;
    for (std::uint32_t i = 0; i < 12; ++i) {
        const V p(0.01f * random.real(-1, 1), 0.01f * random.real(-1, 1), 0.0f);
        points.push_back({{p, Lambert<V>{{0, 0, 1}, V(1.0f)}, p, i}, V(random.real(0.1, 1))});
    }
    for (const int n : {1, 2, 3, 10, 150, 500}) {
        std::vector<Virtual> lights;
        for (int i = 0; i < n; ++i) {
            const double turn = 6.2831853 * i / n;
            lights.push_back({{{static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn)), 3.0f},
                               {0, 0, -1},
                               V(1.0f, 2.0f, 3.0f),
                               {}}});
        }
        for (const float scale : {1.0f, 1e-12f, 1e6f}) {
            auto scaled = points;
            for (DiffusePoint& p : scaled) p.strength *= scale;
            const LightTree tree(lights);
            const V free = gather(tree, scaled, AlwaysVisible{}, exact).radiance;
            for (const ProductOptions& options : {exact, ProductOptions{.cut = {.exhaustive_below = 0}}}) {
                const V found = gather(tree, scaled, AlwaysVisible{}, clamped(options, 0.01f)).radiance;
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], free[c], 0.02f * free[c]) << n << " " << scale;
            }
        }
    }
}

/// total = direct + n ratio total, where every light is clamped.
TEST(GatherClamping, OfAllLightsLeavesWhatTheyMayAdd) {
    Random random(7);
    std::vector<DiffusePoint> points;
    for (std::uint32_t i = 0; i < 9; ++i) {
        const V p(0.01f * random.real(-1, 1), 0.01f * random.real(-1, 1), 0.0f);
        points.push_back({{p, Lambert<V>{{0, 0, 1}, V(1.0f)}, p, i}, V(random.real(0.1, 1), 0.5f, 0.25f)});
    }
    const std::vector<OrientedPointLight<V>> direct{{{0, 0, 5}, {0, 0, -1}, V(1.0f), {}}};
    std::vector<Virtual> strong;
    constexpr int n = 600;
    for (int i = 0; i < n; ++i) {
        strong.push_back({{{random.real(-1, 1), random.real(-1, 1), 1.0f}, {0, 0, -1}, V(1e2f), {}}});
    }
    const LightTree a(direct);
    const LightTree b(strong);
    constexpr float ratio = 0.001f;
    ASSERT_LT(2.0f / n, 0.01f);
    const glm::dvec3 light = sum_of_pairs(points, direct, [](const auto&, const auto&) { return 1.0; });
    const auto result = gather(LightForest(a, b), points, AlwaysVisible{}, clamped(exact, ratio));
    // 600 of 2 / 600 each could be all of it: of fewer than 2 / ratio lights each may add 2 / n.
    EXPECT_GT(result.radiance.x, 100.0 * light.x);
    std::vector<Virtual> few(strong.begin(), strong.begin() + 300);
    while (few.size() < 3000) {
        few.push_back(strong[few.size() % strong.size()]);
        few.back().intensity = V(1e-4f);
    }
    const LightTree dim(few);
    const auto some = gather(LightForest(a, dim), points, AlwaysVisible{}, clamped(exact, ratio));
    const std::vector<Virtual> rest(few.begin() + 300, few.end());
    const glm::dvec3 unclamped = light + sum_of_pairs(points, rest, [](const auto&, const auto&) { return 1.0; });
    for (int c = 0; c < 3; ++c) {
        const double total = unclamped[c] / (1.0 - 300 * static_cast<double>(ratio));
        EXPECT_NEAR(some.radiance[c], total, 1e-4 * total);
    }
}

/// Whether a spike is one depends on how many others arrive. A cluster whose representatives arrive may have no other.
TEST(GatherClamping, KeepsTheErrorWithinItsBoundWhereFewOfAClusterArrive) {
    Random random(11);
    std::vector<DiffusePoint> points;
    for (std::uint32_t i = 0; i < 6; ++i) {
        const V p(0.02f * random.real(-1, 1), 0.02f * random.real(-1, 1), 0.0f);
        points.push_back({{p, Lambert<V>{{0, 0, 1}, V(1.0f)}, p, i}, V(random.real(0.1, 1))});
    }
    std::vector<Virtual> lights;
    for (int i = 0; i < 120; ++i) {
        const double turn = 6.2831853 * i / 120;
        lights.push_back({{{static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn)), 3.0f},
                           {0, 0, -1},
                           V(1.0f),
                           {}}});
    }
    lights.push_back({{{0.0f, 0.0f, 0.5f}, {0, 0, -1}, V(100.0f), {}}});
    const LightTree tree(lights);
    int fooled = 0;
    for (std::size_t only = 0; only < 120; only += 3) {
        // Of two that arrive neither is clamped.
        const auto seen = [&](const auto&, const Virtual& light) {
            return light.position == lights[only].position || light.position == lights.back().position ? 1.0f : 0.0f;
        };
        const double truth = pairs_of(points, lights, seen, 0).total(0.01);
        for (const std::size_t most : {3u, 6u, 10u, 20u, 40u}) {
            for (const std::uint64_t seed : {1u, 2u, 3u}) {
                const auto result = gather(
                    tree, points, seen,
                    {.cut = {.max_cut = most, .exhaustive_below = 0, .seed = seed, .clamp = automatic_clamping}});
                const double error = std::abs(static_cast<double>(result.radiance.x) - truth);
                EXPECT_LE(error, static_cast<double>(result.error_bound.x) + 1e-4 * truth) << only << " " << most;
                fooled += error > 0.5 * truth ? 1 : 0;
            }
        }
    }
    EXPECT_GT(fooled, 20);
}

/// A third light that adds next to nothing changes next to nothing, however unlike the points are.
TEST(GatherClamping, IsContinuousInALightThatIsAdded) {
    std::vector<DiffusePoint> points;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const V p(static_cast<float>(i), 0.0f, 0.0f);
        points.push_back({{p, Lambert<V>{{0, 0, 1}, V(1.0f)}, p, i}, V(0.25f)});
    }
    const auto light = [](const V& at, float intensity) { return Virtual{{at, {0, 0, -1}, V(intensity), {}}}; };
    const auto total_with = [&](std::size_t lights, float third) {
        // A spike at the first point, a light for all of them, and one more.
        std::vector<Virtual> all = {light({0, 0, 0.05f}, 1), light({1.5f, 0, 1}, 1), light({1.5f, 0.1f, 1}, third)};
        all.resize(lights);
        const LightTree tree(all);
        return gather(tree, points, AlwaysVisible{}, clamped(exact, 0.01f)).radiance.x;
    };
    for (const std::size_t others : {1u, 2u}) {
        const float without = total_with(others, 0.0f);
        for (const float third : {0.0f, 1e-14f, 1e-12f, 1e-11f}) {
            EXPECT_NEAR(total_with(3, third), total_with(2, 0.0f), 0.02f * total_with(2, 0.0f)) << third;
        }
        EXPECT_GT(without, 0.0f);
    }
}

TEST(GatherClamping, OfDarknessIsDarkness) {
    Random random(8);
    Room<V> room(8);
    const auto points = diffuse_points(random, 20, 0.3, 1.0);
    const auto lights = with_spikes(room, 200, points);
    const LightTree tree(lights);
    const auto never = [](const auto&, const auto&) { return 0.0f; };
    for (const ProductOptions& options : {exact, ProductOptions{}}) {
        const auto result = gather(tree, points, never, clamped(options, 0.01f));
        EXPECT_EQ(result.radiance, V(0.0f));
        for (int c = 0; c < 3; ++c) EXPECT_FALSE(std::isnan(result.error_bound[c]));
        EXPECT_EQ(result.clamp_threshold, V(std::numeric_limits<float>::infinity()));
    }
    EXPECT_EQ(gather(tree, points, never, clamped(exact, 0.01f)).error_bound, V(0.0f));
    const auto none = std::vector<DiffusePoint>{};
    EXPECT_EQ(gather(tree, none, AlwaysVisible{}, clamped(exact, 0.01f)).radiance, V(0.0f));
}

TEST(GatherClamping, IfOffChangesNoBit) {
    Random random(9);
    Room<V> room(9);
    const auto points = diffuse_points(random, 40, 0.3, 1.0);
    const auto plain = room.oriented(400);
    const auto lights = marked(plain);
    const LightTree a(plain);
    const LightTree b(lights);
    const auto of_a = gather(a, points), of_b = gather(b, points);
    EXPECT_EQ(of_a.radiance, of_b.radiance);
    EXPECT_EQ(of_a.error_bound, of_b.error_bound);
    EXPECT_EQ(of_a.largest_bound, of_b.largest_bound);
    EXPECT_EQ(of_a.cut_size, of_b.cut_size);
    EXPECT_EQ(of_b.clamp_threshold, V(std::numeric_limits<float>::infinity()));
    EXPECT_EQ(sizeof(ProductNode<V>) + sizeof(V), sizeof(ProductNode<V, true>));
}

/// Neither on what a scratch was used for before, nor on batches, nor on threads.
TEST(GatherClamping, DoesNotDependOnThreads) {
    Room<V> room(10);
    std::vector<std::vector<DiffusePoint>> sums;
    for (std::uint64_t i = 0; i < 24; ++i) {
        Random random(i);
        sums.push_back(diffuse_points(random, 5 + i, 0.3, 1.0));
    }
    const auto lights = with_spikes(room, 600, sums.back());
    const LightTree tree(lights);
    const auto occluders = room.occluders();
    const auto all = [&](const auto& oracle, std::size_t tile, const auto& execute) {
        std::vector<GatherResult<V>> results(sums.size());
        execute(sums.size() / tile, [&](std::size_t t) {
            GatherForest<DiffusePoint> trees;
            gather_scratch_of<decltype(tree)> scratch;
            for (std::size_t i = t * tile; i < (t + 1) * tile; ++i) {
                trees.build(sums[i], {});
                results[i] = gather(tree, trees, oracle, scratch,
                                    {.cut = {.exhaustive_below = 0, .clamp = automatic_clamping}});
            }
        });
        return results;
    };
    const auto alone = all(ScalarOccluders{occluders}, 1, Sequential{});
    for (const auto& other :
         {all(BatchedOccluders{occluders}, 24, Sequential{}), all(ScalarOccluders{occluders}, 4, FourThreads{})}) {
        for (std::size_t i = 0; i < sums.size(); ++i) {
            EXPECT_EQ(alone[i].radiance, other[i].radiance);
            EXPECT_EQ(alone[i].error_bound, other[i].error_bound);
            EXPECT_EQ(alone[i].clamp_threshold, other[i].clamp_threshold);
            EXPECT_EQ(alone[i].cut_size, other[i].cut_size);
        }
    }
}

TEST(GatherClamping, ByRadianceIsRefused) {
    Room<V> room(2);
    const auto lights = marked(room.oriented(50));
    const LightTree tree(lights);
    const auto no_points = std::vector<DiffusePoint>{};
    EXPECT_THROW(gather(tree, no_points, AlwaysVisible{}, ProductOptions{.cut = {.clamp = {.radiance = 1.0f}}}),
                 invalid_input);
}

}  // namespace
}  // namespace lightcuts::test
