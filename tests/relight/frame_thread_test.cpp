#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <latch>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <lightcuts/core/invalid_input.hpp>
#include <relight/frame_thread.hpp>

#include "viewed_world.hpp"

namespace {

/// Takes pictures until one holds what is waited for; null after a minute. `meanwhile` is called again and again.
std::shared_ptr<const relight::ShownFrame> wait_for(
    relight::FrameThread& thread, const std::function<bool(const relight::ShownFrame&)>& holds,
    const std::function<void()>& meanwhile = [] {}) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < end) {
        const auto frame = thread.take();
        if (frame && holds(*frame)) return frame;
        meanwhile();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return nullptr;
}

class FrameThreadTest : public ::testing::Test {
protected:
    ViewedWorld viewed;
    relight::FrameSource source{viewed.options, viewed.prepared, relight::read_environment(viewed.options)};
    relight::FrameSource other{viewed.options, viewed.prepared, relight::read_environment(viewed.options)};

    static bool is_at_rest(const relight::ShownFrame& frame) { return frame.is_at_rest(); }
};

TEST_F(FrameThreadTest, ComesToRestAtThePictureThatWasAskedFor) {
    std::atomic<int> calls{0};
    std::shared_ptr<const relight::ShownFrame> frame;
    relight::ShownState state{viewed.state(50, 30)};
    {
        relight::FrameThread thread(source, 2, [&] { ++calls; });
        for (int i = 0; i < 20; ++i) {
            state.frame.rotation = i;
            thread.show(state);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        frame = wait_for(thread, [&](const auto& f) { return f.is_at_rest() && f.state == state; });
    }
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->picture->pixels, other.picture(state.frame).value().pixels);
    EXPECT_EQ(frame->figures.points, other.figures().points);
    // The first is coarse.
    EXPECT_GE(calls, 2);
}

TEST_F(FrameThreadTest, FirstPictureIsCoarse) {
    std::latch is_taken(1);
    relight::FrameThread thread(source, 2, [&] { is_taken.wait(); });
    relight::ShownState state{viewed.state(50, 30)};
    thread.show(state);
    const auto coarse = wait_for(thread, [](const auto&) { return true; });
    is_taken.count_down();
    ASSERT_TRUE(coarse);
    EXPECT_EQ(coarse->divisor, 4);
    relight::FrameState smaller = state.frame;
    smaller.width = 13;
    smaller.height = 8;
    EXPECT_EQ(coarse->picture->width, smaller.width);
    EXPECT_EQ(coarse->picture->pixels, other.picture(smaller).value().pixels);
}

/// Pictures whose every pixel traces a ray into each direction: those of `large` take seconds.
class SlowFrameThread : public ::testing::Test {
protected:
    SlowFrameThread() { viewed.options.exhaustive = relight::Truth::pixels; }

    relight::ShownState large(double rotation) const {
        relight::ShownState state{viewed.state(480, 360)};
        state.frame.rotation = rotation;
        return state;
    }

    ViewedWorld viewed;
    relight::FrameSource source{viewed.options, viewed.prepared, relight::read_environment(viewed.options)};
};

TEST_F(SlowFrameThread, CoarsePicturesAreFinishedWhateverChanges) {
    relight::FrameThread thread(source, 2, [] {});
    int shown = 0;
    const auto coarse = wait_for(
        thread, [&](const auto&) { return true; }, [&] { thread.show(large(++shown)); });
    ASSERT_TRUE(coarse);
    EXPECT_EQ(coarse->divisor, 4);
    EXPECT_LT(coarse->state.frame.rotation, shown);
}

TEST_F(SlowFrameThread, ChangeCancelsARefinement) {
    std::latch is_taken(1);
    relight::FrameThread thread(source, 2, [&] { is_taken.wait(); });
    thread.show(large(0.0));
    const auto coarse = wait_for(thread, [](const auto&) { return true; });
    ASSERT_TRUE(coarse);
    is_taken.count_down();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    thread.show(large(1.0));
    const auto next = wait_for(thread, [](const auto&) { return true; });
    ASSERT_TRUE(next);
    EXPECT_EQ(next->state, large(1.0));
    EXPECT_GT(next->divisor, 1);
}

TEST_F(SlowFrameThread, ChangeCancelsAFullPictureThatTakesTooLong) {
    relight::Pace hopeful;
    hopeful.took(1.0, 0.0);
    relight::FrameThread thread(
        source, 2, [] {}, hopeful);
    thread.show(large(0.0));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    thread.show(large(1.0));
    const auto next = wait_for(thread, [](const auto&) { return true; });
    ASSERT_TRUE(next);
    // What it took until then is known.
    EXPECT_EQ(next->state, large(1.0));
    EXPECT_GT(next->divisor, 1);
}

TEST_F(FrameThreadTest, ToneCurveStaysUntilAnotherIsAskedFor) {
    relight::FrameThread thread(source, 2, [] {});
    relight::ShownState state{viewed.state()};
    thread.show(state);
    const auto first = wait_for(thread, is_at_rest);
    ASSERT_TRUE(first);
    const render::ToneCurve curve = render::tone_curve(*first->picture);
    const auto shown = [&](render::ToneCurve c, double stops) {
        c.exposure *= std::exp2(stops);
        return render::srgb_bytes(render::tone_mapped(other.picture(state.frame).value(), c));
    };
    EXPECT_EQ(first->bytes, shown(curve, 0.0));

    state.frame.materials.albedo = 0.25f;
    state.exposure = -1.0;
    thread.show(state);
    const auto darker = wait_for(thread, [&](const auto& f) { return f.is_at_rest() && f.state == state; });
    ASSERT_TRUE(darker);
    EXPECT_EQ(darker->bytes, shown(curve, -1.0));

    state.fits = 1;
    thread.show(state);
    const auto fitted = wait_for(thread, [&](const auto& f) { return f.is_at_rest() && f.state == state; });
    ASSERT_TRUE(fitted);
    // The same picture, exposed anew.
    EXPECT_EQ(fitted->picture, darker->picture);
    EXPECT_EQ(fitted->bytes, shown(render::tone_curve(*fitted->picture), -1.0));
    EXPECT_NE(fitted->bytes, darker->bytes);
}

TEST(FrameThread, EndsWhateverIsUnderWay) {
    for (const std::size_t points : {0, 300}) {
        const ViewedWorld viewed({.deviation = 0.5}, 1.0, {.points = points});
        relight::FrameSource source(viewed.options, viewed.prepared, relight::read_environment(viewed.options));
        relight::FrameSource other(viewed.options, viewed.prepared, relight::read_environment(viewed.options));
        for (const int milliseconds : {0, 1, 3, 10, 30}) {
            relight::FrameThread thread(source, 2, [] {});
            thread.show({viewed.state(400, 300)});
            std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        }
        // The source is as good as before.
        EXPECT_EQ(source.picture(viewed.state()).value().pixels, other.picture(viewed.state()).value().pixels);
    }
}

TEST(FrameThread, TellsOfDamagedCuts) {
    ViewedWorld viewed;
    std::string content = viewed.world.folder.read("scene.relight");
    // Among the cuts, which come last and take most of the file.
    for (std::size_t i = content.size() / 2; i < content.size(); i += 16) content[i] = static_cast<char>(~content[i]);
    viewed.world.folder.write("damaged.relight", content);
    const relight::PreparedScene damaged(viewed.world.folder / "damaged.relight",
                                         relight::load_still_scene(viewed.world.folder / "scene.obj"),
                                         render::RayTracer());
    relight::FrameSource source(viewed.options, damaged, relight::read_environment(viewed.options));
    relight::FrameThread thread(source, 2, [] {});
    thread.show({viewed.state()});
    EXPECT_THROW(wait_for(thread, [](const auto& frame) { return frame.is_at_rest(); }), lightcuts::invalid_input);
}

TEST(Pace, IsTheFinestThatIsFastEnough) {
    constexpr double pixels = 640.0 * 480.0;
    for (const double seconds : {1e-6, 0.09, 0.11, 0.39, 0.41, 1.5, 1.7, 6.0, 20.0, 100.0, 1e4}) {
        relight::Pace pace;
        // Whatever size the picture had of which the time is known.
        pace.took(pixels / 16.0, 1e3);
        pace.took(pixels / 16.0, seconds / 16.0);
        const int divisor = pace.divisor(pixels);
        if (divisor > 1) { EXPECT_GT(seconds / (divisor * divisor / 4.0), relight::Pace::most_seconds) << seconds; }
        if (divisor < relight::Pace::coarsest) {
            EXPECT_LE(seconds / (divisor * divisor), relight::Pace::most_seconds) << seconds;
        }
    }
}

TEST(Pace, LargerPicturesAreCoarserAtOnce) {
    relight::Pace pace;
    EXPECT_EQ(pace.divisor(1e6), 4);
    pace.took(1e4, 0.09);
    EXPECT_EQ(pace.divisor(1e4), 1);
    EXPECT_EQ(pace.divisor(4e4), 2);
    EXPECT_EQ(pace.divisor(16e4), 4);
    EXPECT_EQ(pace.divisor(1e9), relight::Pace::coarsest);
}

TEST(Pace, RefinementEndsAtTheFullPicture) {
    for (int divisor = relight::Pace::coarsest; divisor > 1; divisor /= 2) {
        int steps = 0;
        for (int d = divisor; d > 1; ++steps) {
            ASSERT_LT(relight::Pace::finer(d), d);
            d = relight::Pace::finer(d);
        }
        EXPECT_LE(steps, 2);
    }
}

}  // namespace
