#include <lightcuts/visibility/hidden_lights.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/cut/shade_in_groups.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/light/directional.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/tree/light_tree.hpp>
#include <lightcuts/visibility/shared_proofs.hpp>

#include "support/random.hpp"
#include "support/triangle_soup.hpp"

namespace lightcuts::test {
namespace {

/// Asks all triangles of a soup.
struct SoupHit {
    const TriangleSoup& soup;

    OccluderMesh::Index operator()(const VisibilityQuery& query) const {
        const glm::dvec3 from(query.from), to(query.to);
        const auto hits = soup.hits(from, query.distant ? 100.0 * to : to - from);
        return hits.empty() ? OccluderMesh::no_triangle : hits.front();
    }
};
static_assert(FirstHit<SoupHit>);
static_assert(!FirstHit<int>);

/// Two rooms, one above the other, with furniture in the lower one.
struct House {
    TriangleSoup soup;
    OccluderMesh mesh;

    House() {
        Random random(1);
        soup.add_box(random, {-3, -3, 0}, {3, 3, 3}, 3);
        soup.add_box(random, {-3, -3, 3}, {3, 3, 6}, 3);
        soup.add_sheet(random, {-1, -1, 1.5}, {2, 0, 0}, {0, 2, 0}, 2, 2);  // a table, seen from below
        mesh = OccluderMesh(soup.triangles.size(), [&](std::size_t i) { return soup.triangles[i]; });
    }
};

/// A lamp somewhere in the lower or in the upper room.
OmniLight<> any_lamp(Random& random, bool lower) {
    const double floor = lower ? 0.2 : 3.2;
    return {glm::vec3(random.in_box({-2.8, -2.8, floor}, {2.8, 2.8, floor + 2.5})), glm::vec3(1.0f), {}};
}

/// Sees what no triangle of the house is before.
struct HouseVisible {
    const SoupHit& hit;

    template <class R, Light L>
    bool operator()(const R& receiver, const L& light) const {
        const bool distant = DirectionalLight<L>;
        return hit({receiver.shadow_origin, 0, position_or_direction(light), 0, 0, distant}) ==
               OccluderMesh::no_triangle;
    }
};

/// The same with proofs, which it counts.
struct HouseOracle : HouseVisible {
    const HiddenLights<SoupHit>& hidden;
    mutable std::size_t proofs = 0;

    template <class R, class Lights>
    bool hides(const R& receiver, const Lights& lights) const {
        const bool result = hidden.hides(receiver, lights);
        proofs += result ? 1u : 0u;
        return result;
    }
};

TEST(HiddenLights, LookBehindWhatIsInTheWay) {
    const House house;
    const HiddenLights hidden(house.mesh, SoupHit{house.soup});
    const ReceiverBox below_the_table{box_of({0.1f, 0.2f, 0.5f})};
    // The table hides none of so wide a box by itself; the ceiling behind it does.
    EXPECT_TRUE(hidden.hides(below_the_table, Box{{-2.5f, -2.5f, 4.0f}, {2.5f, 2.5f, 5.0f}}));
    EXPECT_FALSE(hidden.hides(below_the_table, Box{{-2.5f, -2.5f, 2.0f}, {2.5f, 2.5f, 2.5f}})) << "in the same room";
    EXPECT_TRUE(hidden.hides(below_the_table, Box{{-0.1f, -0.1f, 2.0f}, {0.3f, 0.3f, 2.5f}})) << "above the table";
    EXPECT_TRUE(hidden.hides(below_the_table, DirectionBox{{{0.0f, 0.5f, 0.6f}, {0.2f, 0.7f, 0.8f}}}));
}

TEST(HiddenLights, OfNoTrianglesAreNone) {
    const OccluderMesh none;
    const TriangleSoup soup;
    const HiddenLights hidden(none, SoupHit{soup});
    EXPECT_FALSE(hidden.hides(ReceiverBox{box_of(glm::vec3(0.0f))}, Box{glm::vec3(1.0f), glm::vec3(2.0f)}));
}

TEST(HiddenLights, OfWrongTrianglesProveNothingWrong) {
    const House house;
    Random random(2);
    const SoupHit hit{house.soup};
    int proofs = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto any = [&](const VisibilityQuery&) {
            return static_cast<OccluderMesh::Index>(random.below(house.mesh.size() + 2));
        };
        const HiddenLights hidden(house.mesh, any);
        const glm::vec3 from(random.in_box({-2.9, -2.9, 0.1}, {2.9, 2.9, 5.9}));
        const glm::vec3 light(random.in_box({-2.9, -2.9, 0.1}, {2.9, 2.9, 5.9}));
        if (hidden.hides(ReceiverBox{box_of(from)}, Box{light, light})) {
            ++proofs;
            EXPECT_NE(hit({from, 0, light, 0, 0, false}), OccluderMesh::no_triangle) << i;
        }
    }
    EXPECT_GT(proofs, 50);
}

TEST(HiddenLights, AskNothingWhereNothingIs) {
    const House house;
    int asked = 0;
    const auto count = [&](const VisibilityQuery&) { return ++asked, OccluderMesh::no_triangle; };
    const HiddenLights hidden(house.mesh, count);
    EXPECT_FALSE(hidden.hides(ReceiverBox{}, Box{glm::vec3(0.0f), glm::vec3(1.0f)}));
    EXPECT_FALSE(hidden.hides(ReceiverBox{box_of(glm::vec3(0.0f))}, Box{}));
    EXPECT_FALSE(hidden.hides(ReceiverBox{box_of(glm::vec3(0.0f))}, DirectionBox{}));
    EXPECT_EQ(asked, 0);
}

TEST(HiddenLights, SpareTheCutWhatIsHidden) {
    const House house;
    const SoupHit hit{house.soup};
    const HiddenLights hidden(house.mesh, hit);
    Random random(3);
    std::vector<OmniLight<>> lamps;
    std::vector<DistantLight<>> sky;
    for (int i = 0; i < 400; ++i) {
        lamps.push_back(any_lamp(random, i % 10 == 0));
        sky.push_back({glm::vec3(random.on_sphere()), glm::vec3(1.0f)});
    }
    const LightTree near(lamps);
    const LightTree far(sky);
    const LightForest lights(near, far);
    std::size_t plain = 0, proved = 0, proofs = 0;
    for (int i = 0; i < 30; ++i) {
        const Receiver receiver(glm::vec3(random.in_box({-2.8, -2.8, 0.01}, {2.8, 2.8, 0.02})),
                                Lambert<>{glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(0.5f)});
        const HouseVisible visible{hit};
        const HouseOracle oracle{visible, hidden};
        const LightcutOptions options{.max_cut = 0, .exhaustive_below = 0};
        const CutResult<glm::vec3> cut = shade(lights, receiver, oracle, options);
        const CutResult<glm::vec3> without = shade(lights, receiver, visible, options);
        const glm::vec3 exact = exhaustive(lights, receiver, oracle).radiance;
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(std::fabs(cut.radiance[c] - exact[c]), cut.error_bound[c] + 1e-5f * exact[c]);
        plain += without.queries;
        proved += cut.queries;
        proofs += oracle.proofs;
    }
    EXPECT_GT(proofs, 30u);
    EXPECT_LT(static_cast<double>(proved), 0.6 * static_cast<double>(plain));
}

TEST(ShadeInGroups, IsWithinItsBoundsWhateverIsShared) {
    const House house;
    const SoupHit hit{house.soup};
    const HiddenLights hidden(house.mesh, hit);
    Random random(4);
    std::vector<OmniLight<>> lamps;
    for (int i = 0; i < 600; ++i) lamps.push_back(any_lamp(random, i % 20 == 0));
    const LightTree lights(lamps);
    std::vector<Receiver<Lambert<>>> receivers;
    for (int i = 0; i < 200; ++i) {
        const bool on_floor = i % 3 != 0;
        receivers.emplace_back(glm::vec3(on_floor ? random.in_box({-2.8, -2.8, 0.01}, {2.8, 2.8, 0.01})
                                                  : random.in_box({-2.9, -2.8, 0.1}, {-2.9, 2.8, 2.8})),
                               Lambert<>{on_floor ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0), glm::vec3(0.5f)});
    }
    const HouseVisible visible{hit};
    const auto all = std::span<const Receiver<Lambert<>>>(receivers);
    std::vector<CutResult<glm::vec3>> results(receivers.size()), again(receivers.size());
    GroupScratch<LightTree<OmniLight<>>, Receiver<Lambert<>>> scratch;
    const LightcutOptions unlimited{.max_cut = 0, .exhaustive_below = 0};
    std::size_t hidden_clusters = 0;
    std::uint64_t rays_of_large_groups = 0;
    for (const std::size_t group : {64u, 8u, 1u}) {
        const std::uint64_t before = scratch.steps().rays;
        shade_in_groups(lights, all, visible, hidden, std::span(results), scratch, unlimited, {.largest_group = group});
        const std::uint64_t rays = scratch.steps().rays - before;
        if (group == 64) rays_of_large_groups = rays;
        if (group == 1) { EXPECT_GT(rays, 4 * rays_of_large_groups) << "shared proofs are made once"; }
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            const glm::vec3 exact = exhaustive(lights, receivers[i], visible).radiance;
            for (int c = 0; c < 3; ++c) {
                EXPECT_LE(std::fabs(results[i].radiance[c] - exact[c]), results[i].error_bound[c] + 1e-5f * exact[c]);
            }
            EXPECT_LE(results[i].hidden, results[i].cut_size);
            hidden_clusters += results[i].hidden;
        }
        // Scratch that has seen other receivers changes nothing.
        shade_in_groups(lights, all, visible, hidden, std::span(again), scratch, unlimited, {.largest_group = group});
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            EXPECT_EQ(again[i].radiance, results[i].radiance);
            EXPECT_EQ(again[i].queries, results[i].queries);
        }
    }
    EXPECT_GT(hidden_clusters, 200u);
}

TEST(ShadeInGroups, ProvesForOneWhereItsCutEndsAtTheLimit) {
    // Receivers of both rooms as one group: nothing is hidden from all of them.
    const House house;
    const SoupHit hit{house.soup};
    const HiddenLights hidden(house.mesh, hit);
    Random random(5);
    std::vector<OmniLight<>> lamps;
    for (int i = 0; i < 2000; ++i) lamps.push_back(any_lamp(random, i % 100 == 0));
    const LightTree lights(lamps);
    std::vector<Receiver<Lambert<>>> receivers;
    for (int i = 0; i < 32; ++i) {
        const double floor = i % 2 == 0 ? 0.01 : 3.01;
        receivers.emplace_back(glm::vec3(random.in_box({-2.8, -2.8, floor}, {2.8, 2.8, floor})),
                               Lambert<>{glm::vec3(0, 0, 1), glm::vec3(0.5f)});
    }
    const HouseVisible visible{hit};
    const auto all = std::span<const Receiver<Lambert<>>>(receivers);
    std::vector<CutResult<glm::vec3>> shared(receivers.size()), own(receivers.size());
    GroupScratch<LightTree<OmniLight<>>, Receiver<Lambert<>>> scratch;
    const LightcutOptions options{.max_cut = 100, .exhaustive_below = 0};
    shade_in_groups(lights, all, visible, hidden, std::span(shared), scratch, options,
                    {.largest_group = 64, .own_proofs_at_limit = false});
    shade_in_groups(lights, all, visible, hidden, std::span(own), scratch, options, {.largest_group = 64});
    const auto at_limit = [](const auto& results) {
        return std::count_if(results.begin(), results.end(), [](const auto& r) { return r.stop == StopReason::limit; });
    };
    EXPECT_GE(at_limit(shared), 10);
    EXPECT_LE(2 * at_limit(own), at_limit(shared));
}

TEST(SharedProofs, AreMadeOnceAndForgottenForOthers) {
    struct Counter {
        mutable std::size_t asked = 0;
        bool answer = true;
        bool hides(const ReceiverBox&, const Box&, ProofSteps*) const { return ++asked, answer; }
        bool hides(const ReceiverBox&, const DirectionBox&, ProofSteps*) const { return ++asked, !answer; }
    };
    SharedProofs proofs;
    Counter counter;
    const auto box = [](int i) {
        return Box{glm::vec3(static_cast<float>(i)), glm::vec3(static_cast<float>(i) + 0.5f)};
    };
    for (int start = 0; start < 3; ++start) {
        counter = {0, start % 2 == 0};
        const ReceiverBox receiver{box_of(glm::vec3(static_cast<float>(start)))};
        proofs.start(receiver);
        for (int repeat = 0; repeat < 3; ++repeat) {
            for (int i = 0; i < 3000; ++i) {
                ASSERT_EQ(proofs.hides(counter, receiver, box(i)), counter.answer);
                // A box of directions is not the box of positions that has the same numbers.
                ASSERT_EQ(proofs.hides(counter, receiver, DirectionBox{box(i)}), !counter.answer);
            }
        }
        EXPECT_EQ(counter.asked, 6000u);
    }
}

TEST(SharedProofs, AreForThoseOfTheGroupOnly) {
    // A leaf: what it hides from its front is seen from behind.
    TriangleSoup soup;
    soup.add({-9, -9, 0}, {9, -9, 0}, {0, 9, 0});
    const OccluderMesh mesh(1, [&](std::size_t i) { return soup.triangles[i]; });
    const HiddenLights hidden(mesh, SoupHit{soup});
    const Box below{{-1.0f, -1.0f, -2.0f}, {1.0f, 1.0f, -1.0f}};
    const ReceiverBox front{box_of({0.0f, 0.0f, 1e-2f})}, behind{box_of({0.0f, 0.0f, -1e-2f})};
    SharedProofs proofs;
    EXPECT_FALSE(proofs.hides(hidden, behind, below)) << "before it is started";
    proofs.start(front);
    EXPECT_TRUE(proofs.hides(hidden, front, below));
    EXPECT_FALSE(proofs.hides(hidden, behind, below));
    // Another horizon than the group's.
    const Horizon up{{0.0f, 0.0f, 1.0f}, box_of(glm::vec3(0.0f))}, down{{0.0f, 0.0f, -1.0f}, box_of(glm::vec3(0.0f))};
    const ReceiverBox lit_from_below{behind.box, down};
    proofs.start({merge(front.box, behind.box), up});
    EXPECT_FALSE(proofs.hides(hidden, lit_from_below, below));
    EXPECT_FALSE(proofs.hides(hidden, behind, below)) << "one without a horizon";
}

}  // namespace
}  // namespace lightcuts::test
