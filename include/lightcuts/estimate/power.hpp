#pragma once

#include "../core/discrete_distribution.hpp"
#include "../core/random.hpp"
#include "descent.hpp"

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

namespace detail {

/// Draws `samples` lights in proportion to intensity, with stratified random numbers.
template <Spectrum S>
void draw_by_power(const PowerDistribution& distribution, std::uint32_t receiver, std::uint32_t samples,
                   std::uint64_t seed, EstimateScratch<S>& scratch) {
    scratch.draws.clear();
    if (distribution.empty()) return;
    for (std::uint32_t k = 0; k < samples; ++k) {
        const double jitter = uniform01(hash_keys(seed, receiver, k));
        const auto choice = distribution.choose((k + jitter) / samples);
        const double weight = 1.0 / (choice.probability * samples);
        // Stratified numbers rise, so a light that is drawn again is drawn at once.
        auto& draws = scratch.draws;
        if (!draws.empty() && draws.back().light == choice.light && draws.back().kind == choice.kind) {
            draws.back().weight += weight;
        } else {
            draws.push_back({choice.light, choice.kind, weight});
        }
    }
}

}  // namespace detail

/// Estimates the sum over all lights from `samples` of them, drawn in proportion to intensity and stratified.
/// Unbiased. cost: up to `samples` lights evaluated and shadow rays, whatever the number of lights; a light drawn more
/// than once counts once.
template <TreeOrForest Lights, class M, class Oracle>
Estimate<forest_spectrum<Lights>> power_sampling(const Lights& lights, const PowerDistribution& distribution,
                                                 const Receiver<M>& receiver, const Oracle& oracle,
                                                 std::uint32_t samples, std::uint64_t seed,
                                                 EstimateScratch<forest_spectrum<Lights>>& scratch) {
    detail::draw_by_power(distribution, receiver.id, samples, seed, scratch);
    return detail::estimate_draws(as_forest(lights), receiver, oracle, scratch);
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
