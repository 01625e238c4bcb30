#include "coarse_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "shutter.hpp"

namespace render {

void see_through(const MovingView& view, const EyePathTracer& surfaces, const glm::vec2& place, std::uint32_t name,
                 std::vector<SurfacePoint>& points) {
    const std::uint32_t instant = instant_of_ray(0, name, 0, 1, view.instants());
    EyeRay ray = view.at(instant).ray(place.x, place.y);
    ray.instant = instant;
    surfaces.follow(ray, name, 0, points);
}

void see_coarse_row(const MovingView& view, const EyePathTracer& surfaces, const CoarseGrid& grid, int row,
                    std::vector<SurfacePoint>& points) {
    for (int column = 0; column < grid.columns; ++column) {
        const float x = (static_cast<float>(column) + 0.5f) / static_cast<float>(grid.columns);
        const float y = (static_cast<float>(row) + 0.5f) / static_cast<float>(grid.rows);
        const auto cell = static_cast<std::uint32_t>(row * grid.columns + column);
        see_through(view, surfaces, {x * static_cast<float>(view.width()), y * static_cast<float>(view.height())}, cell,
                    points);
    }
}

CoarseGrid pilot_grid(int width, int height) {
    const double w = width, h = height;
    const double count = std::clamp(w * h / 64.0, 576.0, 2304.0);
    CoarseGrid grid;
    grid.columns = std::clamp(static_cast<int>(std::lround(std::sqrt(count * w / h))), 1, width);
    grid.rows = std::clamp(static_cast<int>(std::lround(count / grid.columns)), 1, height);
    return grid;
}

}  // namespace render
