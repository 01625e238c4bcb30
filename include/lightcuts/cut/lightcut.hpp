#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ranges>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "../core/assertion.hpp"
#include "../core/reusable_list.hpp"
#include "lightcut_problem.hpp"

namespace lightcuts {

/// What shading a receiver by a cut yields.
template <Spectrum S>
struct CutResult {
    S radiance = black<S>();
    /// Sum of the error bounds of the cut's clusters, absolute radiance; infinite if a cluster that may touch the
    /// receiver is left on the cut. With automatic clamping it includes what errors do to the threshold. Beside it
    /// stands the rounding of float: 1e-5 of the radiance; and what float cannot hold: 2^-126 of all lights' intensity
    /// where transfer or visibility are smaller than that, as beyond distances of 1e18, and radiance above the largest
    /// float, of one light or of all, is the largest float.
    S error_bound = black<S>();
    /// The same with each cluster's bound times the likelihood that a PredictingOracle states: where the error is
    /// expected to be below, which nothing proves. `error_bound` if the oracle predicts nothing.
    S expected_error = black<S>();
    /// Radiance that no clamped light exceeded; infinite if there was no limit, as in automatic clamping of two or
    /// fewer.
    S clamp_threshold = make_spectrum<S>([](int) { return std::numeric_limits<float>::infinity(); });
    std::uint32_t cut_size = 0;  ///< clusters on the cut, those that cannot contribute too
    std::uint32_t queries = 0;   ///< shadow rays asked of the oracle
    std::uint32_t hidden = 0;    ///< clusters on the cut that a HidingOracle has proved to be hidden
    StopReason stop = StopReason::converged;
};

/// Storage that shading reuses; one for each thread. No allocation once warm. `Clamps`: for forests with lights that
/// may be clamped; see `scratch_of`.
template <Spectrum S, bool Clamps = false>
struct LightcutScratch {
    struct Slot {
        Refinement<CutNode<S, Clamps>> refinement;
        detail::RunningTotal<S, Clamps> total;
        detail::CutCounts counts;
        bool running = false;
    };
    std::vector<Slot> in_progress;
    ReusableList<VisibilityQuery> queries;
    std::vector<float> answers;
    std::vector<S> transmittances;  ///< answers that are spectra
};

/// The scratch for shading by a tree or a forest.
template <TreeOrForest T>
using scratch_of = LightcutScratch<forest_spectrum<T>, forest_of<T>::clamps>;

namespace detail {

/// The starting frontier is kept whatever `max_cut` is: no cut is smaller than the trees are many.
inline RefinementOptions refinement_options(const LightcutOptions& options) {
    RefinementOptions refinement;
    refinement.round_fraction = options.round_fraction;
    if (options.max_cut > 0) refinement.max_nodes = options.max_cut;
    return refinement;
}

/// Sums of estimates and bounds as a result.
template <Spectrum S>
CutResult<S> result_of(const ChannelSums<S>& radiance, const ChannelSums<S>& bound) {
    CutResult<S> result;
    result.radiance = finite(make_spectrum<S>([&](int c) { return radiance[static_cast<std::size_t>(c)]; }));
    result.error_bound = make_spectrum<S>([&](int c) { return round_up(bound[static_cast<std::size_t>(c)]); });
    return result;
}

/// The estimate from a cut as it is, and its error bound if `bound_of(node)` bounds that of each cluster. Never
/// inlined: its loop is faster alone.
template <Spectrum S, bool Clamps, class BoundOf>
[[gnu::noinline]] CutResult<S> cut_result_by(const Refinement<CutNode<S, Clamps>>& refinement,
                                             const RunningTotal<S, Clamps>& total, const CutCounts& counts,
                                             const BoundOf& bound_of) {
    ChannelSums<S> radiance{}, bound{};
    S threshold = CutResult<S>{}.clamp_threshold;
    if constexpr (Clamps) {
        using Node = CutNode<S, true>;
        const auto sums = total.clamping().sums([&](auto&& f) { refinement.for_each(f); }, total.total(),
                                                refinement.stop_reason() == StopReason::converged, bound_of,
                                                [](const Node& n, LightCount<S>& least) {
                                                    least.add(n.estimate, 1.0,
                                                              n.lights == 1.0f ? 1.0 : representative_part(n));
                                                });
        radiance = sums.clamped.total;
        threshold = sums.clamped.threshold_at_receiver(total.clamping().options());
        bound = sums.bound;
    } else {
        refinement.for_each([&](const CutNode<S>& n) {
            for (std::size_t c = 0; c < radiance.size(); ++c) {
                radiance[c] += static_cast<double>(channel(n.estimate, static_cast<int>(c)));
                bound[c] += static_cast<double>(channel(bound_of(n), static_cast<int>(c)));
            }
        });
    }
    CutResult<S> result = result_of<S>(radiance, bound);
    result.clamp_threshold = threshold;
    result.cut_size = static_cast<std::uint32_t>(refinement.size());
    result.queries = counts.queries;
    result.hidden = counts.hidden;
    result.stop = refinement.stop_reason();
    return result;
}

/// The estimate from a cut as it is, with its error bound and what `likely`, a Prediction, makes of that.
template <Spectrum S, bool Clamps, class Likely>
CutResult<S> cut_result(const Refinement<CutNode<S, Clamps>>& refinement, const RunningTotal<S, Clamps>& total,
                        const CutCounts& counts, const Likely& likely) {
    using Node = CutNode<S, Clamps>;
    CutResult<S> result = cut_result_by(refinement, total, counts, [](const Node& n) -> const S& { return n.bound; });
    result.expected_error = result.error_bound;
    if constexpr (Likely::predicts) {
        const auto expected = [&](const Node& n) {
            const auto factor = static_cast<float>(likely(n));
            return make_spectrum<S>([&](int c) { return channel(n.bound, c) * factor; });
        };
        result.expected_error = cut_result_by(refinement, total, counts, expected).error_bound;
    }
    return result;
}

}  // namespace detail

/// One receiver's lightcut, refined a round at a time: for those who stop on a time budget, look at the cut, or bring
/// their own batches. Refers to the trees, the receiver and the oracle. `shade` is the one-shot function.
template <class Forest, class R, class Oracle, class Policy = TwoStageBounds>
class Lightcut {
    static constexpr bool kept_by_value = std::is_empty_v<Oracle> && std::is_copy_constructible_v<Oracle>;

public:
    using S = typename Forest::spectrum;

    template <TreeOrForest Lights>
    Lightcut(const Lights& lights, const R& receiver, const Oracle& oracle, const LightcutOptions& options = {},
             const Policy& policy = {})
        : forest_(as_forest(lights)), receiver_(receiver), oracle_(oracle), options_(options), policy_(policy),
          refinement_options_(detail::refinement_options(options_)) {
        auto p = problem();
        refinement_.start(p);
        evaluate_fresh(p);
    }
    /// The cut would refer to a receiver that is gone.
    template <TreeOrForest Lights, class... Rest>
    Lightcut(const Lights&, const R&&, const Rest&...) = delete;
    /// The cut would refer to an oracle that is gone; one without members is kept by value.
    template <TreeOrForest Lights, class... Rest>
        requires(!kept_by_value)
    Lightcut(const Lights&, const R&, const Oracle&&, const Rest&...)
    = delete;
    /// The cut would refer to a tree that is gone.
    template <Light L, class... Rest>
    Lightcut(const LightTree<L>&&, const Rest&...) = delete;

    /// One round; false, having done nothing, when the cut is final.
    bool step() {
        auto p = problem();
        if (!refinement_.split(p, refinement_options_)) return false;
        evaluate_fresh(p);
        return true;
    }

    /// The estimate from the cut as it is.
    CutResult<S> result() const {
        return detail::cut_result(refinement_, total_, counts_, detail::Prediction<Oracle, R>(oracle_, receiver_));
    }

    /// Calls `f(node)` for each CutNode of the cut, in no particular order.
    template <class F>
    void for_each(F&& f) const {
        refinement_.for_each(f);
    }

private:
    auto problem() {
        return LightcutProblem<Forest, R, Oracle, Policy>(forest_, receiver_, oracle_, policy_, options_, total_,
                                                          counts_, queries_);
    }

    template <class P>
    void evaluate_fresh(P& p) {
        if constexpr (detail::AnswersMany<Oracle, S>) {
            p.request(refinement_.fresh());
            p.receive(refinement_.fresh(),
                      detail::ask_many(oracle_, std::span(queries_.data(), queries_.size()), answers_));
            queries_.clear();
        } else {
            p.evaluate(refinement_.fresh());
        }
        refinement_.absorb(p);
    }

    Forest forest_;
    const R& receiver_;
    [[no_unique_address]] std::conditional_t<kept_by_value, Oracle, const Oracle&> oracle_;
    LightcutOptions options_;
    Policy policy_;
    RefinementOptions refinement_options_;
    Refinement<CutNode<S, Forest::clamps>> refinement_;
    detail::RunningTotal<S, Forest::clamps> total_;
    detail::CutCounts counts_;
    ReusableList<VisibilityQuery> queries_;
    std::vector<detail::many_answer<Oracle, S>> answers_;
};

template <TreeOrForest Lights, class R, class Oracle, class Policy = TwoStageBounds>
Lightcut(const Lights&, const R&, const Oracle&, const LightcutOptions& = {}, const Policy& = {})
    -> Lightcut<forest_of<Lights>, R, Oracle, Policy>;

namespace detail {

// Never inlined: where products and sums are contracted, each copy of this code could round in its own way.

template <class Forest, class M, class Oracle, class Policy>
[[gnu::noinline]] void shade_one_by_one(const Forest& forest, std::span<const Receiver<M>> receivers,
                                        const Oracle& oracle, std::span<CutResult<typename Forest::spectrum>> results,
                                        LightcutScratch<typename Forest::spectrum, Forest::clamps>& scratch,
                                        const LightcutOptions& options, const Policy& policy) {
    const RefinementOptions refinement = refinement_options(options);
    if (scratch.in_progress.empty()) scratch.in_progress.resize(1);
    auto& slot = scratch.in_progress.front();
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        LightcutProblem<Forest, Receiver<M>, Oracle, Policy> problem(forest, receivers[i], oracle, policy, options,
                                                                     slot.total, slot.counts, scratch.queries);
        slot.refinement.run(problem, refinement);
        results[i] = cut_result(slot.refinement, slot.total, slot.counts, problem.prediction());
    }
}

template <class Forest, class M, class Oracle, class Policy>
[[gnu::noinline]] void shade_in_lock_step(const Forest& forest, std::span<const Receiver<M>> receivers,
                                          const Oracle& oracle, std::span<CutResult<typename Forest::spectrum>> results,
                                          LightcutScratch<typename Forest::spectrum, Forest::clamps>& scratch,
                                          const LightcutOptions& options, const Policy& policy) {
    using S = typename Forest::spectrum;
    const RefinementOptions refinement = refinement_options(options);
    const auto problem_of = [&](std::size_t i, auto& slot) {
        return LightcutProblem<Forest, Receiver<M>, Oracle, Policy>(forest, receivers[i], oracle, policy, options,
                                                                    slot.total, slot.counts, scratch.queries);
    };
    if (scratch.in_progress.size() < receivers.size()) scratch.in_progress.resize(receivers.size());
    scratch.queries.clear();
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        auto& slot = scratch.in_progress[i];
        auto problem = problem_of(i, slot);
        slot.refinement.start(problem);
        problem.request(slot.refinement.fresh());
        slot.running = true;
    }
    for (bool any = !receivers.empty(); any;) {
        // Step 1: one stream of shadow rays for all receivers.
        auto answers = ask_many(oracle, std::span(scratch.queries.data(), scratch.queries.size()),
                                answers_for<Oracle, S>(scratch));
        scratch.queries.clear();
        // Step 2: each takes its answers, in the order of its queries, and asks the next.
        any = false;
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            auto& slot = scratch.in_progress[i];
            if (!slot.running) continue;
            auto problem = problem_of(i, slot);
            answers = problem.receive(slot.refinement.fresh(), answers);
            slot.refinement.absorb(problem);
            slot.running = slot.refinement.split(problem, refinement);
            if (slot.running) {
                problem.request(slot.refinement.fresh());
                any = true;
            } else {
                results[i] = cut_result(slot.refinement, slot.total, slot.counts, problem.prediction());
            }
        }
    }
}

}  // namespace detail

namespace detail {

template <class R>
inline constexpr bool is_receiver = false;
template <class M>
inline constexpr bool is_receiver<Receiver<M>> = true;

/// Contiguous ranges of receivers.
template <class Rs>
concept Receivers = std::ranges::contiguous_range<Rs> && is_receiver<std::ranges::range_value_t<Rs>>;

}  // namespace detail

/// Shades receivers by lightcuts [Lightcuts 2005, section 3]: `results[i]` is the light that leaves `receivers[i]`.
/// With a batched oracle all receivers advance in lock-step, so that their shadow rays form long streams; some 16 at
/// a time are enough, and stay in the cache. The result of a receiver does not depend on the others.
/// threads: safe with one scratch each. cost: about one shadow ray and three bounds for two clusters on the cut.
/// pre: results.size() >= receivers.size().
template <TreeOrForest Lights, class M, class Oracle, class Policy = TwoStageBounds>
void shade(const Lights& lights, std::span<const Receiver<M>> receivers, const Oracle& oracle,
           std::span<CutResult<forest_spectrum<Lights>>> results, scratch_of<Lights>& scratch,
           const LightcutOptions& options = {}, const Policy& policy = {}) {
    LIGHTCUTS_ASSERT(results.size() >= receivers.size());
    const auto& forest = as_forest(lights);
    if constexpr (detail::AnswersMany<Oracle, forest_spectrum<Lights>>) {
        detail::shade_in_lock_step(forest, receivers, oracle, results, scratch, options, policy);
    } else {
        detail::shade_one_by_one(forest, receivers, oracle, results, scratch, options, policy);
    }
}

/// Shades the receivers of a vector, an array or another contiguous range, as the function that takes spans does, into
/// a contiguous range of results: a vector is resized, another needs room for all.
template <TreeOrForest Lights, detail::Receivers Rs, class Oracle, class Results, class Policy = TwoStageBounds>
    requires(std::ranges::contiguous_range<Results>&&
                 std::same_as<std::ranges::range_value_t<Results>, CutResult<forest_spectrum<Lights>>>)
void shade(const Lights& lights, const Rs& receivers, const Oracle& oracle, Results&& results,
           scratch_of<Lights>& scratch, const LightcutOptions& options = {}, const Policy& policy = {}) {
    using R = std::ranges::range_value_t<Rs>;
    using Result = CutResult<forest_spectrum<Lights>>;
    const std::size_t count = std::ranges::size(receivers);
    if constexpr (requires { results.resize(count); }) results.resize(count);
    shade(lights, std::span<const R>(std::ranges::data(receivers), count), oracle,
          std::span<Result>(std::ranges::data(results), std::ranges::size(results)), scratch, options, policy);
}

/// Shades one receiver, by a scratch: no allocation once it is warm.
template <TreeOrForest Lights, class M, class Oracle, class Policy = TwoStageBounds>
CutResult<forest_spectrum<Lights>> shade(const Lights& lights, const Receiver<M>& receiver, const Oracle& oracle,
                                         scratch_of<Lights>& scratch, const LightcutOptions& options = {},
                                         const Policy& policy = {}) {
    CutResult<forest_spectrum<Lights>> result;
    shade(lights, std::span<const Receiver<M>>(&receiver, 1), oracle,
          std::span<CutResult<forest_spectrum<Lights>>>(&result, 1), scratch, options, policy);
    return result;
}

/// Shades one receiver.
template <TreeOrForest Lights, class M, class Oracle = AlwaysVisible, class Policy = TwoStageBounds>
CutResult<forest_spectrum<Lights>> shade(const Lights& lights, const Receiver<M>& receiver, const Oracle& oracle = {},
                                         const LightcutOptions& options = {}, const Policy& policy = {}) {
    Lightcut<forest_of<Lights>, Receiver<M>, Oracle, Policy> cut(lights, receiver, oracle, options, policy);
    while (cut.step()) {}
    return cut.result();
}

}  // namespace lightcuts
