#pragma once

#include "material.hpp"

namespace lightcuts {

/// The sum of materials; of equal spectra and at one receiver. `Sum{Lambert{...}, Ggx{...}}`. They share its shadow
/// rays, which start on one side; so none is a TwoSidedMaterial, but each side of a ThinSheet may be a sum.
template <Material M, Material... Ms>
    requires(std::same_as<material_spectrum<M>, material_spectrum<Ms>>&&...)
class Sum {
    static_assert(!TwoSidedMaterial<M>,
                  "what is lit from both sides is no part of a Sum: make each side of a ThinSheet a sum");

public:
    constexpr explicit Sum(const M& first, const Ms&... rest) : first_(first), rest_(rest...) {}

    material_spectrum<M> evaluate(const glm::vec3& to_light) const {
        return first_.evaluate(to_light) + rest_.evaluate(to_light);
    }
    void evaluate_many(const LaneVectors& to_lights, int count, LaneSpectra<material_spectrum<M>>& values) const
        requires(LaneMaterial<M> || (LaneMaterial<Ms> || ...)) {
        evaluate_lanes(first_, to_lights, count, values);
        rest_.add_many(to_lights, count, values);
    }
    material_spectrum<M> upper_bound(const OffsetBox& offsets) const
        requires(BoundedMaterial<M> && (BoundedMaterial<Ms> && ...)) {
        return first_.upper_bound(offsets) + rest_.upper_bound(offsets);
    }
    void quick_upper_bounds(const OffsetBlock& offsets, LaneSpectra<material_spectrum<M>>& bounds) const
        requires(BoundedMaterial<M> && (BoundedMaterial<Ms> && ...)) {
        LaneSpectra<material_spectrum<M>> others;
        cheapest_upper_bounds(first_, offsets, bounds);
        rest_.quick_upper_bounds(offsets, others);
        for (std::size_t i = 0; i < bounds.size(); ++i) bounds[i] = bounds[i] + others[i];
    }
    /// Calls f(material) for each material that is not itself a composite, in order.
    template <class F>
    void for_each_component(F&& f) const {
        if constexpr (CompositeMaterial<M>) {
            first_.for_each_component(f);
        } else {
            f(first_);
        }
        rest_.for_each_component(f);
    }

private:
    template <Material A, Material... As>
        requires(std::same_as<material_spectrum<A>, material_spectrum<As>>&&...)
    friend class Sum;

    void add_many(const LaneVectors& to_lights, int count, LaneSpectra<material_spectrum<M>>& values) const {
        add_lanes(first_, to_lights, count, values);
        rest_.add_many(to_lights, count, values);
    }

    [[no_unique_address]] M first_;
    [[no_unique_address]] Sum<Ms...> rest_;
};

template <Material M>
class Sum<M> {
    static_assert(!TwoSidedMaterial<M>,
                  "what is lit from both sides is no part of a Sum: make each side of a ThinSheet a sum");

public:
    constexpr explicit Sum(const M& only) : only_(only) {}

    material_spectrum<M> evaluate(const glm::vec3& to_light) const { return only_.evaluate(to_light); }
    void evaluate_many(const LaneVectors& to_lights, int count,
                       LaneSpectra<material_spectrum<M>>& values) const requires LaneMaterial<M> {
        only_.evaluate_many(to_lights, count, values);
    }
    material_spectrum<M> upper_bound(const OffsetBox& offsets) const requires BoundedMaterial<M> {
        return only_.upper_bound(offsets);
    }
    void quick_upper_bounds(const OffsetBlock& offsets,
                            LaneSpectra<material_spectrum<M>>& bounds) const requires BoundedMaterial<M> {
        cheapest_upper_bounds(only_, offsets, bounds);
    }
    template <class F>
    void for_each_component(F&& f) const {
        if constexpr (CompositeMaterial<M>) {
            only_.for_each_component(f);
        } else {
            f(only_);
        }
    }

private:
    template <Material A, Material... As>
        requires(std::same_as<material_spectrum<A>, material_spectrum<As>>&&...)
    friend class Sum;

    void add_many(const LaneVectors& to_lights, int count, LaneSpectra<material_spectrum<M>>& values) const {
        add_lanes(only_, to_lights, count, values);
    }

    [[no_unique_address]] M only_;
};

template <class... Ms>
Sum(const Ms&...) -> Sum<Ms...>;

}  // namespace lightcuts
