#include "tile_order.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace render {

namespace {

/// Place of cell (x, y) on the Hilbert curve through a grid of `side` x `side` cells; `side` is a power of two.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t side) {
    std::uint64_t index = 0;
    for (std::uint32_t half = side / 2; half > 0; half /= 2) {
        const bool right = (x & half) != 0;
        const bool low = (y & half) != 0;
        const std::uint64_t quadrant = right ? (low ? 2u : 3u) : (low ? 1u : 0u);
        index += static_cast<std::uint64_t>(half) * half * quadrant;
        // Turn the quadrant so that the curve through it starts and ends where its neighbors' do.
        if (!low) {
            if (right) {
                x = side - 1 - x;
                y = side - 1 - y;
            }
            std::swap(x, y);
        }
    }
    return index;
}

}  // namespace

std::vector<Tile> tiles_of(int width, int height, int side) {
    const int columns = (width + side - 1) / side;
    const int rows = (height + side - 1) / side;
    std::uint32_t grid = 1;
    while (grid < static_cast<std::uint32_t>(std::max(columns, rows))) grid *= 2;

    std::vector<std::pair<std::uint64_t, Tile>> placed;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const Tile tile{column * side, row * side, std::min(width, (column + 1) * side),
                            std::min(height, (row + 1) * side)};
            placed.emplace_back(
                hilbert_index(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), grid), tile);
        }
    }
    std::sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Tile> tiles;
    tiles.reserve(placed.size());
    for (const auto& p : placed) tiles.push_back(p.second);
    return tiles;
}

}  // namespace render
