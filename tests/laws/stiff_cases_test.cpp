#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/power.hpp>
#include <lightcuts/estimate/ward.hpp>
#include <lightcuts/material/phong.hpp>
#include <lightcuts/material/ward.hpp>
#include "support/contraction.hpp"
#include "support/scene.hpp"

// The table of stiff cases, row by row: each runs through the whole of shading, not through the bounds alone.
namespace lightcuts::test {
namespace {

using V = glm::vec3;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr LightcutOptions exact_options{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0};

bool is_finite_color(const V& v) { return v.x - v.x == 0.0f && v.y - v.y == 0.0f && v.z - v.z == 0.0f; }

Receiver<Lambert<V>> floor_at(const V& position) { return {position, Lambert<V>{{0.0f, 0.0f, 1.0f}, V(0.5f)}}; }

/// By how much two sums may differ of which the cosines are rounded in two ways; else they are the same.
template <Light L>
V rounding_of_cosines(const std::vector<L>& lights, const V& position) {
    V sum(0.0f);
    if (!is_contracted) return sum;
    for (const L& light : lights) {
        const double geometric = incidence(light, position).geometric;
        if (geometric < 1e30) sum += light.intensity * static_cast<float>(0x1p-22 * geometric);
    }
    return sum;
}

/// Every estimator agrees with the exhaustive sum, the cut within its bound, and nothing is NaN. Returns that sum.
template <Light L, class M>
V expect_sound(const std::vector<L>& lights, const Receiver<M>& receiver, double tolerance = 1e-5) {
    const LightTree<L> tree(lights);
    const LightForest<L> forest(tree);
    EstimateScratch<V> scratch;
    const V exact = exhaustive(forest, receiver, AlwaysVisible{}, scratch).radiance;
    const V by_ward = ward(forest, receiver, AlwaysVisible{}, 0.0f, scratch).radiance;
    const V refined = shade(tree, receiver, AlwaysVisible{}, exact_options).radiance;
    EXPECT_TRUE(is_finite_color(exact));
    const V rounding = rounding_of_cosines(lights, receiver.position);
    const auto allowed = [&](int c) {
        return tolerance * static_cast<double>(exact[c]) + static_cast<double>(rounding[c]);
    };
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(by_ward[c], exact[c], allowed(c));
        EXPECT_NEAR(refined[c], exact[c], allowed(c));
    }
    for (const LightcutOptions& options :
         {LightcutOptions{}, LightcutOptions{.exhaustive_below = 0}, LightcutOptions{.max_cut = 1},
          LightcutOptions{.max_cut = 2}, LightcutOptions{.max_cut = lights.size(), .exhaustive_below = 0},
          LightcutOptions{.error_ratio = 0.5f, .exhaustive_below = 0},
          LightcutOptions{.exhaustive_below = 0, .adaptation = 1.0f}}) {
        const CutResult<V> cut = shade(tree, receiver, AlwaysVisible{}, options);
        EXPECT_TRUE(is_finite_color(cut.radiance));
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(cut.radiance[c], 0.0f);
            EXPECT_GE(cut.error_bound[c], 0.0f) << "also not NaN";
            EXPECT_LE(std::fabs(static_cast<double>(cut.radiance[c]) - static_cast<double>(exact[c])),
                      static_cast<double>(cut.error_bound[c]) + allowed(c));
        }
    }
    return exact;
}

std::size_t depth_of(const ClusterTree& tree) {
    std::vector<std::size_t> depth(tree.size(), 0);
    std::size_t deepest = 0;
    for (std::size_t k = tree.size(); k-- > 0;) {
        const auto n = static_cast<ClusterTree::node_index>(k);
        deepest = std::max(deepest, depth[n]);
        if (!tree.is_leaf(n)) depth[tree.left(n)] = depth[tree.right(n)] = depth[n] + 1;
    }
    return deepest;
}

template <Light L>
double closed_form(const L& light, const V& receiver) {
    const glm::dvec3 p = glm::dvec3(light.position) - glm::dvec3(receiver);
    const double d2 = glm::dot(p, p);
    return p.z > 0.0 ? static_cast<double>(0.5f) / std::numbers::pi * static_cast<double>(light.intensity.x) * p.z /
                           std::sqrt(d2) / d2
                     : 0.0;
}

TEST(StiffCase, NoLight) {
    const std::vector<OmniLight<>> none;
    EXPECT_EQ(expect_sound(none, floor_at(V(0.0f))), V(0.0f));
    const LightTree tree(none);
    EXPECT_TRUE(tree.empty());
    EXPECT_EQ(shade(tree, floor_at(V(0.0f))).cut_size, 0u);
    EXPECT_EQ(shade(LightTree<OmniLight<>>(), floor_at(V(0.0f))).stop, StopReason::converged);
    EXPECT_TRUE(PowerDistribution(LightForest(tree)).empty());
}

TEST(StiffCase, OneLight) {
    const std::vector<OmniLight<>> lights{{{0.3f, -0.2f, 1.7f}, {3.0f, 2.0f, 1.0f}, {}}};
    const V exact = expect_sound(lights, floor_at(V(0.0f)));
    EXPECT_NEAR(exact.x, closed_form(lights[0], V(0.0f)), 1e-5 * static_cast<double>(exact.x));
    const LightTree tree(lights);
    const auto cut = shade(tree, floor_at(V(0.0f)));
    EXPECT_EQ(cut.cut_size, 1u);
    EXPECT_EQ(cut.error_bound, V(0.0f));
}

TEST(StiffCase, AllLightsDark) {
    const std::vector<OmniLight<>> lights(5, {{0.0f, 0.0f, 1.0f}, V(0.0f), {}});
    EXPECT_EQ(expect_sound(lights, floor_at(V(0.0f))), V(0.0f));
    EXPECT_TRUE(LightTree(lights).empty());
}

TEST(StiffCase, DarkLightsAmongOthers) {
    std::vector<OmniLight<>> lights;
    for (int i = 0; i < 40; ++i)
        lights.push_back({{0.1f * static_cast<float>(i), 0.0f, 1.0f}, V(i % 3 == 1 ? 1.0f : 0.0f), {}});
    expect_sound(lights, floor_at(V(0.0f)));
    EXPECT_EQ(LightTree(lights).topology().item_count(), 13u);
}

TEST(StiffCase, CoincidentLights) {
    const std::vector<OmniLight<>> lights(1000, {{0.0f, 1.0f, 2.0f}, {1.0f, 0.5f, 0.25f}, {}});
    const V exact = expect_sound(lights, floor_at(V(0.0f)));
    EXPECT_NEAR(exact.x, 1000.0 * closed_form(lights[0], V(0.0f)), 1e-5 * static_cast<double>(exact.x));
    const LightTree tree(lights);
    EXPECT_LE(depth_of(tree.topology()), 12u);
    // Any light stands for all of them exactly, with or without refinement.
    const auto one = shade(tree, floor_at(V(0.0f)), AlwaysVisible{}, {.max_cut = 1});
    EXPECT_NEAR(one.radiance.x, exact.x, 1e-5 * static_cast<double>(exact.x));
}

TEST(StiffCase, AllLightsAtTheReceiver) {
    const std::vector<OmniLight<>> lights(20, {{1.0f, 2.0f, 3.0f}, V(1.0f), {}});
    EXPECT_EQ(expect_sound(lights, floor_at({1.0f, 2.0f, 3.0f})), V(0.0f));
    const std::vector<OrientedPointLight<>> oriented(20, {{1.0f, 2.0f, 3.0f}, {0.0f, 0.0f, -1.0f}, V(1.0f), {}});
    EXPECT_EQ(expect_sound(oriented, floor_at({1.0f, 2.0f, 3.0f})), V(0.0f));
}

TEST(StiffCase, ReceiverOnACornerAFaceOrInsideTheBox) {
    Random random(1);
    std::vector<OmniLight<>> lights;
    for (int i = 0; i < 8; ++i) {
        lights.push_back(
            {{i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f}, V(random.real(0.1, 1.0)), {}});
    }
    for (int i = 0; i < 100; ++i) lights.push_back({V(random.in_box(glm::dvec3(-1.0), glm::dvec3(1.0))), V(1.0f), {}});
    for (const V& x : {V(1.0f, 1.0f, 1.0f), V(-1.0f, 1.0f, -1.0f), V(0.3f, -1.0f, 0.2f), V(0.0f, 0.0f, 1.0f),
                       V(0.1f, 0.2f, 0.3f), V(0.0f)}) {
        const Receiver<Lambert<V>> receiver = floor_at(x);
        expect_sound(lights, receiver);
        // A cluster that may touch the receiver is never left unrefined, unless the limit comes first; then the bound
        // says so.
        const LightTree tree(lights);
        const auto limited = shade(tree, receiver, AlwaysVisible{}, {.max_cut = 1});
        if (x.z < 1.0f) {
            EXPECT_EQ(limited.error_bound.x, infinity);
            EXPECT_EQ(limited.stop, StopReason::limit);
        }
        EXPECT_LT(shade(tree, receiver, AlwaysVisible{}, {.max_cut = 0, .exhaustive_below = 0}).error_bound.x,
                  infinity);
    }
}

TEST(StiffCase, EmitterCoplanarWithTheReceiverAndTouchingIt) {
    std::vector<OmniLight<>> lights;
    for (int i = 0; i < 64; ++i)
        lights.push_back({{static_cast<float>(i % 8), static_cast<float>(i / 8), 0.5f}, V(1.0f), {}});
    const auto receiver = floor_at({3.0f, 3.0f, 0.5f});
    EXPECT_EQ(expect_sound(lights, receiver), V(0.0f));
    const LightTree tree(lights);
    const auto cut = shade(tree, receiver, AlwaysVisible{}, {.exhaustive_below = 0});
    EXPECT_EQ(cut.cut_size, tree.start().size()) << "the bound of an axis-aligned coplanar cluster is exactly zero";
    EXPECT_EQ(cut.error_bound, V(0.0f));

    // Turned, what rounding leaves of the cosines is refined, and the result stays next to nothing.
    const glm::dvec3 u = glm::normalize(glm::dvec3(1.0, 2.0, 3.0)),
                     v = glm::normalize(glm::cross(u, glm::dvec3(0.0, 1.0, 0.0)));
    std::vector<OmniLight<>> turned;
    for (int i = 0; i < 64; ++i)
        turned.push_back({V(u * static_cast<double>(i % 8) + v * static_cast<double>(i / 8)), V(1.0f), {}});
    const Receiver<Lambert<V>> facing(turned[27].position, Lambert<V>{V(glm::cross(u, v)), V(0.5f)});
    EXPECT_LT(expect_sound(turned, facing).x, 1e-5f);
}

TEST(StiffCase, BoxBelowTheHorizon) {
    Room<V> room(2);
    std::vector<OmniLight<>> lights = room.omni(200);
    for (auto& l : lights) l.position.z -= 10.0f;
    EXPECT_EQ(expect_sound(lights, floor_at(V(0.0f))), V(0.0f));
    const LightTree tree(lights);
    const Occluders none;
    const auto cut = shade(tree, floor_at(V(0.0f)), ScalarOccluders{none}, {.exhaustive_below = 0});
    EXPECT_EQ(cut.cut_size, tree.start().size()) << "never refined";
    EXPECT_EQ(cut.queries, 0u);
}

TEST(StiffCase, FlatSegmentPointAndNeedleBoxes) {
    Random random(3);
    for (const V& size : {V(1.0f, 1.0f, 0.0f), V(1.0f, 0.0f, 0.0f), V(0.0f), V(1.0f, 1e-6f, 1e-6f),
                          V(1e-6f, 1.0f, 0.0f), V(1.0f, 1e-6f, 1.0f)}) {
        std::vector<OrientedPointLight<>> lights;
        const V axis(random.on_sphere());
        for (int i = 0; i < 50; ++i) {
            const V p(random.in_box(-glm::dvec3(size), glm::dvec3(size)));
            lights.push_back({p, random.chance(0.5) ? axis : V(random.on_sphere()), V(1.0f), {}});
        }
        for (int k = 0; k < 20; ++k) {
            const V x(random.on_sphere() * random.between(0.1, 3.0));
            expect_sound(lights, Receiver<Lambert<V>>(x, Lambert<V>{V(random.on_sphere()), V(0.5f)}));
        }
        // In the box's own plane or line, and with an axis at right angles to it.
        expect_sound(lights, floor_at({2.0f, 0.0f, 0.0f}));
        expect_sound(lights, Receiver<Lambert<V>>({2.0f, 0.0f, 0.0f}, Lambert<V>{{-1.0f, 0.0f, 0.0f}, V(0.5f)}));
    }
}

// Float vector code must not mistake an overflow for a bound.
TEST(StiffCase, OneLightIncomparablyFarAmongNearOnes) {
    for (const float far : {1e9f, 1e15f, 1e17f, 1e18f, 1e19f, 1e20f, 1e30f}) {
        Room<V> room(7);
        std::vector<OmniLight<>> omni = room.omni(64);
        omni.push_back({{far, 0.3f * far, -0.7f * far}, V(1.0f), {}});
        std::vector<OrientedPointLight<>> oriented = room.oriented(64);
        oriented.push_back({{far, 0.3f * far, -0.7f * far}, {-1.0f, 0.0f, 0.0f}, V(1.0f), {}});
        for (const auto& receiver : room.glossy_receivers(10)) {
            expect_sound(omni, receiver);
            expect_sound(oriented, receiver);
        }
        for (const auto& receiver : room.diffuse_receivers(10)) expect_sound(oriented, receiver);
    }
}

TEST(StiffCase, VastAndTinyRooms) {
    for (const float scale : {1e-17f, 1e-15f, 1e15f, 1e17f, 1e18f}) {
        Room<V> room(8);
        std::vector<OmniLight<>> omni = room.omni(64);
        std::vector<OrientedPointLight<>> oriented = room.oriented(64);
        for (auto& l : omni) l.position *= scale;
        for (auto& l : oriented) l.position *= scale;
        for (auto receiver : room.glossy_receivers(10)) {
            receiver.position *= scale;
            expect_sound(omni, receiver);
            expect_sound(oriented, receiver);
        }
    }
}

// The center of the cluster's box lies in the receiver's plane, but for a coordinate that is no normal number.
TEST(StiffCase, CenterInThePlaneUpToADenormal) {
    for (const float z : {1e-3f, 1e-20f, 1e-37f, 1e-38f, 1e-39f, 0.0f}) {
        std::vector<OmniLight<>> lights;
        for (const float x : {0.5f, 1.0f, 1.5f}) {
            for (const float y : {-1.5f, -1.0f, -0.5f}) lights.push_back({{x, y, y < -0.9f ? 0.0f : z}, V(1.0f), {}});
        }
        const V normal(0.70710678f, 0.70710678f, 1e-3f);
        const Receiver<Lambert<V>> receiver(V(0.0f), Lambert<V>{glm::normalize(normal), V(0.5f)});
        expect_sound(lights, receiver);
    }
}

TEST(StiffCase, ExtremeScales) {
    Room<V> room(4);
    const std::vector<OmniLight<>> lights = room.omni(100);
    const auto receiver = floor_at({0.1f, 0.2f, -0.3f});
    const double at_one = static_cast<double>(expect_sound(lights, receiver).x);
    for (const float scale : {0x1p-40f, 0x1p40f}) {  // about 1e-12 and 1e12, exact
        std::vector<OmniLight<>> scaled = lights;
        for (auto& l : scaled) l.position *= scale;
        const double s = static_cast<double>(scale);
        const V exact = expect_sound(scaled, floor_at(receiver.position * scale));
        EXPECT_NEAR(static_cast<double>(exact.x) * s * s, at_one, 1e-6 * at_one);
        // The same cut, since every bound scales likewise.
        const LightTree a(lights);
        const LightTree b(scaled);
        EXPECT_EQ(shade(a, receiver).cut_size, shade(b, floor_at(receiver.position * scale)).cut_size);
    }
}

TEST(StiffCase, LargeOffsetAndSmallExtent) {
    Random random(5);
    std::vector<OrientedPointLight<>> lights;
    const glm::dvec3 far(1e6, -1e6, 1e6);
    for (int i = 0; i < 60; ++i) {
        lights.push_back(
            {V(far + random.in_box(glm::dvec3(-1e-3), glm::dvec3(1e-3))), V(random.on_sphere()), V(1.0f), {}});
    }
    expect_sound(lights, floor_at(V(far)));
    expect_sound(lights, floor_at(V(far - glm::dvec3(0.0, 0.0, 1.0))));
    expect_sound(lights, floor_at(V(0.0f)));
}

TEST(StiffCase, IntensitiesFromDenormalToHuge) {
    Random random(6);
    std::vector<OmniLight<>> lights;
    double sum = 0.0;
    for (int i = 0; i < 200; ++i) {
        const float power = i == 7 ? 1e-45f : static_cast<float>(random.decades(-44.0, 30.0));
        lights.push_back({V(random.in_box({-1.0, -1.0, 0.5}, {1.0, 1.0, 1.5})), V(power), {}});
        sum += static_cast<double>(power);
    }
    expect_sound(lights, floor_at(V(0.0f)));
    const LightTree tree(lights);
    EXPECT_EQ(tree.topology().item_count(), lights.size()) << "a denormal light is lit";
    const double total = static_cast<double>(tree.clusters()[tree.topology().root()].intensity.x);
    EXPECT_NEAR(total, sum, 1e-7 * sum);

    // All of them denormal.
    std::vector<OmniLight<>> faint;
    for (int i = 0; i < 50; ++i) faint.push_back({V(random.in_box({-1.0, -1.0, 0.5}, {1.0, 1.0, 1.5})), V(3e-45f), {}});
    expect_sound(faint, floor_at(V(0.0f)), 1.0);
}

TEST(StiffCase, SumOfIntensitiesBeyondTheLargestFloat) {
    std::vector<OmniLight<>> lights;
    for (int i = 0; i < 16; ++i) lights.push_back({{0.1f * static_cast<float>(i), 0.0f, 1e3f}, V(3e38f), {}});
    const Receiver<Lambert<V>> receiver(V(0.0f), Lambert<V>{{0.0f, 0.0f, 1.0f}, {0.5f, 0.25f, 0.0f}});
    const V exact = expect_sound(lights, receiver);
    EXPECT_GT(exact.x, 1e30f);
    EXPECT_EQ(exact.z, 0.0f);
    const LightTree tree(lights);
    const CutResult<V> cut = shade(tree, receiver, AlwaysVisible{}, {.max_cut = 1});
    EXPECT_EQ(cut.radiance.z, 0.0f) << "what is dark stays dark";
    EXPECT_EQ(cut.error_bound.z, 0.0f);
    const std::vector<OmniLight<>> behind(lights.size(), {{0.0f, 0.0f, -1.0f}, V(3e38f), {}});
    EXPECT_EQ(expect_sound(behind, receiver), V(0.0f));
}

TEST(StiffCase, LightNextToTheReceiver) {
    for (const float distance : {1e-20f, 1e-10f, 1e-30f}) {
        // What is beyond floats is cut off, and times darkness stays dark.
        const std::vector<OmniLight<>> lights{{{0.0f, 0.0f, distance}, {1.0f, 1.0f, 0.0f}, {}},
                                              {{0.0f, 1.0f, 1.0f}, {1.0f, 1.0f, 0.0f}, {}},
                                              {{1.0f, 0.0f, 2.0f}, {1.0f, 1.0f, 0.0f}, {}}};
        const Receiver<Lambert<V>> receiver(V(0.0f), Lambert<V>{{0.0f, 0.0f, 1.0f}, {0.5f, 0.0f, 0.5f}});
        const V exact = expect_sound(lights, receiver);
        EXPECT_GT(exact.x, 1e17f);
        EXPECT_LT(exact.x, infinity);
        EXPECT_EQ(exact.y, 0.0f);
        EXPECT_EQ(exact.z, 0.0f);
        EXPECT_TRUE(is_finite_color(unshadowed_transfer(receiver, lights[0])));
    }
}

TEST(StiffCase, ConesOfEveryWidthAndOppositeAxes) {
    for (const double beta : {0.0, 1e-7, 0.5 * std::numbers::pi, std::numbers::pi}) {
        std::vector<OrientedPointLight<>> lights;
        for (int i = -8; i <= 8; ++i) {
            const double angle = beta * static_cast<double>(i) / 8.0;
            const V axis(static_cast<float>(std::sin(angle)), 0.0f, static_cast<float>(-std::cos(angle)));
            lights.push_back({{0.1f * static_cast<float>(i), 0.2f, 2.0f}, axis, V(1.0f), {}});
        }
        EXPECT_GT(expect_sound(lights, floor_at(V(0.0f))).x, 0.0f);
        EXPECT_GE(
            expect_sound(lights, Receiver<Lambert<V>>({0.0f, 0.0f, 4.0f}, Lambert<V>{{0.0f, 0.0f, -1.0f}, V(0.5f)})).x,
            0.0f);
    }
    const std::vector<OrientedPointLight<>> opposite{{{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, V(1.0f), {}},
                                                     {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, -1.0f}, V(1.0f), {}}};
    EXPECT_GT(expect_sound(opposite, floor_at(V(0.0f))).x, 0.0f);
}

TEST(StiffCase, MaterialsAtTheirLimits) {
    Room<V> room(7);
    const auto omni = room.omni(60);
    const auto oriented = room.oriented(60);
    const V n(0.0f, 0.0f, 1.0f);
    for (const V& view : {n, V(1.0f, 0.0f, 0.0f), V(glm::normalize(glm::dvec3(1.0, 0.0, 1e-6))),
                          V(glm::normalize(glm::dvec3(1.0, 1.0, 1.0)))}) {
        for (const float exponent : {0.0f, 1.0f, 1e6f}) {
            const Receiver<ModifiedPhong<V>> receiver({0.1f, 0.2f, -0.4f},
                                                      ModifiedPhong<V>(n, view, V(0.5f), exponent));
            expect_sound(omni, receiver);
            expect_sound(oriented, receiver);
        }
        for (const float alpha : {1e-3f, 1.0f, 2.0f}) {
            const Receiver<Ggx<V>> receiver({0.1f, 0.2f, -0.4f}, Ggx<V>(n, view, V(0.04f), alpha));
            expect_sound(omni, receiver);
            expect_sound(oriented, receiver);
            const Receiver<Ward<V>> ward_receiver({0.1f, 0.2f, -0.4f}, Ward<V>(n, view, V(0.04f), alpha));
            expect_sound(omni, ward_receiver);
        }
        // A light exactly opposite the viewer.
        const std::vector<OmniLight<>> behind{{-view + V(0.1f, 0.2f, -0.4f), V(1.0f), {}},
                                              {view + V(0.1f, 0.2f, -0.4f), V(1.0f), {}}};
        expect_sound(behind, Receiver<Ggx<V>>({0.1f, 0.2f, -0.4f}, Ggx<V>(n, view, V(0.04f), 0.2f)));
        expect_sound(behind, Receiver<Ward<V>>({0.1f, 0.2f, -0.4f}, Ward<V>(n, view, V(0.04f), 0.2f)));
    }
}

// The light opposite the viewer, and rounding puts both above the horizon: there is no half-vector.
TEST(StiffCase, LightOppositeTheViewerOnTheHorizon) {
    const V normal(0.53032732f, 0.847792983f, 6.43957419e-19f), view(0.847792983f, -0.53032732f, -8.92692995e-08f);
    const V x(9.0257283e-13f, 0.0f, 0.0f);
    const std::vector<OmniLight<>> lights{{{-1.78965539e-13f, 6.76544161e-13f, 1.13881781e-19f}, V(1.0f), {}}};
    const V to_light = incidence(lights[0], x).to_light;
    for (const V& value : {Ggx<V>(normal, view, V(0.5f), 0.1f).evaluate(to_light),
                           Ward<V>(normal, view, V(0.5f), 0.1f).evaluate(to_light)}) {
        EXPECT_TRUE(is_finite_color(value));
    }
    expect_sound(lights, Receiver<Ggx<V>>(x, Ggx<V>(normal, view, V(0.5f), 0.1f)));
    expect_sound(lights, Receiver<Ward<V>>(x, Ward<V>(normal, view, V(0.5f), 0.1f)));
}

// An exponent of zero is as bright just in front of the mirror direction's plane as anywhere, and black behind it: the
// bound and evaluate() have to agree on which side rounding leaves a light in that plane.
TEST(StiffCase, ExponentZeroInThePlaneOfTheViewer) {
    Random random(9);
    for (int trial = 0; trial < 100000; ++trial) {
        // The mirror direction is -z but for rounding, and the light's direction has no z at all.
        const double t = random.decades(-8.0, -5.0), phi = random.between(-1.5, 1.5);
        const V normal(glm::normalize(glm::dvec3(1.0, 0.0, -t))), view(glm::normalize(glm::dvec3(2.0 * t, 0.0, 1.0)));
        const DistantLight<> light{V(glm::dvec3(-std::cos(phi), -std::sin(phi), 0.0)), V(1.0f)};
        const ModifiedPhong<V> material{normal, view, V(1.0f), 0.0f};
        const LightCluster<DistantLight<>> cluster = cluster_of(light);
        const float value = material.evaluate(position_or_direction(light)).x;
        ASSERT_LE(value, TwoStageBounds{}.quick(material, cluster, box_of(V(0.0f))).x) << trial;
        ASSERT_LE(value, TwoStageBounds{}.tight(material, cluster, box_of(V(0.0f))).x) << trial;
    }
}

TEST(StiffCase, NanAndInfinityNeverComeOutOfRandomTrouble) {
    Random random(8);
    for (int trial = 0; trial < 300; ++trial) {
        std::vector<OrientedPointLight<>> lights;
        const double scale = random.decades(-12.0, 12.0);
        for (int i = 0; i < 20; ++i) {
            lights.push_back({V(random.in_box(glm::dvec3(-scale), glm::dvec3(scale))),
                              V(glm::normalize(random.on_sphere())),
                              V(static_cast<float>(random.decades(-30.0, 10.0))),
                              {}});
        }
        if (random.chance(0.5)) lights[3].position = lights[4].position = lights[5].position;
        const V x = random.chance(0.3) ? lights[3].position : V(random.in_box(glm::dvec3(-scale), glm::dvec3(scale)));
        expect_sound(lights, Receiver<Lambert<V>>(x, Lambert<V>{V(random.on_sphere()), V(0.7f)}), 1e-4);
    }
}

}  // namespace
}  // namespace lightcuts::test
