#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <render/io/picture.hpp>

#include "programs.hpp"

namespace {

using Json = nlohmann::json;

const std::string below_the_sky = "builtin:hall --sun-sky 35,120 --ground 0 --size 40x30 --quiet ";

TEST_F(Programs, ProveWhatIsHiddenFromTheSky) {
    ASSERT_EQ(render(below_the_sky + "--method exhaustive -o exact.exr").status, 0);
    const auto run = [&](const std::string& mode) {
        EXPECT_EQ(render(below_the_sky + "--aov hidden_share --reference exact.exr --visibility-bounds " + mode).status,
                  0);
        return report("render.json");
    };
    const Json off = run("off"), on = run("on"), by_pilot = run("auto");
    EXPECT_EQ(off.at("visibility_bounds"), Json({{"used", false}, {"pilot_ratio", nullptr}, {"hidden_share", 0.0}}));
    EXPECT_EQ(off.at("options").at("visibility_bounds"), "off");
    EXPECT_GT(off.at("cut_size").at("at_limit"), 500);
    for (const Json& with : {on, by_pilot}) {
        EXPECT_EQ(with.at("visibility_bounds").at("used"), true);
        EXPECT_GT(with.at("visibility_bounds").at("hidden_share"), 0.01);
        EXPECT_LT(with.at("cut_size").at("mean"), 0.4 * off.at("cut_size").at("mean").get<double>());
        EXPECT_LT(with.at("cut_size").at("at_limit"), 30);
        EXPECT_LT(with.at("error").at("relative_rmse"), 0.03);
        EXPECT_EQ(with.at("error"), on.at("error"));
    }
    EXPECT_LT(by_pilot.at("visibility_bounds").at("pilot_ratio"), 0.7);
    double share = 0.0;
    const render::Picture picture = render::read_exr((folder.path() / "render.exr").string());
    for (const float value : picture.find("hidden_share")->values) {
        EXPECT_GE(value, 0.0f);
        EXPECT_LE(value, 1.0f);
        share += static_cast<double>(value);
    }
    EXPECT_GT(share, 0.01 * 1200);
}

TEST_F(Programs, DoWithoutProofsWhereLittleIsHidden) {
    ASSERT_EQ(render("builtin:omni --size 40x30 --quiet").status, 0);
    const Json by_pilot = report("render.json");
    const std::string picture = folder.read("render.exr");
    EXPECT_EQ(by_pilot.at("visibility_bounds").at("used"), false);
    EXPECT_GT(by_pilot.at("visibility_bounds").at("pilot_ratio"), 1.0);
    ASSERT_EQ(render("builtin:omni --size 40x30 --quiet --visibility-bounds off").status, 0);
    EXPECT_EQ(folder.read("render.exr"), picture);
}

TEST_F(Programs, ProveTheSameInAnyThread) {
    std::string pictures[2];
    for (const int threads : {1, 3}) {
        ASSERT_EQ(render(below_the_sky + "--spp 2 --threads " + std::to_string(threads)).status, 0);
        pictures[threads / 2] = folder.read("render.exr");
    }
    EXPECT_EQ(pictures[0], pictures[1]);
}

TEST_F(Programs, RefuseProofsWhereNoneAreMade) {
    for (const std::string line : {"--visibility-bounds on --method power", "--visibility-bounds sometimes"}) {
        const auto refused = render("builtin:omni " + line);
        EXPECT_EQ(refused.status, 2) << line;
        EXPECT_NE(refused.err.find("--visibility-bounds"), std::string::npos) << refused.err;
    }
    EXPECT_EQ(render("builtin:omni --size 8x6 --quiet --method power").status, 0) << "by default none are";
}

}  // namespace
