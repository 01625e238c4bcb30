#pragma once

#include <cstdint>
#include <type_traits>

#include "../core/spectrum.hpp"
#include "../tree/light_cluster.hpp"

namespace lightcuts {

namespace detail {
struct LightCountTag {};
struct AllChannelsTag {};
}  // namespace detail

/// A cluster on a lightcut. `Clamps`: the cut may hold lights that are clamped; estimates and bounds here are as they
/// were without.
template <Spectrum S, bool Clamps = false>
struct CutNode {
    using LightCount = std::conditional_t<Clamps, float, detail::Absent<detail::LightCountTag>>;
    using ChannelMark = std::conditional_t<Clamps, bool, detail::Absent<detail::AllChannelsTag>>;

    std::uint32_t node = 0;            ///< in its tree
    std::uint32_t representative = 0;  ///< leaf of the tree that stands for the cluster
    S terms{};                         ///< the representative's material x geometric x visibility terms
    S estimate{};                      ///< terms x cluster intensity [Lightcuts 2005, Eq. 2]
    S unit_bound{};                    ///< upper bound of material x geometric terms, the cluster's or its parent's
    S bound{};                         ///< upper bound of the cluster's error; 0 for a single light
    std::uint8_t kind = 0;             ///< tree of the forest
    bool bounded = false;              ///< `unit_bound` is the cluster's own
    bool queried = false;              ///< `terms` waits for the representative, or for its shadow ray
    /// The representative shines in every channel; the cluster may shine in others than it.
    [[no_unique_address]] ChannelMark all_channels{};
    /// Of the cluster; infinite if its kind is not clamped.
    [[no_unique_address]] LightCount lights{};
};

}  // namespace lightcuts
