#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <signal.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <render/io/picture.hpp>

#include "render/process.hpp"
#include "small_world.hpp"

namespace {

class RelightProgram : public ::testing::Test {
protected:
    TemporaryFolder folder;
    TemporaryFolder streams;

    void SetUp() override {
        folder.write("m.mtl", two_materials);
        folder.write("block.obj", block_over_floor);
        folder.write("box.obj", box_alone);
        render::write_exr(folder / "sky.exr", small_map());
    }

    static std::vector<std::string> words(const std::string& text) {
        std::istringstream stream(text);
        return {std::istream_iterator<std::string>(stream), {}};
    }
    Process::Result run(const std::string& arguments) {
        return Process(LIGHTCUTS_RELIGHT_EXECUTABLE, words(arguments), folder.path(), streams.path()).wait();
    }
    void refuse(const std::string& arguments, int status, const std::string& says) {
        const auto result = run(arguments);
        EXPECT_EQ(result.status, status) << arguments << ": " << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    }
    std::size_t file_count() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
    }

    const std::string view = " --eye 1,5,7 --target 0,0.5,0 --size 40x30 ";
};

TEST_F(RelightProgram, PreparesAndRendersFrames) {
    const auto prepared = run("prepare block.obj -o b.relight --directions 256 --edge 1");
    ASSERT_EQ(prepared.status, 0) << prepared.err;
    EXPECT_NE(prepared.err.find("RMS of visibility"), std::string::npos);
    const auto rendered = run("render b.relight --scene block.obj --env sky.exr --frames 3 --turn 30 -o f.exr" + view);
    ASSERT_EQ(rendered.status, 0) << rendered.err;
    const auto report = nlohmann::json::parse(folder.read("f.json"));
    EXPECT_EQ(report.at("frames").size(), 3u);
    EXPECT_EQ(report.at("frames")[2].at("rotation"), 60.0);
    const auto first = render::read_exr(folder / "f-0000.exr"), last = render::read_exr(folder / "f-0002.exr");
    EXPECT_EQ(first.width, 40);
    EXPECT_TRUE(folder.has("f-0001.png"));
    EXPECT_NE(first.pixels, last.pixels);
    // One frame alone is the same.
    ASSERT_EQ(run("render b.relight --scene block.obj --env sky.exr --rotate 60 -o one.exr --quiet" + view).status, 0);
    EXPECT_EQ(render::read_exr(folder / "one.exr").pixels, last.pixels);
}

TEST_F(RelightProgram, ReportsItsErrorAgainstAReference) {
    ASSERT_EQ(run("prepare block.obj -o b.relight --directions 256 --edge 0.5").status, 0);
    const std::string what = "render b.relight --scene block.obj --env sky.exr" + view;
    ASSERT_EQ(run(what + "--exhaustive pixels -o r.exr --quiet").status, 0);
    const auto result = run(what + "--reference r.exr -o f.exr");
    ASSERT_EQ(result.status, 0) << result.err;
    const auto report = nlohmann::json::parse(folder.read("f.json"));
    EXPECT_GT(report.at("relative_rmse"), 0.0);
    EXPECT_LT(report.at("relative_rmse"), 0.15);
}

TEST_F(RelightProgram, BounceIsAddedIfItWasPrepared) {
    const std::string prepare = "prepare block.obj --directions 256 --edge 1 --quiet ";
    ASSERT_EQ(run(prepare + "-o without.relight").status, 0);
    ASSERT_EQ(run(prepare + "-o off.relight --bounce off").status, 0);
    EXPECT_EQ(folder.read("without.relight"), folder.read("off.relight"));
    const auto prepared = run("prepare block.obj --directions 256 --edge 1 -o with.relight --bounce 300");
    ASSERT_EQ(prepared.status, 0) << prepared.err;
    EXPECT_NE(prepared.err.find("bounce: 600 patches"), std::string::npos) << prepared.err;
    const auto picture = [&](const std::string& arguments) {
        const auto result = run("render " + arguments + " --scene block.obj --env sky.exr -o p.exr --quiet" + view);
        EXPECT_EQ(result.status, 0) << result.err;
        return render::read_exr(folder / "p.exr").pixels;
    };
    const auto direct = picture("without.relight"), all = picture("with.relight");
    EXPECT_EQ(picture("with.relight --bounce off"), direct);
    float more = 0.0f;
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_GE(all[i].x, direct[i].x);
        more = std::max(more, all[i].x - direct[i].x);
    }
    EXPECT_GT(more, 0.01f);
    EXPECT_EQ(nlohmann::json::parse(folder.read("p.json")).at("patches"), 0);
}

TEST_F(RelightProgram, RefusesBadInput) {
    ASSERT_EQ(run("prepare block.obj -o b.relight --directions 64 --quiet").status, 0);
    const std::string render = "render b.relight --scene block.obj --env sky.exr" + view;
    const std::size_t files = file_count();
    refuse("render b.relight --scene box.obj --env sky.exr" + view, 1, "another mesh");
    refuse("render m.mtl --scene block.obj --env sky.exr" + view, 1, "no file of visibility cuts");
    refuse("render none.relight --scene block.obj --env sky.exr" + view, 1, "none.relight");
    refuse("render b.relight --scene block.obj --env none.exr" + view, 1, "none.exr");
    refuse("prepare none.obj -o n.relight", 1, "none.obj");
    refuse("prepare block.obj -o block.obj", 1, "block.obj");
    refuse("prepare block.obj -o b.relight --edge 0.000001", 1, "longer ones");
    EXPECT_EQ(file_count(), files);

    std::string content = folder.read("b.relight");
    folder.write("short.relight", content.substr(0, content.size() / 2));
    refuse("render short.relight --scene block.obj --env sky.exr" + view, 1, "cut short");
    char& changed = content[content.find('\n') + 300];
    changed = static_cast<char>(changed ^ 1);
    folder.write("damaged.relight", content);
    refuse("render damaged.relight --scene block.obj --env sky.exr --eye 1,5,7 --target 0,0.5,0", 1, "damaged.relight");
    render::Picture map = small_map();
    map.pixels[5].x = std::numeric_limits<float>::quiet_NaN();
    render::write_exr(folder / "nan.exr", map);
    refuse("render b.relight --scene block.obj --env nan.exr" + view, 1, "not finite");
}

TEST_F(RelightProgram, RefusesBadCommandLines) {
    refuse("", 2, "prepare, render or view");
    refuse("prepare block.obj", 2, "--output");
    refuse("prepare block.obj -o b.relight --directions many", 2, "--directions many");
    refuse("prepare block.obj -o b.relight --sides back", 2, "front or both");
    refuse("prepare block.obj -o b.relight --deviation -1", 2, "--deviation");
    refuse("prepare block.obj -o b.relight --bounce some", 2, "--bounce some");
    refuse("prepare block.obj -o b.relight --bounce-deviation x", 2, "--bounce-deviation");
    refuse("render b.relight --scene block.obj --env sky.exr --bounce 5", 2, "on or off");
    refuse("render b.relight --scene block.obj --env sky.exr --size 0x3", 2, "--size");
    refuse("render b.relight --scene block.obj --env sky.exr --eye 1,2,3", 2, "--target");
    refuse("render b.relight --scene block.obj", 2, "--env");
    refuse("render b.relight --scene block.obj --env sky.exr --exhaustive all", 2, "--exhaustive all");
    refuse("render b.relight --scene block.obj --env sky.exr --gloss-width 0", 2, "--gloss-width");
    refuse("view b.relight --scene block.obj", 2, "--env");
    refuse("view b.relight --scene block.obj --env sky.exr --seconds -1", 2, "--seconds");
    refuse("view b.relight --scene block.obj --env sky.exr --frames 2", 2, "--frames");
    EXPECT_EQ(run("--help").status, 0);
    EXPECT_NE(run("view --help").out.find("Esc"), std::string::npos);
    EXPECT_NE(run("prepare --help").out.find("--deviation"), std::string::npos);
    EXPECT_NE(run("--version").out.find("lightcuts-relight "), std::string::npos);
}

TEST_F(RelightProgram, InterruptedPreparationLeavesTheOldFile) {
    folder.write("b.relight", "old");
    const std::size_t files = file_count();
    Process process(LIGHTCUTS_RELIGHT_EXECUTABLE,
                    words("prepare block.obj -o b.relight --directions 32768 --edge 0.02"), folder.path(),
                    streams.path());
    ASSERT_TRUE(process.wait_for_handler(SIGINT));
    ASSERT_TRUE(process.wait_for_work(0.3));
    process.send(SIGINT);
    EXPECT_EQ(process.wait().status, 3);
    EXPECT_EQ(folder.read("b.relight"), "old");
    EXPECT_EQ(file_count(), files);
}

}  // namespace
