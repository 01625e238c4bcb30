#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../cut/refinement.hpp"
#include "strata.hpp"

namespace lightcuts {

namespace detail {

/// The choice of a cut by bounds alone, as a refinement problem: nothing is estimated and no shadow ray is asked for.
/// Clusters that cannot contribute are left out.
template <class Forest, class M, class Policy>
class BoundedCutProblem {
public:
    using node = typename EstimateScratch<typename Forest::spectrum>::Stratum;

    BoundedCutProblem(const Forest& forest, const Receiver<M>& receiver, const Policy& policy)
        : forest_(forest), receiver_(receiver), policy_(policy) {}

    void roots(std::vector<node>& out) {
        const auto importances = root_importances(policy_, receiver_, forest_);
        forest_.for_each([&](std::uint32_t kind, const auto& tree) {
            if (!tree.empty()) add(tree, kind, tree.topology().root(), importances[kind], out);
        });
    }

    void split(const node& parent, std::vector<node>& out) {
        forest_.visit(parent.kind, [&](const auto& tree) {
            const auto children = child_importances(policy_, receiver_, tree, parent.node);
            add(tree, parent.kind, tree.topology().left(parent.node), children[0], out);
            add(tree, parent.kind, tree.topology().right(parent.node), children[1], out);
        });
    }

    void evaluate(std::span<node>) {}
    double priority(const node& n) const { return n.priority; }
    double threshold() const { return 0.0; }
    bool settled(const node& n) const { return n.leaf; }

    bool before(const node& a, const node& b) const {
        if (a.importance.irradiance != b.importance.irradiance) {
            return a.importance.irradiance > b.importance.irradiance;
        }
        return a.kind != b.kind ? a.kind < b.kind : a.node < b.node;
    }

private:
    template <class Tree>
    static void add(const Tree& tree, std::uint32_t kind, std::uint32_t index, const Importance& importance,
                    std::vector<node>& out) {
        if (importance.is_zero()) return;
        const bool leaf = tree.topology().is_leaf(index);
        out.push_back({index, kind, leaf, importance, leaf ? 0.0 : importance.bound});
    }

    const Forest& forest_;
    const Receiver<M>& receiver_;
    const Policy& policy_;
};

}  // namespace detail

/// Estimates the sum over all lights from a small cut and one light of each of its clusters, drawn by stochastic
/// descent [Yuksel 2019]. The cut is refined by bounds alone to at most `samples` clusters, so that it does not depend
/// on what is drawn. Unbiased, without the bands that fixed representatives cause. cost: up to `samples` shadow rays,
/// or one a tree if that is more; two importances for each split and for each node that a descent visits.
template <TreeOrForest Lights, class M, class Oracle, class Policy = TwoStageBounds>
Estimate<forest_spectrum<Lights>> stochastic_lightcuts(const Lights& lights, const Receiver<M>& receiver,
                                                       const Oracle& oracle, std::uint32_t samples, std::uint64_t seed,
                                                       EstimateScratch<forest_spectrum<Lights>>& scratch,
                                                       const Policy& policy = {}) {
    const auto& forest = as_forest(lights);
    using Stratum = typename EstimateScratch<forest_spectrum<Lights>>::Stratum;
    detail::BoundedCutProblem<forest_of<Lights>, M, Policy> problem(forest, receiver, policy);
    scratch.refinement.run(problem, {.max_nodes = samples});
    scratch.strata.clear();
    scratch.refinement.for_each([&](const Stratum& cluster) { scratch.strata.push_back(cluster); });
    detail::draw_from_strata(forest, receiver, policy, samples, seed, scratch);
    return detail::estimate_draws(forest, receiver, oracle, scratch);
}

/// A single estimate by stochastic lightcuts, with storage of its own. cost: it allocates.
template <TreeOrForest Lights, class M, class Oracle, class Policy = TwoStageBounds>
Estimate<forest_spectrum<Lights>> stochastic_lightcuts(const Lights& lights, const Receiver<M>& receiver,
                                                       const Oracle& oracle, std::uint32_t samples, std::uint64_t seed,
                                                       const Policy& policy = {}) {
    EstimateScratch<forest_spectrum<Lights>> scratch;
    return stochastic_lightcuts(as_forest(lights), receiver, oracle, samples, seed, scratch, policy);
}

}  // namespace lightcuts
