#pragma once

#include <cmath>
#include <type_traits>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "../core/cone_block.hpp"
#include "../core/offset_block.hpp"
#include "../light/light.hpp"
#include "../material/conservative_rounding.hpp"
#include "../tree/light_cluster.hpp"

namespace lightcuts::detail {

/// A cluster's lights as the receivers in a box see them: the box of their offsets, or of the directions towards
/// distant lights, and how near they are. Widened by the float rounding of the directions that materials are given, so
/// that bounds over the box hold for what `evaluate` returns; zeros stay zeros.
struct ClusterView {
    OffsetBox box;
    double distance2;         ///< lower bound of the squared distance; 0 if the box touches the receivers
    double inverse_distance;  ///< 1 / sqrt(distance2), infinite if that is 0
};

/// What the receivers in a box see of a cluster. pre: `cluster` holds a light; `receivers` is not empty, and is
/// `box_of` the position for a single receiver.
template <Light L>
ClusterView view_of(const LightCluster<L>& cluster, const Box& receivers) {
    ClusterView view;
    if constexpr (DirectionalLight<L>) {
        view.box = rounded_directions({glm::dvec3(cluster.box.lo), glm::dvec3(cluster.box.hi)});
    } else {
        view.box = rounded_directions(offsets(cluster.box, receivers));
    }
    view.distance2 = min_distance2(view.box);
    view.inverse_distance = 1.0 / std::sqrt(view.distance2);
    return view;
}

/// `ClusterView`s side by side in float: each of a cluster of one kind of light and of a box of receivers.
template <Light L>
struct ClusterBlock : OffsetBlock {
    static constexpr bool oriented = LightCluster<L>::oriented;
    struct NoAxes {};

    [[no_unique_address]] std::conditional_t<oriented, ConeBlock, NoAxes> reversed_axes;

    /// Bounds of max(0, cos) at the lights, about the reversed axes: computed when first asked for.
    const Lanes& cosines_at_lights() requires oriented {
        if (!has_cosines_) clamped_max_cosines(reversed_axes, *this, cosines_);
        has_cosines_ = true;
        return cosines_;
    }

    /// Lane i is of *clusters[i] and `receivers(i)`. pre: 0 < count <= lane_count
    template <class Receivers>
        requires requires(const Receivers& receivers) { receivers(0); }
    ClusterBlock(const LightCluster<L>* const* clusters, int count, const Receivers& receivers) {
        for (int i = 0; i < count; ++i) {
            const Box& lights = clusters[i]->box;
            if constexpr (DirectionalLight<L>) {
                set(i, lights.lo, lights.hi);
            } else {
                const Box& seen_from = receivers(i);
                set(i, lights.lo - seen_from.hi, lights.hi - seen_from.lo);
            }
            if constexpr (oriented) reversed_axes.set(i, negated(clusters[i]->cone));
        }
        finish(count);
        if constexpr (oriented) reversed_axes.finish(count, *this);
    }
    /// All of one box of receivers.
    ClusterBlock(const LightCluster<L>* const* clusters, int count, const Box& receivers)
        : ClusterBlock(clusters, count, [&](int) -> const Box& { return receivers; }) {}

private:
    alignas(32) Lanes cosines_;
    bool has_cosines_ = false;
};

}  // namespace lightcuts::detail
