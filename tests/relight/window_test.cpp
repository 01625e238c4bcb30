#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <signal.h>
#include <stdlib.h>

#include <gtest/gtest.h>
#include <render/error.hpp>
#include <render/io/picture.hpp>
#include <render/surfaces/texture.hpp>

#include "small_world.hpp"
#include "virtual_display.hpp"

namespace {

/// lightcuts-relight with a window on a display of its own.
class RelightWindow : public ::testing::Test {
protected:
    TemporaryFolder folder;
    TemporaryFolder streams;
    std::unique_ptr<VirtualDisplay> display = std::make_unique<VirtualDisplay>();
    std::unique_ptr<Process> window;

    const std::string place = " --eye 1,5,7 --target 0,0.5,0";
    const std::string camera = place + " --size 160x120";
    const std::string scene = " b.relight --scene block.obj --env sky.exr --quiet";

    void SetUp() override {
        folder.write("m.mtl", two_materials);
        folder.write("block.obj", block_over_floor);
        render::write_exr(folder / "sky.exr", small_map(256));
        ASSERT_EQ(run("prepare block.obj -o b.relight --directions 2048 --edge 0.5 --deviation 1 --quiet").status, 0);
    }
    /// A process that is left is killed before its display goes away.
    void TearDown() override { window.reset(); }

    static std::vector<std::string> words(const std::string& text) {
        std::istringstream stream(text);
        return {std::istream_iterator<std::string>(stream), {}};
    }
    Process::Result run(const std::string& arguments, const std::function<void()>& prepare = {}) const {
        const TemporaryFolder own;
        return Process(LIGHTCUTS_RELIGHT_EXECUTABLE, words(arguments), folder.path(), own.path(), prepare).wait();
    }

    void start(const std::string& arguments) {
        std::filesystem::remove(streams / "stdout");  // of a window before
        window = std::make_unique<Process>(LIGHTCUTS_RELIGHT_EXECUTABLE, words("view" + scene + arguments),
                                           folder.path(), streams.path(), display->in_process());
    }
    /// A window whose picture is finished.
    void open(const std::string& output = "f.exr", const std::string& size = "160x120") {
        start(place + " --size " + size + " -o " + output + " --print-options");
        ASSERT_FALSE(printed_line("--eye").empty()) << streams.read("stderr");
    }
    Process::Result close() {
        const Process::Result result = window->wait();
        window.reset();
        return result;
    }

    /// The last whole line that the window has printed.
    std::string last_line() const {
        const std::string text = streams.read("stdout");
        const std::size_t end = text.rfind('\n');
        if (end == std::string::npos) return "";
        const std::size_t begin = text.rfind('\n', end - 1);
        return text.substr(begin == std::string::npos ? 0 : begin + 1,
                           end - (begin == std::string::npos ? 0 : begin + 1));
    }
    /// Waits until the last line holds `part`, or, if that is said, anything else; empty if that does not come.
    std::string printed_line(const std::string& part, bool is_there = true) const {
        const bool came = window->wait_until([&] {
            const std::string line = last_line();
            return !line.empty() && (line.find(part) != std::string::npos) == is_there;
        });
        return came ? last_line() : "";
    }
    /// The value of an option in a line.
    static std::string value(const std::string& line, const std::string& option) {
        const auto all = words(line);
        const auto at = std::find(all.begin(), all.end(), option);
        return at == all.end() ? "" : *std::next(at);
    }

    std::string own_window() const { return words(display->act({"search", "--name", "lightcuts-relight"})).at(0); }
    void press(const std::string& key) const { display->act({"key", key}); }
    /// One right after the other.
    void press(const std::string& key, const std::string& next) const {
        display->act({"key", "--delay", "0", key, next});
    }
    /// A window whose picture is not finished for some seconds.
    void open_slow(const std::string& more = "") {
        start(place + " --size 640x480 --spp 8 --illumination-size 100000 --gloss-detail 0.01" + more);
        display->act({"search", "--sync", "--onlyvisible", "--name", "lightcuts-relight", "windowfocus", "--sync"});
    }
    /// Over the picture, from its middle.
    void drag(const std::string& button, int right, int down) const {
        display->act({"mousemove", "--window", own_window(), "80", "60", "mousedown", button, "mousemove_relative",
                      "--", std::to_string(right), std::to_string(down), "mouseup", button});
    }
    bool wait_for_file(const std::string& name) const {
        return window->wait_until([&] { return folder.has(name); });
    }
};

TEST_F(RelightWindow, SavesWhatRenderMakes) {
    open();
    const std::string line = last_line();
    press("s");
    // The names are given one after the other.
    ASSERT_TRUE(wait_for_file("f-0000.png")) << streams.read("stderr");
    press("Escape");
    const auto result = close();
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    ASSERT_EQ(run("render" + scene + " -o r.exr " + line).status, 0) << line;
    EXPECT_EQ(render::read_exr(folder / "f-0000.exr").pixels, render::read_exr(folder / "r.exr").pixels);
    EXPECT_EQ(folder.read("f-0000.png"), folder.read("r.png"));
    // The start is what the command line says.
    ASSERT_EQ(run("render" + scene + camera + " -o s.exr").status, 0);
    EXPECT_EQ(folder.read("s.exr"), folder.read("r.exr"));
}

TEST_F(RelightWindow, KeysAndMouseChangeThePicture) {
    open();
    const std::string start = last_line();
    EXPECT_EQ(value(start, "--rotate"), "0");
    press("Right");
    press("Right");
    const std::string turned = printed_line("--rotate 10 ");
    ASSERT_FALSE(turned.empty()) << last_line();
    EXPECT_EQ(value(turned, "--eye"), value(start, "--eye"));

    drag("1", 30, 10);
    const std::string orbited = printed_line("--eye " + value(start, "--eye") + " ", false);
    ASSERT_FALSE(orbited.empty());
    EXPECT_EQ(value(orbited, "--rotate"), "10");
    const auto eye = [&](const std::string& line) {
        std::istringstream stream(value(line, "--eye"));
        glm::dvec3 v(0.0);
        char comma = 0;
        stream >> v.x >> comma >> v.y >> comma >> v.z;
        return v - glm::dvec3(0.0, 0.5, 0.0);
    };
    EXPECT_NEAR(glm::length(eye(orbited)), glm::length(eye(start)), 1e-9);
    // Downwards by a twelfth of the picture: the eye rises by 15 degrees.
    const auto height = [&](const std::string& line) { return std::asin(eye(line).y / glm::length(eye(line))); };
    EXPECT_NEAR((height(orbited) - height(start)) * 180.0 / std::numbers::pi, 15.0, 1e-6);

    drag("3", -20, 0);
    ASSERT_FALSE(printed_line("--rotate -20 ").empty()) << last_line();
    press("d");
    ASSERT_FALSE(printed_line("--materials diffuse").empty()) << last_line();
    press("d");
    const std::string last = printed_line("--materials full");
    ASSERT_FALSE(last.empty());

    press("s");
    ASSERT_TRUE(wait_for_file("f-0000.png")) << streams.read("stderr");
    press("Escape");
    EXPECT_EQ(close().status, 0);
    ASSERT_EQ(run("render" + scene + " -o r.exr " + last).status, 0) << last;
    const render::Picture seen = render::read_exr(folder / "f-0000.exr");
    EXPECT_EQ(seen.pixels, render::read_exr(folder / "r.exr").pixels);
    // It is what the sum over all directions makes of it.
    ASSERT_EQ(run("render" + scene + " --exhaustive vertices -o e.exr " + last).status, 0);
    EXPECT_LE(render::compare(seen, render::read_exr(folder / "e.exr")).relative_rmse, 0.04);
}

TEST_F(RelightWindow, PictureTakesTheSizeThatTheWindowGets) {
    open();
    // The panel takes 280 pixels.
    display->act({"windowsize", own_window(), "480", "90"});
    EXPECT_FALSE(printed_line("--size 200x90").empty()) << last_line();
    press("s");
    ASSERT_TRUE(wait_for_file("f-0000.png")) << streams.read("stderr");
    press("Escape");
    EXPECT_EQ(close().status, 0);
    const render::Picture picture = render::read_exr(folder / "f-0000.exr");
    EXPECT_EQ(picture.width, 200);
    EXPECT_EQ(picture.height, 90);
}

TEST_F(RelightWindow, ShowsThePixelsOfTheFile) {
    const auto result = run("view" + scene + camera + " --screenshot w.png", display->in_process());
    ASSERT_EQ(result.status, 0) << result.err;
    ASSERT_EQ(run("render" + scene + camera + " -o r.exr").status, 0);
    const auto read = [&](const std::string& name) { return render::texture_of_bytes(folder.read(name), name, false); };
    const render::Texture whole = read("w.png"), picture = read("r.png");
    ASSERT_EQ(picture.width, 160);
    ASSERT_GT(whole.width, picture.width);
    ASSERT_EQ(whole.height, picture.height);
    double largest = 0.0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const auto at = [&](const render::Texture& t) {
                return t.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(t.width) +
                                static_cast<std::size_t>(x)];
            };
            for (int c = 0; c < 3; ++c) {
                largest = std::max(largest, std::abs(static_cast<double>(at(whole)[c] - at(picture)[c])));
            }
        }
    }
    EXPECT_LT(largest, 1.5 / 255.0);
}

TEST_F(RelightWindow, ClosesAfterTheSecondsItIsGiven) {
    const auto result = run("view" + scene + camera + " --seconds 0.2", display->in_process());
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const auto early = run("view" + scene + " --size 2000x2000 --spp 64 --seconds 0.05 --screenshot w.png" +
                               " --eye 1,5,7 --target 0,0.5,0",
                           display->in_process());
    EXPECT_EQ(early.status, 1);
    EXPECT_NE(early.err.find("no screenshot"), std::string::npos) << early.err;
    EXPECT_FALSE(folder.has("w.png"));
}

TEST_F(RelightWindow, SignalClosesIt) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const auto files = std::distance(std::filesystem::directory_iterator(folder.path()), {});
        open();
        window->send(signal);
        const auto result = close();
        EXPECT_EQ(result.status, 3);
        EXPECT_EQ(result.err, "lightcuts-relight: interrupted; the window is closed\n");
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), files);
    }
}

TEST_F(RelightWindow, SignalBeforeTheScreenshotIsASignal) {
    open_slow(" --screenshot w.png");
    ASSERT_TRUE(window->wait_for_work(0.5));
    window->send(SIGINT);
    const auto result = close();
    EXPECT_EQ(result.status, 3);
    EXPECT_EQ(result.err, "lightcuts-relight: interrupted; the window is closed\n");
    EXPECT_FALSE(folder.has("w.png"));
}

TEST_F(RelightWindow, SavesTheExposureThatWasAskedFor) {
    open("f.exr", "800x600");
    press("Up", "s");
    ASSERT_TRUE(wait_for_file("f-0000.png")) << streams.read("stderr");
    press("Escape");
    EXPECT_EQ(close().status, 0);
    const render::Picture picture = render::read_exr(folder / "f-0000.exr");
    render::ToneCurve curve = render::tone_curve(picture);
    curve.exposure *= std::exp2(1.0 / 3.0);
    render::write_png(folder / "expected.png", picture.width, picture.height, render::tone_mapped(picture, curve));
    EXPECT_EQ(folder.read("f-0000.png"), folder.read("expected.png"));
}

TEST_F(RelightWindow, SavesBeforeItCloses) {
    open();
    press("s", "Escape");
    const auto result = close();
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(folder.has("f-0000.exr"));
    EXPECT_TRUE(folder.has("f-0000.png"));
}

TEST_F(RelightWindow, TellsOfWhatItCouldNotSave) {
    const std::filesystem::path kept = folder / "kept";
    for (const bool closes_at_once : {false, true}) {
        std::filesystem::create_directory(kept);
        open("kept/f.exr");
        std::filesystem::remove(kept);
        if (closes_at_once) {
            press("s", "Escape");
        } else {
            press("s");
            EXPECT_TRUE(window->wait_until([&] { return !streams.read("stderr").empty(); }));
            press("Escape");
        }
        const auto result = close();
        EXPECT_EQ(result.status, 1);
        EXPECT_EQ(result.err.find("lightcuts-relight: kept/f-0000.exr: cannot be written"), 0u) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
}

TEST_F(RelightWindow, TellsThatAPictureWasNotFinished) {
    open_slow(" -o f.exr");
    press("s", "Escape");
    const auto result = close();
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("it is not saved"), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(folder.has("f-0000.exr"));
}

TEST_F(RelightWindow, StartsWhereTheFirstNameIsTaken) {
    std::filesystem::create_directory(folder / "f-0000.exr");
    open();
    press("s", "Escape");
    EXPECT_EQ(close().status, 0);
    EXPECT_TRUE(folder.has("f-0001.png"));
}

TEST_F(RelightWindow, RefusesInOneLine) {
    const auto refuse = [&](const std::string& arguments, const std::string& says,
                            const std::function<void()>& prepare) {
        const auto result = run(arguments, prepare);
        EXPECT_EQ(result.status, 1) << arguments;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    };
    refuse("view" + scene + camera, "no window can be opened", [] {
        ::unsetenv("DISPLAY");
        ::unsetenv("WAYLAND_DISPLAY");
    });
    refuse("view" + scene + camera, "no window can be opened", [] { ::setenv("DISPLAY", ":none", 1); });
    const auto here = display->in_process();
    refuse("view" + scene + camera + " --screenshot none/w.png", "none/w.png", here);
    refuse("view" + scene + camera + " --screenshot sky.exr", "sky.exr", here);
    refuse("view" + scene + camera + " -o none/f.exr", "none/f-0000.exr", here);
    refuse("view b.relight --scene block.obj --env none.exr" + camera, "none.exr", here);
}

}  // namespace
