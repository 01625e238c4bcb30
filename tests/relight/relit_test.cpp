#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include "small_world.hpp"

namespace {

constexpr relight::CutOptions exact{
    .deviation = 0.0, .bits = lightcuts::ValueBits::full, .sides = relight::Sides::both};

/// As many clusters as directions.
constexpr relight::IlluminationOptions every_direction{.size = std::size_t{1} << 20};

TEST(Relit, ExactCutsAndAllDirectionsAreTheExhaustiveSum) {
    const SmallWorld world(block_over_floor, exact, 400);
    const auto power = world.power(small_map());
    const auto exhaustive = world.exhaustive(power, relight::Truth::vertices);
    ASSERT_GT(exhaustive.size(), 300u);
    EXPECT_LT(relative_difference(world.relit(power, every_direction), exhaustive), 2e-6);
}

TEST(Relit, CutsAreNearTheExhaustiveSum) {
    const SmallWorld world(block_over_floor, {.deviation = 1.0}, 4096, 1.0);
    const auto power = world.power(small_map(256));
    EXPECT_LT(relative_difference(world.relit(power), world.exhaustive(power, relight::Truth::vertices)), 0.05);
    // Finer clusters are nearer.
    const auto finer = world.relit(power, {.size = 2048, .cluster_angle = 4.0}, {.gloss_detail = 0.1f});
    EXPECT_LT(relative_difference(finer, world.exhaustive(power, relight::Truth::vertices)), 0.02);
}

TEST(Relit, FineMeshesAreNearVisibilityFromPixels) {
    const SmallWorld world(block_over_floor, {.deviation = 0.5}, 512, 0.2, 24);
    const auto power = world.power(small_map());
    EXPECT_LT(relative_difference(world.relit(power), world.exhaustive(power, relight::Truth::pixels)), 0.08);
}

TEST(Relit, ConvexBodyAloneIsNotShadowed) {
    for (const relight::Sides sides : {relight::Sides::front, relight::Sides::both}) {
        relight::CutOptions options = exact;
        options.sides = sides;
        const SmallWorld world(box_alone, options, 400);
        const auto power = world.power(small_map());
        EXPECT_LT(
            relative_difference(world.relit(power, every_direction), world.exhaustive(power, relight::Truth::none)),
            2e-6);
    }
}

TEST(Relit, ConvexBodyTakesOnePieceAVertexFromItsFront) {
    relight::CutOptions options = exact;
    options.sides = relight::Sides::front;
    const SmallWorld world(box_alone, options, 400);
    EXPECT_EQ(world.statistics.sites, 24u);
    EXPECT_EQ(world.statistics.pieces, 24u);
    EXPECT_EQ(world.statistics.rms(), 0.0);
}

TEST(Relit, SideThatWasNotPreparedIsBlackAndCounted) {
    relight::CutOptions options = exact;
    options.sides = relight::Sides::front;
    // A floor that faces down.
    const SmallWorld world("mtllib m.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nusemtl gray\nf 1 2 3 4\n", options,
                           100);
    relight::Illumination illumination(world.directions());
    illumination.set(world.power(small_map()), {});
    std::vector<glm::vec3> radiance(world.seen.points.size(), glm::vec3(1.0f));
    const auto statistics = relight::RelitShader(*world.file, world.mesh.sites, world.seen)
                                .shade(illumination, {}, radiance);
    ASSERT_FALSE(radiance.empty());
    EXPECT_EQ(statistics.backs, radiance.size());
    for (const glm::vec3& r : radiance) EXPECT_EQ(r, glm::vec3(0.0f));
}

TEST(Relit, ThreadsChangeNoBit) {
    const auto run = [](int threads) {
        tbb::task_arena arena(threads);
        return arena.execute([] {
            const SmallWorld world(block_over_floor, {}, 500, 1.0);
            return std::pair(world.content, world.relit(world.power(small_map())));
        });
    };
    const auto [bytes, radiance] = run(1);
    const auto [other_bytes, other_radiance] = run(4);
    // Names of temporary folders apart.
    const auto after_line = [](const std::vector<char>& content) {
        return std::vector<char>(std::find(content.begin(), content.end(), '\n'), content.end());
    };
    EXPECT_EQ(after_line(bytes), after_line(other_bytes));
    EXPECT_EQ(radiance, other_radiance);
}

}  // namespace
