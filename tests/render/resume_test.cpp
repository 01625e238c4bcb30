#include <filesystem>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "programs.hpp"

/// Going on with a picture whose rendering ended early.
class Resume : public Programs {
protected:
    using Json = nlohmann::json;

    /// A second or so in 247 tiles.
    const std::string large = "room.obj --method exhaustive --area-points 300 --size 300x200 --quiet" + view;

    /// Renders until `bytes` of finished tiles are kept, and then ends that by `signal`.
    void begin(const std::string& arguments, int signal, std::uintmax_t bytes = 20000) {
        const auto process = start(arguments);
        ASSERT_TRUE(process->wait_until([&] { return size_of("render.resume") > bytes; }));
        process->send(signal);
        const int status = process->wait().status;
        ASSERT_EQ(status, signal == SIGKILL ? 128 + SIGKILL : 3);
        ASSERT_TRUE(folder.has("render.resume"));
    }

    bool same(const std::string& a, const std::string& b) const { return folder.read(a) == folder.read(b); }

    /// What does not depend on where, how fast and in how many runs it was rendered.
    Json lasting(const std::string& name) const {
        Json json = report(name);
        for (const char* key : {"threads", "seconds", "peak_memory_bytes", "picture", "resumed_tiles"}) json.erase(key);
        json.at("options").erase("output");
        return json;
    }

    void expect_refusal(const std::string& arguments, const std::string& says) {
        const std::string before = folder.read("render.resume");
        const auto result = render(arguments + " --resume");
        EXPECT_EQ(result.status, 1) << arguments;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("render.resume"), std::string::npos) << result.err;
        EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
        EXPECT_TRUE(folder.read("render.resume") == before) << arguments;
    }
};

TEST_F(Resume, GivesThePictureOfAnUninterruptedRun) {
    const std::string runs[] = {
        "room.obj --size 160x120 --spp 3 --area-points 500 --indirect 1000 --aov "
        "cut_size,shadow_rays,error_bound,depth,normal --quiet" +
            view,
        "room.obj --learn-visibility --size 160x120 --spp 3 --area-points 500 --indirect 1000 --aov "
        "error_bound,expected_error --quiet" +
            view,
        "room.obj --method tree-sampling --adaptation auto --size 161x123 --spp 4 --samples 32 --seed 7 --quiet" +
            view};
    for (const std::string& run : runs) {
        ASSERT_EQ(render(run + "-o whole.exr --threads 2").status, 0);
        begin(run + "--threads 2", SIGKILL);
        begin(run + "--threads 1 --resume", SIGTERM, size_of("render.resume") + 20000);
        EXPECT_FALSE(same("render.exr", "whole.exr"));
        ASSERT_EQ(render(run + "--threads 2 --resume").status, 0);
        EXPECT_GT(report("render.json").at("resumed_tiles"), 0);
        EXPECT_LT(report("render.json").at("resumed_tiles"), 80);
        EXPECT_TRUE(same("render.exr", "whole.exr"));
        EXPECT_TRUE(same("render.png", "whole.png"));
        EXPECT_EQ(lasting("render.json"), lasting("whole.json"));
        EXPECT_FALSE(folder.has("render.resume"));
    }
}

TEST_F(Resume, WithoutAFileStartsFromTheBeginningAndSaysSo) {
    const std::string small = "room.obj --size 16x12 --resume" + view;
    const auto result = render(small);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.err.find("render.resume: there are no finished tiles"), std::string::npos) << result.err;
    EXPECT_EQ(report("render.json").at("resumed_tiles"), 0);
    EXPECT_FALSE(folder.has("render.resume"));
    EXPECT_EQ(render(small + "--quiet").err, "");
}

TEST_F(Resume, StartingOverSaysThatItWasPossible) {
    begin(large, SIGKILL);
    const auto result = render("room.obj --size 16x12" + view);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err.find("lightcuts-render: render.resume: starting over; --resume would"), 0u) << result.err;
    EXPECT_EQ(report("render.json").at("size"), Json({16, 12}));
    EXPECT_FALSE(folder.has("render.resume"));
}

TEST_F(Resume, RefusesAnotherPictureAndSaysWhatDiffers) {
    begin(large, SIGKILL);
    expect_refusal(large + "--spp 2", "--spp (1, now 2)");
    std::string fewer = large;
    expect_refusal(fewer.replace(fewer.find("300 "), 4, "10 "), "the lights");
    expect_refusal(large + "--aov depth", "--aov (none, now depth)");
    expect_refusal(large + "--up 1,1,0", "the camera");
    expect_refusal(large + "--isa sse2", "the ray tracer (");
    const std::string scene = folder.read("room.obj"), materials = folder.read("room.mtl");
    folder.write("room.mtl", "newmtl gray\nKd 0.5 0.4 0.31\nnewmtl lamp\nKd 0 0 0\nKe 20 20 10\n");
    expect_refusal(large, "by the scene's materials;");
    folder.write("room.mtl", materials);
    folder.write("room.obj", scene + "v 9 9 9\nv 9 9 8\nv 9 8 9\nusemtl gray\nf 13 14 15\n");
    expect_refusal(large, "by the scene's triangles;");
    folder.write("room.obj", scene);
    // These change no picture, nor does what a file is called.
    std::filesystem::copy(folder / "room.obj", folder / "same.obj");
    std::string renamed = large + "--threads 2 --resume";
    EXPECT_EQ(render(renamed.replace(0, 4, "same")).status, 0);
    EXPECT_GT(report("render.json").at("resumed_tiles"), 0);
}

TEST_F(Resume, RefusesWhatAnotherBuildHasBegun) {
    begin(large, SIGKILL);
    const std::string before = folder.read("render.resume");
    // The same program to the system, but not the same file.
    std::filesystem::copy_file(LIGHTCUTS_RENDER_EXECUTABLE, folder / "other");
    const auto other = [&] { return run(folder / "other", large + "--resume"); };
    std::ofstream(folder / "other", std::ios::app | std::ios::binary) << "another build";
    const auto result = other();
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("lightcuts-render ("), std::string::npos) << result.err;
    EXPECT_TRUE(folder.read("render.resume") == before);
    // Where the file is does not matter.
    std::filesystem::copy_file(LIGHTCUTS_RENDER_EXECUTABLE, folder / "other",
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_EQ(other().status, 0);
    EXPECT_GT(report("render.json").at("resumed_tiles"), 0);
}

TEST_F(Resume, DropsACutTileAndRefusesADamagedOne) {
    begin(large, SIGKILL);
    const std::string whole = folder.read("render.resume");
    std::string damaged = whole;
    damaged[damaged.size() - 10000] ^= 1;
    folder.write("render.resume", damaged);
    expect_refusal(large, "is damaged at byte");
    folder.write("render.resume", whole.substr(0, whole.size() - 100));
    ASSERT_EQ(render(large + "--resume").status, 0);
    EXPECT_GT(report("render.json").at("resumed_tiles"), 0);
    const std::string resumed = folder.read("render.exr");
    ASSERT_EQ(render(large).status, 0);
    EXPECT_TRUE(folder.read("render.exr") == resumed);
}

TEST_F(Resume, NeverTouchesTheFileOfAnother) {
    folder.write("render.resume", "Jane Doe, born 1970");
    const std::string small = "room.obj --size 16x12" + view;
    expect_refusal(small, "is not a file of finished tiles");
    const auto result = render(small + "--quiet");
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("warning: render.resume"), std::string::npos) << result.err;
    EXPECT_EQ(folder.read("render.resume"), "Jane Doe, born 1970");
    EXPECT_TRUE(folder.has("render.exr"));
}

TEST_F(Resume, NeverTouchesTheFileOfARunThatGoesOn) {
    const TemporaryFolder others;
    const auto process = start(large);
    ASSERT_TRUE(process->wait_until([&] { return size_of("render.resume") > 20000; }));
    process->send(SIGSTOP);
    const auto second = Process(LIGHTCUTS_RENDER_EXECUTABLE, words(large + "--resume"), folder.path(), others.path())
                            .wait();
    EXPECT_EQ(second.status, 1);
    EXPECT_NE(second.err.find("render.resume: is in use by another run"), std::string::npos) << second.err;
    EXPECT_GT(size_of("render.resume"), 20000u);
    process->send(SIGCONT);
    EXPECT_EQ(process->wait().status, 0);
    EXPECT_EQ(report("render.json").at("size"), Json({300, 200}));
}

TEST_F(Resume, AFullDiskOnlyWarns) {
    // Black compresses well; finished tiles are not compressed.
    const auto result = render("floor.obj --lights dark.csv --size 64x64 --quiet" + view, [] {
        const rlimit limit{20000, 20000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    });
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("warning: render.resume: cannot be written"), std::string::npos) << result.err;
    EXPECT_TRUE(folder.has("render.exr"));
    EXPECT_FALSE(folder.has("render.resume"));
}
