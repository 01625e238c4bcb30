#include "adaptation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "luminance.hpp"
#include "shutter.hpp"

namespace render {

namespace {

constexpr int largest_grid = 32;
/// Of the arithmetic mean: what counts as black.
constexpr double darkest = 1e-4;

}  // namespace

double geometric_mean(std::span<const double> luminances) {
    const auto count = static_cast<double>(luminances.size());
    double sum = 0.0;
    for (const double luminance : luminances) sum += luminance;
    if (!(sum > 0.0)) return 0.0;
    double logarithms = 0.0;
    for (const double luminance : luminances) logarithms += std::log(darkest * sum / count + luminance);
    return std::exp(logarithms / count);
}

float measure_adaptation(const MovingView& view, const EyePathTracer& surfaces, const Shader& shader) {
    const int columns = std::min(largest_grid, view.width());
    const int rows = std::min(largest_grid, view.height());
    std::vector<std::vector<double>> by_row(static_cast<std::size_t>(rows));
    tbb::parallel_for(0, rows, [&](int row) {
        std::vector<SurfacePoint> points;
        for (int column = 0; column < columns; ++column) {
            const float x = (static_cast<float>(column) + 0.5f) / static_cast<float>(columns);
            const float y = (static_cast<float>(row) + 0.5f) / static_cast<float>(rows);
            const auto pixel = static_cast<std::uint32_t>(row * columns + column);
            const std::uint32_t instant = instant_of_ray(0, pixel, 0, 1, view.instants());
            EyeRay ray = view.at(instant).ray(x * static_cast<float>(view.width()),
                                              y * static_cast<float>(view.height()));
            ray.instant = instant;
            surfaces.follow(ray, pixel, 0, points);
        }
        std::vector<Shading> shadings(points.size());
        const auto scratch = shader.make_scratch();
        shader.shade(points, shadings, *scratch);
        std::vector<double>& seen = by_row[static_cast<std::size_t>(row)];
        for (std::size_t i = 0; i < points.size(); ++i) {
            // The points of a pixel, several where there are mirrors and glass, come one after the other.
            if (i == 0 || points[i].pixel != points[i - 1].pixel) seen.push_back(0.0);
            seen.back() += static_cast<double>(luminance(points[i].weight * shadings[i].radiance));
        }
    });
    std::vector<double> seen;
    for (const std::vector<double>& row : by_row) seen.insert(seen.end(), row.begin(), row.end());
    return static_cast<float>(geometric_mean(seen));
}

}  // namespace render
