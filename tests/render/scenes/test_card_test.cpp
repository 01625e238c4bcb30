#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/io/picture.hpp>
#include <render/scenes/builtin.hpp>

#include "render/programs.hpp"

namespace {

class TestCard : public Programs {};

/// Mean over the rectangle [x0, x1] x [y0, y1] of the card, in its own coordinates.
glm::dvec3 mean_over(const render::Picture& picture, float x0, float x1, float y0, float y1) {
    const float pixel = render::test_card_height / static_cast<float>(picture.height);
    const float left = 0.5f * (render::test_card_pitch * render::test_card_columns - 0.1f) -
                       0.5f * pixel * static_cast<float>(picture.width);
    const float top = render::test_card_middle + 0.5f * render::test_card_height;
    glm::dvec3 sum(0.0);
    int count = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const float u = left + pixel * (static_cast<float>(x) + 0.5f);
            const float v = top - pixel * (static_cast<float>(y) + 0.5f);
            if (u < x0 || u > x1 || v < y0 || v > y1) continue;
            sum += glm::dvec3(picture.pixels[static_cast<std::size_t>(y * picture.width + x)]);
            ++count;
        }
    }
    EXPECT_GT(count, 20);
    return sum / static_cast<double>(count);
}

TEST_F(TestCard, ShowsOnTheLeftOfEachTileWhatIsOnTheRight) {
    const auto done = render("builtin:test-card --method exhaustive --area-points 64 --size 400x300 -o card.exr");
    ASSERT_EQ(done.status, 0) << done.err;
    const render::Picture card = render::read_exr(folder / "card.exr");
    for (int row = 0; row < render::test_card_rows; ++row) {
        for (int column = 0; column < render::test_card_columns; ++column) {
            SCOPED_TRACE("row " + std::to_string(row + 1) + ", column " + std::to_string(column + 1));
            const float x = render::test_card_pitch * static_cast<float>(column);
            const float y = -render::test_card_pitch * static_cast<float>(row);
            for (const float lower : {0.05f, 0.55f}) {
                const glm::dvec3 left = mean_over(card, x + 0.05f, x + 0.45f, y + lower, y + lower + 0.4f);
                const glm::dvec3 right = mean_over(card, x + 0.55f, x + 0.95f, y + lower, y + lower + 0.4f);
                EXPECT_GT(right.x + right.y + right.z, 0.05);
                const double largest = std::max({right.x, right.y, right.z});
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(left[c], right[c], 0.01 * largest);
            }
        }
    }
}

TEST_F(TestCard, IsLitByEveryKindOfLight) {
    const auto done = render("builtin:test-card --method exhaustive --size 200x150 -o card.exr");
    ASSERT_EQ(done.status, 0) << done.err;
    const auto lights = report("card.json").at("lights");
    EXPECT_EQ(lights.at("omni"), 1);
    EXPECT_EQ(lights.at("spot"), 1);
    EXPECT_EQ(lights.at("sphere"), 64);
    EXPECT_EQ(lights.at("directional"), 2);
    const render::Picture card = render::read_exr(folder / "card.exr");
    // The pools differ in color, and are brighter than between them.
    const float y = -render::test_card_pitch * render::test_card_rows - 0.6f;
    const glm::dvec3 between = mean_over(card, 1.95f, 2.35f, y + 0.3f, y + 0.7f);
    const glm::dvec3 point = mean_over(card, 0.85f, 1.25f, y + 0.3f, y + 0.7f);
    const glm::dvec3 spot = mean_over(card, 3.1f, 3.4f, y + 0.35f, y + 0.65f);
    const glm::dvec3 sphere = mean_over(card, 5.25f, 5.65f, y + 0.3f, y + 0.7f);
    EXPECT_GT(point.x, 1.5 * between.x);
    EXPECT_GT(spot.y, 1.5 * between.y);
    EXPECT_GT(sphere.z, 1.5 * between.z);
}

TEST_F(TestCard, NamesWhatItLeavesOut) {
    const auto done = render("builtin:test-card --size 8x6 -o card.exr");
    ASSERT_EQ(done.status, 0) << done.err;
    const auto left_out = report("card.json").at("left_out");
    ASSERT_EQ(left_out.size(), 3u);
    for (const auto& item : left_out) {
        EXPECT_NE(done.err.find(item.at("what").get<std::string>()), std::string::npos);
        EXPECT_FALSE(item.at("why").get<std::string>().empty());
    }
    const auto quiet = render("builtin:test-card --size 8x6 --quiet -o card.exr");
    EXPECT_TRUE(quiet.err.empty()) << quiet.err;
    EXPECT_EQ(report("card.json").at("left_out").size(), 3u);
}

}  // namespace
