#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

using R = Receiver<Lambert<glm::vec3>>;
using L = OmniLight<>;

struct YesOrNo {
    bool operator()(const R&, const L&) const { return true; }
};
struct Many {
    void many(std::span<const VisibilityQuery>, std::span<float>) const {}
};
/// May not be asked: it changes when it answers.
struct Fickle {
    bool operator()(const R&, const L&) { return true; }
};
struct Wordy {
    const char* operator()(const R&, const L&) const { return "yes"; }
};

static_assert(ScalarOracle<YesOrNo, R, L> && VisibilityOracle<YesOrNo, R, L> && !BatchedOracle<YesOrNo>);
static_assert(BatchedOracle<Many> && VisibilityOracle<Many, R, L> && !ScalarOracle<Many, R, L>);
static_assert(ScalarOracle<AlwaysVisible, R, L> && ScalarOracle<ScalarOccluders, R, L>);
static_assert(!VisibilityOracle<Fickle, R, L> && !VisibilityOracle<Wordy, R, L>);

TEST(AlwaysVisible, IsNeverAsked) {
    Room<glm::vec3> room(1);
    const auto lights = room.omni(1000);
    const LightTree tree(lights);
    const auto receivers = room.diffuse_receivers(1);
    const auto result = shade(tree, receivers[0]);
    EXPECT_EQ(result.queries, 0u);
    const Occluders none;
    const auto asked = shade(tree, receivers[0], ScalarOccluders{none});
    EXPECT_EQ(asked.radiance, result.radiance);
    EXPECT_GT(asked.queries, 0u);
}

TEST(Oracle, OfBothFormsIsAskedForMany) {
    struct Both {
        bool operator()(const R&, const L&) const {
            ADD_FAILURE() << "asked about a single light";
            return true;
        }
        void many(std::span<const VisibilityQuery> queries, std::span<float> answers) const {
            for (std::size_t i = 0; i < queries.size(); ++i) answers[i] = 1.0f;
        }
    };
    Room<glm::vec3> room(2);
    const auto lights = room.omni(1000);
    const LightTree tree(lights);
    for (const auto& receiver : room.diffuse_receivers(3)) {
        EXPECT_EQ(shade(tree, receiver, Both{}).radiance, shade(tree, receiver).radiance);
    }
}

TEST(VisibilityQuery, SaysWhoAsksAboutWhat) {
    struct Checking {
        const std::vector<OmniLight<>>& omni;
        const std::vector<DistantLight<>>& distant;
        const std::vector<R>& receivers;
        std::vector<int>& kinds;
        void many(std::span<const VisibilityQuery> queries, std::span<float> answers) const {
            for (std::size_t i = 0; i < queries.size(); ++i) {
                const VisibilityQuery& q = queries[i];
                ASSERT_LT(q.kind, 2u);
                ++kinds[q.kind];
                EXPECT_EQ(q.distant, q.kind == 1);
                EXPECT_EQ(q.from, receivers[q.receiver].shadow_origin);
                EXPECT_EQ(q.to, q.distant ? position_or_direction(distant[q.light]) : omni[q.light].position);
                answers[i] = 1.0f;
            }
        }
    };
    Room<glm::vec3> room(3);
    auto omni = room.omni(600);
    omni[5].intensity = glm::vec3(0.0f);  // left out of the tree, yet indices stay those of the user
    const auto distant = room.distant(600);
    const LightTree a(omni);
    const LightTree b(distant);
    const LightForest forest(a, b);
    const auto receivers = room.diffuse_receivers(10);
    std::vector<int> kinds(2, 0);
    const Checking oracle{omni, distant, receivers, kinds};
    std::vector<CutResult<glm::vec3>> results(receivers.size());
    LightcutScratch<glm::vec3> scratch;
    shade(forest, std::span<const R>(receivers), oracle, std::span(results), scratch);
    EXPECT_GT(kinds[0], 100);
    EXPECT_GT(kinds[1], 100);
    EstimateScratch<glm::vec3> other;
    for (const R& receiver : receivers) exhaustive(forest, receiver, oracle, other);
}

TEST(Oracle, OfFractionsScalesWhatItLetsThrough) {
    Room<glm::vec3> room(4);
    const auto lights = room.omni(50);
    const LightTree tree(lights);
    const auto half = [](const auto&, const auto&) { return 0.5f; };
    for (const auto& receiver : room.diffuse_receivers(5)) {
        const LightcutOptions all{.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0};
        const glm::vec3 free = shade(tree, receiver, AlwaysVisible{}, all).radiance;
        const glm::vec3 dimmed = shade(tree, receiver, half, all).radiance;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(dimmed[c], 0.5f * free[c], 1e-5f * free[c]);
        const auto dark = shade(
            tree, receiver, [](const auto&, const auto&) { return false; }, all);
        EXPECT_EQ(dark.radiance, glm::vec3(0.0f));
    }
}

}  // namespace
}  // namespace lightcuts::test
