#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>
#include <relight/site_patches.hpp>

#include "small_world.hpp"

namespace {

constexpr relight::CutOptions exact{
    .deviation = 0.0, .bits = lightcuts::ValueBits::full, .sides = relight::Sides::both};
constexpr relight::CutOptions of_fronts{.deviation = 0.5, .sides = relight::Sides::front};

constexpr relight::IlluminationOptions every_direction{.size = std::size_t{1} << 20};
constexpr relight::BounceOptions every_patch{.size = std::size_t{1} << 20, .cluster_angle = 0.0f};

/// What points reflect if every patch has the radiance 1.
std::vector<glm::vec3> reflected_of_one(const SmallWorld& world, const relight::BounceOptions& options = {}) {
    relight::BounceLight light(world.patches());
    light.set(std::vector<glm::vec3>(world.patches().size(), glm::vec3(1.0f)), options.size, options.relative_error);
    std::vector<glm::vec3> radiance(world.seen.points.size(), glm::vec3(0.0f));
    relight::BounceShader(*world.file, world.mesh.sites, world.seen).add(light, options, {}, radiance);
    return radiance;
}

TEST(Bounce, SitesOfAClosedRoomSeeHalfOfTheSphere) {
    for (const relight::Sides sides : {relight::Sides::front, relight::Sides::both}) {
        relight::CutOptions options = of_fronts;
        options.sides = sides;
        const SmallWorld world(closed_room, options, 64, 2.0, 4, {4000});
        const auto ends = relight::ray_ends(world.patches(), world.mesh.scene);
        relight::SitePatches view(world.patches(), ends, *world.rays, sides);
        double mean = 0.0, squares = 0.0;
        for (const relight::Site& site : world.mesh.sites.sites) {
            view.look(site);
            double sum = 0.0;
            for (const float share : view.shares()) sum += static_cast<double>(share) / (2.0 * std::numbers::pi);
            squares += (sum - 1.0) * (sum - 1.0) / static_cast<double>(world.mesh.sites.sites.size());
            mean += sum / static_cast<double>(world.mesh.sites.sites.size());
        }
        EXPECT_NEAR(mean, 1.0, 0.03);
        // Near an edge of the room it depends on where the nearest patches lie.
        EXPECT_LT(std::sqrt(squares), 0.15);
    }
}

// In a furnace a surface reflects its albedo of the radiance about it.
TEST(Bounce, FurnaceAddsAlbedo) {
    const SmallWorld world(closed_room, of_fronts, 64, 0.8, 24, {6000});
    ASSERT_GT(world.seen.points.size(), 300u);
    const std::vector<glm::vec3> expected(world.seen.points.size(), glm::vec3(0.5f, 0.4f, 0.3f));
    for (const relight::BounceOptions& options : {relight::BounceOptions{}, every_patch}) {
        const auto radiance = reflected_of_one(world, options);
        glm::dvec3 mean(0.0);
        for (const glm::vec3& r : radiance) mean += glm::dvec3(r) / static_cast<double>(radiance.size());
        EXPECT_NEAR(mean.x / 0.5, 1.0, 0.015);
        EXPECT_NEAR(mean.y / 0.4, 1.0, 0.015);
        EXPECT_NEAR(mean.z / 0.3, 1.0, 0.015);
        EXPECT_LT(relative_difference(radiance, expected), 0.04);
    }
}

TEST(Bounce, NothingReflectsMoreThanArrives) {
    const SmallWorld world(block_over_floor, {.deviation = 0.5}, 64, 0.5, 24, {3000});
    const auto radiance = reflected_of_one(world);
    float most = 0.0f, brightest = 0.0f;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        const render::SurfacePoint& point = world.seen.points[i];
        if (point.model != render::SurfacePoint::Model::lambert) continue;
        most = std::max(most, radiance[i].x / point.diffuse.x);
        brightest = std::max(brightest, radiance[i].x);
    }
    EXPECT_LT(most, 1.02f);
    EXPECT_GT(brightest, 0.05f);  // below the block
}

TEST(Bounce, SolidAnglesAreBoundedNearBy) {
    const SmallWorld world(block_over_floor, {}, 64, 0.0, 4, {100});
    const relight::Patches& patches = world.patches();
    const float side = std::sqrt(patches.area);
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const glm::vec3 place = patches[i].position, normal = patches[i].normal;
        double before = 3.5;
        for (const float distance : {1e-5f, 1e-3f, 0.6f, 3.0f, 10.0f}) {
            const glm::vec3 from = place + distance * side * normal;
            const auto angle = static_cast<double>(patches.solid_angle(i, from, 0.0f));
            EXPECT_LE(angle, before * 1.0001);
            before = angle;
            EXPECT_EQ(patches.solid_angle(i, place - distance * side * normal, 0.0f), 0.0f);
            EXPECT_EQ(patches.solid_angle(i, from, 1.1f * distance * side), 0.0f);
            if (distance < 0.6f) continue;
            const double expected = 1.0 / (static_cast<double>(distance) * static_cast<double>(distance));
            EXPECT_NEAR(angle / expected, 1.0, 1e-3);
        }
    }
}

TEST(Bounce, BlackSurfacesBounceNothing) {
    SmallWorld world(block_over_floor, {}, 256, 1.0, 16, {500});
    for (const glm::vec3& r : world.bounce(world.power(small_map()))) ASSERT_GE(r.x, 0.0f);
    for (render::Material& material : world.mesh.scene.materials) material.base_color = glm::vec3(0.0f);
    // What reflects is black; what is looked at is still as it was seen.
    for (const glm::vec3& r : world.bounce(world.power(small_map()))) EXPECT_EQ(r, glm::vec3(0.0f));
}

TEST(Bounce, ConvexBodyGetsNone) {
    const SmallWorld world(box_alone, {}, 256, 0.0, 16, {500});
    const auto power = world.power(small_map());
    const auto direct = world.relit(power), bounced = world.bounce(power);
    for (std::size_t i = 0; i < direct.size(); ++i) EXPECT_LE(bounced[i].x, 1e-5f * direct[i].x);
}

TEST(Bounce, ExactCutsOfAllPatchesAreTheExhaustiveSum) {
    const SmallWorld world(block_over_floor, exact, 256, 2.0, 24, {300, 0.0});
    const auto power = world.power(small_map());
    const auto exhaustive = world.exhaustive_bounce(power, relight::Truth::vertices);
    // Solid angles are stored in 16 bits.
    EXPECT_LT(relative_difference(world.bounce(power, every_direction, every_patch), exhaustive), 5e-4);
}

TEST(Bounce, CutsAreNearTheExhaustiveSum) {
    const SmallWorld world(block_over_floor, {.deviation = 0.7}, 2048, 0.5, 24, {2000});
    const auto power = world.power(small_map(128));
    EXPECT_LT(relative_difference(world.bounce(power), world.exhaustive_bounce(power, relight::Truth::vertices)), 0.05);
    EXPECT_LT(world.bounce_statistics.mean_size(), 0.1 * static_cast<double>(world.patches().size()));
}

TEST(Bounce, FineMeshesAreNearVisibilityFromPixels) {
    const SmallWorld world(block_over_floor, {.deviation = 0.5}, 256, 0.2, 16, {800});
    const auto power = world.power(small_map());
    EXPECT_LT(relative_difference(world.bounce(power), world.exhaustive_bounce(power, relight::Truth::pixels)), 0.04);
}

TEST(Bounce, ThreadsChangeNoBit) {
    const auto run = [](int threads) {
        tbb::task_arena arena(threads);
        return arena.execute([] {
            const SmallWorld world(block_over_floor, {}, 128, 1.0, 24, {400});
            const std::vector<char>& all = world.content;
            // Names of temporary folders apart.
            return std::pair(std::vector<char>(std::find(all.begin(), all.end(), '\n'), all.end()),
                             world.bounce(world.power(small_map())));
        });
    };
    const auto [bytes, radiance] = run(1);
    const auto [other_bytes, other_radiance] = run(4);
    EXPECT_EQ(bytes, other_bytes);
    EXPECT_EQ(radiance, other_radiance);
}

}  // namespace
