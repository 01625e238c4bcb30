#pragma once

#include <cstddef>
#include <limits>

#include "../light/incidence.hpp"
#include "../material/material.hpp"
#include "receiver.hpp"

namespace lightcuts {

/// Material x geometric term of `light` at the receiver, shadows apart, per unit intensity: finite.
template <class M, Light L>
spectrum_of<L> unshadowed_transfer(const Receiver<M>& receiver, const L& light) {
    using S = spectrum_of<L>;
    const Incidence arriving = incidence(light, receiver.position);
    if (!(arriving.geometric > 0.0)) return black<S>();
    constexpr double largest = (std::numeric_limits<float>::max)();
    const double geometric = arriving.geometric < largest ? arriving.geometric : largest;
    return finite(S(receiver.material.evaluate(arriving.to_light) * static_cast<float>(geometric)));
}

namespace detail {

/// Unshadowed transfer of the first `count` lights of a block, transfer[i] for lane i, in float vector code where the
/// kinds of light and material allow it. `light_of(i)` is the light itself, for where they do not. pre: 0 < count <=
/// lane_count
template <Light L, class M, class LightOf>
void unshadowed_transfer(const Receiver<M>& receiver, const LightBlock& lights, int count, const LightOf& light_of,
                         LaneSpectra<spectrum_of<L>>& transfer) {
    using S = spectrum_of<L>;
    if constexpr (has_profile<L>) {
        for (int i = 0; i < count; ++i) {
            transfer[static_cast<std::size_t>(i)] = lightcuts::unshadowed_transfer<M, L>(receiver, light_of(i));
        }
    } else {
        IncidenceBlock arriving;
        incidences<L>(lights, receiver.position, arriving);
        evaluate_lanes(receiver.material, arriving.to_light, count, transfer);
        for (int i = 0; i < count; ++i) {
            S& t = transfer[static_cast<std::size_t>(i)];
            if (arriving.in_range[i] != 0.0f) {
                t = finite(S(t * arriving.geometric[i]));
            } else {
                t = lightcuts::unshadowed_transfer<M, L>(receiver, light_of(i));
            }
        }
    }
}

/// Unshadowed transfer of `count` lights `light_of(i)`: transfer[i] for light i. pre: 0 < count <= lane_count
template <Light L, class M, class LightOf>
void unshadowed_transfer(const Receiver<M>& receiver, int count, const LightOf& light_of,
                         LaneSpectra<spectrum_of<L>>& transfer) {
    LightBlock lights;
    for (int i = 0; i < count; ++i) lights.set(i, light_of(i));
    lights.template finish<L>(count);
    unshadowed_transfer<L>(receiver, lights, count, light_of, transfer);
}

}  // namespace detail

}  // namespace lightcuts
