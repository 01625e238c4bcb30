#pragma once

#include <glm/geometric.hpp>

#include "../core/assertion.hpp"
#include "../core/vector.hpp"
#include "conservative_rounding.hpp"
#include "material.hpp"

namespace lightcuts {

/// A material whose shading normal differs from the surface's: black for lights behind the surface itself, which would
/// shine through it. `geometric_normal`: unit, on the side of the viewer. `M` may be a reference.
template <class M>
    requires Material<std::remove_cvref_t<M>>
struct AboveHorizon {
    [[no_unique_address]] M material;
    glm::vec3 geometric_normal;

    using Inner = std::remove_cvref_t<M>;
    using S = material_spectrum<Inner>;

    S evaluate(const glm::vec3& to_light) const {
        return is_above(to_light) ? material.evaluate(to_light) : black<S>();
    }
    void evaluate_many(const LaneVectors& to_lights, int count,
                       LaneSpectra<S>& values) const requires LaneMaterial<Inner> {
        LIGHTCUTS_ASSERT(is_unit(geometric_normal));
        material.evaluate_many(to_lights, count, values);
        for (int i = 0; i < lane_count; ++i) {
            if (!(glm::dot(geometric_normal, to_lights.at(i)) > 0.0f)) values[static_cast<std::size_t>(i)] = black<S>();
        }
    }
    S upper_bound(const OffsetBox& offsets) const requires BoundedMaterial<Inner> {
        return is_below(offsets) ? black<S>() : material.upper_bound(offsets);
    }
    void quick_upper_bounds(const OffsetBlock& offsets, LaneSpectra<S>& bounds) const requires BoundedMaterial<Inner> {
        cheapest_upper_bounds(material, offsets, bounds);
        detail::blacken_below(geometric_normal, offsets, bounds);
    }
    /// Exceeds the material below the horizon, so a bound from it should be compared with `upper_bound`.
    CosineLobe<S> cosine_lobe() const requires CosineLobeMaterial<Inner> { return material.cosine_lobe(); }
    /// Calls f for each component of the material, as seen above this horizon.
    template <class F>
    void for_each_component(F&& f) const requires CompositeMaterial<Inner> {
        material.for_each_component([&]<class C>(const C& component) {
            f(AboveHorizon<const C&>{component, geometric_normal});
        });
    }

    /// True if a light in the direction `to_light`, of any length, can be reflected.
    bool is_above(const glm::vec3& to_light) const {
        LIGHTCUTS_ASSERT(is_unit(geometric_normal));
        return detail::dot(glm::dvec3(geometric_normal), glm::dvec3(to_light)) > 0.0;
    }

private:
    bool is_below(const OffsetBox& offsets) const { return detail::lies_below(glm::dvec3(geometric_normal), offsets); }
};

template <class M>
AboveHorizon(M, glm::vec3) -> AboveHorizon<M>;

}  // namespace lightcuts
