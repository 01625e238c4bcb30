// Oracles that say of a whole cluster how much of it can be visible.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

/// Of the lights beyond the plane x = `wall` (for distant lights: whose direction has x above `wall`) a `share` gets
/// through. Receivers stand before it.
struct Curtain {
    float wall = 0.2f;
    float share = 0.0f;

    template <class R, Light L>
    float operator()(const R&, const L& light) const {
        return position_or_direction(light).x > wall ? share : 1.0f;
    }
};

struct BoundedCurtain : Curtain {
    mutable std::size_t asked = 0;

    template <class R>
    float upper_bound(const R&, const Box& positions) const {
        ++asked;
        return positions.lo.x > wall ? share : 1.0f;
    }
    template <class R>
    float upper_bound(const R& receiver, const DirectionBox& directions) const {
        return upper_bound(receiver, directions.box);
    }
};

/// What is beyond the plane is hidden, and known to be.
struct HidingCurtain : Curtain {
    mutable std::size_t asked = 0;
    mutable std::size_t hidden = 0;

    template <class R>
    bool hides(const R&, const Box& positions) const {
        ++asked;
        const bool all = positions.lo.x > wall;
        hidden += all ? 1u : 0u;
        return all;
    }
    template <class R>
    bool hides(const R& receiver, const DirectionBox& directions) const {
        return hides(receiver, directions.box);
    }
};

/// Knows of positions only.
struct HalfBoundedCurtain : Curtain {
    template <class R>
    float upper_bound(const R&, const Box& positions) const {
        return positions.lo.x > wall ? share : 1.0f;
    }
};

using R = Receiver<Lambert<V>>;
static_assert(BoundedOracle<BoundedCurtain, R, OmniLight<>> && BoundedOracle<BoundedCurtain, R, DistantLight<>>);
static_assert(BoundedOracle<HalfBoundedCurtain, R, OmniLight<>> &&
              !BoundedOracle<HalfBoundedCurtain, R, DistantLight<>>);
static_assert(!BoundedOracle<Curtain, R, OmniLight<>> && !BoundedOracle<AlwaysVisible, R, OmniLight<>>);

static_assert(HidingOracle<HidingCurtain, R, OmniLight<>> && HidingOracle<HidingCurtain, R, DistantLight<>>);
static_assert(!HidingOracle<BoundedCurtain, R, OmniLight<>> && !HidingOracle<AlwaysVisible, R, OmniLight<>>);

template <class Lights, class Oracle>
void expect_sound(const Lights& lights, const R& receiver, const Oracle& oracle) {
    const V exact = exhaustive(lights, receiver, oracle).radiance;
    const V all = shade(lights, receiver, oracle, {.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0}).radiance;
    const CutResult<V> cut = shade(lights, receiver, oracle, {.max_cut = 0, .exhaustive_below = 0});
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(all[c], exact[c], 1e-5f * exact[c]);
        EXPECT_LE(std::fabs(cut.radiance[c] - exact[c]), cut.error_bound[c] + 1e-5f * exact[c]);
    }
}

TEST(BoundedOracle, KeepsTheErrorWithinItsBound) {
    Room<V> room(11);
    const auto omni = room.omni(300);
    const auto distant = room.distant(300);
    const LightTree near(omni);
    const LightTree far(distant);
    for (const auto& receiver : room.diffuse_receivers(30)) {
        for (const float share : {0.0f, 0.3f}) {
            BoundedCurtain oracle;
            oracle.share = share;
            expect_sound(near, receiver, oracle);
            expect_sound(far, receiver, oracle);
            expect_sound(LightForest(near, far), receiver, oracle);
            HalfBoundedCurtain half;
            half.share = share;
            expect_sound(LightForest(near, far), receiver, half);
        }
        expect_sound(near, receiver, HidingCurtain{});
        expect_sound(far, receiver, HidingCurtain{});
        expect_sound(LightForest(near, far), receiver, HidingCurtain{});
    }
}

TEST(BoundedOracle, SparesWhatIsHidden) {
    Room<V> room(12);
    const auto omni = room.omni(3000);
    const LightTree tree(omni);
    const LightcutOptions fine{.error_ratio = 0.005f, .max_cut = 0, .exhaustive_below = 0};
    std::size_t plain = 0, bounded = 0, asked = 0, splits = 0;
    for (const auto& receiver : room.diffuse_receivers(30)) {
        plain += shade(tree, receiver, Curtain{}, fine).queries;
        const BoundedCurtain oracle;
        const CutResult<V> cut = shade(tree, receiver, oracle, fine);
        bounded += cut.queries;
        asked += oracle.asked;
        splits += cut.cut_size - 1;
    }
    EXPECT_LT(static_cast<double>(bounded), 0.8 * static_cast<double>(plain));
    EXPECT_LT(asked, 2 * splits) << "asked only of clusters that are about to be split";
}

TEST(HidingOracle, SparesWhatIsHiddenAndIsAskedOnlyWhereNothingWasSeen) {
    Room<V> room(12);
    const auto omni = room.omni(3000);
    const LightTree tree(omni);
    const LightcutOptions fine{.error_ratio = 0.005f, .max_cut = 0, .exhaustive_below = 0};
    std::size_t plain = 0, hiding = 0, asked = 0, hidden = 0, bounded_asked = 0;
    for (const auto& receiver : room.diffuse_receivers(30)) {
        plain += shade(tree, receiver, Curtain{}, fine).queries;
        const HidingCurtain oracle;
        hiding += shade(tree, receiver, oracle, fine).queries;
        asked += oracle.asked;
        hidden += oracle.hidden;
        const BoundedCurtain bounded;
        (void)shade(tree, receiver, bounded, fine);
        bounded_asked += bounded.asked;
    }
    EXPECT_LT(static_cast<double>(hiding), 0.8 * static_cast<double>(plain));
    EXPECT_GT(hidden, 0u);
    // Clusters with a visible representative are not asked about.
    EXPECT_LT(static_cast<double>(asked), 0.5 * static_cast<double>(bounded_asked));
}

}  // namespace
}  // namespace lightcuts::test
