#pragma once

#include <concepts>
#include <span>
#include <type_traits>

#include "../core/box.hpp"
#include "../light/light.hpp"
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

/// Unit directions towards distant lights, as opposed to positions.
struct DirectionBox {
    Box box;
};

/// Where the lights of a cluster of kind `L` are.
template <class L>
using place_box = std::conditional_t<DirectionalLight<L>, DirectionBox, Box>;

/// An oracle that also says of a whole cluster how much can be visible of it: `upper_bound(receiver, box)`, no light in
/// `box` is visible by a larger fraction. `box` is a Box of positions for point lights, a DirectionBox for directional
/// ones; a cut makes use of the one it finds. Asked before a cluster is split: what is certainly hidden is never
/// refined. It pays where a shadow ray is much dearer than this bound, or where much is hidden.
template <class O, class R, class L>
concept BoundedOracle = requires(const O& visible, const R& receiver, const place_box<L>& box) {
    { visible.upper_bound(receiver, box) } -> std::convertible_to<float>;
};

/// Nothing casts a shadow. Costs nothing: algorithms skip the question.
struct AlwaysVisible {
    template <class R, class L>
    constexpr bool operator()(const R&, const L&) const {
        return true;
    }
};

}  // namespace lightcuts
