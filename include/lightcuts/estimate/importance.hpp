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
#include "../core/vectorized.hpp"
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

/// Squared distances from a point to the points of a box: the mean, and the share of it that the least is.
struct Distances2 {
    double mean = 0.0;
    double least_share = 0.0;
};

inline Distances2 distances2(const Box& box, const glm::vec3& point) {
    double least = 0.0, mean = 0.0;
    for (int k = 0; k < 3; ++k) {
        const auto low = static_cast<double>(box.lo[k]), high = static_cast<double>(box.hi[k]);
        const double half = 0.5 * (high - low);
        const double middle = std::fabs(0.5 * (high + low) - static_cast<double>(point[k]));
        const double gap = middle > half ? middle - half : 0.0;
        least += gap * gap;
        mean += middle * middle + half * half / 3.0;
    }
    return {mean, mean > 0.0 ? least / mean : 0.0};
}

/// The same of several boxes in float; of no use where a mean is not `in_range_of_lanes`.
LIGHTCUTS_VECTORIZED inline void distances2(const LaneVectors& lo, const LaneVectors& hi, const glm::vec3& point,
                                            Lanes& mean, Lanes& least_share) {
    alignas(32) Lanes least{}, sum{};
    for (int k = 0; k < 3; ++k) {
        const float x = point[k];
        for (int i = 0; i < lane_count; ++i) {
            const float half = 0.5f * hi.x[k][i] - 0.5f * lo.x[k][i];
            const float middle = magnitude(0.5f * hi.x[k][i] + 0.5f * lo.x[k][i] - x);
            const float gap = larger(middle - half, 0.0f);
            least[i] += gap * gap;
            sum[i] += middle * middle + half * half * (1.0f / 3.0f);
        }
    }
    for (int i = 0; i < lane_count; ++i) {
        mean[i] = sum[i];
        least_share[i] = least[i] / larger(sum[i], 1e-37f);
    }
}

inline bool in_range_of_lanes(float distance2) { return distance2 > 1e-25f && distance2 < 1e34f; }

/// The importances of up to `lane_count` clusters of one kind: all[i] of *clusters[i].
template <class Policy, class M, Light L>
void find_importances(const Policy& policy, const Receiver<M>& receiver,
                      std::span<const LightCluster<L>* const> clusters, Importance* all) {
    using S = spectrum_of<L>;
    LIGHTCUTS_ASSERT(!clusters.empty() && clusters.size() <= lane_count);
    std::array<S, lane_count> units;
    quick_bounds(policy, receiver.material, clusters.data(), clusters.size(), box_of(receiver.position), units.data());
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        double bound = 0.0;
        for (int c = 0; c < channels_of<S>; ++c) {
            const double product = static_cast<double>(channel(units[i], c)) *
                                   static_cast<double>(channel(clusters[i]->intensity, c));
            if (product > 0.0) bound += product;  // 0 x infinity is a certain zero
        }
        all[i] = {bound, bound > 0.0 ? channel_sum(clusters[i]->intensity) : 0.0, bound};
    }
    if constexpr (PointLight<L>) {
        LaneVectors lo, hi;
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            lo.set(static_cast<int>(i), clusters[i]->box.lo);
            hi.set(static_cast<int>(i), clusters[i]->box.hi);
        }
        repeat_last(lo, static_cast<int>(clusters.size()));
        repeat_last(hi, static_cast<int>(clusters.size()));
        alignas(32) Lanes mean, least_share;
        distances2(lo, hi, receiver.position, mean, least_share);
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            Distances2 d2{static_cast<double>(mean[i]), static_cast<double>(least_share[i])};
            if (!in_range_of_lanes(mean[i])) d2 = distances2(clusters[i]->box, receiver.position);
            all[i].irradiance /= d2.mean > 1e-60 ? d2.mean : 1e-60;
            // A bound counts every light at the least distance. At the mean one, large clusters nearby are worth no
            // more than what they hold.
            if (inverse_square<L> && d2.least_share > 0.0) all[i].expected *= d2.least_share;
        }
    }
}

/// True if the lights of a cluster, seen from `point`, lie in nearly one direction at nearly one distance, and emit
/// about nearly one axis.
template <Light L>
bool is_compact(const LightCluster<L>& cluster, const glm::vec3& point) {
    constexpr double largest_diagonal = 0.3;    // over the distance
    constexpr float largest_sin2_half = 0.06f;  // of half the angle of the cone of axes
    if constexpr (LightCluster<L>::oriented) {
        if (cluster.cone.sin2_half > largest_sin2_half) return false;
    }
    double distance2 = 1.0;
    if constexpr (PointLight<L>) {
        const glm::dvec3 middle = 0.5 * (glm::dvec3(cluster.box.lo) + glm::dvec3(cluster.box.hi)) - glm::dvec3(point);
        distance2 = dot(middle, middle);
    }
    return diagonal2(cluster.box) <= largest_diagonal * largest_diagonal * distance2;
}

/// The probabilities of a node's children in proportion to intensity. pre: not a leaf.
template <class Tree>
std::array<double, 2> power_shares(const Tree& tree, std::uint32_t node) {
    const double left = channel_sum(tree.clusters()[tree.topology().left(node)].intensity);
    const double right = channel_sum(tree.clusters()[tree.topology().right(node)].intensity);
    return {left / (left + right), right / (left + right)};
}

/// How many nodes' children are bounded side by side.
inline constexpr std::size_t parents_at_once = lane_count / 2;

/// The importances of both children, the left one first, of up to `parents_at_once` nodes, none a leaf: all[i] of
/// nodes[i].
template <class Policy, class M, class Tree>
void find_child_importances(const Policy& policy, const Receiver<M>& receiver, const Tree& tree,
                            std::span<const std::uint32_t> nodes, std::array<Importance, 2>* all) {
    using Cluster = typename Tree::cluster;
    std::array<const Cluster*, lane_count> children;
    std::array<Importance, lane_count> importances;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        children[2 * i] = &tree.clusters()[tree.topology().left(nodes[i])];
        children[2 * i + 1] = &tree.clusters()[tree.topology().right(nodes[i])];
    }
    find_importances(policy, receiver, std::span<const Cluster* const>(children).first(2 * nodes.size()),
                     importances.data());
    for (std::size_t i = 0; i < nodes.size(); ++i) all[i] = {importances[2 * i], importances[2 * i + 1]};
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

/// True if nothing is known by which to tell the lights of a node apart but their intensities: it is compact, and
/// `part`, the probabilities of its children, are nearly as intensities alone would have them. pre: not a leaf.
template <class Tree>
bool is_even(const Tree& tree, std::uint32_t node, const glm::vec3& point, const std::array<double, 2>& part) {
    constexpr double largest_difference = 0.125;
    const double difference = part[0] - power_shares(tree, node)[0];
    return std::fabs(difference) <= largest_difference && is_compact(tree.clusters()[node], point);
}

/// The probabilities of a node's children, on a way down from the root on which `by_power` is false at first, and true
/// once intensities decide. pre: not a leaf.
template <class Policy, class M, class Tree>
std::array<double, 2> child_probabilities(const Policy& policy, const Receiver<M>& receiver, const Tree& tree,
                                          std::uint32_t node, bool& by_power) {
    if (by_power) return power_shares(tree, node);
    std::array<Importance, 2> children;
    find_child_importances(policy, receiver, tree, std::span(&node, 1), &children);
    const auto part = probabilities_of(children);
    by_power = is_even(tree, node, receiver.position, part);
    return part;
}

/// True unless all of what `probabilities_of` returned is zero.
inline bool any(const auto& probabilities) {
    for (const double probability : probabilities) {
        if (probability > 0.0) return true;
    }
    return false;
}

}  // namespace detail

}  // namespace lightcuts
