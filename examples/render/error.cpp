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
        const double error = relative_luminance_error(picture.pixels[i], reference.pixels[i]);
        // A pixel that is no number is as wrong as can be, and sortable.
        relative.push_back(std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
    }
    ErrorFigures figures;
    figures.relative_rmse = ratio(std::sqrt(difference2), std::sqrt(reference2));
    figures.relative_l1 = ratio(difference1, reference1);
    figures.relative_bias = ratio(sum, reference_sum);
    if (!relative.empty()) {
        std::sort(relative.begin(), relative.end());
        figures.max_relative = relative.back();
        figures.p999_relative = percentile(relative, 0.999);
    }
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
