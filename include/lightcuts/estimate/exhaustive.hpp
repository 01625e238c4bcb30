#pragma once

#include "estimate.hpp"

namespace lightcuts {

namespace detail {

/// The contributions of unclamped lights and the list of the others, added up under the threshold of `clamp`.
template <Spectrum S>
void add_clamped(const ClampingOptions& clamp, const ChannelSums<S>& counts, const RadianceSum<S>& unclamped,
                 std::span<const S> clamped, Estimate<S>& result) {
    const auto visit = [&](auto&& f) {
        for (const S& contribution : clamped) f(contribution, 1.0);
    };
    const auto solved = clamped_total<S>(clamp, effective_ratios<S>(clamp, counts, visit), unclamped.sum, unclamped.sum,
                                         1e-7, visit);
    result.radiance = RadianceSum<S>{solved.total}.value();
    result.clamp_threshold = solved.threshold_at_receiver(clamp);
}

}  // namespace detail

/// The exact sum over all lights [Lightcuts 2005, Eq. 1], in double; what a lightcut with the same clamping
/// approximates. A light adds no more than the largest float, after its shadow. A light whose transfer is zero costs no
/// shadow ray. cost: linear in the lights; a batched oracle gets up
/// to 1024 rays at once. memory: with clamping, the scratch holds a spectrum for each clamped light.
template <TreeOrForest Lights, class M, class Oracle>
Estimate<forest_spectrum<Lights>> exhaustive(const Lights& lights, const Receiver<M>& receiver, const Oracle& oracle,
                                             EstimateScratch<forest_spectrum<Lights>>& scratch,
                                             const ClampingOptions& clamp = {}) {
    const auto& forest = as_forest(lights);
    using S = forest_spectrum<Lights>;
    using Contribution = typename EstimateScratch<S>::Contribution;
    constexpr std::size_t batch = 1024;
    Estimate<S> result;
    detail::RadianceSum<S> sum;
    bool clamps = false;  // lights of the kind at hand
    const auto seen = [&](const Contribution& c, const auto& visibility) {
        if (!detail::is_saturated(c.radiance)) return S(c.radiance * visibility);
        return forest.visit(c.kind, [&](const auto& tree) {
            // As a cut does: one rounding more decides at a horizon.
            const auto& light = tree.lights()[c.light];
            using L = std::remove_cvref_t<decltype(light)>;
            LaneSpectra<S> transfer;
            detail::unshadowed_transfer<L>(
                receiver, 1, [&](int) -> const L& { return light; }, transfer);
            if constexpr (ClampableLight<L>) transfer[0] = detail::at_most(transfer[0], clamp.transfer);
            return finite_product(S(transfer[0] * visibility), S(detail::intensity_of(light)));
        });
    };
    const auto flush = [&] {
        result.queries += detail::ask(forest, receiver, oracle, scratch,
                                      std::span<const Contribution>(scratch.contributions),
                                      [&](const Contribution& c, const auto& visibility) {
                                          if (clamps) {
                                              scratch.clamped.push_back(seen(c, visibility));
                                          } else if (detail::is_saturated(c.radiance)) {
                                              sum.add(seen(c, visibility), 1.0);
                                          } else {
                                              sum.add_seen(c.radiance, visibility);
                                          }
                                      });
        scratch.contributions.clear();
    };
    scratch.contributions.clear();
    scratch.clamped.clear();
    forest.for_each([&](std::uint32_t kind, const auto& tree) {
        using L = typename std::remove_cvref_t<decltype(tree)>::light_type;
        const bool clamps_kind = ClampableLight<L> && clamp.has_threshold();
        if (clamps_kind != clamps) {
            flush();
            clamps = clamps_kind;
        }
        detail::for_each_unshadowed(
            receiver, tree.lights(),
            [&](std::uint32_t i, const S& radiance) {
                scratch.contributions.push_back({radiance, i, kind});
                if (scratch.contributions.size() == batch) flush();
            },
            clamp);
    });
    flush();
    result.radiance = sum.value();
    if constexpr (forest_of<Lights>::clamps) {
        if (clamp.has_threshold()) {
            detail::add_clamped(clamp, detail::counts_per_radiance(forest), sum, std::span<const S>(scratch.clamped),
                                result);
        }
    }
    return result;
}

/// The exact sum over all lights, once, with storage of its own. cost: it allocates.
template <TreeOrForest Lights, class M, class Oracle = AlwaysVisible>
Estimate<forest_spectrum<Lights>> exhaustive(const Lights& lights, const Receiver<M>& receiver,
                                             const Oracle& oracle = {}, const ClampingOptions& clamp = {}) {
    EstimateScratch<forest_spectrum<Lights>> scratch;
    return exhaustive(as_forest(lights), receiver, oracle, scratch, clamp);
}

}  // namespace lightcuts
