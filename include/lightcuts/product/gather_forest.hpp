#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

#include "../core/kinds.hpp"
#include "gather_tree.hpp"

namespace lightcuts {

/// Trees of the gather points of one sum, one tree for each type of gather point: diffuse and glossy lobes, phase
/// functions. The types are fixed at compile time, and one that a renderer lacks is left out of the list. Made to be
/// rebuilt for each pixel.
template <AnyGatherPoint... Gs>
    requires(sizeof...(Gs) > 0)
class GatherForest {
public:
    using spectrum = typename std::tuple_element_t<0, std::tuple<Gs...>>::spectrum;
    static_assert((std::same_as<spectrum, typename Gs::spectrum> && ...),
                  "all gather points of a forest need the same spectrum");
    static constexpr std::uint32_t kinds = sizeof...(Gs);
    /// True if every gather point exists at one instant.
    static constexpr bool timed = (TimedGatherPoint<Gs> && ...);

    /// Builds the trees of other points, each in the storage of the one before. The points must stay where they are.
    /// throws: invalid_input, see `GatherTree::build`; all trees then are empty.
    void build(std::span<const Gs>... points, const GatherTreeOptions& options) {
        std::apply([](auto&... trees) { (trees.clear(), ...); }, trees_);
        instants_ = options.instants;
        build_from(std::index_sequence_for<Gs...>{}, options, points...);
    }

    /// Of the last build.
    std::uint32_t instants() const { return instants_; }

    /// Calls `f(tree)` with the tree of kind `kind` and returns its result. pre: kind < kinds.
    template <class F>
    decltype(auto) visit(std::uint32_t kind, F&& f) const {
        return detail::visit_kind<kinds>(kind, [&](auto k) -> decltype(auto) { return f(std::get<k>(trees_)); });
    }
    /// Calls `f(kind, tree)` for each kind in order.
    template <class F>
    void for_each(F&& f) const {
        detail::for_each_kind<kinds>([&](auto k) { f(static_cast<std::uint32_t>(k), std::get<k>(trees_)); });
    }

    /// Number of gather points that have any strength.
    std::size_t point_count() const {
        std::size_t count = 0;
        for_each([&](std::uint32_t, const auto& tree) { count += tree.topology().item_count(); });
        return count;
    }

private:
    template <std::size_t... Ks>
    void build_from(std::index_sequence<Ks...>, const GatherTreeOptions& options, std::span<const Gs>... points) {
        (std::get<Ks>(trees_).build(points, options), ...);
    }
    std::tuple<GatherTree<Gs>...> trees_;
    std::uint32_t instants_ = 1;
};

}  // namespace lightcuts
