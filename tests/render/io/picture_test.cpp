#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>
#include <lightcuts/core/invalid_input.hpp>
#include <render/error.hpp>
#include <render/false_color.hpp>
#include <render/io/output_file.hpp>
#include <render/io/picture.hpp>
#include <render/luminance.hpp>

#include "support/temporary_folder.hpp"

namespace {

using render::Picture;

/// Pixels and two channels of numbers that a byte or a half cannot hold.
Picture sample_picture(int width, int height) {
    Picture picture(width, height);
    picture.add_channel("cut_size");
    picture.add_channel("normal.X");
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const float x = static_cast<float>(i);
        picture.pixels[i] = {x / 3.0f, std::exp(-x), 1e20f * x};
        picture.channels[0].values[i] = 1000.0f + x;
        picture.channels[1].values[i] = -x / 7.0f;
    }
    return picture;
}

TEST(Picture, SurvivesOpenExrBitForBit) {
    const TemporaryFolder folder;
    const Picture written = sample_picture(37, 11);
    write_exr(folder / "a.exr", written);
    const Picture read = render::read_exr(folder / "a.exr");
    ASSERT_EQ(read.width, 37);
    ASSERT_EQ(read.height, 11);
    EXPECT_EQ(read.pixels, written.pixels);
    ASSERT_EQ(read.channels.size(), 2u);
    ASSERT_NE(read.find("cut_size"), nullptr);
    ASSERT_NE(read.find("normal.X"), nullptr);
    EXPECT_EQ(read.find("cut_size")->values, written.channels[0].values);
    EXPECT_EQ(read.find("normal.X")->values, written.channels[1].values);
    EXPECT_EQ(read.find("depth"), nullptr);
}

TEST(Picture, KeepsInfinityInOpenExr) {
    const TemporaryFolder folder;
    Picture written(2, 1);
    written.pixels[1].y = std::numeric_limits<float>::infinity();
    write_exr(folder / "a.exr", written);
    EXPECT_EQ(render::read_exr(folder / "a.exr").pixels, written.pixels);
}

TEST(Picture, ReadsHalfGrayAndAShiftedWindow) {
    const TemporaryFolder folder;
    const Imath::Box2i window({5, -3}, {6, -2});
    Imf::Header header(Imath::Box2i({0, 0}, {9, 9}), window);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    const half values[4] = {half(0.5f), half(1.0f), half(2.0f), half(4.0f)};
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice::Make(Imf::HALF, values, window));
    {
        Imf::OutputFile file((folder / "gray.exr").c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(2);
    }

    const Picture read = render::read_exr(folder / "gray.exr");
    ASSERT_EQ(read.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(read.pixels[i], glm::vec3(values[i]));
}

TEST(Picture, RefusesWhatIsNoPicture) {
    const TemporaryFolder folder;
    EXPECT_THROW(render::read_exr(folder / "absent.exr"), lightcuts::invalid_input);
    EXPECT_THROW(render::read_exr(folder.path()), lightcuts::invalid_input);
    EXPECT_THROW(render::read_exr(folder.write("text.exr", "not a picture")), lightcuts::invalid_input);
    write_exr(folder / "whole.exr", sample_picture(64, 64));
    const std::string cut = folder.read("whole.exr").substr(0, 2000);
    EXPECT_THROW(render::read_exr(folder.write("cut.exr", cut)), lightcuts::invalid_input);
    EXPECT_THROW(write_exr(folder / "no/folder.exr", sample_picture(2, 2)), lightcuts::invalid_input);
}

TEST(ToneMapping, KeepsOrderAndRange) {
    Picture picture(100, 1);
    for (std::size_t i = 0; i < 100; ++i) picture.pixels[i] = glm::vec3(std::pow(1.2f, static_cast<float>(i)));
    const auto colors = tone_mapped(picture);
    EXPECT_GE(colors.front().x, 0.0f);
    EXPECT_LE(colors.back().x, 1.0f);
    for (std::size_t i = 1; i < 100; ++i) EXPECT_GE(colors[i].x, colors[i - 1].x) << i;
}

TEST(ToneMapping, OfOneCurveShowsEqualRadianceAlike) {
    Picture picture(3, 1);
    picture.pixels = {glm::vec3(1.0f), glm::vec3(2.0f), glm::vec3(4.0f)};
    Picture other(3, 1);
    other.pixels = {glm::vec3(4.0f), glm::vec3(100.0f), glm::vec3(1.0f)};
    const auto curve = render::tone_curve(picture);
    const auto colors = tone_mapped(picture), others = tone_mapped(other, curve);
    EXPECT_EQ(others[0], colors[2]);
    EXPECT_EQ(others[2], colors[0]);
    EXPECT_EQ(others[1], glm::vec3(1.0f));
    EXPECT_NE(tone_mapped(other)[0], colors[2]);
}

TEST(ToneMapping, ExposesForWhatIsNotNearlyBlack) {
    // Half of the picture is as good as black; a lamp is very bright.
    Picture picture(400, 1);
    for (std::size_t i = 0; i < 400; ++i) picture.pixels[i] = glm::vec3(i % 2 == 0 ? 1e-7f : 1.0f);
    picture.pixels[0] = glm::vec3(1e7f);
    EXPECT_NEAR(render::tone_curve(picture).exposure, 0.18, 0.02);
    // What is still to be seen counts: half of the pixels are a hundred times darker, so the mean is ten times.
    for (std::size_t i = 0; i < 400; i += 2) picture.pixels[i] = glm::vec3(1e-2f);
    EXPECT_NEAR(render::tone_curve(picture).exposure, 1.8, 0.02);
}

TEST(ToneMapping, TakesBlackAndBrokenPixels) {
    Picture picture(4, 1);
    EXPECT_EQ(tone_mapped(picture), std::vector<glm::vec3>(4, glm::vec3(0.0f)));
    picture.pixels[0] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    picture.pixels[1] = glm::vec3(std::numeric_limits<float>::infinity());
    picture.pixels[2] = glm::vec3(1.0f);
    const auto colors = tone_mapped(picture);
    EXPECT_EQ(colors[0], glm::vec3(0.0f));
    EXPECT_EQ(colors[1], glm::vec3(1.0f));
    EXPECT_GT(colors[2].x, 0.0f);
}

TEST(ErrorFigures, AreZeroForEqualPictures) {
    const Picture a = sample_picture(5, 5);
    const auto figures = render::compare(a, a);
    EXPECT_EQ(figures.relative_rmse, 0.0);
    EXPECT_EQ(figures.relative_l1, 0.0);
    EXPECT_EQ(figures.relative_bias, 0.0);
    EXPECT_EQ(figures.max_relative, 0.0);
    EXPECT_EQ(figures.p999_relative, 0.0);
    EXPECT_EQ(figures.max_step, 0.0);
    EXPECT_EQ(figures.p999_step, 0.0);
}

TEST(ErrorFigures, MatchHandComputedValues) {
    Picture reference(3, 1);
    reference.pixels = {glm::vec3(3.0f, 0.0f, 0.0f), glm::vec3(0.0f, 4.0f, 0.0f), glm::vec3(0.0f)};
    Picture picture = reference;
    picture.pixels[0].x = 4.0f;  // off by 1, luminance by a third
    picture.pixels[1].y = 2.0f;  // off by 2, luminance by a half
    picture.pixels[2].z = 2.0f;  // off by 2 where the reference is black: in the norms, not in the luminance
    const auto figures = render::compare(picture, reference);
    EXPECT_NEAR(figures.relative_rmse, 3.0 / 5.0, 1e-12);
    EXPECT_NEAR(figures.relative_l1, 5.0 / 7.0, 1e-12);
    EXPECT_NEAR(figures.relative_bias, 1.0 / 7.0, 1e-12);
    EXPECT_NEAR(figures.max_relative, 0.5, 1e-6);
    EXPECT_NEAR(figures.p999_relative, 1.0 / 3.0 + 0.999 * (0.5 - 1.0 / 3.0), 1e-6);
}

TEST(ErrorFigures, PercentileLeavesOutTheWorstThousandth) {
    Picture reference(1001, 2);
    std::fill(reference.pixels.begin(), reference.pixels.end(), glm::vec3(1.0f));
    Picture picture = reference;
    picture.pixels[17] = glm::vec3(9.0f);
    picture.pixels[1500] = glm::vec3(3.0f);
    const auto figures = render::compare(picture, reference);
    EXPECT_NEAR(figures.max_relative, 8.0, 1e-5);
    EXPECT_NEAR(figures.p999_relative, 0.0, 1e-5);
}

TEST(ErrorFigures, StepsAreThoseThatTheReferenceDoesNotHave) {
    Picture reference(4, 3);
    for (std::size_t i = 0; i < reference.size(); ++i) reference.pixels[i] = glm::vec3(i % 4 < 2 ? 1.0f : 8.0f);
    Picture picture = reference;
    // Too bright everywhere: the pair across the reference's own edge is wrong by 0.7 of 8, no other is.
    for (glm::vec3& pixel : picture.pixels) pixel *= 1.1f;
    EXPECT_NEAR(render::compare(picture, reference).max_step, 0.7 / 8.0, 1e-6);
    // A band: all rows from the second on. The step is between rows, and relative to the brighter of two.
    picture = reference;
    for (std::size_t i = 4; i < picture.size(); ++i) picture.pixels[i] += 0.25f;
    EXPECT_NEAR(render::compare(picture, reference).max_step, 0.25, 1e-6);
    // The last pixel of a row and the first of the next are no neighbors.
    std::fill(reference.pixels.begin(), reference.pixels.end(), glm::vec3(1.0f));
    picture = reference;
    picture.pixels[4] += 3.0f;
    picture.pixels[3] -= 3.0f;
    EXPECT_NEAR(render::compare(picture, reference).max_step, 3.0, 1e-6);
}

TEST(ErrorFigures, StepsLeaveOutPairsOfBlackAndTheWorstThousandth) {
    Picture reference(1001, 1);
    Picture picture = reference;
    picture.pixels[500] = glm::vec3(1.0f);
    EXPECT_EQ(render::compare(picture, reference).max_step, 0.0);
    reference.pixels[501] = glm::vec3(2.0f);
    picture.pixels[501] = glm::vec3(2.0f);
    EXPECT_NEAR(render::compare(picture, reference).max_step, 0.5, 1e-6);
    std::fill(reference.pixels.begin(), reference.pixels.end(), glm::vec3(1.0f));
    picture = reference;
    picture.pixels[0] = glm::vec3(5.0f);  // one pair of 1000
    const auto figures = render::compare(picture, reference);
    EXPECT_NEAR(figures.max_step, 4.0, 1e-6);
    EXPECT_NEAR(figures.p999_step, 0.004, 1e-6);
}

TEST(ErrorFigures, AreInfiniteAgainstABlackReference) {
    const Picture black(2, 2);
    Picture picture(2, 2);
    EXPECT_EQ(render::compare(picture, black).relative_rmse, 0.0);
    picture.pixels[0].x = 1.0f;
    EXPECT_TRUE(std::isinf(render::compare(picture, black).relative_rmse));
    EXPECT_TRUE(std::isinf(render::compare(picture, black).relative_l1));
    EXPECT_EQ(render::compare(picture, black).max_relative, 0.0);
}

TEST(ErrorFigures, DoNotHideBrokenPixels) {
    Picture reference(2, 1);
    reference.pixels = {glm::vec3(1.0f), glm::vec3(1.0f)};
    Picture picture = reference;
    picture.pixels[0].y = std::numeric_limits<float>::quiet_NaN();
    const auto figures = render::compare(picture, reference);
    EXPECT_TRUE(std::isnan(figures.relative_rmse));
    EXPECT_TRUE(std::isinf(figures.max_relative));
    EXPECT_TRUE(std::isinf(figures.max_step));
}

TEST(ErrorFigures, NeedEqualSizes) {
    EXPECT_THROW(render::compare(Picture(2, 3), Picture(3, 2)), lightcuts::invalid_input);
    EXPECT_THROW(render::heat_map(Picture(2, 3), Picture(3, 2), 0.1), lightcuts::invalid_input);
}

TEST(HeatMap, GrowsBrighterWithTheError) {
    Picture reference(5, 1);
    std::fill(reference.pixels.begin(), reference.pixels.end(), glm::vec3(1.0f));
    Picture picture = reference;
    for (std::size_t i = 0; i < 5; ++i) picture.pixels[i] *= 1.0f + 0.026f * static_cast<float>(i);
    const auto colors = render::heat_map(picture, reference, 0.1);
    EXPECT_EQ(colors[0], glm::vec3(0.0f));
    EXPECT_EQ(colors[4], glm::vec3(1.0f));
    for (std::size_t i = 1; i < 5; ++i) EXPECT_GT(render::luminance(colors[i]), render::luminance(colors[i - 1]));
}

TEST(FalseColor, RunsFromBlackThroughBlueRedAndYellowToWhite) {
    using render::false_color;
    EXPECT_EQ(false_color(0.0, 8.0), glm::vec3(0.0f));
    const glm::vec3 blue = false_color(2.0, 8.0), red = false_color(4.0, 8.0), yellow = false_color(6.0, 8.0);
    EXPECT_GT(blue.z, 2.0f * std::max(blue.x, blue.y));
    EXPECT_GT(red.x, 2.0f * std::max(red.y, red.z));
    EXPECT_GT(std::min(yellow.x, yellow.y), 2.0f * yellow.z);
    EXPECT_EQ(false_color(8.0, 8.0), glm::vec3(1.0f));
}

TEST(FalseColor, TakesWhatIsOutOfRangeOrNoNumber) {
    using render::false_color;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(false_color(-1.0, 8.0), glm::vec3(0.0f));
    EXPECT_EQ(false_color(-infinite, 8.0), glm::vec3(0.0f));
    EXPECT_EQ(false_color(9.0, 8.0), glm::vec3(1.0f));
    EXPECT_EQ(false_color(infinite, 8.0), glm::vec3(1.0f));
    EXPECT_EQ(false_color(std::numeric_limits<double>::quiet_NaN(), 8.0), glm::vec3(1.0f));
}

TEST(LayerFigures, LeaveOutWhatIsNotFinite) {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    const auto figures = render::figures_of({infinite, 3.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(), 1.0f});
    EXPECT_EQ(figures.min, -1.0);
    EXPECT_EQ(figures.mean, 1.0);
    EXPECT_EQ(figures.max, 3.0);
    EXPECT_EQ(render::figures_of({infinite}).max, 0.0);
}

TEST(OutputFile, ReplacesItsTargetOnlyOnCommit) {
    const TemporaryFolder folder;
    const std::string target = folder.write("a.txt", "old");
    {
        render::OutputFile dropped(target);
        std::ofstream(dropped.path()) << "half";
    }
    EXPECT_EQ(folder.read("a.txt"), "old");
    {
        render::OutputFile kept(target);
        std::ofstream(kept.path()) << "new";
        EXPECT_EQ(folder.read("a.txt"), "old");
        kept.commit();
    }
    EXPECT_EQ(folder.read("a.txt"), "new");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputFile, RefusesWhatCannotBeWritten) {
    const TemporaryFolder folder;
    EXPECT_THROW(render::require_writable(folder.path()), lightcuts::invalid_input);
    EXPECT_THROW(render::require_writable(folder / "no/such/folder.exr"), lightcuts::invalid_input);
    EXPECT_THROW(render::require_writable("/dev/null"), lightcuts::invalid_input);
    EXPECT_NO_THROW(render::require_writable(folder / "fine.exr"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
