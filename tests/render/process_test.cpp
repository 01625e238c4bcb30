#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <render/io/picture.hpp>

#include "bitmap.hpp"
#include "programs.hpp"

namespace {

using Json = nlohmann::json;
using render::Picture;

TEST_F(Programs, LeavePictureAndReport) {
    const auto result = render("room.obj --size 40x30 --spp 3 --aov cut_size,shadow_rays,error_bound,depth,normal" +
                               view);
    ASSERT_EQ(result.status, 0) << result.err;
    const Picture picture = render::read_exr(folder / "render.exr");
    EXPECT_EQ(picture.width, 40);
    EXPECT_EQ(picture.height, 30);
    for (const char* channel : {"cut_size", "shadow_rays", "error_bound.R", "error_bound.G", "error_bound.B", "depth",
                                "normal.X", "normal.Y", "normal.Z"}) {
        EXPECT_NE(picture.find(channel), nullptr) << channel;
    }
    EXPECT_EQ(folder.read("render.png").substr(1, 3), "PNG");

    const Json json = report("render.json");
    EXPECT_EQ(json.at("scene"), "room.obj");
    EXPECT_EQ(json.at("method"), "lightcuts");
    EXPECT_EQ(json.at("size"), Json({40, 30}));
    EXPECT_EQ(json.at("spp"), 3);
    EXPECT_EQ(json.at("seed"), 1);
    EXPECT_GE(json.at("threads"), 1);
    EXPECT_EQ(json.at("interrupted"), false);
    EXPECT_EQ(json.at("triangles"), 6);
    EXPECT_EQ(json.at("lights").at("oriented"), 64);
    EXPECT_EQ(json.at("lights").at("environment"), 0);
    for (const char* phase : {"load", "tree", "render"}) EXPECT_GE(json.at("seconds").at(phase), 0.0) << phase;
    EXPECT_GT(json.at("shadow_rays"), 0);
    EXPECT_GT(json.at("shadow_rays_per_pixel"), 0.0);
    EXPECT_NEAR(json.at("shadow_rays_per_pixel").get<double>() * 1200, json.at("shadow_rays").get<double>(), 0.5);
    for (const char* key : {"mean", "max", "at_limit"}) EXPECT_TRUE(json.at("cut_size").contains(key)) << key;
    for (const char* key : {"mean", "max"}) EXPECT_TRUE(json.at("error_bound").contains(key)) << key;
    EXPECT_GT(json.at("peak_memory_bytes"), 1000000);
    EXPECT_EQ(json.at("options").at("error_ratio"), 0.02);
    EXPECT_FALSE(json.contains("error"));
}

TEST_F(Programs, PutAllThreeFilesWhereAsked) {
    std::filesystem::create_directory(folder.path() / "out");
    const auto before = files();
    ASSERT_EQ(render("room.obj --size 8x8 --quiet -o out/my.picture.exr" + view).status, 0);
    EXPECT_TRUE(folder.has("out/my.picture.exr"));
    EXPECT_TRUE(folder.has("out/my.picture.png"));
    EXPECT_TRUE(folder.has("out/my.picture.json"));
    EXPECT_EQ(files(), before);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path() / "out"), {}), 3);
}

TEST_F(Programs, QuietPrintsNothing) {
    const auto result = render("room.obj --size 8x8 --quiet" + view);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "");
}

TEST_F(Programs, ProgressStaysOffFiles) {
    EXPECT_EQ(render("room.obj --size 64x64" + view).err.find('\r'), std::string::npos);
}

TEST_F(Programs, MatchTheClosedFormOfOneOmniLight) {
    for (const std::string method : {"exhaustive", "lightcuts", "tree-sampling", "resampled", "resampled-power",
                                     "adaptive-splitting", "stochastic-lightcuts"}) {
        ASSERT_EQ(render("floor.obj --lights one.csv --size 33x25 --aov depth,normal --method " + method + view).status,
                  0);
        const Picture picture = render::read_exr(folder / "render.exr");
        const glm::dvec3 eye(1.0, 5.0, 7.0);
        const glm::dvec3 forward = glm::normalize(glm::dvec3(0.0, 0.5, 0.0) - eye);
        const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
        const glm::dvec3 up = glm::cross(right, forward);
        const double pixel = 2.0 * std::tan(std::numbers::pi / 8.0) / 25.0;
        int lit = 0;
        for (int y = 0; y < 25; ++y) {
            for (int x = 0; x < 33; ++x) {
                const glm::dvec3 direction = forward + (x + 0.5 - 16.5) * pixel * right - (y + 0.5 - 12.5) * pixel * up;
                const double t = -eye.y / direction.y;
                const glm::dvec3 at = eye + t * direction;
                const bool on_floor = t > 0.0 && std::abs(at.x) < 3.99 && std::abs(at.z) < 3.99;
                if (!on_floor) continue;
                ++lit;
                const glm::dvec3 to_light = glm::dvec3(0.5, 2.0, -0.25) - at;
                const double d2 = glm::dot(to_light, to_light);
                const double cosine = to_light.y / std::sqrt(d2);
                const glm::dvec3 expected = glm::dvec3(0.5, 0.4, 0.3) / std::numbers::pi * glm::dvec3(3.0, 2.0, 1.0) *
                                            cosine / d2;
                const glm::dvec3 found(picture.pixels[static_cast<std::size_t>(y * 33 + x)]);
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1.0, 1e-5) << method << x << "," << y;
            }
        }
        EXPECT_GT(lit, 300);
    }
}

TEST_F(Programs, AgreeWithinTheStatedError) {
    const std::string scene = "room.obj --area-points 500 --size 48x36 --quiet" + view;
    ASSERT_EQ(render(scene + "--method exhaustive -o exact.exr").status, 0);
    ASSERT_EQ(render(scene + "--method lightcuts --reference exact.exr").status, 0);
    const Json error = report("render.json").at("error");
    for (const char* key : {"relative_rmse", "relative_l1", "relative_bias", "max_relative", "p999_relative"}) {
        ASSERT_TRUE(error.at(key).is_number()) << key;
    }
    EXPECT_LT(error.at("relative_rmse"), 0.025);
    EXPECT_GT(error.at("relative_rmse"), 0.0);

    const auto figures = compare("render.exr exact.exr --out heat.png");
    ASSERT_EQ(figures.status, 0) << figures.err;
    EXPECT_EQ(Json::parse(figures.out), error);
    EXPECT_EQ(folder.read("heat.png").substr(1, 3), "PNG");
    EXPECT_EQ(Json::parse(compare("exact.exr exact.exr").out).at("max_relative"), 0.0);
}

TEST_F(Programs, SampleLessWronglyWithMoreSamples) {
    const std::string scene = "room.obj --area-points 500 --size 48x36 --quiet" + view;
    ASSERT_EQ(render(scene + "--method exhaustive -o exact.exr").status, 0);
    for (const std::string method :
         {"tree-sampling", "resampled", "resampled-power", "adaptive-splitting", "stochastic-lightcuts"}) {
        const auto error_of = [&](const std::string& samples) {
            EXPECT_EQ(render(scene + "--reference exact.exr --samples " + samples + " --method " + method).status, 0);
            const Json json = report("render.json");
            EXPECT_EQ(json.at("method"), method);
            EXPECT_GT(json.at("shadow_rays_per_pixel"), 0.0);
            EXPECT_LE(json.at("shadow_rays_per_pixel"), std::stod(samples));
            return json.at("error").at("relative_rmse").get<double>();
        };
        const double few = error_of("4"), many = error_of("64");
        EXPECT_LT(many, 0.05) << method;
        EXPECT_LT(many, 0.6 * few) << method;
        // Another seed errs otherwise.
        const std::string picture = folder.read("render.exr");
        error_of("64 --seed 2");
        EXPECT_NE(folder.read("render.exr"), picture) << method;
    }
    ASSERT_EQ(render(scene + "--method resampled --candidates 8").status, 0);
    EXPECT_EQ(report("render.json").at("options").at("candidates"), 8);
    ASSERT_EQ(render(scene + "--method adaptive-splitting --splitting-threshold 0.5").status, 0);
    EXPECT_EQ(report("render.json").at("options").at("splitting_threshold"), 0.5);
}

TEST_F(Programs, ShowALayerInFalseColors) {
    ASSERT_EQ(render("room.obj --size 16x12 --quiet --aov cut_size,depth" + view).status, 0);
    const auto shown = compare("render.exr --layer cut_size --white 100 --out cut.png");
    ASSERT_EQ(shown.status, 0) << shown.err;
    const Json json = Json::parse(shown.out);
    EXPECT_EQ(json.at("layer"), "cut_size");
    EXPECT_EQ(json.at("white"), 100.0);
    EXPECT_LE(json.at("min"), json.at("mean"));
    EXPECT_LE(json.at("mean"), json.at("max"));
    EXPECT_GT(json.at("max"), 1.0);
    EXPECT_EQ(folder.read("cut.png").substr(1, 3), "PNG");

    // Left to itself, white is the largest value.
    const Json usual = Json::parse(compare("render.exr --layer cut_size --out usual.png").out);
    EXPECT_EQ(usual.at("white"), usual.at("max"));
    EXPECT_NE(folder.read("usual.png"), folder.read("cut.png"));
    const Json depth = Json::parse(compare("render.exr --layer depth").out);
    EXPECT_GT(depth.at("min"), 0.0);
}

TEST_F(Programs, MakeTheSameImageWithAnyNumberOfThreads) {
    const std::string scene = "room.obj --size 50x40 --spp 2 --aov cut_size,error_bound --quiet" + view;
    for (const std::string method :
         {"lightcuts", "exhaustive", "tree-sampling", "adaptive-splitting", "stochastic-lightcuts"}) {
        ASSERT_EQ(render(scene + "--threads 1 -o one.exr --method " + method).status, 0);
        ASSERT_EQ(render(scene + "--threads 2 -o two.exr --method " + method).status, 0);
        EXPECT_EQ(folder.read("one.exr"), folder.read("two.exr")) << method;
        EXPECT_EQ(report("one.json").at("cut_size"), report("two.json").at("cut_size"));
        EXPECT_EQ(report("one.json").at("error_bound"), report("two.json").at("error_bound"));
        EXPECT_EQ(report("one.json").at("threads"), 1);
        EXPECT_EQ(report("two.json").at("threads"), 2);
    }
}

TEST_F(Programs, MeasureTheAdaptationWhenAsked) {
    ASSERT_EQ(render("room.obj --size 16x12 --quiet --adaptation auto" + view).status, 0);
    EXPECT_GT(report("render.json").at("options").at("adaptation"), 0.0);
    ASSERT_EQ(render("room.obj --size 16x12 --quiet --adaptation 0.25" + view).status, 0);
    EXPECT_EQ(report("render.json").at("options").at("adaptation"), 0.25);
}

TEST_F(Programs, RenderBlackWhenEveryLightIsDark) {
    const auto result = render("floor.obj --lights dark.csv --size 8x8 --quiet" + view);
    ASSERT_EQ(result.status, 0) << result.err;
    for (const glm::vec3& pixel : render::read_exr(folder / "render.exr").pixels) EXPECT_EQ(pixel, glm::vec3(0.0f));
}

TEST_F(Programs, ListAndDescribe) {
    const auto scenes = render("--list-scenes");
    EXPECT_EQ(scenes.status, 0);
    EXPECT_NE(scenes.out.find("builtin:hall\n"), std::string::npos);
    const auto help = render("--help");
    EXPECT_EQ(help.status, 0);
    EXPECT_NE(help.out.find("--error-ratio"), std::string::npos);
    EXPECT_EQ(render("--version").out, std::string("lightcuts-render ") + LIGHTCUTS_VERSION + "\n");
    EXPECT_EQ(compare("--help").status, 0);
}

TEST_F(Programs, RefuseBadInputInOneLine) {
    folder.write("empty.obj", "# nothing\n");
    folder.write("broken.csv", "kind,x,y,z,dx,dy,dz,r,g,b\nomni,0,2,0,,,,1,1,1\nomni,0,2\n");
    folder.write("negative.csv", "kind,x,y,z,dx,dy,dz,r,g,b\nomni,0,2,0,,,,1,-1,1\n");
    folder.write("cut.glb", "glTF");
    folder.write("text.exr", "no picture");
    write_exr(folder / "small.exr", Picture(4, 4));
    std::filesystem::create_directory(folder.path() / "folder.exr");
    const Refusal refusals[] = {
        {"absent.obj", 1, "absent.obj"},
        {"absent.glb", 1, "absent.glb"},
        {"cut.glb", 1, "cut.glb"},
        {"empty.obj --lights one.csv", 1, "empty.obj"},
        {"builtin:nothing", 1, "nothing"},
        {"floor.obj", 1, "light"},
        {"room.obj --area-points 0", 1, "light"},
        {"room.obj --lights absent.csv", 1, "absent.csv"},
        {"room.obj --lights broken.csv", 1, "broken.csv:3"},
        {"room.obj --lights negative.csv", 1, "negative.csv:2"},
        {"room.obj -o no/such/folder.exr", 1, "no/such/folder.exr"},
        {"room.obj -o folder.exr", 1, "folder.exr"},
        {"room.obj --reference absent.exr", 1, "absent.exr"},
        {"room.obj --reference text.exr", 1, "text.exr"},
        {"room.obj --reference small.exr", 1, "4x4"},
        {"room.obj --size 0x0", 2, "--size"},
        {"room.obj --size 4000000x4000000", 2, "--size"},
        {"room.obj --size 40", 2, "--size"},
        {"room.obj --spp 0", 2, "--spp"},
        {"room.obj --spp many", 2, "--spp"},
        {"room.obj --error-ratio -1", 2, "--error-ratio"},
        {"room.obj --error-ratio nan", 2, "--error-ratio"},
        {"room.obj --max-cut -3", 2, "--max-cut"},
        {"room.obj --samples 0", 2, "--samples"},
        {"room.obj --splitting-threshold -1", 2, "--splitting-threshold"},
        {"room.obj --candidates 0", 2, "--candidates"},
        {"room.obj --representatives 33", 2, "--representatives"},
        {"room.obj --threads 0", 2, "--threads"},
        {"room.obj --builder oak", 2, "--builder"},
        {"room.obj --materials shiny", 2, "--materials"},
        {"room.obj --aov color", 2, "--aov"},
        {"room.obj --fov 180", 2, "--fov"},
        {"room.obj --eye 1,2", 2, "--eye"},
        {"room.obj --unknown", 2, "--unknown"},
        {"room.obj another.obj", 2, "another.obj"},
        {"room.obj -o render.png", 2, "render.png"},
    };
    const auto before = files();
    for (const Refusal& refusal : refusals) {
        const bool own_camera = std::string(refusal.arguments).find("--eye") != std::string::npos;
        const auto result = render(refusal.arguments + (own_camera ? " " : view));
        EXPECT_EQ(result.status, refusal.status) << refusal.arguments << ": " << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << refusal.arguments << ": " << result.err;
        EXPECT_NE(result.err.find(refusal.says), std::string::npos) << refusal.arguments << ": " << result.err;
        EXPECT_EQ(result.out, "") << refusal.arguments;
        EXPECT_EQ(files(), before) << refusal.arguments;
    }
}

TEST_F(Programs, RefuseImpossibleCameras) {
    const Refusal refusals[] = {
        {"room.obj", 1, "camera"},
        {"room.obj --camera north", 1, "camera"},
        {"room.obj --eye 1,2,3", 2, "--target"},
        {"room.obj --target 1,2,3", 2, "--eye"},
        {"room.obj --eye 1,2,3 --target 1,2,3", 2, "--target"},
        {"room.obj --eye 1,2,3 --target 1,2,nan", 2, "--target"},
        {"room.obj --eye 1,2,3 --target 1,5,3 --up 0,1,0", 2, "--up"},
        {"room.obj --eye 1,2,3 --target 0,0,0 --camera north", 2, "--camera"},
        {"room.obj --eye 0,1e20,0 --target 0,0,0", 1, "the target is 1e+20 from the eye"},
        {"room.obj --eye 0,0,0 --target 0,0,1e-45", 1, "the target is 1e-45 from the eye"},
        {"room.obj --eye 0,0,0 --target 1e-30,0,0 --up 0,1e-30,0", 1, "the target is 1e-30 from the eye"},
    };
    for (const Refusal& refusal : refusals) {
        const auto result = render(refusal.arguments);
        EXPECT_EQ(result.status, refusal.status) << refusal.arguments << ": " << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << refusal.arguments << ": " << result.err;
        EXPECT_NE(result.err.find(refusal.says), std::string::npos) << refusal.arguments << ": " << result.err;
    }
    EXPECT_EQ(render("room.obj --size 4x4 --quiet --eye 0,5,0 --target 0,0,0").status, 0);
}

TEST_F(Programs, RefuseWhatALaterVersionBrings) {
    std::vector<std::string> later;
    for (const char* method : {"reconstruction", "row-column"}) later.push_back(std::string("--method ") + method);
    const auto before = files();
    for (const std::string& option : later) {
        const auto result = render("room.obj " + option + view);
        EXPECT_EQ(result.status, 2) << option;
        EXPECT_TRUE(is_one_line(result.err)) << option << ": " << result.err;
        EXPECT_NE(result.err.find("later version"), std::string::npos) << option << ": " << result.err;
    }
    EXPECT_EQ(files(), before);
}

TEST_F(Programs, LeaveOldFilesAloneWhenTheyFail) {
    folder.write("render.exr", "old");
    EXPECT_EQ(render("room.obj --lights absent.csv" + view).status, 1);
    EXPECT_EQ(folder.read("render.exr"), "old");
    EXPECT_FALSE(folder.has("render.png"));
}

TEST_F(Programs, NeverReplaceWhatTheyRead) {
    folder.write("wall.mtl", "newmtl gray\nKd 1\nmap_Kd wall.png\n");
    folder.write("wall.obj", "mtllib wall.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nvt 0 0\nusemtl gray\nf 3/1 2/1 1/1\n");
    Picture map(4, 2);
    for (glm::vec3& pixel : map.pixels) pixel = glm::vec3(1.0f);
    write_exr(folder / "sky.exr", map);
    write_exr(folder / "other.partial.exr", map);
    write_exr(folder / "best.exr", Picture(8, 8));
    folder.write("wall.png", bitmap({{200, 100, 50}}));
    folder.write("wall.json", folder.read("one.csv"));
    std::filesystem::create_symlink("sky.exr", folder / "link.exr");
    std::map<std::string, std::string> before;
    for (const std::string& name : files()) before[name] = folder.read(name);
    for (const char* arguments :
         {"wall.obj --lights one.csv -o wall.exr", "wall.obj --lights one.csv -o ./wall.exr",
          "floor.obj --lights one.csv -o floor.obj", "room.obj -o room.mtl", "floor.obj --env sky.exr -o sky.exr",
          "floor.obj --env sky.exr -o link.exr", "floor.obj --env link.exr -o sky.exr",
          "floor.obj --lights wall.json -o wall.exr", "floor.obj --lights one.csv -o one.csv",
          "room.obj --reference best.exr -o best.exr", "floor.obj --env other.partial.exr -o other.exr"}) {
        const auto result = render(std::string(arguments) + " --size 8x8 --quiet" + view);
        EXPECT_EQ(result.status, 1) << arguments << ": " << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << arguments << ": " << result.err;
        EXPECT_NE(result.err.find("would replace a file that is read"), std::string::npos) << result.err;
        std::map<std::string, std::string> after;
        for (const std::string& name : files()) after[name] = folder.read(name);
        EXPECT_TRUE(after == before) << arguments;
    }
    for (const char* arguments : {"best.exr best.exr --out best.exr", "best.exr sky.exr --out sky.exr"}) {
        const auto result = compare(arguments);
        EXPECT_EQ(result.status, 1) << arguments;
        EXPECT_NE(result.err.find("would replace a file that is read"), std::string::npos) << result.err;
    }
    EXPECT_EQ(folder.read("best.exr"), before["best.exr"]);
    EXPECT_EQ(render("room.obj -o room.exr --size 8x8 --quiet" + view).status, 0) << "names of its own may be alike";
}

TEST_F(Programs, CompareRefusesInOneLine) {
    write_exr(folder / "small.exr", Picture(4, 4));
    write_exr(folder / "large.exr", Picture(5, 4));
    Picture layered(4, 4);
    layered.add_channel("cut_size");
    layered.add_channel("depth");
    write_exr(folder / "layered.exr", layered);
    const Refusal refusals[] = {
        {"small.exr large.exr", 1, "4x4"},
        {"small.exr absent.exr", 1, "absent.exr"},
        {"small.exr small.exr --out no/a.png", 1, "no/a.png"},
        {"small.exr", 2, "B"},
        {"small.exr small.exr --unknown", 2, "--unknown"},
        {"layered.exr --layer cut", 1, "it has cut_size, depth"},
        {"small.exr --layer cut_size", 1, "--aov"},
        {"absent.exr --layer cut_size", 1, "absent.exr"},
        {"layered.exr --layer depth --out no/a.png", 1, "no/a.png"},
        {"layered.exr layered.exr --layer depth", 2, "--layer"},
        {"layered.exr --layer depth --white 0", 2, "--white"},
        {"layered.exr --layer depth --white inf", 2, "--white"},
        {"layered.exr --layer depth --white x", 2, "--white"},
        {"small.exr small.exr --white -1", 2, "--white"},
        {"layered.exr --layer", 2, "--layer"},
    };
    for (const Refusal& refusal : refusals) {
        const auto result = compare(refusal.arguments);
        EXPECT_EQ(result.status, refusal.status) << refusal.arguments << ": " << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << refusal.arguments << ": " << result.err;
        EXPECT_NE(result.err.find(refusal.says), std::string::npos) << refusal.arguments << ": " << result.err;
        EXPECT_EQ(result.out, "") << refusal.arguments;
    }
}

TEST_F(Programs, SaveWhatIsFinishedWhenInterrupted) {
    // Much more work than the wait takes; the signal comes when the first tiles are done.
    Process process(LIGHTCUTS_RENDER_EXECUTABLE,
                    words("room.obj --method exhaustive --area-points 2000 --size 2000x1500 --threads 1" + view),
                    folder.path(), streams.path());
    std::this_thread::sleep_for(std::chrono::seconds(3));
    process.send(SIGINT);
    const auto result = process.wait();
    ASSERT_EQ(result.status, 3) << result.err;
    EXPECT_EQ(report("render.json").at("interrupted"), true);
    EXPECT_EQ(report("render.json").at("size"), Json({2000, 1500}));
    EXPECT_TRUE(folder.has("render.png"));
    const Picture picture = render::read_exr(folder / "render.exr");
    std::size_t lit = 0;
    for (const glm::vec3& pixel : picture.pixels) lit += pixel == glm::vec3(0.0f) ? 0 : 1;
    EXPECT_GT(lit, 0u);
    EXPECT_LT(lit, picture.size() / 2);
}

}  // namespace
