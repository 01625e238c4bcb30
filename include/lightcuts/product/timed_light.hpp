#pragma once

#include <concepts>
#include <cstdint>

#include "../light/light.hpp"

namespace lightcuts {

/// A light that exists at one instant of several, at which alone it reaches gather points: `instant` is a data member,
/// a member function or a function of `light_traits`. A light that moves or changes is one such light for each instant;
/// a particle traced at one instant carries T times its power where there are T. Lights of other kinds are the same at
/// every instant, and time costs them nothing.
template <class L>
concept TimedLight = Light<L> &&(
    requires(const L& l) {
        { light_traits<L>::instant(l) } -> std::convertible_to<std::uint32_t>;
    } ||
    requires(const L& l) {
        { l.instant() } -> std::convertible_to<std::uint32_t>;
    } ||
    requires(const L& l) {
        { l.instant } -> std::convertible_to<std::uint32_t>;
    });

/// The instant of a light.
template <TimedLight L>
constexpr std::uint32_t instant_of(const L& light) {
    if constexpr (requires {
                      { light_traits<L>::instant(light) } -> std::convertible_to<std::uint32_t>;
                  }) {
        return light_traits<L>::instant(light);
    } else if constexpr (requires {
                             { light.instant() } -> std::convertible_to<std::uint32_t>;
                         }) {
        return light.instant();
    } else {
        return light.instant;
    }
}

/// A light of kind `L` that exists at one instant: a kind of its own, with a tree of its own. pre: `L` can be derived
/// from.
template <class L>
struct InstantLight : L {
    std::uint32_t instant = 0;
};

/// What the traits of `L` say of it holds for its instants too.
template <class L>
struct light_traits<InstantLight<L>> : light_traits<L> {};

}  // namespace lightcuts
