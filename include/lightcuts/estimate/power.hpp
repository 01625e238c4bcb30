#pragma once

#include "../core/discrete_distribution.hpp"
#include "../core/random.hpp"
#include "estimate.hpp"

namespace lightcuts {

/// Chances of lights proportional to their intensities, over all kinds of a forest. Immutable; made once a scene.
class PowerDistribution {
public:
    struct Choice {
        std::uint32_t kind;
        std::uint32_t light;
        double probability;
    };

    template <TreeOrForest Lights>
    explicit PowerDistribution(const Lights& lights) {
        as_forest(lights).for_each([&](std::uint32_t, const auto& tree) {
            first_.push_back(static_cast<std::uint32_t>(choice_.size()));
            for (const auto& light : tree.lights()) choice_.add(channel_sum(detail::intensity_of(light)));
        });
        if (!empty()) choice_.prepare();
    }

    /// True if no light is lit.
    bool empty() const { return !(choice_.total() > 0.0); }

    /// The light at `u` in [0, 1) of the total. pre: !empty().
    Choice choose(double u) const {
        const auto at = static_cast<std::uint32_t>(choice_(u));
        std::uint32_t kind = 0;
        while (kind + 1 < first_.size() && first_[kind + 1] <= at) ++kind;
        return {kind, at - first_[kind], choice_.probability(at)};
    }

private:
    detail::DiscreteDistribution choice_;
    std::vector<std::uint32_t> first_;  ///< of each kind
};

/// Estimates the sum over all lights from `samples` of them, drawn in proportion to intensity and stratified.
/// Unbiased. cost: `samples` lights evaluated and shadow rays, whatever the number of lights.
template <TreeOrForest Lights, class M, class Oracle>
Estimate<forest_spectrum<Lights>> power_sampling(const Lights& lights, const PowerDistribution& distribution,
                                                 const Receiver<M>& receiver, const Oracle& oracle,
                                                 std::uint32_t samples, std::uint64_t seed,
                                                 EstimateScratch<forest_spectrum<Lights>>& scratch) {
    const auto& forest = as_forest(lights);
    using S = forest_spectrum<Lights>;
    using Contribution = typename EstimateScratch<S>::Contribution;
    Estimate<S> result;
    if (distribution.empty()) return result;
    scratch.contributions.clear();
    for (std::uint32_t k = 0; k < samples; ++k) {
        const double jitter = uniform01(hash_keys(seed, receiver.id, k));
        const auto choice = distribution.choose((k + jitter) / samples);
        const auto weight = static_cast<float>(1.0 / (choice.probability * samples));
        forest.visit(choice.kind, [&](const auto& tree) {
            detail::for_each_unshadowed(
                receiver, tree.lights().subspan(choice.light, 1), [&](std::uint32_t, const S& radiance) {
                    scratch.contributions.push_back({finite(S(radiance * weight)), choice.light, choice.kind});
                });
        });
    }
    detail::RadianceSum<S> sum;
    result.queries = detail::ask(
        forest, receiver, oracle, scratch, std::span<const Contribution>(scratch.contributions),
        [&](const Contribution& c, const auto& visibility) { sum.add_seen(c.radiance, visibility); });
    result.radiance = sum.value();
    return result;
}

/// A single estimate by power sampling, with storage of its own. cost: it allocates.
template <TreeOrForest Lights, class M, class Oracle>
Estimate<forest_spectrum<Lights>> power_sampling(const Lights& lights, const PowerDistribution& distribution,
                                                 const Receiver<M>& receiver, const Oracle& oracle,
                                                 std::uint32_t samples, std::uint64_t seed) {
    EstimateScratch<forest_spectrum<Lights>> scratch;
    return power_sampling(as_forest(lights), distribution, receiver, oracle, samples, seed, scratch);
}

}  // namespace lightcuts
