#include <cmath>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <relight/options.hpp>
#include <relight/view_state.hpp>
#include <render/choose_camera.hpp>

namespace {

using relight::ViewState;

relight::FrameState start() {
    relight::FrameState state;
    state.camera.eye = {1.0 / 3.0, 2.0, 9.0};
    state.camera.target = {0.1, 0.2, 0.3};
    state.camera.vertical_fov = 37.3f;
    state.rotation = 12.5;
    return state;
}

/// What `render` makes of options that a window prints.
relight::FrameState read_back(const std::string& options) {
    std::istringstream stream("lightcuts-relight render a.relight --scene s.obj --env m.hdr " + options);
    const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    const relight::Options read = relight::parse_options(static_cast<int>(argv.size()), argv.data());
    return {render::choose_camera(render::Scene(), read.view), read.rotation, read.materials, read.view.width,
            read.view.height};
}

TEST(ViewState, StartsAsItIsTold) {
    const ViewState state(start(), 5.0);
    relight::FrameState expected = start();
    expected.width = 30;
    expected.height = 20;
    EXPECT_EQ(state.frame(30, 20), expected);
}

TEST(ViewState, OptionsAreReadBackToTheLastBit) {
    ViewState state(start(), 5.0);
    EXPECT_EQ(read_back(state.options(30, 20)), state.frame(30, 20));
    state.drag(ViewState::Drag::orbit, 0.123, -0.2);
    state.drag(ViewState::Drag::light, 0.7, 0.1);
    state.drag(ViewState::Drag::shift, 0.01, 0.3);
    state.scroll(1.5);
    state.press(ViewState::Key::diffuse);
    state.materials.albedo = 0.7f;
    state.materials.gloss_width = 1.0f / 3.0f;
    EXPECT_NE(state.frame(640, 480).camera.eye, start().camera.eye);
    EXPECT_EQ(read_back(state.options(640, 480)), state.frame(640, 480));
}

TEST(ViewState, LightTurnsAndComesRound) {
    ViewState state(start(), 5.0);
    state.press(ViewState::Key::light_right);
    EXPECT_DOUBLE_EQ(state.rotation, 17.5);
    state.press(ViewState::Key::light_left);
    state.press(ViewState::Key::light_left);
    EXPECT_DOUBLE_EQ(state.rotation, 7.5);
    for (int i = 0; i < 72; ++i) {
        state.press(ViewState::Key::light_right);
        EXPECT_GE(state.rotation, -180.0);
        EXPECT_LT(state.rotation, 180.0);
    }
    EXPECT_DOUBLE_EQ(state.rotation, 7.5);
    // Up and down drags turn nothing.
    state.drag(ViewState::Drag::light, 0.0, 0.5);
    EXPECT_DOUBLE_EQ(state.rotation, 7.5);
    EXPECT_EQ(state.frame(3, 3).camera.eye, start().camera.eye);
}

TEST(ViewState, LightStaysBelowHalfATurn) {
    for (int turns = -2000; turns <= 2000; ++turns) {
        const double edge = 180.0 + 360.0 * turns;
        for (const double rotation : {edge, std::nextafter(edge, -1e9), std::nextafter(edge, 1e9)}) {
            relight::FrameState turned = start();
            turned.rotation = rotation;
            ViewState state(turned, 5.0);
            state.drag(ViewState::Drag::light, 0.0, 0.0);
            EXPECT_GE(state.rotation, -180.0) << turns;
            EXPECT_LT(state.rotation, 180.0) << turns;
            EXPECT_EQ(std::remainder(state.rotation - rotation, 360.0), 0.0) << turns;
        }
    }
}

TEST(ViewState, OrthographicCamerasHaveNoOptions) {
    relight::FrameState orthographic = start();
    orthographic.camera.height = 3.0f;
    const std::string options = ViewState(orthographic, 5.0).options(30, 20);
    EXPECT_EQ(options.find("--eye"), std::string::npos) << options;
    EXPECT_EQ(options.find("--rotate 12.5"), 0u) << options;
}

TEST(ViewState, KeysUndoEachOtherAndStartAgain) {
    ViewState state(start(), 5.0);
    state.press(ViewState::Key::brighter);
    EXPECT_GT(state.exposure, 0.0);
    state.press(ViewState::Key::darker);
    EXPECT_EQ(state.exposure, 0.0);
    state.press(ViewState::Key::diffuse);
    EXPECT_TRUE(state.frame(3, 3).materials.is_diffuse);
    state.press(ViewState::Key::brighter);
    state.drag(ViewState::Drag::orbit, 0.5, 0.0);
    state.press(ViewState::Key::reset);
    EXPECT_EQ(state.exposure, 0.0);
    EXPECT_EQ(state.frame(0, 0), start());
}

}  // namespace
