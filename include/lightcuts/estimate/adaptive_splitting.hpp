#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "stratum_problem.hpp"

namespace lightcuts {

namespace detail {

/// Relative standard deviation of 1/d^2 over distances d spread evenly between the least and the largest of the
/// cluster's box [Conty Estevez and Kulla 2018, section 5.4, where it is (b - a) / sqrt(3 a b) in closed form].
/// Infinite if the box holds `point`. Of distant lights: of a ball about their directions, seen from distance 1.
template <Light L>
double distance_deviation(const LightCluster<L>& cluster, const glm::vec3& point) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double nearest, farthest;
    if constexpr (DirectionalLight<L>) {
        const double radius = 0.5 * std::sqrt(diagonal2(cluster.box));
        nearest = 1.0 - radius;
        farthest = 1.0 + radius;
    } else {
        const OffsetBox box = offsets(cluster.box, point);
        nearest = std::sqrt(min_distance2(box));
        farthest = std::sqrt(max_distance2(box));
    }
    return nearest > 0.0 ? (farthest - nearest) / std::sqrt(3.0 * nearest * farthest) : infinity;
}

}  // namespace detail

/// Estimates the sum over all lights by descending into *both* children of every node whose relative deviation is above
/// `threshold`, the largest contributions first, until there are `samples` nodes, and by stochastic descent from each
/// of them [Conty Estevez and Kulla 2018]. What to split depends on geometry only. Unbiased. The deviation is that of
/// 1/d^2 over the distances within the node, (b - a) / sqrt(3 a b): 0 far away, infinite around the receiver. A
/// threshold of 0 splits as long as `samples` allow; larger ones leave samples to be shared out in proportion to
/// importance. pre: threshold >= 0. cost: up to `samples` shadow rays, or one a tree if that is more; two importances
/// for each split and for each node that a descent visits.
template <TreeOrForest Lights, class M, class Oracle, class Policy = TwoStageBounds>
Estimate<forest_spectrum<Lights>> adaptive_splitting(const Lights& lights, const Receiver<M>& receiver,
                                                     const Oracle& oracle, float threshold, std::uint32_t samples,
                                                     std::uint64_t seed,
                                                     EstimateScratch<forest_spectrum<Lights>>& scratch,
                                                     const Policy& policy = {}) {
    const auto& forest = as_forest(lights);
    const auto least = static_cast<double>(threshold);
    const auto priority_of = [&](const auto& tree, std::uint32_t node, const Importance& importance) {
        const double deviation = detail::distance_deviation(tree.clusters()[node], receiver.position);
        return deviation > least ? importance.expected * deviation : 0.0;
    };
    detail::choose_strata(forest, receiver, policy, priority_of, {.max_nodes = samples, .round_fraction = 1.0},
                          scratch);
    detail::draw_from_strata(forest, receiver, policy, samples, seed, scratch);
    return detail::estimate_draws(forest, receiver, oracle, scratch);
}

/// A single estimate by adaptive splitting, with storage of its own. cost: it allocates.
template <TreeOrForest Lights, class M, class Oracle, class Policy = TwoStageBounds>
Estimate<forest_spectrum<Lights>> adaptive_splitting(const Lights& lights, const Receiver<M>& receiver,
                                                     const Oracle& oracle, float threshold, std::uint32_t samples,
                                                     std::uint64_t seed, const Policy& policy = {}) {
    EstimateScratch<forest_spectrum<Lights>> scratch;
    return adaptive_splitting(as_forest(lights), receiver, oracle, threshold, samples, seed, scratch, policy);
}

}  // namespace lightcuts
