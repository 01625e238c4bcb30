#include <chrono>
#include <filesystem>
#include <string>

#include <signal.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <render/io/picture.hpp>

#include "programs.hpp"

/// What signals do to the renderer in each of its phases.
class Signals : public Programs {
protected:
    static constexpr int all[] = {SIGINT, SIGTERM, SIGHUP};
    /// Minutes of work in many tiles, all of which see lit surfaces.
    const std::string long_run =
        "room.obj --method exhaustive --area-points 2000 --size 1000x800 --threads 1 --eye 0,2.5,0.5 --target 0,0,0 ";

    std::unique_ptr<Process> start_rendering(const std::string& arguments, const std::function<void()>& prepare = {}) {
        std::filesystem::remove(folder / "render.resume");
        auto process = start(arguments, prepare);
        EXPECT_TRUE(process->wait_until([&] { return size_of("render.resume") > 30000; }));
        return process;
    }

    std::size_t lit_pixels(const std::string& name) const {
        std::size_t lit = 0;
        for (const glm::vec3& pixel : render::read_exr(folder / name).pixels) lit += pixel == glm::vec3(0.0f) ? 0 : 1;
        return lit;
    }

    bool has_temporary() const {
        for (const std::string& name : files()) {
            if (name.starts_with(".lightcuts-")) return true;
        }
        return false;
    }
};

TEST_F(Signals, AllSaveWhatIsFinished) {
    for (const int signal : all) {
        const auto process = start_rendering(long_run);
        process->send(signal);
        const auto result = process->wait();
        EXPECT_EQ(result.status, 3) << signal << result.err;
        EXPECT_EQ(report("render.json").at("interrupted"), true) << signal;
        EXPECT_GT(lit_pixels("render.exr"), 0u) << signal;
        EXPECT_FALSE(has_temporary());
    }
}

TEST_F(Signals, EndTheProgramAtOnceBeforeItRenders) {
    folder.write("render.exr", "old");
    const auto before = files();
    for (const int signal : all) {
        // Tree building takes many seconds.
        const auto process = start("builtin:omni?lights=3000000 --builder agglomerate --representatives 32 --size 8x8");
        ASSERT_TRUE(process->wait_for_handler(signal));
        process->send(signal);
        const auto result = process->wait();
        EXPECT_EQ(result.status, 3) << signal;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("before there was anything to save"), std::string::npos) << result.err;
        EXPECT_EQ(files(), before);
    }
    EXPECT_EQ(folder.read("render.exr"), "old");
}

TEST_F(Signals, WriteNothingWhenNothingIsFinished) {
    folder.write("render.exr", "old");
    const auto before = files();
    // One tile of an hour, of which the points that are shaded at once take half a minute.
    for (const std::string method : {"exhaustive --area-points 200000", "power --samples 200000 --area-points 200000",
                                     "lightcuts --error-ratio 0 --max-cut 0 --area-points 60000"}) {
        const auto process = start("room.obj --size 16x16 --spp 60000 --threads 1 --method " + method + view);
        ASSERT_TRUE(process->wait_until([&] { return folder.has("render.resume"); }));
        ASSERT_TRUE(process->wait_for_work(0.1));
        const auto sent = std::chrono::steady_clock::now();
        process->send(SIGTERM);
        const auto result = process->wait();
        EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(10)) << method;
        EXPECT_EQ(result.status, 3) << method;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_EQ(files(), before) << method;
    }
    EXPECT_EQ(folder.read("render.exr"), "old");
}

TEST_F(Signals, StayIgnoredIfTheParentIgnoresThem) {
    const auto process = start_rendering(long_run, [] {
        ::signal(SIGINT, SIG_IGN);
        ::signal(SIGHUP, SIG_IGN);
    });
    process->send(SIGINT);
    process->send(SIGHUP);
    const auto then = size_of("render.resume");
    EXPECT_TRUE(process->wait_until([&] { return size_of("render.resume") > then + 30000; }));
    process->send(SIGTERM);
    EXPECT_EQ(process->wait().status, 3);
}

TEST_F(Signals, ASecondOneLeavesNothingHalfWritten) {
    // A large picture takes a while to be encoded.
    const auto process = start_rendering(
        "room.obj --method exhaustive --area-points 2000 --size 5000x4000 --threads 1" + view);
    process->send(SIGINT);
    ASSERT_TRUE(process->wait_until([&] { return has_temporary(); }));
    process->send(SIGTERM);
    const auto result = process->wait();
    EXPECT_EQ(result.status, 3);
    EXPECT_NE(result.err.find("again"), std::string::npos) << result.err;
    EXPECT_FALSE(has_temporary());
    EXPECT_FALSE(folder.has("render.exr"));
    EXPECT_TRUE(folder.has("render.resume"));
}

TEST_F(Signals, APartNeverReplacesAFinishedPicture) {
    ASSERT_EQ(render("room.obj --size 16x12 --quiet" + view).status, 0);
    const std::string exr = folder.read("render.exr"), json = folder.read("render.json");
    auto process = start_rendering(long_run + "--quiet");
    process->send(SIGTERM);
    auto result = process->wait();
    EXPECT_EQ(result.status, 3);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("render.partial.exr"), std::string::npos) << result.err;
    EXPECT_TRUE(folder.read("render.exr") == exr);
    EXPECT_EQ(folder.read("render.json"), json);
    EXPECT_EQ(report("render.partial.json").at("picture"), "render.partial.exr");
    EXPECT_EQ(report("render.partial.json").at("interrupted"), true);
    EXPECT_TRUE(folder.has("render.partial.png"));
    EXPECT_GT(lit_pixels("render.partial.exr"), 0u);

    // One that says itself that it is a part is replaced by another part.
    for (const char* name : {"render.exr", "render.png", "render.json"}) std::filesystem::remove(folder / name);
    folder.write("render.exr", "a part");
    folder.write("render.json", "{\"interrupted\": true}");
    process = start_rendering(long_run);
    process->send(SIGTERM);
    EXPECT_EQ(process->wait().status, 3);
    EXPECT_EQ(report("render.json").at("size"), nlohmann::json({1000, 800}));
    EXPECT_GT(lit_pixels("render.exr"), 0u);
}
