#include "adaptation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "coarse_picture.hpp"
#include "luminance.hpp"

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
    const CoarseGrid grid{std::min(largest_grid, view.width()), std::min(largest_grid, view.height())};
    std::vector<std::vector<double>> by_row(static_cast<std::size_t>(grid.rows));
    tbb::parallel_for(0, grid.rows, [&](int row) {
        std::vector<SurfacePoint> points;
        see_coarse_row(view, surfaces, grid, row, points);
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
