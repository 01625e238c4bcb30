#include "report/methods.hpp"

#include <cstdint>

namespace benchmark {

namespace {

using render::Options;

void ward_threshold(Options& options, double value) { options.ward_threshold = static_cast<float>(value); }

void samples(Options& options, double value) { options.samples = static_cast<std::uint32_t>(value); }

template <std::uint32_t representatives>
void error_ratio(Options& options, double value) {
    options.error_ratio = static_cast<float>(value);
    options.representatives = representatives;
}

void error_ratio_of_large_cuts(Options& options, double value) {
    error_ratio<1>(options, value);
    options.max_cut = 4000;
}

/// Sums over pairs clamp by transfer, or by the share of a pixel rather than of a point: they are compared with the sum
/// that does not clamp.
void error_ratio_of_pixels(Options& options, double value) {
    options.error_ratio = static_cast<float>(value);
    options.clamp = {};
}

}  // namespace

std::vector<const ReportMethod*> report_methods(const render::Options& scene) {
    static const std::vector<double> ratios = {0.32, 0.16, 0.08, 0.04, 0.02, 0.01, 0.005};
    static const std::vector<double> counts = {4, 16, 64, 256, 1024};
    // A method joins by a line.
    static const std::vector<ReportMethod> methods = {
        {"Ward", "ward", "threshold", ward_threshold, {0.5, 0.2, 0.1, 0.05}},
        {"power", "power", "samples", samples, counts},
        {"tree sampling", "tree-sampling", "samples", samples, counts},
        {"resampled", "resampled", "samples", samples, counts},
        {"resampled by power", "resampled-power", "samples", samples, counts},
        {"adaptive splitting", "adaptive-splitting", "samples", samples, counts},
        {"stochastic lightcuts", "stochastic-lightcuts", "samples", samples, counts},
        {"lightcuts", "lightcuts", "error ratio", error_ratio<1>, ratios},
        {"lightcuts, 8 representatives", "lightcuts", "error ratio", error_ratio<8>, ratios},
        {"lightcuts of up to 4000", "lightcuts", "error ratio", error_ratio_of_large_cuts, ratios},
        {"unified cut", "unified-cut", "error ratio", error_ratio_of_pixels, ratios, true},
        {"multidimensional lightcuts", "multidimensional", "error ratio", error_ratio_of_pixels, ratios, true},
    };
    std::vector<const ReportMethod*> compared;
    for (const ReportMethod& method : methods) {
        if (!method.sums_pixels || scene.spp > 1 || scene.fog > 0.0f) compared.push_back(&method);
    }
    return compared;
}

}  // namespace benchmark
