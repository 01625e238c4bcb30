#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "moving_view.hpp"
#include "surfaces/surface.hpp"

namespace render {

/// Appends to `points` what reflects light along one eye ray through a place of the view, in pixels. `name`: their
/// SurfacePoint::pixel.
void see_through(const MovingView& view, const EyePathTracer& surfaces, const glm::vec2& place, std::uint32_t name,
                 std::vector<SurfacePoint>& points);

/// Columns and rows of points that lie evenly in a picture.
struct CoarseGrid {
    int columns = 0;
    int rows = 0;
};

/// Appends to `points` what reflects light along the eye rays of a row of a grid over the view, one ray a cell, through
/// its middle. `SurfacePoint::pixel` then counts cells.
void see_coarse_row(const MovingView& view, const EyePathTracer& surfaces, const CoarseGrid& grid, int row,
                    std::vector<SurfacePoint>& points);

/// The grid of pilots that a picture's visibility is learned from: about one for 64 pixels, at least 576 and at most
/// 2304; no more than pixels.
CoarseGrid pilot_grid(int width, int height);

}  // namespace render
