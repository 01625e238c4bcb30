#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/tree/light_tree.hpp>
#include <lightcuts/tree/validate.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

// What a scene does not need takes no space.
static_assert(sizeof(LightCluster<OmniLight<>>) == 36);
static_assert(sizeof(LightCluster<OmniLight<float>>) == 28);
static_assert(sizeof(LightCluster<DistantLight<>>) == 36);
static_assert(sizeof(LightCluster<OrientedPointLight<>>) == 36 + sizeof(Cone));
static_assert(sizeof(LightCluster<SpotLight<>>) == 36 + sizeof(Cone) + sizeof(SpotProfile));
static_assert(sizeof(LightCluster<OmniLight<V, PolynomialFalloff>>) == 36 + sizeof(PolynomialFalloff));
static_assert(std::is_trivially_copyable_v<LightCluster<OrientedPointLight<>>>);

// The tree would refer to lights that are gone.
static_assert(std::is_constructible_v<LightTree<OmniLight<>>, const std::vector<OmniLight<>>&>);
static_assert(!std::is_constructible_v<LightTree<OmniLight<>>, std::vector<OmniLight<>>>);
static_assert(!std::is_constructible_v<LightTree<OmniLight<>>, std::vector<OmniLight<>>, LightTreeOptions>);

// A copy of what holds lights and their tree would refer to the lights of the original.
static_assert(!std::is_copy_constructible_v<LightTree<OmniLight<>>>);
static_assert(!std::is_copy_assignable_v<LightTree<OmniLight<>>>);
static_assert(std::is_nothrow_move_constructible_v<LightTree<OmniLight<>>>);
static_assert(std::is_nothrow_move_assignable_v<LightTree<OmniLight<>>>);

TEST(LightTree, MovesWithLightsThatStayInPlace) {
    struct Lamps {
        std::vector<OmniLight<>> lights;
        LightTree<OmniLight<>> tree{lights};
    };
    Room<V> room(8);
    Lamps lamps{room.omni(500)};  // too many for a cut that starts with each of them
    const auto receivers = room.diffuse_receivers(3);
    std::vector<V> expected;
    for (const auto& receiver : receivers) expected.push_back(shade(lamps.tree, receiver).radiance);
    Lamps moved = std::move(lamps), assigned;
    assigned = std::move(moved);
    for (const LightTree<OmniLight<>>* left : {&lamps.tree, &moved.tree}) {  // NOLINT(bugprone-use-after-move)
        EXPECT_TRUE(left->empty());
        EXPECT_TRUE(left->lights().empty());
        EXPECT_TRUE(left->clusters().empty());
        EXPECT_TRUE(left->start().empty());
    }
    EXPECT_EQ(assigned.tree.lights().data(), assigned.lights.data());
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        EXPECT_EQ(shade(assigned.tree, receivers[i]).radiance, expected[i]);
    }
}

TEST(LightTree, TakesFewBytesALight) {
    Room<V> room(1);
    const auto omni = room.omni(5000);
    const auto oriented = room.oriented(5000);
    EXPECT_LE(LightTree(omni).memory_bytes(), 96u * omni.size());
    EXPECT_LE(LightTree(oriented).memory_bytes(), 136u * oriented.size());
}

template <class L>
void expect_summaries(const LightTree<L>& tree) {
    const ClusterTree& topology = tree.topology();
    EXPECT_NO_THROW(validate(topology));
    ASSERT_EQ(tree.clusters().size(), topology.size());
    for (ClusterTree::node_index n = 0; n < topology.size(); ++n) {
        const auto& cluster = tree.clusters()[n];
        Box box;
        glm::dvec3 sum(0.0);
        for (ClusterTree::node_index k = topology.left_leaf(n); k <= n; ++k) {
            if (!topology.is_leaf(k)) continue;
            const L& light = tree.lights()[topology.item(k)];
            box = merge(box, box_of(position_or_direction(light)));
            sum += glm::dvec3(light.intensity);
            if constexpr (OrientedLight<L>) {
                if (is_single(cluster.cone)) {
                    EXPECT_EQ(cluster.cone.axis, light.axis) << n;
                } else {
                    EXPECT_TRUE(contains(cluster.cone, glm::dvec3(light.axis))) << n;
                }
            }
        }
        EXPECT_EQ(cluster.box, box);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(cluster.intensity[c], sum[c], 1e-7 * sum[c]) << n;
    }
}

TEST(LightTree, KnowsTheLightsBelowEachNode) {
    Room<V> room(2);
    auto omni = room.omni(700);
    for (std::size_t i = 0; i < omni.size(); i += 7) omni[i].intensity = V(0.0f);
    expect_summaries(LightTree(omni));
    const auto oriented = room.oriented(700);
    expect_summaries(LightTree(oriented));
    expect_summaries(LightTree(oriented, {.representatives = 8}));
    const auto distant = room.distant(300);
    expect_summaries(LightTree(distant));
}

// Relative error of the total below 1e-12 over sixty decades: sums are in double.
TEST(LightTree, AddsUpIntensitiesOfAllMagnitudes) {
    Random random(3);
    std::vector<OmniLight<float>> lights;
    double sum = 0.0;
    for (int i = 0; i < 3000; ++i) {
        const float power = static_cast<float>(random.decades(-30.0, 30.0));
        lights.push_back({V(random.on_sphere()), power, {}});
        sum += static_cast<double>(power);
    }
    const LightTree tree(lights);
    EXPECT_NEAR(static_cast<double>(tree.clusters().back().intensity), sum, 6e-8 * sum) << "rounded to float once";
    // Ten million tenths, added up as floats, would be 9 % off.
    const std::vector<OmniLight<float>> equal(1000000, {V(0.0f), 0.1f, {}});
    EXPECT_NEAR(LightTree(equal).clusters().back().intensity, 1e5f, 0.01f);
}

TEST(LightTree, LeavesDarkLightsOut) {
    for (const int first_lit : {0, 1, 5}) {
        std::vector<OmniLight<>> lights(12);
        for (int i = 0; i < 12; ++i) {
            lights[static_cast<std::size_t>(i)] = {
                {static_cast<float>(i), 0.0f, 0.0f}, V(i >= first_lit && i % 4 != 3 ? 1.0f : 0.0f), {}};
        }
        const LightTree tree(lights);
        std::vector<bool> found(12, false);
        for (ClusterTree::node_index n = 0; n < tree.topology().size(); ++n) {
            if (tree.topology().is_leaf(n)) found[tree.topology().item(n)] = true;
        }
        for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(found[i], lights[i].intensity.x > 0.0f) << i;
        EXPECT_EQ(tree.lights().size(), 12u);
    }
}

template <class L>
std::string refusal(const std::vector<L>& lights) {
    try {
        const LightTree tree(lights);
    } catch (const invalid_input& e) { return e.what(); }
    return "";
}

TEST(LightTree, NamesTheFirstLightThatItRefuses) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const std::vector<OmniLight<>> good(5, {V(1.0f), V(1.0f), {}});
    const auto with = [&](std::size_t i, const OmniLight<>& bad) {
        std::vector<OmniLight<>> lights = good;
        lights[i] = bad;
        return refusal(lights);
    };
    EXPECT_EQ(refusal(good), "");
    EXPECT_NE(with(3, {V(1.0f), {1.0f, -1e-30f, 1.0f}, {}}).find("light 3: intensity"), std::string::npos);
    EXPECT_NE(with(0, {V(1.0f), {1.0f, 1.0f, nan}, {}}).find("light 0: intensity"), std::string::npos);
    EXPECT_NE(with(4, {V(1.0f), {infinity, 1.0f, 1.0f}, {}}).find("light 4: intensity"), std::string::npos);
    EXPECT_NE(with(2, {{nan, 0.0f, 0.0f}, V(1.0f), {}}).find("light 2: position"), std::string::npos);
    EXPECT_NE(with(1, {{0.0f, -infinity, 0.0f}, V(1.0f), {}}).find("light 1: position"), std::string::npos);
    EXPECT_NE(with(2, {{nan, 0.0f, 0.0f}, V(0.0f), {}}).find("light 2"), std::string::npos) << "even a dark one";
    std::vector<OmniLight<>> two = good;
    two[1].intensity.x = two[3].intensity.x = -1.0f;
    EXPECT_NE(refusal(two).find("light 1"), std::string::npos);
}

TEST(LightTree, RefusesAxesAndDirectionsThatAreNotUnitVectors) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for (const V& bad : {V(0.0f), V(0.0f, 0.0f, 2.0f), V(0.0f, 0.5f, 0.0f), V(nan, 0.0f, 1.0f), V(0.0f, 0.0f, 1.01f)}) {
        const std::vector<OrientedPointLight<>> oriented{{V(0.0f), {0.0f, 0.0f, 1.0f}, V(1.0f), {}},
                                                         {V(0.0f), bad, V(1.0f), {}}};
        EXPECT_NE(refusal(oriented).find("light 1: axis"), std::string::npos) << bad.x << ' ' << bad.y << ' ' << bad.z;
        const std::vector<DistantLight<>> distant{{{0.0f, 0.0f, 1.0f}, V(1.0f)}, {bad, V(1.0f)}};
        const std::string message = refusal(distant);
        EXPECT_NE(message.find("light 1"), std::string::npos) << bad.x << ' ' << bad.y << ' ' << bad.z;
        EXPECT_NE(message.find("direction"), std::string::npos) << message;
    }
    // What float normalization leaves is accepted.
    Room<V> room(4);
    EXPECT_EQ(refusal(room.distant(1000)), "");
    EXPECT_EQ(refusal(room.oriented(1000)), "");
}

TEST(LightTree, RefusesNumbersOfRepresentativesOutOfRange) {
    const std::vector<OmniLight<>> lights(5, {V(1.0f), V(1.0f), {}});
    EXPECT_THROW(LightTree(lights, {.representatives = 0}), invalid_input);
    EXPECT_THROW(LightTree(lights, {.representatives = 33}), invalid_input);
    EXPECT_NO_THROW(LightTree(lights, {.representatives = 32}));
}

TEST(LightTree, RefusesTopologiesThatAreNotBinary) {
    const std::vector<OmniLight<>> lights(3, {V(1.0f), V(1.0f), {}});
    constexpr auto leaf = ClusterTree::leaf_word;
    const auto flat = [](const auto&, const auto&) { return ClusterTree({leaf(0), leaf(1), leaf(2), 0}); };
    EXPECT_THROW(LightTree(lights, {}, flat), invalid_input);
}

// Lights that moved, turned or dimmed in place: refit knows what a new tree of the same topology would.
TEST(LightTree, RefitIsAFreshSummary) {
    Room<V> room(5);
    auto lights = room.oriented(400);
    LightTree tree(lights, {.representatives = 4});
    const ClusterTree topology = tree.topology();
    Random random(6);
    for (auto& l : lights) {
        l.position += V(random.on_sphere());
        l.axis = V(random.near(glm::normalize(glm::dvec3(l.axis)), 0.7));
        l.intensity *= random.real(0.01, 3.0);
    }
    tree.refit();
    EXPECT_EQ(tree.topology(), topology);
    expect_summaries(tree);
    const auto same_topology = [&](auto, const auto&) { return topology; };
    const LightTree fresh(lights, {.representatives = 4}, same_topology);
    for (ClusterTree::node_index n = 0; n < topology.size(); ++n) {
        EXPECT_EQ(tree.clusters()[n].box, fresh.clusters()[n].box);
        EXPECT_EQ(tree.clusters()[n].cone, fresh.clusters()[n].cone);
        EXPECT_EQ(tree.clusters()[n].intensity, fresh.clusters()[n].intensity);
        const auto a = tree.representatives().of(n), b = fresh.representatives().of(n);
        EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    }
    for (const auto& receiver : room.diffuse_receivers(5)) {
        EXPECT_EQ(shade(tree, receiver).radiance, shade(fresh, receiver).radiance);
    }
}

TEST(LightTree, ReadsSpansAndRefersToTheLights) {
    Room<V> room(7);
    const auto lights = room.omni(10);
    const std::span<const OmniLight<>> first_six(lights.data(), 6);
    const LightTree from_span(first_six);
    EXPECT_EQ(from_span.topology().item_count(), 6u);
    EXPECT_EQ(from_span.lights().data(), lights.data());
    const std::array<OmniLight<>, 3> few{lights[0], lights[1], lights[2]};
    const std::span all(few);
    const LightTree from_array(all);
    EXPECT_EQ(from_array.topology().item_count(), 3u);
}

TEST(LightTree, RefusesToRefitToBadLightsAndStaysAsItWas) {
    std::vector<OmniLight<>> lights(3);
    for (std::size_t i = 0; i < 3; ++i) lights[i] = {glm::vec3(static_cast<float>(i)), glm::vec3(1.0f), {}};
    LightTree tree(lights);
    const auto before = tree.clusters()[tree.topology().root()].box;
    lights[0].position = glm::vec3(-5.0f);
    lights[2].intensity = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    EXPECT_THROW(tree.refit(), invalid_input);
    EXPECT_EQ(tree.clusters()[tree.topology().root()].box, before);
    lights[2].intensity = glm::vec3(1.0f);
    tree.refit();
    EXPECT_EQ(tree.clusters()[tree.topology().root()].box.lo, glm::vec3(-5.0f));
}

}  // namespace
}  // namespace lightcuts::test
