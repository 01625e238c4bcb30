#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "estimate.hpp"
#include "importance.hpp"

namespace lightcuts::detail {

/// A number chosen for a descent keeps its random bits as it is rescaled from node to node; below this probability too
/// few are left and it is drawn afresh.
inline constexpr double least_resolution = 0x1p-24;

/// Where in [0, 1) `u` lies within the part of length `length` that begins at `begin`.
inline double remainder_in(double u, double begin, double length) {
    const double r = (u - begin) / length;
    return r > 0.0 ? (std::min)(r, 1.0 - unit_roundoff) : 0.0;
}

/// Sends the random numbers of the scratch's visits down the tree: at each node a number chooses the child into whose
/// part of [0, 1) it falls, the parts being the children's probabilities, and goes on as its place within that part. So
/// what was stratified stays so. Numbers that meet at a leaf become one drawn light; those below whose node nothing can
/// contribute are dropped. `scratch.visits` says which of `numbers`, rising within [0, 1), start where.
/// cost: two importances a node visited, however many numbers visit it; found for four nodes at a time.
template <class Tree, class M, class Policy>
void descend(const Tree& tree, std::uint32_t kind, const Receiver<M>& receiver, const Policy& policy,
             std::span<double> numbers, std::uint64_t seed, EstimateScratch<typename Tree::spectrum>& scratch) {
    using Visit = typename EstimateScratch<typename Tree::spectrum>::Visit;
    using Cluster = typename Tree::cluster;
    constexpr std::size_t most = lane_count / 2;
    const ClusterTree& topology = tree.topology();
    std::array<Visit, most> inner;
    std::array<const Cluster*, 2 * most> children;
    std::array<Importance, 2 * most> importances;
    while (!scratch.visits.empty()) {
        // Step 1: take nodes that may be bounded together, and the leaves on the way.
        std::size_t count = 0;
        while (!scratch.visits.empty() && count < most) {
            const Visit& visit = scratch.visits.back();
            const bool leaf = topology.is_leaf(visit.node);
            if (visit.begin == visit.end) {
                // No sample reached this node.
            } else if (leaf) {
                scratch.draws.push_back({topology.item(visit.node), kind, visit.weight * (visit.end - visit.begin)});
            } else {
                children[2 * count] = &tree.clusters()[topology.left(visit.node)];
                children[2 * count + 1] = &tree.clusters()[topology.right(visit.node)];
                inner[count++] = visit;
            }
            scratch.visits.pop_back();
        }
        // Step 2: bound their children side by side.
        if (count == 0) continue;
        find_importances(policy, receiver, std::span<const Cluster* const>(children.data(), 2 * count),
                         importances.data());
        // Step 3: share out their numbers.
        for (std::size_t i = 0; i < count; ++i) {
            const Visit& visit = inner[i];
            const auto part = probabilities_of(std::array{importances[2 * i], importances[2 * i + 1]});
            if (!(part[0] + part[1] > 0.0)) continue;
            const std::span<double> own = numbers.subspan(visit.begin, visit.end - visit.begin);
            double resolution = visit.resolution;
            if (resolution < least_resolution) {
                for (std::size_t k = 0; k < own.size(); ++k) {
                    own[k] = uniform01(hash_keys(seed, receiver.id, kind, visit.node, k));
                }
                std::sort(own.begin(), own.end());
                resolution = 1.0;
            }
            const auto middle = std::lower_bound(own.begin(), own.end(), part[0]);
            for (auto u = own.begin(); u != middle; ++u) *u = remainder_in(*u, 0.0, part[0]);
            for (auto u = middle; u != own.end(); ++u) *u = remainder_in(*u, part[0], part[1]);
            const auto split = visit.begin + static_cast<std::uint32_t>(middle - own.begin());
            scratch.visits.push_back(
                {topology.left(visit.node), visit.begin, split, visit.weight / part[0], resolution * part[0]});
            scratch.visits.push_back(
                {topology.right(visit.node), split, visit.end, visit.weight / part[1], resolution * part[1]});
        }
    }
}

/// The part of [0, 1) into which `u` falls, when the parts are `probabilities` long; `u` becomes its place within it.
/// pre: the probabilities sum to 1.
template <std::size_t N>
std::size_t choose(const std::array<double, N>& probabilities, double& u) {
    std::size_t chosen = 0;
    double begin = 0.0, end = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
        if (!(probabilities[i] > 0.0)) continue;
        chosen = i;
        begin = end;
        end += probabilities[i];
        if (u < end) break;
    }
    u = remainder_in(u, begin, probabilities[chosen]);
    return chosen;
}

/// Appends rising random numbers, one in each of `count` equal parts of [0, 1).
template <class Draw>
void add_stratified(std::vector<double>& numbers, std::size_t count, Draw&& draw) {
    for (std::size_t k = 0; k < count; ++k) {
        numbers.push_back(remainder_in(static_cast<double>(k) + draw(k), 0.0, static_cast<double>(count)));
    }
}

/// radiance x weight, finite.
template <Spectrum S>
S weighted(const S& radiance, double weight) {
    return finite(make_spectrum<S>([&](int c) { return static_cast<double>(channel(radiance, c)) * weight; }));
}

/// The weighted sum over the scratch's drawn lights. Those whose transfer is zero cost no shadow ray.
template <class Forest, class M, class Oracle>
Estimate<typename Forest::spectrum> estimate_draws(const Forest& forest, const Receiver<M>& receiver,
                                                   const Oracle& oracle,
                                                   EstimateScratch<typename Forest::spectrum>& scratch) {
    static_assert(Material<std::remove_cvref_t<M>>,
                  "a material needs evaluate(to_light) const, which returns a Spectrum");
    using S = typename Forest::spectrum;
    using Contribution = typename EstimateScratch<S>::Contribution;
    const auto& draws = scratch.draws;
    scratch.contributions.clear();
    LaneSpectra<S> transfer;
    for (std::size_t begin = 0; begin < draws.size();) {
        const std::uint32_t kind = draws[begin].kind;
        std::size_t end = begin + 1;
        while (end < draws.size() && end - begin < lane_count && draws[end].kind == kind) ++end;
        forest.visit(kind, [&](const auto& tree) {
            using L = typename std::remove_cvref_t<decltype(tree)>::light_type;
            const auto light_of = [&](int i) -> const L& {
                return tree.lights()[draws[begin + static_cast<std::size_t>(i)].light];
            };
            const int count = static_cast<int>(end - begin);
            unshadowed_transfer<L>(receiver, count, light_of, transfer);
            for (int i = 0; i < count; ++i) {
                const S radiance = finite_product(transfer[static_cast<std::size_t>(i)], S(intensity_of(light_of(i))));
                if (is_black(radiance)) continue;
                const auto& draw = draws[begin + static_cast<std::size_t>(i)];
                scratch.contributions.push_back({weighted(radiance, draw.weight), draw.light, kind});
            }
        });
        begin = end;
    }
    Estimate<S> result;
    RadianceSum<S> sum;
    result.queries = ask(forest, receiver, oracle, scratch, std::span<const Contribution>(scratch.contributions),
                         [&](const Contribution& c, const auto& visibility) { sum.add_seen(c.radiance, visibility); });
    result.radiance = sum.value();
    return result;
}

}  // namespace lightcuts::detail
