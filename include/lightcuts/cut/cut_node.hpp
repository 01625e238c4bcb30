#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include "../core/spectrum.hpp"
#include "../tree/light_cluster.hpp"

namespace lightcuts {

namespace detail {
struct LightCountTag {};
struct PartTag {};
}  // namespace detail

/// A cluster on a lightcut. `Clamps`: the cut may hold lights that are clamped; estimates and bounds here are as they
/// were without.
template <Spectrum S, bool Clamps = false>
struct CutNode {
    using LightCount = std::conditional_t<Clamps, float, detail::Empty<detail::LightCountTag>>;
    static constexpr double lights_rounding = 0.0;  ///< relative, of `lights`, which are whole
    using PartExponent = std::conditional_t<Clamps, std::uint8_t, detail::Empty<detail::PartTag>>;

    std::uint32_t node = 0;            ///< in its tree
    std::uint32_t representative = 0;  ///< leaf of the tree that stands for the cluster
    S transfer = black<S>();           ///< the representative's material x geometric term x visibility
    S estimate = black<S>();           ///< transfer x cluster intensity [Lightcuts 2005, Eq. 2]
    S unit_bound = black<S>();         ///< upper bound of material x geometric term, the cluster's or its parent's
    S bound = black<S>();              ///< upper bound of the cluster's error; 0 for a single light
    std::uint8_t kind = 0;             ///< tree of the forest
    bool bounded = false;              ///< `unit_bound` is the cluster's own
    bool queried = false;              ///< `transfer` waits for the representative, or for its shadow ray
    /// In every channel the representative has at least 2^(1-this) of the cluster's intensity; 0: it may have none.
    [[no_unique_address]] PartExponent part{};
    /// Of the cluster; infinite if its kind is not clamped.
    [[no_unique_address]] LightCount lights{};
};

namespace detail {

/// The least part of the cluster's intensity, in any channel, that is the representative's.
template <Spectrum S>
double representative_part(const CutNode<S, true>& n) {
    const std::uint64_t exponent = 1024u - n.part;
    return n.part > 0 ? 0.999999 * std::bit_cast<double>(exponent << 52) : 0.0;
}

/// `CutNode::part`, from the exponents of the two intensities: it may be four times too small.
template <Spectrum S>
std::uint8_t representative_part(const S& representative, const S& cluster) {
    const auto exponent = [](float x) { return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23); };
    int most = 0;
    for (int c = 0; c < channels_of<S>; ++c) {
        const int some = exponent(channel(representative, c)), all = exponent(channel(cluster, c));
        if (some == 0 && channel(cluster, c) > 0.0f) return 0;  // none, or denormal
        most = all - some > most ? all - some : most;
    }
    return static_cast<std::uint8_t>(most + 2 < 256 ? most + 2 : 0);
}

}  // namespace detail

}  // namespace lightcuts
