#include <string>

#include <gtest/gtest.h>
#include <benchmarks/scene_options.hpp>
#include <lightcuts/core/invalid_input.hpp>

namespace {

using benchmark::scene_options;

TEST(SceneOptions, AreTheRenderersDefaultsWithoutAnyInTheName) {
    for (const std::string name : {"builtin:hall", "rooms/room.glb"}) {
        const render::Options options = scene_options(name, 16);
        EXPECT_EQ(options.scene, name);
        EXPECT_EQ(options.area_points, 16u);
        EXPECT_EQ(options.indirect, 0u);
        EXPECT_EQ(options.clamp.ratio, lightcuts::automatic_clamping.ratio);
    }
}

TEST(SceneOptions, ComeFromTheName) {
    const render::Options options = scene_options(
        "room.glb?area-points=7&indirect=1000&sun-sky=35,120&ground=0.5&clamp=0.5&materials=diffuse&seed=3", 16);
    EXPECT_EQ(options.scene, "room.glb");
    EXPECT_EQ(options.area_points, 7u);
    EXPECT_EQ(options.indirect, 1000u);
    ASSERT_TRUE(options.sun_sky);
    EXPECT_EQ(options.sun_sky->azimuth, 120.0f);
    EXPECT_EQ(options.ground, 0.5f);
    EXPECT_EQ(options.clamp.radiance, 0.5f);
    EXPECT_FALSE(options.clamp.is_automatic());
    EXPECT_TRUE(options.diffuse_materials);
    EXPECT_EQ(options.seed, 3u);
}

TEST(SceneOptions, LeaveABuiltinSceneItsOwn) {
    EXPECT_EQ(scene_options("builtin:surfaces?lights=10&rotated=0").scene, "builtin:surfaces?lights=10&rotated=0");
    const render::Options options = scene_options("builtin:surfaces?indirect=9&lights=10&clamp=off&rotated=0");
    EXPECT_EQ(options.scene, "builtin:surfaces?lights=10&rotated=0");
    EXPECT_EQ(options.indirect, 9u);
    EXPECT_FALSE(options.clamp.has_threshold());
}

TEST(SceneOptions, RefuseWhatIsNone) {
    for (const std::string name :
         {"builtin:hall?method=power", "builtin:hall?indirect", "builtin:hall?indirect=many", "room.glb?rotated=1",
          "builtin:hall?indirect=1&indirect=2", "builtin:hall?&indirect=1"}) {
        try {
            scene_options(name);
            ADD_FAILURE() << name;
        } catch (const lightcuts::invalid_input& e) {
            const std::string message = e.what();
            EXPECT_EQ(message.rfind(name + ": ", 0), 0u) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
}

}  // namespace
