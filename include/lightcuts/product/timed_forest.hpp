#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

#include "../core/kinds.hpp"
#include "../cut/forest.hpp"
#include "../light/clampable.hpp"
#include "time_vectors.hpp"
#include "timed_light.hpp"

namespace lightcuts {

namespace detail {
template <std::size_t Kind>
struct NoTimesTag {};
}  // namespace detail

/// Light trees at T instants: a forest, and for each kind of `TimedLight` what its clusters are at each instant; of
/// those that may be clamped also how many lights they are then. Other kinds cost nothing. Built once for a scene and
/// shared by threads; refers to the trees.
template <Light... Ls>
class TimedForest {
public:
    using forest_type = LightForest<Ls...>;
    using spectrum = typename forest_type::spectrum;
    /// True if some kind exists at instants.
    static constexpr bool timed = (TimedLight<Ls> || ...);

    /// Kinds without instants only: one instant.
    explicit TimedForest(const forest_type& forest) requires(!timed) : forest_(forest) {}

    /// throws: invalid_input if `instants` is not in 1 to 65536, or naming the light whose instant is not below it.
    /// memory: see TimeVectors.
    TimedForest(const forest_type& forest, std::uint32_t instants) : forest_(forest), instants_(instants) {
        detail::for_each_kind<forest_type::kinds>([this](auto k) { this->template build_kind<k>(); });
    }

    const forest_type& forest() const { return forest_; }
    std::uint32_t instants() const { return instants_; }

    /// Calls `f(tree, times)` for kind `kind`: `times` is a `TimeVectors` if the kind is a TimedLight, with `counts` if
    /// it is a ClampableLight, else empty.
    template <class F>
    decltype(auto) visit(std::uint32_t kind, F&& f) const {
        return detail::visit_kind<forest_type::kinds>(
            kind, [&](auto k) -> decltype(auto) { return f(forest_.template tree<k>(), std::get<k>(times_)); });
    }
    /// Calls `f(kind, tree, times)` for each kind in order.
    template <class F>
    void for_each(F&& f) const {
        detail::for_each_kind<forest_type::kinds>(
            [&](auto k) { f(static_cast<std::uint32_t>(k), forest_.template tree<k>(), std::get<k>(times_)); });
    }

    std::size_t memory_bytes() const {
        std::size_t bytes = 0;
        for_each([&](std::uint32_t, const auto&, const auto& times) {
            if constexpr (requires { times.memory_bytes(); }) bytes += times.memory_bytes();
        });
        return bytes;
    }

private:
    template <std::size_t K>
    using Kind = std::tuple_element_t<K, std::tuple<Ls...>>;
    template <std::size_t K>
    using Vectors =
        std::conditional_t<ClampableLight<Kind<K>>, detail::CountedTimeVectors<spectrum>, TimeVectors<spectrum>>;
    template <std::size_t K>
    using Times = std::conditional_t<TimedLight<Kind<K>>, Vectors<K>, detail::Empty<detail::NoTimesTag<K>>>;

    template <std::size_t... Ks>
    static std::tuple<Times<Ks>...> times_type(std::index_sequence<Ks...>);

    template <std::size_t K>
    void build_kind() {
        using L = Kind<K>;
        if constexpr (TimedLight<L>) {
            const LightTree<L>& tree = forest_.template tree<K>();
            const auto instant = [&](std::uint32_t i) { return instant_of(tree.lights()[i]); };
            auto& times = std::get<K>(times_);
            times.build(tree.topology(), instants_, instant,
                        [&](std::uint32_t i) { return detail::intensity_of(tree.lights()[i]); });
            times.shrink_to_fit();
            if constexpr (ClampableLight<L>) {
                times.counts.build(tree.topology(), instants_, instant, [](std::uint32_t) { return 1.0f; });
                times.counts.shrink_to_fit();
            }
        }
    }

    forest_type forest_;
    std::uint32_t instants_ = 1;
    [[no_unique_address]] decltype(times_type(std::index_sequence_for<Ls...>{})) times_{};
};

}  // namespace lightcuts
