#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "power.hpp"
#include "tree_sampling.hpp"

namespace lightcuts {

/// How many lights resampling looks at, and how many shadow rays it spends on them.
struct ResamplingOptions {
    std::uint32_t samples = 64;     ///< lights kept, each for one shadow ray
    std::uint32_t candidates = 32;  ///< drawn for each that is kept, and evaluated without shadows
};

namespace detail {

/// Candidates of all samples; limited, so that they can be counted.
inline std::uint32_t candidate_count(const ResamplingOptions& options) {
    const std::uint64_t count = std::uint64_t{options.samples} * options.candidates;
    constexpr std::uint32_t most = (std::numeric_limits<std::uint32_t>::max)() / 2;
    return count < most ? static_cast<std::uint32_t>(count) : most;
}

/// Keeps at most `samples` of the scratch's contributions, drawn in proportion to the sum of their channels at equal
/// steps from `u` in [0, 1) of the first, and weighs them such that the expectation of their sum, whatever of each is
/// visible, stays. All of them if they are no more.
template <Spectrum S>
void resample(std::uint32_t samples, double u, EstimateScratch<S>& scratch) {
    auto& contributions = scratch.contributions;
    if (contributions.size() <= samples) return;
    double total = 0.0;
    for (const auto& c : contributions) total += channel_sum(c.radiance);
    const double step = total / samples;
    std::size_t kept = 0;
    double before = 0.0, taken = 0.0;
    for (const auto& c : contributions) {
        const double weight = channel_sum(c.radiance);
        before += weight;
        // How many of the places (taken + u) x step lie within the weight.
        double times = 0.0;
        while (taken < samples && (taken + u) * step < before) {
            taken += 1.0;
            times += 1.0;
        }
        if (times > 0.0) contributions[kept++] = {weighted(c.radiance, times * (step / weight)), c.light, c.kind};
    }
    contributions.resize(kept);
}

/// The random number of a receiver's resampling: of none of its candidates.
inline double resampling_number(std::uint64_t seed, std::uint32_t receiver) {
    constexpr std::uint64_t purpose = 0x7265'7361'6d70'6c65;
    return uniform01(hash_keys(seed, receiver, purpose));
}

}  // namespace detail

/// Estimates the sum over all lights by resampled importance sampling [Talbot et al. 2005]: `candidates` lights a
/// sample are drawn by stochastic descent of the trees and evaluated without shadows; of all of them `samples` are
/// kept, in proportion to what they contribute, stratified, and tested for shadows. Unbiased. A light drawn or kept
/// more than once costs one evaluation and one shadow ray. cost: up to `samples` shadow rays; `samples` x `candidates`
/// lights drawn as by `tree_sampling` and evaluated.
template <TreeOrForest Lights, class M, class Oracle, class Policy = TwoStageBounds>
Estimate<forest_spectrum<Lights>> resampled_sampling(const Lights& lights, const Receiver<M>& receiver,
                                                     const Oracle& oracle, const ResamplingOptions& options,
                                                     std::uint64_t seed,
                                                     EstimateScratch<forest_spectrum<Lights>>& scratch,
                                                     const Policy& policy = {}) {
    const auto& forest = as_forest(lights);
    detail::draw_from_roots(forest, receiver, policy, detail::candidate_count(options), seed, scratch);
    detail::find_contributions(forest, receiver, scratch);
    detail::resample(options.samples, detail::resampling_number(seed, receiver.id), scratch);
    return detail::sum_visible(forest, receiver, oracle, scratch);
}

/// The same of candidates drawn in proportion to intensity, as by `power_sampling`: each is cheaper, and is less often
/// one that matters. cost: up to `samples` shadow rays; `samples` x `candidates` lights evaluated.
template <TreeOrForest Lights, class M, class Oracle>
Estimate<forest_spectrum<Lights>> resampled_sampling(const Lights& lights, const PowerDistribution& distribution,
                                                     const Receiver<M>& receiver, const Oracle& oracle,
                                                     const ResamplingOptions& options, std::uint64_t seed,
                                                     EstimateScratch<forest_spectrum<Lights>>& scratch) {
    const auto& forest = as_forest(lights);
    detail::draw_by_power(distribution, receiver.id, detail::candidate_count(options), seed, scratch);
    detail::find_contributions(forest, receiver, scratch);
    detail::resample(options.samples, detail::resampling_number(seed, receiver.id), scratch);
    return detail::sum_visible(forest, receiver, oracle, scratch);
}

/// A single estimate from candidates of the trees, with storage of its own. cost: it allocates.
template <TreeOrForest Lights, class M, class Oracle, class Policy = TwoStageBounds>
Estimate<forest_spectrum<Lights>> resampled_sampling(const Lights& lights, const Receiver<M>& receiver,
                                                     const Oracle& oracle, const ResamplingOptions& options,
                                                     std::uint64_t seed, const Policy& policy = {}) {
    EstimateScratch<forest_spectrum<Lights>> scratch;
    return resampled_sampling(as_forest(lights), receiver, oracle, options, seed, scratch, policy);
}

}  // namespace lightcuts
