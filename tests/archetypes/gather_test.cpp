#include <lightcuts/product/gather.hpp>

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "archetypes/archetypes.hpp"

namespace lightcuts::test {
namespace {

Bands bands(float k) { return Bands(std::array<float, 5>{k, 2 * k, 3 * k, 4 * k, 5 * k}); }

/// Lights, lobes and oracles that offer the least: lobes that cannot be copied are referred to.
TEST(GatherArchetypes, AreAllThatASumNeeds) {
    using Point = GatherPoint<const LeastMaterial&, Bands>;
    const std::array<LeastLight, 4> bulbs{LeastLight{{0, 0, 2}, bands(1)}, LeastLight{{1, 0, 2}, bands(2)},
                                          LeastLight{{0, 1, 3}, bands(0)}, LeastLight{{4, 1, 3}, bands(3)}};
    const std::array<LeastSun, 2> suns{LeastSun{{0, 0, -1}, bands(1)}, LeastSun{{0, -0.6f, -0.8f}, bands(1)}};
    const LightTree bulb_tree(bulbs);
    const LightTree sun_tree(suns);
    const LightForest forest(bulb_tree, sun_tree);
    const LeastMaterial lobe;
    std::vector<Point> points;
    for (int i = 0; i < 6; ++i) {
        points.push_back({{glm::vec3(0.1f * static_cast<float>(i), 0.0f, 0.0f), lobe}, bands(0.01f)});
    }
    std::array<double, 5> expected{};
    for (const Point& p : points) {
        const Bands radiance = shade(forest, p.receiver, LeastOracle(), {.error_ratio = 0.0f}).radiance;
        for (int c = 0; c < 5; ++c) {
            expected[static_cast<std::size_t>(c)] += static_cast<double>(radiance[c]) *
                                                     static_cast<double>(p.strength[c]);
        }
    }
    const ProductOptions exact{.cut = {.error_ratio = 0.0f, .max_cut = 0, .exhaustive_below = 0}};
    const auto expect_exact = [&](const auto& result) {
        for (int c = 0; c < 5; ++c) {
            const double truth = expected[static_cast<std::size_t>(c)];
            EXPECT_NEAR(static_cast<double>(result.radiance[c]), truth, 1e-5 * truth);
        }
    };
    expect_exact(gather(forest, points, LeastOracle(), exact));
    expect_exact(gather(forest, points, LeastBatchedOracle(), exact));
    expect_exact(gather(forest, points, LeastOracle(), exact, {}, LeastPolicy()));
}

}  // namespace
}  // namespace lightcuts::test
