#include <chrono>
#include <optional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/task_group.h>

#include "viewed_world.hpp"

namespace {

/// States that differ from the one before in each thing that is kept, and in several.
std::vector<relight::FrameState> states_of(const relight::FrameState& start) {
    std::vector<relight::FrameState> states{start};
    const auto next = [&]() -> relight::FrameState& { return states.emplace_back(states.back()); };
    next().rotation = 40.0;
    next().materials.albedo = 0.5f;
    next().materials.gloss_width = 2.0f;
    next().camera.eye.x = -3.0;
    next().materials = {};
    next().materials.is_diffuse = true;
    next().materials = {.is_diffuse = false, .albedo = 1.5f, .gloss_width = 0.5f};
    next().width = 12;
    next().camera.vertical_fov = 60.0f;
    states.push_back(start);
    return states;
}

TEST(FrameSource, WhatIsKeptChangesNoBit) {
    const ViewedWorld viewed;
    relight::FrameSource kept(viewed.options, viewed.prepared, relight::read_environment(viewed.options));
    std::vector<glm::vec3> before;
    for (const relight::FrameState& state : states_of(viewed.state())) {
        relight::FrameSource fresh(viewed.options, viewed.prepared, relight::read_environment(viewed.options));
        const render::Picture picture = kept.picture(state).value();
        EXPECT_EQ(picture.pixels, fresh.picture(state).value().pixels);
        EXPECT_NE(picture.pixels, before);
        before = picture.pixels;
        EXPECT_EQ(kept.figures().points, fresh.figures().points);
        EXPECT_EQ(kept.figures().relit.nodes, fresh.figures().relit.nodes);
        EXPECT_EQ(kept.figures().illumination_cut, fresh.figures().illumination_cut);
    }
}

TEST(FrameSource, CanceledPictureIsNoneAndHarmsNoOther) {
    const ViewedWorld viewed;
    relight::FrameSource source(viewed.options, viewed.prepared, relight::read_environment(viewed.options));
    relight::FrameSource undisturbed(viewed.options, viewed.prepared, relight::read_environment(viewed.options));
    for (const relight::FrameState& state : states_of(viewed.state())) {
        tbb::task_group group;
        bool has_picture = true;
        group.run_and_wait([&] {
            group.cancel();
            has_picture = source.picture(state).has_value();
        });
        EXPECT_FALSE(has_picture);
        EXPECT_EQ(source.picture(state).value().pixels, undisturbed.picture(state).value().pixels);
    }
}

TEST(FrameSource, CanceledByAnotherThreadAtAnyTimeHarmsNoOther) {
    const ViewedWorld viewed;
    relight::FrameSource source(viewed.options, viewed.prepared, relight::read_environment(viewed.options));
    relight::FrameSource undisturbed(viewed.options, viewed.prepared, relight::read_environment(viewed.options));
    std::vector<relight::FrameState> states = states_of(viewed.state(96, 64));
    std::vector<std::vector<glm::vec3>> expected;
    for (const relight::FrameState& state : states) expected.push_back(undisturbed.picture(state).value().pixels);
    int canceled = 0;
    for (int i = 0; i < 200; ++i) {
        const std::size_t k = static_cast<std::size_t>(i) % states.size();
        tbb::task_group group;
        std::optional<render::Picture> picture;
        std::thread other([&] {
            std::this_thread::sleep_for(std::chrono::microseconds(50 * i));
            group.cancel();
        });
        group.run_and_wait([&] { picture = source.picture(states[k]); });
        other.join();
        canceled += picture ? 0 : 1;
        if (picture) { EXPECT_EQ(picture->pixels, expected[k]); }
        EXPECT_EQ(source.picture(states[k]).value().pixels, expected[k]);
    }
    EXPECT_GT(canceled, 0);
}

TEST(FrameSource, DiffuseReflectionGrowsWithTheAlbedo) {
    const ViewedWorld viewed;
    relight::FrameSource source(viewed.options, viewed.prepared, relight::read_environment(viewed.options));
    relight::FrameState state = viewed.state();
    state.materials.is_diffuse = true;
    const auto whole = source.picture(state).value().pixels;
    state.materials.albedo = 0.5f;
    const auto half = source.picture(state).value().pixels;
    state.materials.albedo = 0.0f;
    const auto sky = source.picture(state).value().pixels;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[i][c], 0.5f * (whole[i][c] + sky[i][c]), 1e-5f * whole[i][c]);
    }
}

}  // namespace
