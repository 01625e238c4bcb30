#pragma once

#include <concepts>
#include <type_traits>

#include "../core/spectrum.hpp"
#include "../core/vector.hpp"

namespace lightcuts {

/// Where a light type that cannot be edited says what it is. Specialize with static functions of the names that
/// the concepts below ask for, taking the light first:
/// ```
/// template <> struct lightcuts::light_traits<TheirLight> {
///     static glm::vec3 position(const TheirLight& l) { return l.where; }
///     static glm::vec3 intensity(const TheirLight& l) { return l.power; }
/// };
/// ```
template <class L>
struct light_traits {};

namespace detail {

/// Defines `NAME_of(light)`: the trait if there is one, else the member function, else the data member.
#define LIGHTCUTS_LIGHT_PROPERTY(NAME)                                                        \
    template <class L>                                                                        \
        requires requires(const L& l) { light_traits<L>::NAME(l); } || requires(const L& l) { \
            l.NAME();                                                                         \
        } || requires(const L& l) { l.NAME; }                                                 \
    constexpr auto NAME##_of(const L& l) {                                                    \
        if constexpr (requires { light_traits<L>::NAME(l); }) {                               \
            return light_traits<L>::NAME(l);                                                  \
        } else if constexpr (requires { l.NAME(); }) {                                        \
            return l.NAME();                                                                  \
        } else {                                                                              \
            return l.NAME;                                                                    \
        }                                                                                     \
    }
LIGHTCUTS_LIGHT_PROPERTY(position)
LIGHTCUTS_LIGHT_PROPERTY(direction)
LIGHTCUTS_LIGHT_PROPERTY(axis)
LIGHTCUTS_LIGHT_PROPERTY(intensity)
LIGHTCUTS_LIGHT_PROPERTY(envelope)
#undef LIGHTCUTS_LIGHT_PROPERTY

/// Defines `NAME_of(light, argument)` likewise for a function of one number.
#define LIGHTCUTS_LIGHT_FUNCTION(NAME)                                                              \
    template <class L>                                                                              \
        requires requires(const L& l) { light_traits<L>::NAME(l, 0.0f); } || requires(const L& l) { \
            l.NAME(0.0f);                                                                           \
        }                                                                                           \
    constexpr float NAME##_of(const L& l, float x) {                                                \
        if constexpr (requires { light_traits<L>::NAME(l, 0.0f); }) {                               \
            return light_traits<L>::NAME(l, x);                                                     \
        } else {                                                                                    \
            return l.NAME(x);                                                                       \
        }                                                                                           \
    }
LIGHTCUTS_LIGHT_FUNCTION(emission)
LIGHTCUTS_LIGHT_FUNCTION(falloff)
#undef LIGHTCUTS_LIGHT_FUNCTION

}  // namespace detail

/// The spectrum in which a light states its intensity.
template <class L>
using spectrum_of = std::remove_cvref_t<decltype(detail::intensity_of(std::declval<const L&>()))>;

namespace detail {
template <class L>
concept HasIntensity = requires(const L& l) {
    {detail::intensity_of(l)};
}
&&Spectrum<spectrum_of<L>>;
}  // namespace detail

/// A light at a point. `position`: units of the scene; `intensity`: W/sr, the peak where emission varies.
/// Each is a member function, a data member or a `light_traits` function.
template <class L>
concept PointLight = detail::HasIntensity<L> && requires(const L& l) {
    { detail::position_of(l) } -> Vector3;
};

/// A light at infinity. `direction`: unit vector, the way the light travels; `intensity`: irradiance on a plane
/// that faces the light, W/m^2.
template <class L>
concept DirectionalLight = detail::HasIntensity<L> && !PointLight<L> && requires(const L& l) {
    { detail::direction_of(l) } -> Vector3;
};

template <class L>
concept Light = PointLight<L> || DirectionalLight<L>;

/// A point light whose emission is symmetric about `axis`, a unit vector towards the maximum of emission. Without
/// an `emission` function it emits intensity * max(0, cos).
template <class L>
concept OrientedLight = PointLight<L> && requires(const L& l) {
    { detail::axis_of(l) } -> Vector3;
};

/// An oriented light with a profile of its own: `emission(cos)` in [0, 1] for any cos in [-1, 1] about the axis.
template <class L>
concept ProfiledLight = OrientedLight<L> && requires(const L& l) {
    detail::emission_of(l, 0.0f);
};

/// A point light with an attenuation of its own: `falloff(distance)`; without it 1/d^2.
template <class L>
concept FalloffLight = PointLight<L> && requires(const L& l) {
    detail::falloff_of(l, 0.0f);
};

}  // namespace lightcuts
