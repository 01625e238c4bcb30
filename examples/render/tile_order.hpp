#pragma once

#include <vector>

namespace render {

/// Pixels [x0, x1) x [y0, y1).
struct Tile {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;
};

/// The tiles of a picture, `side` pixels wide and high (less at the right and lower edges), along a Hilbert curve:
/// neighbors in the list are neighbors in the picture. pre: all arguments > 0.
std::vector<Tile> tiles_of(int width, int height, int side);

}  // namespace render
