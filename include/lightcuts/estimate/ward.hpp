#pragma once

#include <algorithm>

#include "estimate.hpp"

namespace lightcuts {

/// Adaptive shadow testing [Ward 1994]: sorts the lights by their unshadowed contribution and tests them in falling
/// order until those that are left could add no more than `threshold` of what was found, then adds the rest scaled
/// by the visible share so far, which is gray. Not a bound: the rest may be darker or brighter than that.
/// pre: threshold >= 0. cost: linear in the lights, plus a sort, plus the rays tested, in blocks of 16.
template <TreeOrForest Lights, class M, class Oracle>
Estimate<forest_spectrum<Lights>> ward(const Lights& lights, const Receiver<M>& receiver, const Oracle& oracle,
                                       float threshold, EstimateScratch<forest_spectrum<Lights>>& scratch) {
    const auto& forest = as_forest(lights);
    using S = forest_spectrum<Lights>;
    using Contribution = typename EstimateScratch<S>::Contribution;
    constexpr std::size_t block = 16;
    scratch.contributions.clear();
    forest.for_each([&](std::uint32_t kind, const auto& tree) {
        detail::for_each_unshadowed(receiver, tree.lights(), [&](std::uint32_t i, const S& radiance) {
            scratch.contributions.push_back({radiance, i, kind});
        });
    });
    std::sort(scratch.contributions.begin(), scratch.contributions.end(),
              [](const Contribution& a, const Contribution& b) {
                  const double x = channel_sum(a.radiance), y = channel_sum(b.radiance);
                  if (x != y) return x > y;
                  return a.kind != b.kind ? a.kind < b.kind : a.light < b.light;
              });

    // sums[i]: of the contributions from i on. Added up from the faintest, since the difference of the whole and of
    // what was tested is only noise where the bright lights are shadowed.
    scratch.sums.assign(scratch.contributions.size() + 1, 0.0);
    for (std::size_t i = scratch.contributions.size(); i-- > 0;) {
        scratch.sums[i] = scratch.sums[i + 1] + channel_sum(scratch.contributions[i].radiance);
    }

    Estimate<S> result;
    detail::RadianceSum<S> found;
    double found_sum = 0.0, tested_sum = 0.0;
    std::span<const Contribution> left(scratch.contributions);
    while (!left.empty() &&
           scratch.sums[scratch.contributions.size() - left.size()] > static_cast<double>(threshold) * found_sum) {
        const auto tested = left.first((std::min)(block, left.size()));
        result.queries += detail::ask(forest, receiver, oracle, scratch, tested,
                                      [&](const Contribution& c, const auto& visibility) {
                                          found.add_seen(c.radiance, visibility);
                                          const double sum = channel_sum(c.radiance);
                                          found_sum += channel_sum(S(c.radiance * visibility));
                                          tested_sum += sum;
                                      });
        left = left.subspan(tested.size());
    }
    if (!left.empty() && tested_sum > 0.0) {
        const double visible_share = found_sum / tested_sum;
        for (const Contribution& c : left) found.add(c.radiance, visible_share);
    }
    result.radiance = found.value();
    return result;
}

/// A single estimate by Ward's adaptive shadow testing, with storage of its own. cost: it allocates.
template <TreeOrForest Lights, class M, class Oracle>
Estimate<forest_spectrum<Lights>> ward(const Lights& lights, const Receiver<M>& receiver, const Oracle& oracle,
                                       float threshold) {
    EstimateScratch<forest_spectrum<Lights>> scratch;
    return ward(as_forest(lights), receiver, oracle, threshold, scratch);
}

}  // namespace lightcuts
