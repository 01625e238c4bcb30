#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/program.hpp"

namespace {

struct ErrorVsTime : BenchmarkProgram {
    ErrorVsTime() : BenchmarkProgram(LIGHTCUTS_ERROR_VS_TIME_EXECUTABLE) {}
};

const std::string lamp = "newmtl lamp\nKd 0 0 0\nKe 9 9 9\nnewmtl wall\nKd 0.5 0.5 0.5\n";
const std::string room =
    "mtllib room.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nv -1 2 2\nv 1 2 2\nv 0 2 1\n"
    "usemtl wall\nf 1 2 3\nusemtl lamp\nf 4 6 5\nf 4 5 6\n";
const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST_F(ErrorVsTime, WritesFiguresPlotsAndPictures) {
    const auto result = run("--scene builtin:omni?lights=64 --width 32 --height 18 --quick --svg");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");

    const auto json = figures("error_vs_time.json");
    ASSERT_EQ(json.at("scenes").size(), 1u);
    const auto& scene = json.at("scenes")[0];
    EXPECT_EQ(scene.at("lights"), 64);
    EXPECT_EQ(scene.at("size"), (std::vector<int>{32, 18}));
    EXPECT_EQ(scene.at("exhaustive").at("error").at("relative_rmse"), 0.0);
    EXPECT_GT(scene.at("exhaustive").at("seconds"), 0.0);
    std::size_t settings = 1;
    for (const auto& curve : scene.at("curves")) {
        settings += curve.at("points").size();
        for (const auto& point : curve.at("points")) {
            EXPECT_GT(point.at("seconds"), 0.0);
            EXPECT_GT(point.at("shadow_rays_per_pixel"), 0.0);
            // The last setting of every method is its finest.
            EXPECT_GE(point.at("error").at("relative_rmse"), curve.at("points").back().at("error").at("relative_rmse"));
        }
    }
    EXPECT_EQ(scene.at("equal_time").size(), 3u);  // lightcuts, with 8 representatives, of up to 4000 clusters

    const std::string csv = folder.read("error_vs_time.csv");
    EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), 1 + settings);

    const std::string html = folder.read("error_vs_time.html");
    for (const char* part : {"<svg", "data:image/png;base64,iVBORw0KGgo", "16 x difference", "cut size", "</html>"}) {
        EXPECT_NE(html.find(part), std::string::npos) << part;
    }
    EXPECT_EQ(html.find("src=\"http"), std::string::npos);
    const std::string svg = folder.read("error_vs_time-builtin-omni-lights-64.svg");
    EXPECT_EQ(svg.rfind("<svg xmlns", 0), 0u);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST_F(ErrorVsTime, ComparesMethodsThatDoNotClampWithASumThatDoesNot) {
    const auto result = run("--scene builtin:hall?area-points=1&indirect=150 --width 16 --height 9 --quick");
    ASSERT_EQ(result.status, 0) << result.err;
    const auto json = figures("error_vs_time.json");
    const auto& scene = json.at("scenes")[0];
    EXPECT_NEAR(scene.at("lights").get<double>(), 72.0 + 150.0, 30.0);
    EXPECT_GT(scene.at("exhaustive_not_clamped").at("seconds"), 0.0);
    // Each comes near to its own; the pictures are far from each other.
    for (const auto& curve : scene.at("curves")) {
        const std::string method = curve.at("method");
        if (method != "ward" && method != "lightcuts") continue;
        EXPECT_LT(curve.at("points").back().at("error").at("relative_rmse"), 0.05) << method;
    }
    const auto off = run("--scene builtin:hall?area-points=1&indirect=150&clamp=off --width 16 --height 9 --quick");
    ASSERT_EQ(off.status, 0) << off.err;
    EXPECT_FALSE(figures("error_vs_time.json").at("scenes")[0].contains("exhaustive_not_clamped"));
}

TEST_F(ErrorVsTime, UsesTheCamerasOfASceneJson) {
    const std::string camera = R"({"eye": [0, 0, 3], "target": [0, 0, 0], "up": [0, 1, 0], "vfov_deg": 40,
                                   "resolution": [64, 128]})";
    folder.write("scene.json", R"({"file": "room.obj", "cameras": [)" + camera + "," + camera + "]}");
    folder.write("room.mtl", lamp);
    folder.write("room.obj", room);
    const auto result = run("--scene room.obj --height 20 --runs 1 --area-points 8");
    ASSERT_EQ(result.status, 0) << result.err;
    const auto json = figures("error_vs_time.json");
    ASSERT_EQ(json.at("scenes").size(), 2u);
    EXPECT_EQ(json.at("scenes")[1].at("name"), "room, camera 1");
    EXPECT_EQ(json.at("scenes")[0].at("size"), (std::vector<int>{10, 20}));
}

TEST_F(ErrorVsTime, RefusesInOneLineAndWritesNothing) {
    folder.write("dark.obj", triangle);
    std::filesystem::create_directory(folder.path() / "bad");
    folder.write("bad/room.mtl", lamp);
    folder.write("bad/room.obj", room);
    folder.write("bad/scene.json", "{\n\"file\": \"room.obj\",\n\"cameras\": [{\"eye\": [1, 2, 3]}]}");
    struct Refusal {
        std::string arguments;
        int status;
        std::string says;
    };
    const std::vector<Refusal> refusals = {
        {"--scene dark.obj", 1, "dark.obj: "},
        {"--scene bad/room.obj", 1, "bad/scene.json: cameras[0]: 'target' is missing"},
        {"--scene bad/room.obj --area-points 0", 1, "bad/room.obj: "},
        {"--scene builtin:none", 1, "builtin:none"},
        {"--scene builtin:hall?env-scale=2", 1, "builtin:hall?env-scale=2: --env-scale needs --env"},
        {"--scene builtin:hall?indirect=some", 1, "builtin:hall?indirect=some: --indirect"},
        {"--scene bad/room.obj?indirect=10&method=power", 1, "'method=power'"},
        {"--output no/such/folder", 1, "no/such/folder"},
        {"--runs 0", 2, "--runs"},
        {"--runs 2", 2, "--runs"},
        {"--width 0", 2, "--width"},
        {"--unknown", 2, "--unknown"},
    };
    for (const Refusal& refusal : refusals) {
        const auto result = run(refusal.arguments);
        EXPECT_EQ(result.status, refusal.status) << refusal.arguments << ": " << result.err;
        EXPECT_NE(result.err.find(refusal.says), std::string::npos) << refusal.arguments << ": " << result.err;
        EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << refusal.arguments << ": " << result.err;
        EXPECT_FALSE(folder.has("error_vs_time.html")) << refusal.arguments;
    }
}

}  // namespace
