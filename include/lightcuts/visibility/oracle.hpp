#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "../core/assertion.hpp"
#include "../core/box.hpp"
#include "../core/spectrum.hpp"
#include "../light/light.hpp"
#include "query.hpp"

namespace lightcuts {

namespace detail {
/// What an oracle may say of one light of spectrum `S`.
template <class A, class S>
concept VisibilityAnswer = std::convertible_to<A, float> || std::same_as<std::remove_cvref_t<A>, S>;
}  // namespace detail

/// Answers whether `light` reaches `receiver`: `bool`, the fraction in [0, 1] that gets through, or such a fraction for
/// each channel, as a spectrum of the light's type: through colored glass.
/// It must be safe to call from several threads if the caller shades on several.
template <class O, class R, class L>
concept ScalarOracle = requires(const O& visible, const R& receiver, const L& light) {
    { visible(receiver, light) } -> detail::VisibilityAnswer<spectrum_of<L>>;
};

/// Answers many shadow rays at once: `answers[i]` is the fraction in [0, 1] of `queries[i]`. Queries of one call may
/// come from several receivers; their order is the same in every run.
template <class O>
concept BatchedOracle = requires(const O& visible, std::span<const VisibilityQuery> queries, std::span<float> answers) {
    visible.many(queries, answers);
};

/// A batched oracle with an answer for each channel: `answers[i]` is a spectrum of fractions in [0, 1].
/// A cut refines until every channel has converged, which one without any light never does: where tints have a channel
/// of zero, cuts grow to their limit. A BoundedOracle does not help, as its bound is one float for all channels.
template <class O, class S>
concept TintingOracle = !std::same_as<S, float> &&
                        requires(const O& visible, std::span<const VisibilityQuery> queries, std::span<S> answers) {
    visible.many(queries, answers);
};

namespace detail {

template <class O, class S>
concept AnswersMany = BatchedOracle<O> || TintingOracle<O, S>;

/// A second `many` beside that of `O`, if it has one: then the name is ambiguous.
struct OtherMany {
    int many;
};
template <class O>
struct WithOtherMany : O, OtherMany {};

/// True if `O` has a member `many`, whatever it is.
template <class O>
constexpr bool has_many() {
    if constexpr (std::is_class_v<O> && !std::is_final_v<O>) {
        return !requires { &WithOtherMany<O>::many; };
    } else {
        return false;
    }
}

/// True; says so if an oracle that answers about one light has a `many` that cannot be called.
template <class O, class S>
constexpr bool is_many_usable() {
    static_assert(AnswersMany<O, S> || !has_many<O>(),
                  "this oracle's many cannot be called, so it would be asked one light at a time: it has to be "
                  "void many(std::span<const lightcuts::VisibilityQuery>, std::span<float>) const, with floats or the "
                  "lights' spectrum");
    return true;
}

}  // namespace detail

/// What every algorithm asks of visibility: one of the forms above. Where several exist, `many` is used, and the one
/// with spectra. A `many` with other arguments, or that is not const, is an error and not ignored.
template <class O, class R, class L>
concept VisibilityOracle = (ScalarOracle<O, R, L> && detail::is_many_usable<O, spectrum_of<L>>()) || BatchedOracle<O> ||
                           TintingOracle<O, spectrum_of<L>>;

namespace detail {

/// What `many` answers about lights of spectrum `S`.
template <class O, class S>
using many_answer = std::conditional_t<TintingOracle<O, S>, S, float>;

/// Whether every channel is in [0, 1].
template <Spectrum A>
constexpr bool is_fraction(const A& answer) {
    for (int c = 0; c < channels_of<A>; ++c) {
        if (!(channel(answer, c) >= 0.0f && channel(answer, c) <= 1.0f)) return false;
    }
    return true;
}

/// A single answer as what light is multiplied by: a float or a spectrum. pre: is_fraction
template <class S, class A>
constexpr auto as_factor(const A& answer) {
    if constexpr (std::same_as<A, S>) {
        LIGHTCUTS_ASSERT(is_fraction(answer));
        return answer;
    } else {
        LIGHTCUTS_ASSERT(is_fraction(static_cast<float>(answer)));
        return static_cast<float>(answer);
    }
}

/// Where a scratch keeps what `many` answers.
template <class O, class S, class Scratch>
std::vector<many_answer<O, S>>& answers_for(Scratch& scratch) {
    if constexpr (TintingOracle<O, S>) {
        return scratch.transmittances;
    } else {
        return scratch.answers;
    }
}

/// The answers to `queries`, in their order, each a fraction; `answers` is storage.
template <class O, class A>
std::span<const A> ask_many(const O& oracle, std::span<const VisibilityQuery> queries, std::vector<A>& answers) {
    answers.resize(queries.size());
    if (!queries.empty()) oracle.many(queries, std::span(answers));
    LIGHTCUTS_ASSERT(std::all_of(answers.begin(), answers.end(), is_fraction<A>));
    return answers;
}

}  // namespace detail

/// Unit directions towards distant lights, as opposed to positions.
struct DirectionBox {
    Box box;
};

/// Where the lights of a cluster of kind `L` are.
template <class L>
using place_box = std::conditional_t<DirectionalLight<L>, DirectionBox, Box>;

/// An oracle that also says of a whole cluster how much can be visible of it: `upper_bound(receiver, box)`, no light in
/// `box` is visible by a larger fraction, in any channel. `box` is a Box of positions for point lights, a DirectionBox
/// for directional ones; a cut makes use of the one it finds. Asked before a cluster is split: what is certainly hidden
/// is never refined. It pays where a shadow ray is much more expensive than this bound, or where much is hidden.
template <class O, class R, class L>
concept BoundedOracle = requires(const O& visible, const R& receiver, const place_box<L>& box) {
    { visible.upper_bound(receiver, box) } -> std::convertible_to<float>;
};

/// An oracle that can prove of a whole cluster that nothing of it is visible: `hides(receiver, box)` is true only if no
/// light in `box` is, not in part; boxes as of a BoundedOracle. Asked before a cluster is split of whose representative
/// nothing was visible, and so less often than a BoundedOracle: it may take as long as several shadow rays. False costs
/// nothing but time. See HiddenLights.
template <class O, class R, class L>
concept HidingOracle = requires(const O& visible, const R& receiver, const place_box<L>& box) {
    { visible.hides(receiver, box) } -> std::same_as<bool>;
};

/// An oracle that has an idea of how likely something of a cluster is to be visible, with or without proof:
/// `likely_visible(receiver)` returns a function of (kind, node), which number a tree in the forest and a node in it,
/// with values in (0, 1]. A cut multiplies the priorities of clusters by them and nothing else: where they are wrong it
/// refines the wrong clusters, but its stated error bound stays true. 1 changes nothing. The function is asked for a
/// few times while a receiver is shaded and called for each cluster, so that what depends on the receiver alone is
/// best done before it is returned. See LearnedVisibility.
template <class O, class R>
concept PredictingOracle = requires(const O& visible, const R& receiver,
                                    const std::remove_cvref_t<decltype(visible.likely_visible(receiver))>& likely,
                                    std::uint32_t kind, std::uint32_t node) {
    { likely(kind, node) } -> std::convertible_to<float>;
};

/// Nothing casts a shadow. Costs nothing: algorithms skip the question.
struct AlwaysVisible {
    template <class R, class L>
    constexpr bool operator()(const R&, const L&) const {
        return true;
    }
};

}  // namespace lightcuts
