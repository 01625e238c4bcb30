#include <cstddef>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <render/coarse_picture.hpp>
#include <render/io/exr_picture.hpp>

#include "programs.hpp"

namespace {

using Json = nlohmann::json;
using render::Picture;

TEST(PilotGrid, HasOnePilotForSixtyFourPixelsWithinLimits) {
    const auto count = [](int width, int height) {
        const render::CoarseGrid grid = render::pilot_grid(width, height);
        EXPECT_GE(grid.columns, 1);
        EXPECT_LE(grid.columns, width);
        EXPECT_GE(grid.rows, 1);
        EXPECT_LE(grid.rows, height);
        return grid.columns * grid.rows;
    };
    EXPECT_NEAR(count(320, 180), 900, 30);
    EXPECT_NEAR(count(96, 72), 576, 20);
    EXPECT_NEAR(count(1920, 1080), 2304, 50);
    EXPECT_EQ(count(1, 1), 1);
    EXPECT_GT(count(2000, 1), 576);
    EXPECT_EQ(count(10, 10), 100);
    const render::CoarseGrid wide = render::pilot_grid(640, 160);
    EXPECT_NEAR(wide.columns, 4 * wide.rows, 4);
}

TEST_F(Programs, LearnVisibilityWhenAsked) {
    const std::string scene = "room.obj --size 50x40 --area-points 2000 --error-ratio 0.01 --quiet" + view;
    ASSERT_EQ(render(scene + "-o plain.exr").status, 0);
    EXPECT_TRUE(report("plain.json").at("learned_visibility").is_null());
    EXPECT_EQ(report("plain.json").at("options").at("learn_visibility"), false);
    const std::string learning = scene + "--learn-visibility --aov error_bound,expected_error,shadow_rays ";
    ASSERT_EQ(render(learning + "--threads 1 --reference plain.exr -o one.exr").status, 0);
    ASSERT_EQ(render(learning + "--threads 2 -o two.exr").status, 0);
    EXPECT_EQ(folder.read("one.exr"), folder.read("two.exr")) << "of any number of threads";

    const Json json = report("one.json");
    EXPECT_EQ(json.at("options").at("learn_visibility"), true);
    const Json& learned = json.at("learned_visibility");
    EXPECT_GT(learned.at("pilots"), 300);
    EXPECT_LE(learned.at("pilots"), 600);
    EXPECT_GT(learned.at("shadow_rays"), 0);
    EXPECT_EQ(learned, report("two.json").at("learned_visibility"));
    const double all = json.at("shadow_rays"), own = learned.at("shadow_rays");
    EXPECT_NEAR(learned.at("share"), own / all, 1e-12);
    EXPECT_LT(json.at("error").at("relative_rmse"), 0.02);

    const Picture picture = render::read_exr(folder / "one.exr");
    double rays = 0.0;
    for (const float r : picture.find("shadow_rays")->values) rays += static_cast<double>(r);
    EXPECT_NEAR(rays + own, all, 0.5) << "the pilots' are among all";
    for (const std::string channel : {"R", "G", "B"}) {
        const auto& bound = picture.find("error_bound." + channel)->values;
        const auto& expected = picture.find("expected_error." + channel)->values;
        for (std::size_t i = 0; i < bound.size(); ++i) {
            EXPECT_GE(expected[i], 0.0f);
            EXPECT_LE(expected[i], 1.0001f * bound[i]);
        }
    }
}

TEST_F(Programs, RefuseToLearnForOtherMethods) {
    const auto expect_refusal = [&](const std::string& arguments, const std::string& says) {
        const auto result = render("room.obj --size 8x8 " + arguments + view);
        EXPECT_EQ(result.status, 2) << arguments;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
        EXPECT_FALSE(folder.has("render.exr"));
    };
    expect_refusal("--learn-visibility --method exhaustive", "--learn-visibility goes with --method lightcuts");
    expect_refusal("--aov expected_error", "--aov expected_error needs --learn-visibility");
}

}  // namespace
