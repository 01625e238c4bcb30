#include "error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <lightcuts/core/invalid_input.hpp>

#include "false_color.hpp"
#include "luminance.hpp"

namespace render {

namespace {

void require_same_size(const Picture& a, const Picture& b) {
    if (a.width == b.width && a.height == b.height) return;
    const auto size = [](const Picture& p) { return std::to_string(p.width) + "x" + std::to_string(p.height); };
    throw lightcuts::invalid_input("a picture of " + size(a) + " cannot be compared with a reference of " + size(b) +
                                   ": render both at one size");
}

/// Quotient of two norms; 0/0 means that nothing differs.
double ratio(double difference, double reference) {
    if (reference > 0.0 || std::isnan(difference)) return difference / reference;
    return difference > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
}

double relative_luminance_error(const glm::vec3& pixel, const glm::vec3& reference) {
    const double l = static_cast<double>(luminance(reference));
    return std::abs(static_cast<double>(luminance(pixel)) - l) / std::abs(l);
}

/// pre: `values` is sorted and not empty.
double percentile(const std::vector<double>& values, double share) {
    const double at = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    const double rest = at - static_cast<double>(below);
    return rest > 0.0 ? values[below] + rest * (values[above] - values[below]) : values[below];
}

/// The largest value and the 99.9th percentile; zeros if there is none.
struct Worst {
    double max = 0;
    double p999 = 0;
};

Worst worst_of(std::vector<double>& values) {
    if (values.empty()) return {};
    // NaN cannot be sorted; it counts as an infinite error.
    for (double& v : values) v = std::isnan(v) ? std::numeric_limits<double>::infinity() : v;
    std::sort(values.begin(), values.end());
    return {values.back(), percentile(values, 0.999)};
}

/// Calls `f(i, j)` for each pixel and its neighbors to the right and below.
template <class F>
void for_each_neighbors(const Picture& picture, F&& f) {
    const auto width = static_cast<std::size_t>(picture.width);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        if ((i + 1) % width != 0) f(i, i + 1);
        if (i + width < picture.size()) f(i, i + width);
    }
}

std::vector<double> steps_of(const Picture& picture, const Picture& reference) {
    std::vector<double> wrong;  // by how much each pixel's luminance is
    wrong.reserve(picture.size());
    for (std::size_t i = 0; i < picture.size(); ++i) {
        wrong.push_back(static_cast<double>(luminance(picture.pixels[i])) -
                        static_cast<double>(luminance(reference.pixels[i])));
    }
    std::vector<double> steps;
    steps.reserve(2 * picture.size());
    for_each_neighbors(picture, [&](std::size_t i, std::size_t j) {
        const double brighter = static_cast<double>(
            std::max(luminance(reference.pixels[i]), luminance(reference.pixels[j])));
        if (brighter != 0.0) steps.push_back(std::abs(wrong[i] - wrong[j]) / brighter);
    });
    return steps;
}

}  // namespace

ErrorFigures compare(const Picture& picture, const Picture& reference) {
    require_same_size(picture, reference);
    double difference1 = 0;
    double difference2 = 0;
    double reference1 = 0;
    double reference2 = 0;
    double sum = 0;
    double reference_sum = 0;
    std::vector<double> relative;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double r = static_cast<double>(reference.pixels[i][c]);
            const double d = static_cast<double>(picture.pixels[i][c]) - r;
            difference1 += std::abs(d);
            difference2 += d * d;
            reference1 += std::abs(r);
            reference2 += r * r;
            sum += d;
            reference_sum += r;
        }
        if (luminance(reference.pixels[i]) == 0.0f) continue;
        relative.push_back(relative_luminance_error(picture.pixels[i], reference.pixels[i]));
    }
    ErrorFigures figures;
    figures.relative_rmse = ratio(std::sqrt(difference2), std::sqrt(reference2));
    figures.relative_l1 = ratio(difference1, reference1);
    figures.relative_bias = ratio(sum, reference_sum);
    const Worst pixel = worst_of(relative);
    figures.max_relative = pixel.max;
    figures.p999_relative = pixel.p999;
    std::vector<double> steps = steps_of(picture, reference);
    const Worst step = worst_of(steps);
    figures.max_step = step.max;
    figures.p999_step = step.p999;
    return figures;
}

std::vector<glm::vec3> heat_map(const Picture& picture, const Picture& reference, double white) {
    require_same_size(picture, reference);
    std::vector<glm::vec3> colors;
    colors.reserve(picture.size());
    for (std::size_t i = 0; i < picture.size(); ++i) {
        // A pixel that is black in both pictures is no error, although it is 0/0.
        const bool equal = picture.pixels[i] == reference.pixels[i];
        const double error = equal ? 0.0 : relative_luminance_error(picture.pixels[i], reference.pixels[i]);
        colors.push_back(false_color(error, white));
    }
    return colors;
}

}  // namespace render
