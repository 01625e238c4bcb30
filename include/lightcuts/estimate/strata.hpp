#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "descent.hpp"

namespace lightcuts::detail {

/// Draws `samples` lights from the scratch's strata: one from each, and the rest in proportion to importance from
/// those that hold more than one light.
template <class Forest, class M, class Policy>
void draw_from_strata(const Forest& forest, const Receiver<M>& receiver, const Policy& policy, std::uint32_t samples,
                      std::uint64_t seed, EstimateScratch<typename Forest::spectrum>& scratch) {
    const auto& strata = scratch.strata;
    bool by_irradiance = false;
    for (const auto& s : strata) by_irradiance = by_irradiance || !s.importance.is_finite();
    const auto weight_of = [&](const auto& s) { return s.leaf ? 0.0 : s.importance.weight(by_irradiance); };
    double total = 0.0;
    for (const auto& s : strata) total += weight_of(s);
    const double rest = samples > strata.size() ? static_cast<double>(samples - strata.size()) : 0.0;
    const double rate = total > 0.0 ? rest / total : 0.0;

    scratch.draws.clear();
    double before = 0.0;
    forest.for_each([&](std::uint32_t kind, const auto& tree) {
        scratch.numbers.clear();
        for (const auto& s : strata) {
            if (s.kind != kind) continue;
            const double behind = before + weight_of(s);
            // By halves, so that rounding loses none of the rest.
            const auto count = 1 + static_cast<std::size_t>(std::floor(behind * rate + 0.5) -
                                                            std::floor(before * rate + 0.5));
            before = behind;
            const auto begin = static_cast<std::uint32_t>(scratch.numbers.size());
            add_stratified(scratch.numbers, count,
                           [&](std::size_t k) { return uniform01(hash_keys(seed, receiver.id, kind, s.node, k)); });
            typename EstimateScratch<typename Forest::spectrum>::Visit visit{
                s.node, begin, static_cast<std::uint32_t>(scratch.numbers.size()), 1.0 / static_cast<double>(count),
                1.0};
            if (s.leaf) {
                scratch.visits.push_back(visit);
                continue;
            }
            // The importances that its children would have been split by serve for the first step down.
            const auto part = probabilities_of(s.children);
            if (!any(part)) continue;
            visit.by_power = is_even(tree, s.node, receiver.position, part);
            share_out(visit, tree.topology(), part, std::span(scratch.numbers), scratch.visits);
        }
        descend(tree, kind, receiver, policy, std::span(scratch.numbers), seed, scratch);
    });
}

}  // namespace lightcuts::detail
