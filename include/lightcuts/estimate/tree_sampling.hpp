#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "descent.hpp"

namespace lightcuts {

/// A light drawn by stochastic descent.
struct LightSample {
    std::uint32_t kind = 0;    ///< tree of the forest
    std::uint32_t leaf = 0;    ///< of that tree
    std::uint32_t light = 0;   ///< index into that tree's lights
    double probability = 0.0;  ///< 0: the descent ended where nothing can contribute; there is no light
};

/// The light that the random number `u` in [0, 1) draws: from the roots on, a child in proportion to its importance
/// for the receiver, and below clusters that are small and far away in proportion to intensity. Every light that can
/// contribute, shadows apart, can be drawn, as far as the bits of `u` reach. cost: two importances a level of the tree.
template <TreeOrForest Lights, class M, class Policy = TwoStageBounds>
LightSample sample_light(const Lights& lights, const Receiver<M>& receiver, double u, const Policy& policy = {}) {
    const auto& forest = as_forest(lights);
    const auto roots = detail::probabilities_of(detail::root_importances(policy, receiver, forest));
    if (!detail::any(roots)) return {};
    const std::size_t kind = detail::choose(roots, u);
    LightSample sample{.kind = static_cast<std::uint32_t>(kind), .probability = roots[kind]};
    forest.visit(sample.kind, [&](const auto& tree) {
        const ClusterTree& topology = tree.topology();
        std::uint32_t node = topology.root();
        bool by_power = false;
        while (!topology.is_leaf(node)) {
            const auto probabilities = detail::child_probabilities(policy, receiver, tree, node, by_power);
            if (!detail::any(probabilities)) {
                sample = {};
                return;
            }
            const std::size_t child = detail::choose(probabilities, u);
            node = child == 0 ? topology.left(node) : topology.right(node);
            sample.probability *= probabilities[child];
        }
        sample.leaf = node;
        sample.light = topology.item(node);
    });
    return sample;
}

/// The probability that `sample_light` draws the light at `leaf` of the tree of kind `kind` for a random number. Summed
/// over all leaves it is 1, less the probability of descents that end where nothing can contribute. pre: `leaf` is a
/// leaf of that tree. cost: two importances a level of the tree.
template <TreeOrForest Lights, class M, class Policy = TwoStageBounds>
double probability_of(const Lights& lights, const Receiver<M>& receiver, std::uint32_t kind, std::uint32_t leaf,
                      const Policy& policy = {}) {
    const auto& forest = as_forest(lights);
    double probability = detail::probabilities_of(detail::root_importances(policy, receiver, forest))[kind];
    forest.visit(kind, [&](const auto& tree) {
        const ClusterTree& topology = tree.topology();
        bool by_power = false;
        for (std::uint32_t node = topology.root(); probability > 0.0 && !topology.is_leaf(node);) {
            const auto probabilities = detail::child_probabilities(policy, receiver, tree, node, by_power);
            const std::uint32_t left = topology.left(node);
            probability *= probabilities[leaf <= left ? 0 : 1];
            node = leaf <= left ? left : topology.right(node);
        }
    });
    return probability;
}

/// What `leaves_of` says of a light of zero intensity, which is not in the tree.
inline constexpr std::uint32_t no_leaf = (std::numeric_limits<std::uint32_t>::max)();

/// The leaf of every light of a tree: for those who know a light and ask for its probability. cost: linear.
template <Light L>
std::vector<std::uint32_t> leaves_of(const LightTree<L>& tree) {
    std::vector<std::uint32_t> leaves(tree.lights().size(), no_leaf);
    for (std::uint32_t n = 0; n < tree.topology().size(); ++n) {
        if (tree.topology().is_leaf(n)) leaves[tree.topology().item(n)] = n;
    }
    return leaves;
}

namespace detail {

/// Draws `samples` lights by stochastic descent from the roots, with stratified random numbers.
template <class Forest, class M, class Policy>
void draw_from_roots(const Forest& forest, const Receiver<M>& receiver, const Policy& policy, std::uint32_t samples,
                     std::uint64_t seed, EstimateScratch<typename Forest::spectrum>& scratch) {
    scratch.draws.clear();
    const auto roots = probabilities_of(root_importances(policy, receiver, forest));
    if (!any(roots)) return;
    scratch.numbers.clear();
    add_stratified(scratch.numbers, samples, [&](std::size_t k) { return uniform01(hash_keys(seed, receiver.id, k)); });
    std::span<double> numbers(scratch.numbers);
    double begin = 0.0;
    forest.for_each([&](std::uint32_t kind, const auto& tree) {
        const double probability = roots[kind];
        if (!(probability > 0.0)) return;
        // Where rounding leaves something over behind the last tree, `remainder_in` brings it back.
        bool last = true;
        for (std::size_t k = kind + 1; k < roots.size(); ++k) last = last && !(roots[k] > 0.0);
        const auto end = last ? numbers.end() : std::lower_bound(numbers.begin(), numbers.end(), begin + probability);
        const std::span<double> own = numbers.first(static_cast<std::size_t>(end - numbers.begin()));
        numbers = numbers.subspan(own.size());
        for (double& u : own) u = remainder_in(u, begin, probability);
        begin += probability;
        scratch.visits.push_back({tree.topology().root(), 0, static_cast<std::uint32_t>(own.size()),
                                  1.0 / (samples * probability), probability});
        descend(tree, kind, receiver, policy, own, seed, scratch);
    });
}

}  // namespace detail

/// Estimates the sum over all lights from `samples` of them, drawn by stochastic descent of the trees with stratified
/// random numbers [Shirley et al. 1996; Conty Estevez and Kulla 2018]. Unbiased.
/// cost: up to `samples` shadow rays; two importances for each node that a descent visits, shared by all that do.
template <TreeOrForest Lights, class M, class Oracle, class Policy = TwoStageBounds>
Estimate<forest_spectrum<Lights>> tree_sampling(const Lights& lights, const Receiver<M>& receiver, const Oracle& oracle,
                                                std::uint32_t samples, std::uint64_t seed,
                                                EstimateScratch<forest_spectrum<Lights>>& scratch,
                                                const Policy& policy = {}) {
    const auto& forest = as_forest(lights);
    detail::draw_from_roots(forest, receiver, policy, samples, seed, scratch);
    return detail::estimate_draws(forest, receiver, oracle, scratch);
}

/// A single estimate by tree sampling, with storage of its own. cost: it allocates.
template <TreeOrForest Lights, class M, class Oracle, class Policy = TwoStageBounds>
Estimate<forest_spectrum<Lights>> tree_sampling(const Lights& lights, const Receiver<M>& receiver, const Oracle& oracle,
                                                std::uint32_t samples, std::uint64_t seed, const Policy& policy = {}) {
    EstimateScratch<forest_spectrum<Lights>> scratch;
    return tree_sampling(as_forest(lights), receiver, oracle, samples, seed, scratch, policy);
}

}  // namespace lightcuts
