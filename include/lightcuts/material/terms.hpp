#pragma once

#include <limits>

#include "../light/incidence.hpp"
#include "receiver.hpp"

namespace lightcuts {

/// Material x geometric term of `light` at the receiver, shadows apart, per unit intensity: finite.
template <class M, Light L>
spectrum_of<L> unshadowed_terms(const Receiver<M>& receiver, const L& light) {
    using S = spectrum_of<L>;
    const Incidence arriving = incidence(light, receiver.position);
    if (!(arriving.geometric > 0.0)) return S{};
    constexpr double largest = std::numeric_limits<float>::max();
    const double geometric = arriving.geometric < largest ? arriving.geometric : largest;
    return finite(S(receiver.material.evaluate(arriving.to_light) * static_cast<float>(geometric)));
}

}  // namespace lightcuts
