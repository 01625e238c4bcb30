#pragma once

#include <cmath>
#include <limits>

#include "../core/cone.hpp"
#include "../core/cone_block.hpp"
#include "../core/cosine.hpp"
#include "../core/lanes.hpp"
#include "../core/rounding.hpp"
#include "../light/incidence.hpp"
#include "../tree/light_cluster.hpp"
#include "view.hpp"

namespace lightcuts::detail {

/// x / d2 for a bound x, with 0 / 0 = 0: a term that is certainly zero beats a light that may be at the receiver.
inline double over_distance2(double x, double d2) {
    if (!(x > 0.0)) return 0.0;
    return d2 > 0.0 ? x / d2 : std::numeric_limits<double>::infinity();
}

/// The profile functions of a light are floats; this covers their rounding.
inline constexpr double float_slack = 1.0 + 2e-6;

/// a x b, lane by lane, where 0 x infinity is a certain zero.
inline void multiply(const Lanes& a, const Lanes& b, Lanes& product) {
    for (int i = 0; i < lane_count; ++i) {
        product[i] = select(smaller(a[i], b[i]) > 0.0f, larger(a[i] * b[i] * 1.000001f, 1e-37f), 0.0f);
    }
}

/// Sets bounds[i] to what `bound(cluster, view)` returns for lane i: of functions that only answer one by one.
template <Light L, class Receivers, class F>
void fill_lanes(const LightCluster<L>* const* clusters, int count, const Receivers& receivers, const F& bound,
                Lanes& bounds) {
    for (int i = 0; i < count; ++i) bounds[i] = round_up(bound(*clusters[i], view_of(*clusters[i], receivers(i))));
    repeat_last(bounds, count);
}

/// Upper bound of the attenuation of any light in the cluster.
template <Light L>
double attenuation_bound(const LightCluster<L>& cluster, const ClusterView& view) {
    if constexpr (DirectionalLight<L>) {
        return 1.0;
    } else if constexpr (inverse_square<L>) {
        return view.inverse_distance * view.inverse_distance * (1.0 + 8.0 * unit_roundoff);
    } else {
        const float nearest = round_down(std::sqrt(view.distance2) * (1.0 - 1e-7));
        const float distance = nearest > 0.0f ? nearest : 0.0f;
        if constexpr (requires { cluster.envelope.falloff_bound(distance); }) {
            return static_cast<double>(cluster.envelope.falloff_bound(distance)) * float_slack;
        } else if constexpr (requires { light_traits<L>::falloff_bound(distance); }) {
            return static_cast<double>(light_traits<L>::falloff_bound(distance)) * float_slack;
        } else {
            static_assert(
                requires { L::falloff_bound(distance); },
                "a light with falloff(d) needs falloff_bound(d_min): static, or on what its envelope() returns");
            return static_cast<double>(L::falloff_bound(distance)) * float_slack;
        }
    }
}

/// Upper bound of the emission, relative to the peak, of any light in the cluster towards the receiver.
template <Light L>
double emission_bound(const LightCluster<L>& cluster, const ClusterView& view) {
    if constexpr (!OrientedLight<L>) {
        return 1.0;
    } else {
        // The angle at the light is between its axis and -p, which is the one between the reversed axis and p.
        // A cone's angle was measured from the unit vector along the stored axis; a single axis counts as it is.
        const glm::dvec3 axis = is_single(cluster.cone) ? glm::dvec3(cluster.cone.axis) : unit_axis(cluster.cone);
        if constexpr (cosine_emission<L>) {
            if (is_single(cluster.cone)) return clamped_max_cosine(-axis, view.box);
            const double widened = widen_cosine(max_cosine(-axis, view.box), cluster.cone);
            return widened > 0.0 ? widened : 0.0;
        } else {
            const auto to_float = [](double c) { return static_cast<float>(c < -1.0 ? -1.0 : c > 1.0 ? 1.0 : c); };
            // The slack is for axes of nearly unit length and the rounding of the cosine to float.
            const double largest = widen_cosine(max_cosine(-axis, view.box), cluster.cone) + 6e-6;
            const double least = -widen_cosine(max_cosine(axis, view.box), cluster.cone) - 6e-6;
            const float cos_min = to_float(least), cos_max = to_float(largest);
            if constexpr (requires { cluster.envelope.emission_bound(cos_min, cos_max); }) {
                return static_cast<double>(cluster.envelope.emission_bound(cos_min, cos_max)) * float_slack;
            } else if constexpr (requires { light_traits<L>::emission_bound(cos_min, cos_max); }) {
                return static_cast<double>(light_traits<L>::emission_bound(cos_min, cos_max)) * float_slack;
            } else {
                static_assert(
                    requires { L::emission_bound(cos_min, cos_max); },
                    "a light with emission(cos) needs emission_bound(cos_min, cos_max): static, or on what its "
                    "envelope() returns");
                return static_cast<double>(L::emission_bound(cos_min, cos_max)) * float_slack;
            }
        }
    }
}

/// Upper bound of emission x attenuation of any light in the cluster: the geometric term [Lightcuts 2005, Eq. 3].
template <Light L>
double geometric_bound(const LightCluster<L>& cluster, const ClusterView& view) {
    if constexpr (cosine_emission<L> && inverse_square<L>) {
        if (is_single(cluster.cone)) return max_dot_over_distance<3>(-glm::dvec3(cluster.cone.axis), view.box).value;
        return over_distance2(emission_bound(cluster, view), view.distance2);
    } else if constexpr (OrientedLight<L>) {
        const double emission = emission_bound(cluster, view);
        return emission > 0.0 ? emission * attenuation_bound(cluster, view) : 0.0;
    } else {
        return attenuation_bound(cluster, view);
    }
}

/// `geometric_bound` of every lane.
template <Light L, class Receivers>
void geometric_bounds(const LightCluster<L>* const* clusters, int count, const Receivers& receivers,
                      ClusterBlock<L>& block, Lanes& bounds) {
    if constexpr (DirectionalLight<L>) {
        for (int i = 0; i < lane_count; ++i) bounds[i] = 1.0f;
    } else if constexpr (has_profile<L>) {
        const auto bound = [](const auto& cluster, const auto& view) { return geometric_bound(cluster, view); };
        fill_lanes(clusters, count, receivers, bound, bounds);
    } else {
        for (int i = 0; i < lane_count; ++i) bounds[i] = block.inverse[i] * block.inverse[i] * 1.000002f;
        if constexpr (OrientedLight<L>) { multiply(block.cosines_at_lights(), bounds, bounds); }
    }
}

}  // namespace lightcuts::detail
