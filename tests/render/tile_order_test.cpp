#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>
#include <render/tile_order.hpp>
#include <render/view.hpp>

namespace {

TEST(TileOrder, CoversEveryPixelOnce) {
    const int sizes[][2] = {{1, 1}, {16, 16}, {17, 33}, {640, 480}, {5, 300}};
    for (const auto& [width, height] : sizes) {
        std::vector<int> covered(static_cast<std::size_t>(width * height), 0);
        for (const render::Tile& tile : render::tiles_of(width, height, 16)) {
            for (int y = tile.y0; y < tile.y1; ++y) {
                for (int x = tile.x0; x < tile.x1; ++x) ++covered[static_cast<std::size_t>(y * width + x)];
            }
        }
        EXPECT_EQ(covered, std::vector<int>(covered.size(), 1)) << width << "x" << height;
    }
}

TEST(TileOrder, NextTileIsANeighbor) {
    const auto tiles = render::tiles_of(256, 256, 16);
    for (std::size_t i = 1; i < tiles.size(); ++i) {
        EXPECT_EQ(std::abs(tiles[i].x0 - tiles[i - 1].x0) + std::abs(tiles[i].y0 - tiles[i - 1].y0), 16) << i;
    }
}

TEST(PixelOffset, IsTheCenterForOneSample) {
    EXPECT_EQ(render::pixel_offset(1, 123, 0, 1), glm::vec2(0.5f));
    EXPECT_EQ(render::pixel_offset(2, 7, 0, 1), glm::vec2(0.5f));
}

TEST(PixelOffset, SpreadsSamplesEvenly) {
    constexpr int spp = 64;
    int quarter[4] = {};
    for (int sample = 0; sample < spp; ++sample) {
        const glm::vec2 p = render::pixel_offset(1, 99, sample, spp);
        ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
        ++quarter[(p.x < 0.5f ? 0 : 1) + (p.y < 0.5f ? 0 : 2)];
    }
    for (const int count : quarter) EXPECT_NEAR(count, spp / 4, 3);
    EXPECT_NE(render::pixel_offset(1, 99, 0, spp), render::pixel_offset(2, 99, 0, spp));
}

}  // namespace
