#include "bounce_light.hpp"

namespace relight {

void BounceLight::set(std::span<const glm::vec3> radiance, std::size_t size, double relative_error) {
    const lightcuts::ClusterTree& tree = patches_.tree;
    lightcuts::refit_moments(tree, moments_, [&](std::uint32_t item) { return radiance[item]; });
    approximation_.start(tree, moments_);
    const lightcuts::Moments<3>& all = moments_[tree.root()];
    const double total = (all.mean[0] + all.mean[1] + all.mean[2]) * all.leaves;
    approximation_.refine_by_error(relative_error * total, size);
    approximation_.refine_by_value(size);
    approximation_.store(cut_);
    sums_.resize(tree.size());
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        const lightcuts::Moments<3>& m = moments_[n];
        sums_[n] = {m.mean[0] * m.leaves, m.mean[1] * m.leaves, m.mean[2] * m.leaves};
    }
}

}  // namespace relight
