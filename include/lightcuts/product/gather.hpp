#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "../core/reusable_list.hpp"
#include "../cut/lightcut.hpp"
#include "gather_forest.hpp"
#include "product_problem.hpp"
#include "timed_forest.hpp"

namespace lightcuts {

/// What a sum over pairs of gather points and lights yields.
template <Spectrum S>
struct GatherResult : CutResult<S> {
    /// The largest bound of a pair of clusters left on the cut, in each channel: at most the error ratio times the sum
    /// of the total and a tenth of the adaptation where the refinement has converged, and 1 % more with automatic
    /// clamping, under which a pair's bound is no more than its lights may add. `error_bound` is the sum of all, and
    /// with automatic clamping what the errors do to the threshold too.
    S largest_bound = black<S>();
    double pairs = 0.0;  ///< gather points times lights
};

/// Storage that `gather` reuses; one for each thread. No allocation once warm. `Clamps`: some lights may be clamped.
template <Spectrum S, bool Clamps = false>
struct GatherScratch {
    using Node = ProductNode<S, Clamps>;

    Refinement<Node> refinement;
    detail::ProductTotal<S, Clamps> total;
    [[no_unique_address]] detail::PairLightsIf<S, Clamps> lights;
    ReusableList<Node> redrawn;
    ReusableList<VisibilityQuery> queries;
    std::vector<float> answers;
    std::vector<S> transmittances;         ///< answers that are spectra
    LightcutScratch<S, Clamps> one_point;  ///< for sums over a single gather point
};

namespace detail {

template <class Lights>
inline constexpr bool is_timed_forest = false;
template <Light... Ls>
inline constexpr bool is_timed_forest<TimedForest<Ls...>> = true;

template <Light... Ls>
TimedForest<Ls...> without_instants(const LightForest<Ls...>& forest) {
    static_assert(!(TimedLight<Ls> || ...), "lights with instants need a TimedForest, which says how many there are");
    return TimedForest<Ls...>(forest);
}

template <class T>
struct GatherLights {};
template <TreeOrForest T>
struct GatherLights<T> {
    using type = decltype(without_instants(std::declval<const forest_of<T>&>()));
};
template <Light... Ls>
struct GatherLights<TimedForest<Ls...>> {
    using type = TimedForest<Ls...>;
};

}  // namespace detail

/// A LightTree, a LightForest or a TimedForest.
template <class T>
concept GatherableLights = requires {
    typename detail::GatherLights<std::remove_cvref_t<T>>::type;
};

/// The scratch for gathering from such lights.
template <GatherableLights T>
using gather_scratch_of = GatherScratch<typename detail::GatherLights<std::remove_cvref_t<T>>::type::spectrum,
                                        detail::GatherLights<std::remove_cvref_t<T>>::type::forest_type::clamps>;

namespace detail {

/// The most that a node of a cut may be off by where no light adds more than `threshold`.
template <Spectrum S, class Node>
S clamped_bound(const Node& n, const S& threshold) {
    if constexpr (std::is_empty_v<typename Node::LightCount>) {
        return n.bound;
    } else {
        return make_spectrum<S>([&](int c) {
            const double most = lights_in(n.lights, static_cast<std::size_t>(c)) *
                                static_cast<double>(channel(threshold, c));
            const float bound = channel(n.bound, c);
            return static_cast<double>(bound) > most ? round_up(most) : bound;
        });
    }
}

/// The sum over one gather point: its lightcut.
template <class Forest, class G, class Oracle, class Scratch, class Policy>
GatherResult<typename Forest::spectrum> gather_at_one_point(const Forest& forest, const G& point, const Oracle& oracle,
                                                            Scratch& scratch, const ProductOptions& product,
                                                            const Policy& policy) {
    using S = typename Forest::spectrum;
    LightcutOptions options = product.cut;
    options.seed = hash_keys(options.seed, product.id);
    // The least that it is of a channel: the threshold is then at most what it is of the sum.
    options.adaptation /= channel_max(point.strength);
    GatherResult<S> result{shade(forest, point.receiver, oracle, scratch, options, policy)};
    result.radiance = finite_product(result.radiance, point.strength);
    const auto scaled = [&](const S& bound) {
        return make_spectrum<S>([&](int c) {
            const double b = static_cast<double>(channel(bound, c)),
                         s = static_cast<double>(channel(point.strength, c));
            return s > 0.0 ? round_up(b * s) : 0.0f;
        });
    };
    result.error_bound = scaled(result.error_bound);
    S largest = black<S>();
    scratch.in_progress.front().refinement.for_each(
        [&](const auto& n) { largest = larger_channels(largest, clamped_bound<S>(n, result.clamp_threshold)); });
    result.largest_bound = scaled(largest);
    result.clamp_threshold = make_spectrum<S>([&](int c) {
        const float s = channel(point.strength, c);
        return s > 0.0f ? s * channel(result.clamp_threshold, c) : std::numeric_limits<float>::infinity();
    });
    result.pairs = static_cast<double>(forest.light_count());
    return result;
}

template <class Lights, class Points, class Oracle, class Scratch, class Policy>
GatherResult<typename Lights::spectrum> gather_pairs(const Lights& lights, const Points& points, const Oracle& oracle,
                                                     Scratch& scratch, const ProductOptions& options,
                                                     const Policy& policy) {
    using S = typename Lights::spectrum;
    constexpr bool clamps = Lights::forest_type::clamps;
    using Node = ProductNode<S, clamps>;
    if constexpr (!Lights::timed) {
        if (points.point_count() == 1 && !options.redraw) {
            GatherResult<S> result;
            points.for_each([&](std::uint32_t, const auto& tree) {
                if (tree.empty()) return;
                result = gather_at_one_point(lights.forest(), tree.point(tree.topology().root()), oracle,
                                             scratch.one_point, options, policy);
            });
            return result;
        }
    }
    std::uint32_t queries = 0;
    ProductProblem<Lights, Points, Oracle, Policy> problem(lights, points, oracle, policy, options, scratch.total,
                                                           scratch.lights, queries, scratch.queries);
    const RefinementOptions refinement = refinement_options(options.cut);
    const auto evaluate = [&](std::span<Node> fresh) {
        if constexpr (AnswersMany<Oracle, S>) {
            scratch.queries.clear();
            problem.request(fresh);
            problem.receive(fresh,
                            ask_many(oracle, std::span(std::as_const(scratch.queries).data(), scratch.queries.size()),
                                     answers_for<Oracle, S>(scratch)));
        } else {
            problem.evaluate(fresh);
        }
    };
    scratch.refinement.start(problem);
    do {
        evaluate(scratch.refinement.fresh());
        scratch.refinement.absorb(problem);
    } while (scratch.refinement.split(problem, refinement));

    if (options.redraw) {
        scratch.redrawn.clear();
        scratch.redrawn.reserve(scratch.refinement.size());
        scratch.refinement.for_each([&](const Node& n) {
            scratch.redrawn.append(n);
            problem.redraw(scratch.redrawn[scratch.redrawn.size() - 1]);
        });
        evaluate(std::span<Node>(scratch.redrawn.data(), scratch.redrawn.size()));
    }
    const auto visit = [&](auto&& f) {
        if (!options.redraw) return scratch.refinement.for_each(f);
        for (const Node& n : std::span<const Node>(scratch.redrawn.data(), scratch.redrawn.size())) f(n);
    };
    ChannelSums<S> radiance{}, bound{}, threshold{};
    threshold.fill(std::numeric_limits<double>::infinity());
    if constexpr (clamps) {
        const bool found = !options.redraw && scratch.refinement.stop_reason() == StopReason::converged;
        const auto sums = scratch.total.clamping().sums(
            visit, scratch.total.total(), found, [](const Node& n) -> const S& { return n.bound; },
            [&](const Node& n, LightCount<S>& least) { problem.add_certain(n, least); });
        radiance = sums.clamped.total;
        threshold = sums.clamped.threshold;
        bound = sums.bound;
    } else {
        visit([&](const Node& n) {
            for (std::size_t c = 0; c < bound.size(); ++c) {
                radiance[c] += static_cast<double>(channel(n.estimate, static_cast<int>(c)));
                bound[c] += static_cast<double>(channel(n.bound, static_cast<int>(c)));
            }
        });
    }
    GatherResult<S> result{result_of<S>(radiance, bound)};
    result.clamp_threshold = make_spectrum<S>([&](int c) { return threshold[static_cast<std::size_t>(c)]; });
    visit([&](const Node& n) {
        result.largest_bound = larger_channels(result.largest_bound, clamped_bound<S>(n, result.clamp_threshold));
    });
    result.cut_size = static_cast<std::uint32_t>(scratch.refinement.size());
    result.queries = queries;
    result.stop = scratch.refinement.stop_reason();
    result.pairs = static_cast<double>(points.point_count()) * static_cast<double>(lights.forest().light_count());
    return result;
}

}  // namespace detail

/// Sums up what all lights send to all gather points, each times the point's strength, by one cut through the graph of
/// pairs of clusters [Multidimensional Lightcuts 2006]: a pixel, a light-map texel, a probe. `radiance` of the result
/// is the sum of strength x lobe x geometric term x visibility x intensity over pairs that exist at one instant.
/// `lights`: a LightTree, a LightForest, or a TimedForest where some lights exist at one instant each.
/// ClampableLights may be clamped by transfer, and by ratio: no light adds more than that share of the sum over all
/// gather points. A gather point's part of it is as its strength, in every channel, so that a light adds at most the
/// same radiance per strength at each; a light of one instant adds its share at the gather points of that instant. For
/// one gather point, or many at one place, that is the clamping of lightcuts, which takes strength to be 1. The
/// threshold in the result is of the sum, strengths included. A BoundedOracle's bounds of clusters are not asked, but
/// at a single point. pre: where lights have instants, `points` was built with as many. threads: safe with one scratch
/// and one GatherForest each. cost: about one shadow ray for two pairs on the cut, and the bounds of four pairs; of
/// lobes without an envelope, such as sums, a bound takes as long as there are points below. The sum over a single
/// gather point is its lightcut.
///
/// throws: invalid_input if `options` ask for clamping by radiance, or the instants of lights and points differ
template <GatherableLights Lights, AnyGatherPoint... Gs, class Oracle, class Policy = TwoStageBounds>
GatherResult<typename GatherForest<Gs...>::spectrum> gather(const Lights& lights, const GatherForest<Gs...>& points,
                                                            const Oracle& oracle, gather_scratch_of<Lights>& scratch,
                                                            const ProductOptions& options = {},
                                                            const Policy& policy = {}) {
    if (options.cut.clamp.radiance < std::numeric_limits<float>::infinity()) {
        LIGHTCUTS_THROW(invalid_input("gather: lights may be clamped by transfer or share, not by radiance"));
    }
    if constexpr (detail::is_timed_forest<Lights>) {
        if (Lights::timed && points.instants() != lights.instants()) {
            LIGHTCUTS_THROW(invalid_input("gather: the lights have " + std::to_string(lights.instants()) +
                                          " instants, the trees of gather points were built with " +
                                          std::to_string(points.instants()) + "; build them with as many"));
        }
        return detail::gather_pairs(lights, points, oracle, scratch, options, policy);
    } else {
        return detail::gather_pairs(detail::without_instants(as_forest(lights)), points, oracle, scratch, options,
                                    policy);
    }
}

namespace detail {

/// Contiguous ranges of gather points.
template <class Ps>
concept GatherPoints = std::ranges::contiguous_range<Ps> && AnyGatherPoint<std::ranges::range_value_t<Ps>>;

}  // namespace detail

/// Sums up what all lights send to the gather points of a vector, an array or another contiguous range of one type, as
/// the function that takes a GatherForest does. `tree`: how the tree of gather points is built.
template <GatherableLights Lights, detail::GatherPoints Ps, class Oracle = AlwaysVisible, class Policy = TwoStageBounds>
GatherResult<typename std::ranges::range_value_t<Ps>::spectrum> gather(const Lights& lights, const Ps& points,
                                                                       const Oracle& oracle = {},
                                                                       const ProductOptions& options = {},
                                                                       GatherTreeOptions tree = {},
                                                                       const Policy& policy = {}) {
    using G = std::ranges::range_value_t<Ps>;
    GatherForest<G> forest;
    if constexpr (detail::is_timed_forest<Lights>) tree.instants = lights.instants();
    forest.build(std::span<const G>(std::ranges::data(points), std::ranges::size(points)), tree);
    gather_scratch_of<Lights> scratch;
    return gather(lights, forest, oracle, scratch, options, policy);
}

}  // namespace lightcuts
