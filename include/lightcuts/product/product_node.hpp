#pragma once

#include <cstdint>
#include <type_traits>

#include "../core/spectrum.hpp"
#include "../cut/cut_node.hpp"

namespace lightcuts {

/// Which side of a pair of clusters is split.
enum class PairSide : std::uint8_t { undecided, gather, light };

/// How the side of a pair to split is chosen.
enum class SideRule : std::uint8_t {
    /// The side whose collapse to a single gather point or light lowers the bound more.
    bounds,
    /// The larger side: the light cluster's diagonal is compared with that of the gather points' times the cosine of
    /// their cone of normals, as printed in [Multidimensional Lightcuts 2006, appendix A]. It looks at no bounds, and
    /// so
    /// takes less time for a split; the cuts of pixels are mostly larger.
    sizes
};

namespace detail {

/// How many lights a pair counts for in each channel, see PairLights: a number if there is one channel.
template <Spectrum S>
using ProductLightCount = std::conditional_t<channels_of<S> == 1, float, S>;

}  // namespace detail

/// A pair of a cluster of gather points and a cluster of lights: a node of the product graph [Multidimensional
/// Lightcuts 2006, section 3.1]. `Clamps`: the cut may hold lights that are clamped; estimates and bounds here are as
/// they were without.
template <Spectrum S, bool Clamps = false>
struct ProductNode {
    using LightCount = std::conditional_t<Clamps, detail::ProductLightCount<S>, detail::Empty<detail::LightCountTag>>;
    /// Relative, of `lights`: a fraction that is the quotient of two sums in float.
    static constexpr double lights_rounding = 0x1p-22;

    std::uint32_t gather = 0;                 ///< node in its tree of gather points
    std::uint32_t light = 0;                  ///< node in its light tree
    std::uint32_t gather_representative = 0;  ///< leaf that stands for the gather points
    std::uint32_t light_representative = 0;   ///< leaf that stands for the lights
    S transfer = black<S>();                  ///< the representatives' lobe x geometric term x visibility
    S weight = black<S>();      ///< strength x intensity, summed over pairs that exist at one instant [S . I, Eq. 7]
    S estimate = black<S>();    ///< transfer x weight
    S unit_bound = black<S>();  ///< upper bound of lobe x geometric term, the pair's or its parent's
    S bound = black<S>();       ///< upper bound of the pair's error; 0 for one gather point and one light
    std::uint8_t gather_kind = 0;
    std::uint8_t light_kind = 0;
    bool bounded = false;                 ///< `unit_bound` is the pair's own
    bool queried = false;                 ///< `transfer` waits for the representatives, or for their shadow ray
    PairSide side = PairSide::undecided;  ///< the side to split
    std::uint8_t gather_splits = 0;       ///< splits of the gather side since the last of the light side
    std::uint8_t light_splits = 0;        ///< splits of the light side since the last of the gather side
    /// What the pair counts for under clamping; infinite if it is not clamped.
    [[no_unique_address]] LightCount lights{};
};

}  // namespace lightcuts
