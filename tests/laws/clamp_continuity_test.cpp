// Automatic clamping changes gradually with what each light adds, and a cut's error bound covers what it takes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/light/clampable.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/phong.hpp>
#include <lightcuts/shading/receiver.hpp>
#include "support/random.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
using Virtual = VirtualPointLight<float>;

const Receiver<Lambert<float>> floor_point(V(0.0f), Lambert<float>{{0.0f, 0.0f, 1.0f}, 0.5f});

/// n lights that are alike, on a ring above the origin.
std::vector<Virtual> ring(std::size_t n) {
    std::vector<Virtual> lights;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 6.28318530718 * static_cast<double>(i) / static_cast<double>(n);
        const V direction = glm::normalize(V(std::cos(angle), std::sin(angle), 1.0));
        lights.push_back({{direction, -direction, 1.0f, {}}});
    }
    return lights;
}

/// Lets through a fraction of each light.
struct Filter {
    const Virtual* lights;
    std::vector<float> through;

    float operator()(const auto&, const Virtual& light) const {
        return through[static_cast<std::size_t>(&light - lights)];
    }
};

/// By how much the clamped total may change for each bit of a light's own: x = total / (n counted radiances), of n
/// lights that count. The total is rest / (1 - slope), where rest is at least n / 2 counted radiances and 1 - slope at
/// least rest / total; and a contribution counts in steps of the counted radiance.
double lipschitz(double total, double whole) {
    const double x = total / whole;
    return 4.0 * (1.0 + x) * (1.0 + x);
}

double counted(const std::vector<Virtual>& lights) {
    Box box;
    double intensity = 0.0;
    for (const Virtual& light : lights) {
        box = merge(box, box_of(light.position));
        intensity += static_cast<double>(light.intensity);
    }
    return 1e-9 * intensity / diagonal2(box);
}

double clamped_total(const LightTree<Virtual>& tree, const Filter& filter, float ratio) {
    return static_cast<double>(exhaustive(tree, floor_point, filter, {.ratio = ratio}).radiance);
}

/// Fractions of very different sizes, or of two.
std::vector<float> some_fractions(Random& random, std::size_t n) {
    const bool two = random.chance(0.5);
    const double dark = random.decades(-12.0, -1.0);
    std::vector<float> all(n);
    for (float& f : all) {
        f = static_cast<float>(random.chance(0.1)   ? 0.0
                               : !two               ? random.decades(-14.0, 0.0)
                               : random.chance(0.5) ? 1.0
                                                    : dark);
    }
    return all;
}

// Whether next to nothing arrives, or nothing, is all the same.
TEST(ClampingIsContinuous, WhereNextToNothingArrives) {
    Random random(1);
    int clamped = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto lights = ring(3 + random.below(60));
        const LightTree tree(lights);
        const float ratio = random.chance(0.5) ? 0.01f : static_cast<float>(random.decades(-3.0, -1.0));
        Filter filter{lights.data(), some_fractions(random, lights.size())};
        const auto faint = static_cast<float>(random.decades(-45.0, -24.0));
        double change = 0.0;
        const std::size_t changed = random.chance(0.5) ? 1 : random.below(lights.size());
        for (std::size_t j = 0; j < changed; ++j) {
            float& f = filter.through[random.below(lights.size())];
            f = 0.0f;
        }
        Filter with = filter;
        for (float& f : with.through) {
            if (f == 0.0f) {
                f = faint;
                change += static_cast<double>(faint);
            }
        }
        const double before = clamped_total(tree, filter, ratio), after = clamped_total(tree, with, ratio);
        const double most = std::max(before, after);
        ASSERT_NEAR(before, after, 1e-6 * most + change * lipschitz(most, counted(lights))) << i;
        const double all = static_cast<double>(exhaustive(tree, floor_point, filter).radiance);
        clamped += before < 0.99 * all ? 1 : 0;
    }
    EXPECT_GT(clamped, 5000);
}

// While a light is turned up from nothing, the total never jumps.
TEST(ClampingIsContinuous, WhileALightIsTurnedUp) {
    Random random(2);
    int moved = 0;
    for (int i = 0; i < 200; ++i) {
        const auto lights = ring(3 + random.below(30));
        const LightTree tree(lights);
        Filter filter{lights.data(), some_fractions(random, lights.size())};
        const double whole = counted(lights);
        const std::size_t one = random.below(lights.size());
        // Where a light alone would add a counted radiance.
        filter.through[one] = 1.0f;
        Filter alone{lights.data(), std::vector<float>(lights.size(), 0.0f)};
        alone.through[one] = 1.0f;
        const double unit = clamped_total(tree, alone, 0.01f);
        double last_total = -1.0, first = 0.0, last_added = 0.0;
        for (int step = 0; step <= 400; ++step) {
            const double fraction = step == 0 ? 0.0 : std::pow(10.0, -14.0 + 14.0 * step / 400.0);
            filter.through[one] = static_cast<float>(fraction);
            const double added = static_cast<double>(filter.through[one]) * unit;
            const double total = clamped_total(tree, filter, 0.01f);
            if (step > 0) {
                const double most = std::max(total, last_total);
                ASSERT_NEAR(total, last_total, (added - last_added) * lipschitz(most, whole) + 1e-6 * most) << i;
            } else {
                first = total;
            }
            last_total = total;
            last_added = added;
        }
        moved += std::fabs(last_total - first) > 0.01 * first ? 1 : 0;
    }
    EXPECT_GT(moved, 100);
}

// The threshold itself, with steps that are not small against what they change: a counted radiance like the others'.
TEST(ClampingIsContinuous, InEveryContribution) {
    Random random(3);
    int steep = 0;
    for (int i = 0; i < 100000; ++i) {
        std::vector<float> all(3 + random.below(random.chance(0.7) ? 12 : 300));
        for (float& raw : all) raw = static_cast<float>(random.decades(random.chance(0.5) ? -1.0 : -4.0, 0.0));
        const double whole = random.decades(-4.0, 0.0);
        const double fixed = random.chance(0.5) ? 0.0 : random.decades(-4.0, 0.0);
        const ClampingOptions clamp{.ratio = static_cast<float>(random.decades(-3.0, -0.5))};
        const auto total_of = [&] {
            const auto visit = [&](auto&& f) {
                for (const float raw : all) f(raw, 1.0);
            };
            return detail::clamped_total<float>(clamp, detail::effective_ratios<float>(clamp, {1.0 / whole}, visit),
                                                {fixed}, {}, 1e-13, visit)
                .total[0];
        };
        const double before = total_of();
        float& one = all[random.below(all.size())];
        const float old = one;
        one = old * (1.0f + random.real(-1e-5, 1e-5));
        const double after = total_of(), most = std::max(before, after);
        const double change = std::fabs(static_cast<double>(one) - static_cast<double>(old));
        ASSERT_NEAR(before, after, change * lipschitz(most, whole) + 1e-11 * most) << i;
        steep += std::fabs(after - before) > 2.0 * change ? 1 : 0;
    }
    EXPECT_GT(steep, 100);
}

/// What a cut and the exhaustive sum come to, of few lights on a glossy surface.
void expect_error_within_bound(Random& random, int& bounded, int& unequal) {
    std::vector<Virtual> lights(2 + random.below(random.chance(0.9) ? 60 : 300));
    const double spread = random.decades(-2.0, 1.0);
    const V receiver_at(0.0f);
    for (Virtual& light : lights) {
        const double far = random.chance(0.1) ? random.decades(-4.0, 0.0) : 1.0;
        const V place(far * (glm::dvec3(0.0, 0.0, 1.0) + spread * random.on_sphere()));
        light = {{place,
                  V(random.near(-glm::normalize(glm::dvec3(place) + 1e-9), 2.0)),
                  static_cast<float>(random.decades(-3.0, 0.0)),
                  {}}};
    }
    const V normal(random.near({0.0, 0.0, 1.0}, 1.2)), view(random.near({0.0, 0.0, 1.0}, 1.5));
    const auto exponent = static_cast<float>(random.decades(0.0, 3.5));
    const Receiver<ModifiedPhong<float>> receiver(receiver_at,
                                                  ModifiedPhong<float>(normal, view, random.real(0.1, 1.0), exponent));
    const double seen = random.unit();
    const auto oracle = [&](const auto&, const Virtual& light) {
        const auto bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(light.position.x * 1e6f));
        return uniform01(hash_keys(7, bits)) < seen ? 1.0f : 0.0f;
    };
    const LightTree tree(lights, {.representatives = random.chance(0.5) ? 1u : 4u});
    const LightcutOptions options{
        .error_ratio = random.chance(0.3) ? 0.0f : random.real(0.01, 0.5),
        .max_cut = random.chance(0.5) ? 0 : 1 + random.below(40),
        .exhaustive_below = 0,
        .seed = random.bits(),
        .clamp = {.radiance = random.chance(0.8) ? std::numeric_limits<float>::infinity()
                                                 : static_cast<float>(random.decades(-6, 0)),
                  .ratio = random.chance(0.5) ? 0.01f : static_cast<float>(random.decades(-3.0, -0.1))}};
    const double exact = static_cast<double>(exhaustive(tree, receiver, oracle, options.clamp).radiance);
    Lightcut cut(tree, receiver, oracle, options);
    for (bool more = true; more; more = cut.step()) {
        const CutResult<float> result = cut.result();
        const auto total = static_cast<double>(result.radiance), bound = static_cast<double>(result.error_bound);
        ASSERT_FALSE(std::isnan(total + bound));
        ASSERT_LE(std::fabs(total - exact), bound + 1e-5 * (exact + total)) << lights.size() << " " << result.cut_size;
        bounded += bound < total ? 1 : 0;
        unequal += std::fabs(total - exact) > 0.01 * exact ? 1 : 0;
    }
    const CutResult<float> result = cut.result();
    if (options.error_ratio == 0.0f && options.max_cut == 0) {
        ASSERT_NEAR(static_cast<double>(result.radiance), exact, 1e-5 * exact) << lights.size();
    }
}

TEST(ClampingIsContinuous, AndItsErrorIsBoundedOnGlossySurfaces) {
    Random random(4);
    int bounded = 0, unequal = 0;
    for (int i = 0; i < 20000 && !testing::Test::HasFatalFailure(); ++i) {
        SCOPED_TRACE(i);
        expect_error_within_bound(random, bounded, unequal);
    }
    EXPECT_GT(bounded, 10000) << "it says something";
    EXPECT_GT(unequal, 10000) << "there is something to bound";
}

}  // namespace
}  // namespace lightcuts::test
