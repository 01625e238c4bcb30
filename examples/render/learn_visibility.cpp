#include "learn_visibility.hpp"

#include <cstddef>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "coarse_picture.hpp"

namespace render {

LearningCost learn_visibility(const MovingView& view, const EyePathTracer& surfaces, Shader& shader) {
    const CoarseGrid grid = pilot_grid(view.width(), view.height());
    std::vector<std::vector<SurfacePoint>> by_row(static_cast<std::size_t>(grid.rows));
    tbb::parallel_for(0, grid.rows, [&](int row) {
        see_coarse_row(view, surfaces, grid, row, by_row[static_cast<std::size_t>(row)]);
    });
    std::vector<SurfacePoint> pilots;
    for (const std::vector<SurfacePoint>& row : by_row) pilots.insert(pilots.end(), row.begin(), row.end());
    return shader.learn(pilots);
}

}  // namespace render
