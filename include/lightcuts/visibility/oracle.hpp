#pragma once

#include <concepts>
#include <span>

#include "query.hpp"

namespace lightcuts {

/// Answers whether `light` reaches `receiver`: `bool`, or the fraction in [0, 1] that gets through.
/// It must be safe to call from several threads if the caller shades on several.
template <class O, class R, class L>
concept ScalarOracle = requires(const O& visible, const R& receiver, const L& light) {
    { visible(receiver, light) } -> std::convertible_to<float>;
};

/// Answers many shadow rays at once: `answers[i]` is the fraction in [0, 1] of `queries[i]`. Queries of one call may
/// come from several receivers; their order is the same in every run.
template <class O>
concept BatchedOracle = requires(const O& visible, std::span<const VisibilityQuery> queries, std::span<float> answers) {
    visible.many(queries, answers);
};

/// What every algorithm asks of visibility: one of the two forms above. Where both exist, `many` is used.
template <class O, class R, class L>
concept VisibilityOracle = ScalarOracle<O, R, L> || BatchedOracle<O>;

/// Nothing casts a shadow. Costs nothing: algorithms skip the question.
struct AlwaysVisible {
    template <class R, class L>
    constexpr bool operator()(const R&, const L&) const {
        return true;
    }
};

}  // namespace lightcuts
