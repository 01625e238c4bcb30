#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "../bound/policy.hpp"
#include "../core/assertion.hpp"
#include "../core/lanes.hpp"
#include "../shading/receiver.hpp"
#include "../tree/light_cluster.hpp"

namespace lightcuts {

/// How much a cluster may matter at a receiver: what the probabilities of clusters are made of. Knows nothing of
/// shadows.
struct Importance {
    /// What the cluster's bound amounts to at its mean distance. Zero only where the bound is; infinite only where the
    /// bound is, since the cluster may touch the receiver.
    double expected = 0.0;
    /// Intensity over mean squared distance, finite: what clusters are compared by where one of them is infinite.
    double irradiance = 0.0;
    /// Upper bound of what the cluster contributes, summed over the channels.
    double bound = 0.0;

    /// True if no light of the cluster can contribute.
    bool is_zero() const { return !(bound > 0.0); }
    bool is_finite() const { return expected <= (std::numeric_limits<double>::max)(); }
    /// The finite number to compare by, with others of the same `by_irradiance`.
    double weight(bool by_irradiance) const { return by_irradiance ? (is_zero() ? 0.0 : irradiance) : expected; }
};

namespace detail {

/// Squared distances from a point to the points of a box.
struct Distances2 {
    double least = 0.0;
    double mean = 0.0;
};

inline Distances2 distances2(const Box& box, const glm::vec3& point) {
    const auto along = [](float lo, float hi, float x) -> Distances2 {
        const double half = 0.5 * (static_cast<double>(hi) - static_cast<double>(lo));
        const double middle = std::fabs(0.5 * (static_cast<double>(hi) + static_cast<double>(lo)) -
                                        static_cast<double>(x));
        const double gap = middle > half ? middle - half : 0.0;
        return {gap * gap, middle * middle + half * half / 3.0};
    };
    const Distances2 x = along(box.lo.x, box.hi.x, point.x), y = along(box.lo.y, box.hi.y, point.y),
                     z = along(box.lo.z, box.hi.z, point.z);
    return {x.least + y.least + z.least, x.mean + y.mean + z.mean};
}

/// The importance of a cluster whose bound per unit intensity is `unit`.
template <Light L, class S>
Importance importance_of(const LightCluster<L>& cluster, const S& unit, const glm::vec3& point) {
    Importance importance;
    for (int c = 0; c < channels_of<S>; ++c) {
        const auto u = static_cast<double>(channel(unit, c)), i = static_cast<double>(channel(cluster.intensity, c));
        if (u > 0.0 && i > 0.0) importance.bound += u * i;
    }
    if (importance.is_zero()) return importance;
    importance.irradiance = channel_sum(cluster.intensity);
    importance.expected = importance.bound;
    if constexpr (PointLight<L>) {
        const Distances2 d2 = distances2(cluster.box, point);
        importance.irradiance /= d2.mean > 1e-60 ? d2.mean : 1e-60;
        // A bound counts every light at the least distance. At the mean one, large clusters nearby are worth no more
        // than what they hold.
        if (inverse_square<L> && d2.least > 0.0) importance.expected *= d2.least / d2.mean;
    }
    return importance;
}

/// The importances of up to `lane_count` clusters of one kind: all[i] of *clusters[i].
template <class Policy, class M, Light L>
void find_importances(const Policy& policy, const Receiver<M>& receiver,
                      std::span<const LightCluster<L>* const> clusters, Importance* all) {
    using S = spectrum_of<L>;
    LIGHTCUTS_ASSERT(clusters.size() <= lane_count);
    std::array<S, lane_count> units;
    quick_bounds(policy, receiver.material, clusters.data(), clusters.size(), box_of(receiver.position), units.data());
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        all[i] = importance_of(*clusters[i], units[i], receiver.position);
    }
}

/// The importances of both children of a node. pre: not a leaf.
template <class Policy, class M, class Tree>
std::array<Importance, 2> child_importances(const Policy& policy, const Receiver<M>& receiver, const Tree& tree,
                                            std::uint32_t node) {
    using Cluster = typename Tree::cluster;
    const std::array<const Cluster*, 2> children{&tree.clusters()[tree.topology().left(node)],
                                                 &tree.clusters()[tree.topology().right(node)]};
    std::array<Importance, 2> both;
    find_importances(policy, receiver, std::span<const Cluster* const>(children), both.data());
    return both;
}

/// The importances of a forest's roots; zero for a tree without lit lights.
template <class Policy, class M, class Forest>
std::array<Importance, Forest::kinds> root_importances(const Policy& policy, const Receiver<M>& receiver,
                                                       const Forest& forest) {
    std::array<Importance, Forest::kinds> roots{};
    forest.for_each([&](std::uint32_t kind, const auto& tree) {
        if (tree.empty()) return;
        using Cluster = typename std::remove_cvref_t<decltype(tree)>::cluster;
        const Cluster* const root = &tree.clusters()[tree.topology().root()];
        find_importances(policy, receiver, std::span<const Cluster* const>(&root, 1), &roots[kind]);
    });
    return roots;
}

/// The share of a choice that goes by irradiance alone. A bound may be far above what a cluster does: without such a
/// share its siblings would be drawn too seldom, and outshine everything when they are [Hesterberg 1995, defensive
/// mixtures].
inline constexpr double defensive_share = 0.25;

/// The probabilities of clusters, in proportion to their importances but for the defensive share. Zero only where the
/// importance is. They sum to 1, or to 0 if all importances are zero.
template <std::size_t N>
std::array<double, N> probabilities_of(const std::array<Importance, N>& importances) {
    double expected = 0.0, irradiance = 0.0;
    for (const Importance& i : importances) {
        expected += i.expected;
        irradiance += i.weight(true);
    }
    std::array<double, N> probabilities{};
    if (!(expected > 0.0)) return probabilities;
    const double share = expected <= (std::numeric_limits<double>::max)() ? defensive_share : 1.0;
    for (std::size_t i = 0; i < N; ++i) {
        probabilities[i] = share * (importances[i].weight(true) / irradiance);
        if (share < 1.0) probabilities[i] += (1.0 - share) * (importances[i].expected / expected);
    }
    return probabilities;
}

}  // namespace detail

}  // namespace lightcuts
