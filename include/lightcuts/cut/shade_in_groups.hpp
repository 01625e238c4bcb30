#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "../core/assertion.hpp"
#include "../visibility/hidden_lights.hpp"
#include "../visibility/proving_oracle.hpp"
#include "../visibility/receiver_groups.hpp"
#include "../visibility/shared_proofs.hpp"
#include "lightcut.hpp"

namespace lightcuts {

/// How receivers share proofs that lights are hidden.
struct GroupOptions {
    /// Receivers that share proofs, at most; at least 1.
    std::size_t largest_group = 128;
    /// A receiver whose cut ends at its limit is shaded once more with proofs of its own, unless those of others of its
    /// group took longer than a cut of four times the limit.
    bool own_proofs_at_limit = true;
};

/// Storage that shading in groups reuses; one for each thread. `R`: the Receiver.
template <TreeOrForest Lights, class R>
struct GroupScratch {
    scratch_of<Lights> cuts;
    SharedProofs proofs;
    ReceiverGroups groups;
    std::vector<ReceiverBox> boxes;
    std::vector<R> receivers;
    std::vector<CutResult<forest_spectrum<Lights>>> results;

    /// What proofs have taken since this was made.
    const ProofSteps& steps() const { return proofs.steps(); }
};

/// Shades receivers by lightcuts as `shade` does, and proves that clusters are hidden: once for all receivers of a
/// group of neighbors, which are found among those given. Give many at once, such as those of some hundred pixels; the
/// same ones give the same results, in whatever threads and order. A copy of `oracle` is asked. `hidden`: a
/// HiddenLights of triangles that `oracle` sees nothing through. A receiver that is shaded twice counts the shadow rays
/// of both in `queries`. threads: safe with one scratch each. pre: results.size() >= receivers.size().
template <TreeOrForest Lights, class M, class Oracle, class Hidden, class Policy = TwoStageBounds>
void shade_in_groups(const Lights& lights, std::span<const Receiver<M>> receivers, const Oracle& oracle,
                     const Hidden& hidden, std::span<CutResult<forest_spectrum<Lights>>> results,
                     GroupScratch<Lights, Receiver<M>>& scratch, const LightcutOptions& options = {},
                     const GroupOptions& groups = {}, const Policy& policy = {}) {
    static_assert(std::is_copy_constructible_v<Oracle> && !std::is_final_v<Oracle>,
                  "shading in groups adds proofs to a copy of the oracle: it has to be copyable, and not final");
    LIGHTCUTS_ASSERT(results.size() >= receivers.size());
    // As many as stay in the cache side by side.
    constexpr std::size_t most_at_once = 16;
    const ProvingOracle proving(oracle, hidden, &scratch.proofs);
    scratch.boxes.clear();
    for (const Receiver<M>& r : receivers) scratch.boxes.push_back(box_of(r));
    scratch.groups.divide(scratch.boxes, groups.largest_group);
    for (std::size_t g = 0; g < scratch.groups.size(); ++g) {
        const std::span<const std::uint32_t> members = scratch.groups.members(g);
        scratch.proofs.start(scratch.groups.box(g));
        for (std::size_t first = 0; first < members.size(); first += most_at_once) {
            const auto some = members.subspan(first, (std::min)(most_at_once, members.size() - first));
            scratch.receivers.clear();
            for (const std::uint32_t i : some) scratch.receivers.push_back(receivers[i]);
            scratch.results.resize(some.size());
            shade(lights, std::span<const Receiver<M>>(scratch.receivers), proving, std::span(scratch.results),
                  scratch.cuts, options, policy);
            for (std::size_t k = 0; k < some.size(); ++k) results[some[k]] = scratch.results[k];
        }
        if (!groups.own_proofs_at_limit || members.size() == 1) continue;
        double steps = 0.0, most_steps = 0.0;
        for (const std::uint32_t i : members) {
            if (results[i].stop != StopReason::limit) continue;
            if (steps > most_steps) break;
            const double before = scratch.steps().in_shadow_rays();
            scratch.proofs.start(scratch.boxes[i]);
            const std::uint32_t asked = results[i].queries;
            results[i] = shade(lights, receivers[i], proving, scratch.cuts, options, policy);
            // Each cluster takes about a shadow ray, and as long again for its bounds.
            steps += scratch.steps().in_shadow_rays() - before + results[i].queries + results[i].cut_size;
            most_steps += 8.0 * static_cast<double>(options.max_cut);
            results[i].queries += asked;
        }
    }
}

}  // namespace lightcuts
