#include <gtest/gtest.h>
#include <lightcuts/core/invalid_input.hpp>
#include <relight/site_patches.hpp>

#include "render/refusal.hpp"
#include "small_world.hpp"

namespace {

void expect_that_damage_is_refused(const SmallBounce& bounce) {
    const SmallWorld world(block_over_floor, {}, 64, 0.0, 4, bounce);
    const auto opened = [&](std::vector<char> content) {
        render::write_file(world.folder / "damaged.relight", content);
        const relight::RelightFile file(world.folder / "damaged.relight");
        lightcuts::PiecewiseConstant<float> cut;
        for (std::size_t i = 0; i < file.preparation().sites; ++i) {
            file.read(i, cut);
            if (bounce.points > 0) file.read_bounce(i, cut);
        }
    };
    opened(world.content);
    for (std::size_t i = 0; i < world.content.size(); i += 1 + world.content.size() / 150) {
        std::vector<char> content = world.content;
        content[i] = static_cast<char>(content[i] ^ 0x10);
        const std::string message = refusal([&] { opened(content); });
        EXPECT_NE(message.find("damaged.relight"), std::string::npos) << i << ": " << message;
        content = world.content;
        content.resize(i);
        refusal([&] { opened(content); });
    }
    std::vector<char> longer = world.content;
    longer.push_back('x');
    EXPECT_NE(refusal([&] { opened(longer); }).find("1 bytes too many"), std::string::npos);
}

TEST(RelightFile, DamageIsRefused) {
    expect_that_damage_is_refused({});
    expect_that_damage_is_refused({.points = 50});
}

TEST(RelightFile, BounceIsReadAsItWasWritten) {
    const SmallWorld world(block_over_floor, {}, 64, 0.0, 4, {.points = 300, .deviation = 0.0});
    const relight::Patches written = relight::spread_patches(world.mesh.scene, 300, relight::Sides::both, 1);
    EXPECT_EQ(world.patches().clusters, written.clusters);
    EXPECT_EQ(world.patches().leaves, written.leaves);
    EXPECT_EQ(world.patches().area, written.area);
    EXPECT_NEAR(written.area * 300.0f, 64.0f + 4.0f + 4.0f + 4.0f * 2.0f, 0.01f);
    const auto ends = relight::ray_ends(written, world.mesh.scene);
    relight::SitePatches view(written, ends, *world.rays, relight::Sides::both);
    lightcuts::PiecewiseConstant<float> cut;
    for (std::size_t site = 0; site < world.mesh.sites.sites.size(); ++site) {
        view.look(world.mesh.sites.sites[site]);
        world.file->read_bounce(site, cut);
        std::size_t item = 0;
        for (std::size_t i = 0; i < cut.size(); ++i) {
            for (; item < cut.pieces()[i].leaf_end(); ++item) {
                EXPECT_NEAR(cut.values()[i], view.shares()[item], 3e-4f * (view.shares()[item] + 0.01f));
            }
        }
    }
}

// Programs that know no bounce read them.
TEST(RelightFile, WithoutBounceIsOfTheFirstVersion) {
    const auto version = [](const SmallBounce& bounce) {
        const SmallWorld world(block_over_floor, {}, 64, 0.0, 4, bounce);
        return std::string(world.content.begin(), world.content.begin() + 20);
    };
    EXPECT_EQ(version({}), "lightcuts-relight 1 ");
    EXPECT_EQ(version({.points = 50}), "lightcuts-relight 2 ");
}

TEST(RelightFile, AnotherMeshIsRefused) {
    const SmallWorld world(block_over_floor, {}, 64);
    render::Scene scene = relight::load_still_scene(world.folder / "scene.obj");
    world.file->require_scene(scene);
    scene.positions[3].y += 0.5f;
    EXPECT_NE(refusal([&] { world.file->require_scene(scene); }).find("another mesh"), std::string::npos);
}

TEST(RelightFile, MaterialsMayChange) {
    const SmallWorld world(block_over_floor, {}, 64);
    render::Scene scene = relight::load_still_scene(world.folder / "scene.obj");
    scene.materials[0].base_color = glm::vec3(0.1f, 0.9f, 0.2f);
    world.file->require_scene(scene);
    // But not what lets light pass.
    scene.materials[0].transmission = 0.5f;
    EXPECT_NE(render::occlusion_hash(scene), world.file->preparation().fingerprint);
}

}  // namespace
