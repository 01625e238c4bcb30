#include "pixel_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace render {

namespace {

constexpr double radius = 1.5;  ///< pixels

double gaussian(double x) { return std::exp(-2.0 * x * x) - std::exp(-2.0 * radius * radius); }

double blackman_harris(double x) {
    const double t = std::numbers::pi * (x / radius + 1.0);
    return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2.0 * t) - 0.01168 * std::cos(3.0 * t);
}

}  // namespace

/// Where a filter's integral reaches each share of the whole.
class InverseIntegral {
public:
    template <class F>
    explicit InverseIntegral(const F& filter) {
        double sum = 0.0;
        for (std::size_t i = 0; i < steps; ++i) {
            integral_[i] = sum;
            sum += filter((static_cast<double>(i) + 0.5) / steps * 2.0 * radius - radius);
        }
        integral_[steps] = sum;
        for (double& x : integral_) x /= sum;
    }
    /// From -radius to radius.
    double at(double share) const {
        const auto above = std::upper_bound(integral_.begin() + 1, integral_.end() - 1, share);
        const auto below = above - 1;
        const double within = (share - *below) / (*above - *below);
        return (static_cast<double>(below - integral_.begin()) + within) / steps * 2.0 * radius - radius;
    }

private:
    static constexpr std::size_t steps = 1024;
    std::array<double, steps + 1> integral_;
};

const std::vector<std::string>& pixel_filters() {
    static const std::vector<std::string> names = {"box", "gaussian", "blackman-harris"};
    return names;
}

PixelFilter::PixelFilter(const std::string& name) : integral_(nullptr) {
    static const InverseIntegral of_gaussian(gaussian), of_blackman_harris(blackman_harris);
    if (name == "gaussian") integral_ = &of_gaussian;
    if (name == "blackman-harris") integral_ = &of_blackman_harris;
}

glm::vec2 PixelFilter::operator()(const glm::vec2& point) const {
    if (!integral_) return point;
    return {static_cast<float>(0.5 + integral_->at(static_cast<double>(point.x))),
            static_cast<float>(0.5 + integral_->at(static_cast<double>(point.y)))};
}

}  // namespace render
