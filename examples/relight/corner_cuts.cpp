#include "corner_cuts.hpp"

#include <algorithm>
#include <numeric>

#include <oneapi/tbb/parallel_for.h>

namespace relight {

CornerCuts::CornerCuts(const Sites& sites, const SeenPoints& seen,
                       const std::function<void(std::uint32_t, lightcuts::PiecewiseConstant<float>&)>& read)
    : order_(seen.points.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return seen.points[a].triangle < seen.points[b].triangle;
    });
    constexpr auto unused = static_cast<std::uint32_t>(-1);
    cut_of_.assign(sites.sites.size(), unused);
    std::vector<std::uint32_t> used;
    for (std::size_t i = 0; i < order_.size(); ++i) {
        const std::uint32_t triangle = seen.points[order_[i]].triangle;
        if (i > 0 && seen.points[order_[i - 1]].triangle == triangle) continue;
        begins_.push_back(i);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t site = sites.of_triangle[triangle][k];
            if (cut_of_[site] != unused) continue;
            cut_of_[site] = static_cast<std::uint32_t>(used.size());
            used.push_back(site);
        }
    }
    begins_.push_back(order_.size());
    cuts_.resize(used.size());
    tbb::parallel_for(std::size_t{0}, used.size(), [&](std::size_t i) { read(used[i], cuts_[i]); });
}

double CornerCuts::mean_size() const {
    double sum = 0.0;
    for (const auto& cut : cuts_) sum += static_cast<double>(cut.size());
    return cuts_.empty() ? 0.0 : sum / static_cast<double>(cuts_.size());
}

}  // namespace relight
