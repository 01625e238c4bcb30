#pragma once

#include <type_traits>
#include <utility>

#include <glm/vec3.hpp>

#include "../core/assertion.hpp"
#include "material.hpp"

namespace lightcuts {

/// A material that is evaluated by code of its own and bounded by another material: a BSDF of which nothing is known
/// but its values, and one of the library's, or a Sum of them, that is nowhere below it. Cuts are as small as those of
/// `bound` itself, where a stated cap (`Capped`) lets them grow full. `M` may be a reference.
/// pre: in no direction and channel is evaluate() of `material` above that of `bound`; an assertion compares the two in
/// each direction that is asked for one by one, with 1e-4 of the value and 1e-5 / sr to spare. Where it does not hold,
/// errors exceed what results state.
/// cost: that of `material` for each light, that of `bound` for each cluster.
template <class M, Material B>
    requires Material<std::remove_cvref_t<M>> &&
        std::same_as<material_spectrum<std::remove_cvref_t<M>>, material_spectrum<B>>
struct BoundedBy {
    [[no_unique_address]] M material;
    [[no_unique_address]] B bound;

    using Inner = std::remove_cvref_t<M>;
    using S = material_spectrum<Inner>;

    S evaluate(const glm::vec3& to_light) const {
        const S value = material.evaluate(to_light);
        LIGHTCUTS_ASSERT(is_bounded(value, to_light));
        return value;
    }
    void evaluate_many(const LaneVectors& to_lights, int count,
                       LaneSpectra<S>& values) const requires LaneMaterial<Inner> {
        material.evaluate_many(to_lights, count, values);
    }
    S upper_bound(const OffsetBox& offsets) const requires BoundedMaterial<B> { return bound.upper_bound(offsets); }
    void quick_upper_bounds(const OffsetBlock& offsets, LaneSpectra<S>& bounds) const requires BoundedMaterial<B> {
        cheapest_upper_bounds(bound, offsets, bounds);
    }
    CosineLobe<S> cosine_lobe() const requires CosineLobeMaterial<B> { return bound.cosine_lobe(); }
    /// Calls f for each component of the bound.
    template <class F>
    void for_each_component(F&& f) const requires CompositeMaterial<B> {
        bound.for_each_component(std::forward<F>(f));
    }
    bool is_behind(const glm::vec3& to_light) const requires TwoSidedMaterial<Inner> {
        return material.is_behind(to_light);
    }

private:
    bool is_bounded(const S& value, const glm::vec3& to_light) const {
        const S most = bound.evaluate(to_light);
        for (int c = 0; c < channels_of<S>; ++c) {
            if (!(channel(value, c) <= channel(most, c) * 1.0001f + 1e-5f)) return false;
        }
        return true;
    }
};

template <class M, class B>
BoundedBy(M, B) -> BoundedBy<M, B>;

}  // namespace lightcuts
