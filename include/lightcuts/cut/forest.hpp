#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

#include "../core/kinds.hpp"
#include "../light/clampable.hpp"
#include "../material/material.hpp"
#include "../tree/light_tree.hpp"
#include "../visibility/oracle.hpp"

namespace lightcuts {

/// Light trees that are refined as one: one frontier, one total, one threshold, one batch of shadow rays. The kinds
/// are fixed at compile time, and a kind that a scene lacks is left out of the list. Refers to the trees.
template <Light... Ls>
    requires(sizeof...(Ls) > 0)
class LightForest {
public:
    using spectrum = std::tuple_element_t<0, std::tuple<spectrum_of<Ls>...>>;
    static_assert((std::same_as<spectrum, spectrum_of<Ls>> && ...), "all lights of a forest need the same spectrum");
    static constexpr std::uint32_t kinds = sizeof...(Ls);
    /// True if lights of some kind may be clamped.
    static constexpr bool clamps = (ClampableLight<Ls> || ...);

    explicit LightForest(const LightTree<Ls>&... trees) : trees_(&trees...) {}
    /// The forest would refer to trees that are gone.
    template <class... Ts>
        requires(sizeof...(Ts) == sizeof...(Ls) && (!std::is_lvalue_reference_v<Ts> || ...) &&
                 (std::same_as<std::remove_cvref_t<Ts>, LightTree<Ls>> && ...))
    explicit LightForest(Ts&&... trees) = delete;

    /// The tree of kind `Kind`.
    template <std::size_t Kind>
    const auto& tree() const {
        return *std::get<Kind>(trees_);
    }

    /// Calls `f(tree)` with the tree of kind `kind` and returns its result. pre: kind < kinds.
    template <class F>
    decltype(auto) visit(std::uint32_t kind, F&& f) const {
        return detail::visit_kind<kinds>(kind, [&](auto k) -> decltype(auto) { return f(tree<k>()); });
    }

    /// Calls `f(kind, tree)` for each kind in order.
    template <class F>
    void for_each(F&& f) const {
        detail::for_each_kind<kinds>([&](auto k) { f(static_cast<std::uint32_t>(k), tree<k>()); });
    }

    /// Number of trees with at least one lit light: the smallest cut.
    std::size_t root_count() const {
        std::size_t count = 0;
        for_each([&](std::uint32_t, const auto& tree) { count += tree.empty() ? 0u : 1u; });
        return count;
    }

    /// Number of clusters that the trees propose to start with.
    std::size_t start_count() const {
        std::size_t count = 0;
        for_each([&](std::uint32_t, const auto& tree) { count += tree.start().size(); });
        return count;
    }

    /// Number of lit lights: the largest cut.
    std::size_t light_count() const {
        std::size_t count = 0;
        for_each([&](std::uint32_t, const auto& tree) { count += tree.topology().item_count(); });
        return count;
    }

private:
    std::tuple<const LightTree<Ls>*...> trees_;
};

namespace detail {

/// True if `M` reflects light of spectrum `S`; also if it is no material, which is said elsewhere.
template <class M, class S>
inline constexpr bool reflects = true;
template <Material M, class S>
inline constexpr bool reflects<M, S> = std::same_as<material_spectrum<M>, S>;

/// True if `Oracle` can be asked about every light of the forest.
template <class Oracle, class R, class Forest>
inline constexpr bool answers = false;
template <class Oracle, class R, Light... Ls>
inline constexpr bool answers<Oracle, R, LightForest<Ls...>> = (VisibilityOracle<Oracle, R, Ls> && ...);

/// True if `Oracle` bounds what is visible of some kind of cluster.
template <class Oracle, class R, class Forest>
inline constexpr bool bounds_clusters = false;
template <class Oracle, class R, Light... Ls>
inline constexpr bool bounds_clusters<Oracle, R, LightForest<Ls...>> =
    ((BoundedOracle<Oracle, R, Ls> || HidingOracle<Oracle, R, Ls>) || ...);

}  // namespace detail

/// A tree as a forest of one; a forest as it is. Algorithms take either.
template <Light L>
LightForest<L> as_forest(const LightTree<L>& tree) {
    return LightForest<L>(tree);
}
template <Light... Ls>
const LightForest<Ls...>& as_forest(const LightForest<Ls...>& forest) {
    return forest;
}

/// A LightTree or a LightForest.
template <class T>
concept TreeOrForest = requires(const T& lights) {
    as_forest(lights);
};

template <TreeOrForest T>
using forest_of = std::remove_cvref_t<decltype(as_forest(std::declval<const T&>()))>;
template <TreeOrForest T>
using forest_spectrum = typename forest_of<T>::spectrum;

}  // namespace lightcuts
