#pragma once

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/estimate/exhaustive.hpp>
#include "support/scene.hpp"
#include "support/statistics.hpp"

namespace lightcuts::test {

// What is asked of every stochastic estimator: `estimate(forest, receiver, oracle, seed, scratch)`, or without
// oracle and seed.

/// The mean over seeds is the exhaustive sum: false alarms one in a million for each receiver.
template <Spectrum S, class Forest, class R, class Oracle, class F>
void expect_mean_is_exact(const Forest& forest, const std::vector<R>& receivers, const Oracle& oracle, F&& estimate,
                          std::uint64_t seeds = 2000) {
    EstimateScratch<S> scratch;
    for (const R& receiver : receivers) {
        const double exact = channel_sum(exhaustive(forest, receiver, oracle, scratch).radiance);
        Mean mean;
        for (std::uint64_t seed = 0; seed < seeds; ++seed) {
            mean.add(channel_sum(S(estimate(forest, receiver, oracle, seed, scratch).radiance)));
        }
        EXPECT_LT(mean.standard_errors_from(exact), one_in_a_million)
            << mean.value() << " against " << exact << " at receiver " << receiver.id;
    }
}

/// Over scenes of each kind of light and of all kinds, with diffuse and glossy receivers, with occluders.
template <class F>
void expect_unbiased(F&& estimate) {
    using S = float;
    Room<S> room(11);
    const auto omni = room.omni(120);
    auto oriented = room.oriented(150);
    for (std::size_t i = 0; i < oriented.size(); i += 10) oriented[i].intensity = 0.0f;
    const auto distant = room.distant(30);
    const LightTree a(omni);
    const LightTree b(oriented);
    const LightTree c(distant);
    const Occluders occluders = room.occluders();
    const ScalarOccluders scalar{occluders, 0.25f};
    const BatchedOccluders batched{occluders, 0.25f};
    const auto diffuse = room.diffuse_receivers(3);
    const auto glossy = room.glossy_receivers(3);
    expect_mean_is_exact<S>(LightForest(a), diffuse, scalar, estimate);
    expect_mean_is_exact<S>(LightForest(a), glossy, scalar, estimate);
    expect_mean_is_exact<S>(LightForest(b), diffuse, scalar, estimate);
    expect_mean_is_exact<S>(LightForest(b), glossy, batched, estimate);
    expect_mean_is_exact<S>(LightForest(c), diffuse, scalar, estimate);
    expect_mean_is_exact<S>(LightForest(c), glossy, batched, estimate);
    const LightForest all(a, b, c);
    expect_mean_is_exact<S>(all, diffuse, batched, estimate);
    expect_mean_is_exact<S>(all, glossy, scalar, estimate);
}

/// The same for the same seed with either kind of oracle; another for another seed or receiver.
template <class F>
void expect_deterministic(F&& estimate) {
    using V = glm::vec3;
    Room<V> room(12);
    const auto omni = room.omni(300);
    const auto oriented = room.oriented(300);
    const LightTree a(omni);
    const LightTree b(oriented);
    const LightForest forest(a, b);
    const Occluders occluders = room.occluders();
    const ScalarOccluders scalar{occluders, 0.5f};
    EstimateScratch<V> scratch;
    for (const auto& receiver : room.glossy_receivers(5)) {
        const auto first = estimate(forest, receiver, scalar, 5, scratch);
        EXPECT_GT(first.queries, 0u);
        EXPECT_LE(first.queries, 16u);
        const auto other = estimate(forest, receiver, scalar, 6, scratch);
        EXPECT_NE(first.radiance, other.radiance);
        const auto again = estimate(forest, receiver, BatchedOccluders{occluders, 0.5f}, 5, scratch);
        EXPECT_EQ(first.radiance, again.radiance);
        EXPECT_EQ(first.queries, again.queries);
        auto renamed = receiver;
        renamed.id += 1000;
        EXPECT_NE(first.radiance, estimate(forest, renamed, scalar, 5, scratch).radiance);
    }
}

template <class L, class F>
void expect_exact_sum(const std::vector<L>& lights, F&& estimate) {
    using S = spectrum_of<L>;
    const LightTree tree(lights);
    const LightForest forest(tree);
    const Receiver receiver(glm::vec3(0.0f), Lambert<S>{{0.0f, 0.0f, 1.0f}, S(0.5f)});
    EstimateScratch<S> scratch;
    const S exact = exhaustive(forest, receiver, AlwaysVisible{}, scratch).radiance;
    const S found = estimate(forest, receiver, scratch).radiance;
    for (int c = 0; c < channels_of<S>; ++c)
        EXPECT_NEAR(channel(found, c), channel(exact, c), 1e-5f * channel(exact, c));
    EXPECT_FALSE(is_black(exact));
}

/// No lights, dark ones, lights behind the surface, in its plane and at the receiver itself: black, and no queries.
template <class F>
void expect_black_where_nothing_shines(F&& estimate) {
    using V = glm::vec3;
    using Lights = std::vector<OmniLight<>>;
    const OmniLight<> dark{{0.0f, 0.0f, 1.0f}, V(0.0f), {}};
    const OmniLight<> behind{{1.0f, 0.0f, -1.0f}, V(1.0f), {}};
    const OmniLight<> level{{1.0f, 2.0f, 0.0f}, V(1.0f), {}};
    const OmniLight<> here{{0.0f, 0.0f, 0.0f}, V(1.0f), {}};
    const Receiver receiver(V(0.0f), Lambert<V>{{0.0f, 0.0f, 1.0f}, V(1.0f)});
    EstimateScratch<V> scratch;
    for (const Lights& lights : {Lights{}, Lights{dark, dark}, Lights{behind, behind, behind}, Lights{level, level},
                                 Lights{here}, Lights{here, here}, Lights{behind, level, here, dark}}) {
        const LightTree tree(lights);
        const auto result = estimate(LightForest(tree), receiver, scratch);
        EXPECT_EQ(result.radiance, V(0.0f)) << lights.size();
        EXPECT_EQ(result.queries, 0u);
    }
    // One light that shines among many that do not is found by some seeds; the sum stays finite.
    const OmniLight<> lit{{0.0f, 0.0f, 2.0f}, V(1.0f), {}};
    const Lights mixed{behind, level, here, dark, lit, lit};
    const LightTree tree(mixed);
    const float found = estimate(LightForest(tree), receiver, scratch).radiance.x;
    EXPECT_GE(found, 0.0f);
    EXPECT_LT(found, 1e6f);
}

}  // namespace lightcuts::test
