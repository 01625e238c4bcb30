#include "pilot.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <oneapi/tbb/parallel_for.h>

#include "coarse_picture.hpp"
#include "tile_order.hpp"

namespace render {

namespace {

constexpr int block_side = 8;
constexpr std::size_t fewest = 4, most = 16;
constexpr std::size_t pixels_a_block = 10'000;

}  // namespace

std::vector<std::vector<SurfacePoint>> pilot_blocks(const MovingView& view, const EyePathTracer& surfaces) {
    const std::vector<Tile> tiles = tiles_of(view.width(), view.height(), block_side);
    const auto pixels = static_cast<std::size_t>(view.width()) * static_cast<std::size_t>(view.height());
    const std::size_t count = std::min(std::clamp(pixels / pixels_a_block, fewest, most), tiles.size());
    std::vector<std::vector<SurfacePoint>> blocks(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t b) {
        // Tiles are in the order of a curve that fills the picture: even steps along it are spread over the picture.
        const Tile& tile = tiles[(2 * b + 1) * tiles.size() / (2 * count)];
        for (int y = tile.y0; y < tile.y1; ++y) {
            for (int x = tile.x0; x < tile.x1; ++x) {
                const auto pixel = static_cast<std::uint32_t>(y * view.width() + x);
                see_through(view, surfaces, {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, pixel,
                            blocks[b]);
            }
        }
    });
    return blocks;
}

}  // namespace render
