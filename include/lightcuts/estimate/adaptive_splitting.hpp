#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "strata.hpp"

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

/// A node as a stratum, with what to split it for: its importance x its relative deviation, or 0 if that is not above
/// the threshold.
template <class S, class Tree>
typename EstimateScratch<S>::Stratum stratum_of(const Tree& tree, std::uint32_t kind, std::uint32_t node,
                                                const Importance& importance, const glm::vec3& point,
                                                double threshold) {
    typename EstimateScratch<S>::Stratum stratum{node, kind, tree.topology().is_leaf(node), importance, 0.0};
    if (stratum.leaf) return stratum;
    const double deviation = distance_deviation(tree.clusters()[node], point);
    if (deviation > threshold) stratum.priority = importance.expected * deviation;
    return stratum;
}

/// True if `b` is to be split before `a`; of those of infinite importance the one of larger irradiance.
template <class Stratum>
bool is_split_later(const Stratum& a, const Stratum& b) {
    if (a.priority != b.priority) return a.priority < b.priority;
    if (a.importance.irradiance != b.importance.irradiance) return a.importance.irradiance < b.importance.irradiance;
    return a.kind != b.kind ? a.kind > b.kind : a.node > b.node;
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
    using S = forest_spectrum<Lights>;
    using Stratum = typename EstimateScratch<S>::Stratum;
    const auto least = static_cast<double>(threshold);
    auto& heap = scratch.strata;
    heap.clear();
    const auto add = [&](const auto& tree, std::uint32_t kind, std::uint32_t node, const Importance& importance) {
        if (importance.is_zero()) return;
        heap.push_back(detail::stratum_of<S>(tree, kind, node, importance, receiver.position, least));
        std::push_heap(heap.begin(), heap.end(), detail::is_split_later<Stratum>);
    };
    const auto roots = detail::root_importances(policy, receiver, forest);
    forest.for_each([&](std::uint32_t kind, const auto& tree) {
        if (!tree.empty()) add(tree, kind, tree.topology().root(), roots[kind]);
    });
    while (!heap.empty() && heap.size() < samples && heap.front().priority > 0.0) {
        std::pop_heap(heap.begin(), heap.end(), detail::is_split_later<Stratum>);
        const Stratum parent = heap.back();
        heap.pop_back();
        forest.visit(parent.kind, [&](const auto& tree) {
            const auto children = detail::child_importances(policy, receiver, tree, parent.node);
            add(tree, parent.kind, tree.topology().left(parent.node), children[0]);
            add(tree, parent.kind, tree.topology().right(parent.node), children[1]);
        });
    }
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
