#pragma once

#include "material.hpp"

namespace lightcuts {

/// A material without a bound of its own, cut off at a stated cap, channel by channel: the cap is its bound. A cap
/// below what the material reaches darkens the picture rather than breaking the stated error; a generous cap only costs
/// larger cuts.
template <Material M>
struct Capped {
    [[no_unique_address]] M material;
    material_spectrum<M> cap;  ///< 1/sr, cosine included; not negative

    material_spectrum<M> evaluate(const glm::vec3& to_light) const {
        const material_spectrum<M> value = material.evaluate(to_light);
        return make_spectrum<material_spectrum<M>>([&](int i) {
            const float v = channel(value, i);
            const float most = channel(cap, i);
            return v < most ? v : most;
        });
    }
    material_spectrum<M> upper_bound(const OffsetBox&) const { return cap; }
    bool is_behind(const glm::vec3& to_light) const requires TwoSidedMaterial<M> {
        return material.is_behind(to_light);
    }
};

template <class M, class S>
Capped(M, S) -> Capped<M>;

}  // namespace lightcuts
