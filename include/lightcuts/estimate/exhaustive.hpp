#pragma once

#include "estimate.hpp"

namespace lightcuts {

/// The exact sum over all lights [Lightcuts 2005, Eq. 1], in double. A light whose terms are zero costs no shadow
/// ray. cost: linear in the lights; a batched oracle gets up to 1024 rays at once.
template <TreeOrForest Lights, class M, class Oracle>
Estimate<forest_spectrum<Lights>> exhaustive(const Lights& lights, const Receiver<M>& receiver, const Oracle& oracle,
                                             EstimateScratch<forest_spectrum<Lights>>& scratch) {
    const auto& forest = as_forest(lights);
    using S = forest_spectrum<Lights>;
    using Contribution = typename EstimateScratch<S>::Contribution;
    constexpr std::size_t batch = 1024;
    Estimate<S> result;
    detail::RadianceSum<S> sum;
    const auto flush = [&] {
        result.queries += detail::ask(
            forest, receiver, oracle, scratch, std::span<const Contribution>(scratch.contributions),
            [&](const Contribution& c, float visibility) { sum.add(c.radiance, static_cast<double>(visibility)); });
        scratch.contributions.clear();
    };
    scratch.contributions.clear();
    forest.for_each([&](std::uint32_t kind, const auto& tree) {
        detail::for_each_unshadowed(receiver, tree.lights(), [&](std::uint32_t i, const S& radiance) {
            scratch.contributions.push_back({radiance, i, kind});
            if (scratch.contributions.size() == batch) flush();
        });
    });
    flush();
    result.radiance = sum.value();
    return result;
}

/// The same in one call, by the lights of a tree or a forest.
template <TreeOrForest Lights, class M, class Oracle = AlwaysVisible>
Estimate<forest_spectrum<Lights>> exhaustive(const Lights& lights, const Receiver<M>& receiver,
                                             const Oracle& oracle = {}) {
    EstimateScratch<forest_spectrum<Lights>> scratch;
    return exhaustive(as_forest(lights), receiver, oracle, scratch);
}

}  // namespace lightcuts
