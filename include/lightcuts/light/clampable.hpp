#pragma once

#include "light.hpp"
#include "oriented.hpp"
#include "scattering.hpp"

namespace lightcuts {

/// A light whose contributions may be clamped, see ClampingOptions: one of many samples of what they stand for
/// together, each of which is mostly noise. The mark is `static constexpr bool clampable = true`, in the type or its
/// `light_traits`. Kinds without it cost nothing and are never clamped.
template <class L>
concept ClampableLight = Light<L> &&(
    requires { requires std::bool_constant<L::clampable>::value; } ||
    requires { requires std::bool_constant<light_traits<L>::clampable>::value; });

/// A light of kind `L` whose contributions may be clamped: a ClampableLight. It is a kind of its own, so that clampable
/// lights and others are in different trees.
template <class L>
struct Clampable : L {
    static constexpr bool clampable = true;
};

/// A virtual point light: light reflected by a small piece of a diffuse surface.
template <Spectrum S = glm::vec3>
using VirtualPointLight = Clampable<OrientedPointLight<S>>;

/// A virtual light in a medium: light scattered at a point of it.
template <Spectrum S = glm::vec3>
using VirtualVolumeLight = Clampable<ScatteringPointLight<S>>;

}  // namespace lightcuts
