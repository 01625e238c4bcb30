#pragma once

#include <cstdint>

#include "stratum_problem.hpp"

namespace lightcuts {

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
    const auto bound_of = [](const auto&, std::uint32_t, const Importance& importance) { return importance.bound; };
    detail::choose_strata(forest, receiver, policy, bound_of, {.max_nodes = samples}, scratch);
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
