#include <filesystem>
#include <string>

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <render/io/picture.hpp>

#include "programs.hpp"

/// What becomes of the files that the renderer writes, whatever happens to them.
class Output : public Programs {
protected:
    const std::string small = "room.obj --size 16x12 --quiet" + view;

    /// To be inherited: no file may have more than `bytes`.
    static std::function<void()> small_files(rlim_t bytes) {
        return [bytes] {
            const rlimit limit{bytes, bytes};
            ::setrlimit(RLIMIT_FSIZE, &limit);
        };
    }

    const std::string loud = "room.obj --method exhaustive --area-points 300 --size 300x200" + view;
    const std::string large = loud + "--quiet ";

    /// Starts a rendering of seconds and returns when the first tiles are finished.
    std::unique_ptr<Process> start_large() {
        auto process = start(large);
        EXPECT_TRUE(process->wait_until([&] { return size_of("render.resume") > 20000; }));
        return process;
    }
};

TEST_F(Output, AFullDiskKeepsTheOldPicture) {
    folder.write("render.exr", "old");
    folder.write("render.json", "{}");
    const auto before = files();
    const auto result = render("builtin:omni?lights=200 --size 64x49 --threads 1", small_files(23 * 1024));
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("render.exr: cannot be written"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find(".tmp"), std::string::npos) << result.err;
    EXPECT_EQ(folder.read("render.exr"), "old");
    EXPECT_EQ(folder.read("render.json"), "{}");
    EXPECT_FALSE(folder.has("render.png"));
    // But for the finished tiles, with which it can be tried again.
    auto after = files();
    after.erase("render.resume");
    EXPECT_EQ(after, before);
}

TEST_F(Output, KeepsWhatIsWholeWhenTheRestCannotBeWritten) {
    const auto process = start_large();
    std::filesystem::create_directory(folder / "render.png");
    const auto result = process->wait();
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("render.png: cannot be written"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("written: render.exr, render.json"), std::string::npos) << result.err;
    EXPECT_EQ(render::read_exr(folder / "render.exr").width, 300);
    EXPECT_EQ(report("render.json").at("interrupted"), false);
}

TEST_F(Output, WithoutThePictureNothingIsWrittenAndNothingIsLost) {
    const auto process = start_large();
    std::filesystem::create_directory(folder / "render.exr");
    const auto result = process->wait();
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("--resume"), std::string::npos) << result.err;
    EXPECT_FALSE(folder.has("render.png"));
    EXPECT_FALSE(folder.has("render.json"));
    std::filesystem::remove(folder / "render.exr");
    ASSERT_EQ(render(large + "--resume").status, 0);
    EXPECT_EQ(report("render.json").at("resumed_tiles"), 19 * 13);
}

TEST_F(Output, ADanglingLinkStaysALink) {
    std::filesystem::create_directory(folder.path() / "elsewhere");
    std::filesystem::create_symlink("elsewhere/picture", folder / "render.exr");
    const auto result = render(small);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "render.exr"));
    EXPECT_EQ(render::read_exr(folder / "elsewhere/picture").width, 16);
    EXPECT_TRUE(folder.has("render.png"));

    std::filesystem::create_symlink("loop.exr", folder / "loop.exr");
    const auto loop = render(small + "-o loop.exr");
    EXPECT_EQ(loop.status, 1);
    EXPECT_TRUE(is_one_line(loop.err)) << loop.err;
}

TEST_F(Output, TakesNamesOfAllLengths) {
    for (const std::size_t length : {244u, 250u, 251u, 254u, 255u}) {
        const std::string name = std::string(length - 4, 'n') + ".exr";
        const auto result = render(small + "-o " + name);
        ASSERT_EQ(result.status, 0) << length << result.err;
        EXPECT_EQ(render::read_exr(folder / name).width, 16);
        std::string json;
        for (const std::string& file : files()) {
            if (file.ends_with(".json")) json = file;
        }
        EXPECT_EQ(report(json).at("picture"), name);
        for (const std::string& file : files()) {
            if (file.starts_with("nnn")) std::filesystem::remove(folder / file);
        }
    }
}

TEST_F(Output, NamesNeedNotBeText) {
    const std::string name = "caf\xe9\x1b[31m";
    std::filesystem::copy(folder / "room.obj", folder / (name + ".obj"));
    const auto result = render(name + ".obj --size 16x12 -o " + name + ".exr" + view);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.err.find("caf\\xE9\\x1B[31m.exr"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
    EXPECT_TRUE(folder.has(name + ".exr"));
    EXPECT_TRUE(folder.has(name + ".png"));
    const auto json = report(name + ".json");
    EXPECT_EQ(json.at("scene"), "caf\\xE9\x1b[31m.obj");
    EXPECT_EQ(json.at("picture"), "caf\\xE9\x1b[31m.exr");
}

TEST_F(Output, ErrorsStayOneLineWhateverNamesHold) {
    const std::string name = "two\nlines\x1b[2J\xe9";
    const std::string escaped = "two\\nlines\\x1B[2J\\xE9";
    const std::vector<std::vector<std::string>> commands = {
        {name + ".obj"}, {name}, {"room.obj", "--lights", name}, {"room.obj", "-o", name + "/a.exr"}, {"--" + name}};
    for (const auto& command : commands) {
        const auto result = Process(LIGHTCUTS_RENDER_EXECUTABLE, command, folder.path(), streams.path()).wait();
        EXPECT_GT(result.status, 0) << command.back();
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_EQ(result.err.find('\x1b'), std::string::npos) << result.err;
        if (command.back().find("--") == 0) continue;
        EXPECT_NE(result.err.find(escaped), std::string::npos) << result.err;
    }
}

TEST_F(Output, AFullOrClosedStandardOutputFails) {
    write_exr(folder / "a.exr", render::Picture(4, 4));
    const auto full = [] { ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); };
    const auto closed = [] { ::close(STDOUT_FILENO); };
    for (const std::string arguments : {"--help", "--version", "--list-scenes"}) {
        for (const std::function<void()>& prepare : {std::function<void()>(full), std::function<void()>(closed)}) {
            const auto result = render(arguments, prepare);
            EXPECT_EQ(result.status, 1) << arguments;
            EXPECT_TRUE(is_one_line(result.err)) << arguments << result.err;
        }
    }
    for (const std::string arguments : {"--help", "a.exr a.exr"}) {
        const auto result = Process(LIGHTCUTS_COMPARE_EXECUTABLE, words(arguments), folder.path(), streams.path(), full)
                                .wait();
        EXPECT_EQ(result.status, 1) << arguments;
        EXPECT_TRUE(is_one_line(result.err)) << arguments << result.err;
    }
}

TEST_F(Output, AClosedStreamIsNoOtherFile) {
    // The next file that is opened would get the number of stderr, and what is said there.
    const auto process = start(loud, [] { ::close(STDERR_FILENO); });
    ASSERT_TRUE(process->wait_until([&] { return size_of("render.resume") > 20000; }));
    process->send(SIGTERM);
    ASSERT_EQ(process->wait().status, 3);
    const auto result = render(loud + "--resume");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_GT(report("render.json").at("resumed_tiles"), 0);
}

TEST_F(Output, MayBeHeardByNobody) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ::close(ends[0]);
    const auto result = render("room.obj --size 16x12" + view, [&] { ::dup2(ends[1], STDERR_FILENO); });
    ::close(ends[1]);
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(folder.has("render.exr"));
}
