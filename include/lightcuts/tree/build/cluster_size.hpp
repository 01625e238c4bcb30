#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../../core/cone.hpp"
#include "normalized_space.hpp"

namespace lightcuts {

/// The papers' dissimilarity of two clusters: the size of their union, I (alpha^2 + c^2 (1 - cos beta)^2), with its
/// intensity I, the diagonal alpha of its box, and the half-angle beta of the smallest cone around both clusters'
/// cones [Walter et al. 2005, Section 4].
///
/// A factor 1 + 2^-42 per item orders what differs by rounding errors only: the smaller cluster comes first. Equal
/// sizes are merged in the order of the number of items, the smallest item, and the other cluster's smallest item.
struct ClusterSize {
    /// c for items with an axis, in world units. Unset: the diagonal of the items' box. The papers take the diagonal of
    /// the scene: give that where lights fill only a part of the scene, or they are merged by position too soon.
    /// 0 ignores axes.
    std::optional<double> direction_length = {};
};

namespace detail {

/// Where the greedy builder measures: the space of the items, or in units of c if that is larger.
struct GreedySpace {
    NormalizedSpace space;
    double direction = 0;  ///< c in the space, at most 1

    /// pre: checked items and a checked length.
    template <class Item>
    static GreedySpace of(std::span<const Item> items, const ClusterSize& size) {
        GreedySpace result{NormalizedSpace::of(items), 1};
        if (size.direction_length) {
            const double c = *size.direction_length;
            if (c * result.space.per_length > 1) result.space.per_length = 1 / c;
            result.direction = c * result.space.per_length;
        }
        return result;
    }
};

/// What the greedy builder keeps of a cluster, in its space.
template <bool Oriented>
struct BuildCluster {
    std::array<float, 3> lo, hi;
    double weight;
    std::uint32_t count;  ///< of items
    std::uint32_t id;     ///< its smallest item
};

/// Sine and cosine of an angle in [0, pi/2]: half of a cone's angle, or half of the angle between two axes. Sums of
/// them by the addition theorems replace all inverse trigonometric functions.
struct HalfAngle {
    double sin;
    double cos;
};

constexpr HalfAngle operator+(const HalfAngle& a, const HalfAngle& b) {
    return {a.sin * b.cos + a.cos * b.sin, a.cos * b.cos - a.sin * b.sin};
}

inline HalfAngle half_of(const Cone& c) {
    const double s2 = static_cast<double>(c.sin2_half);
    return {std::sqrt(s2), std::sqrt(1.0 - s2)};
}

template <>
struct BuildCluster<true> : BuildCluster<false> {
    Cone cone;
    HalfAngle half;         ///< of the cone
    double inverse_length;  ///< of the axis as stored
};

/// The order of greedy merging: of a pair, the size of the union, its number of items, the smaller id, the other id.
struct Rank {
    double size;
    std::uint32_t count, id, other_id;

    friend bool operator<(const Rank& a, const Rank& b) {
        return std::tie(a.size, a.count, a.id, a.other_id) < std::tie(b.size, b.count, b.id, b.other_id);
    }
};

/// Half of the angle between the axes of two cones, with a relative error of a few units of roundoff even where it is
/// tiny: products of two floats are exact in double. Zero only for equal axes.
inline HalfAngle half_between_axes(const BuildCluster<true>& a, const BuildCluster<true>& b) {
    if (a.cone.axis == b.cone.axis) return {0, 1};
    const glm::dvec3 u(a.cone.axis), v(b.cone.axis);
    const glm::dvec3 w = glm::cross(u, v);
    const double scale = a.inverse_length * b.inverse_length;
    const double sine = std::sqrt((std::max)(dot(w, w), 1e-60)) * scale;
    const double cosine = dot(u, v) * scale;
    if (cosine >= 0) {
        const double c = std::sqrt(0.5 + 0.5 * cosine);
        return {0.5 * sine / c, c};
    }
    const double s = std::sqrt(0.5 - 0.5 * cosine);
    return {s, 0.5 * sine / s};
}

/// 1 - cos beta of the smallest cone around two clusters' cones: beta = max(beta_a, beta_b, (beta_a + beta_b +
/// angle) / 2), by the addition theorems alone. Relative error: a few units of roundoff.
inline double merged_one_minus_cos(const BuildCluster<true>& a, const BuildCluster<true>& b) {
    const HalfAngle sum = (a.half + b.half) + half_between_axes(a, b);  // beta, unless one cone holds the other
    double merged = 2;
    if (sum.sin >= 0) merged = sum.cos > 0 ? sum.sin * sum.sin / (1 + sum.cos) : 1 - sum.cos;
    return (std::max)(merged, (std::max)(one_minus_cos(a.cone), one_minus_cos(b.cone)));
}

/// What makes the size strictly monotone as computed: size(a, b + c) > size(a, b), unless both are zero. Boxes and sums
/// of weights are monotone in floating point. The cone around a and b + c holds the one around a and b (stored cones
/// are rounded outward), so exact values of 1 - cos beta are monotone and computed ones are up to a relative 1e-14,
/// which this factor per item exceeds.
inline constexpr double growth_per_item = 0x1p-42;

/// The dissimilarity. pre: a.id < b.id, so that it is symmetric to the last bit. Not inlined, so that all callers get
/// the same bits.
template <bool Oriented>
[[gnu::noinline]] inline double union_size(const BuildCluster<Oriented>& a, const BuildCluster<Oriented>& b,
                                           double direction) {
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double e = static_cast<double>((std::max)(a.hi[i], b.hi[i])) -
                         static_cast<double>((std::min)(a.lo[i], b.lo[i]));
        size += e * e;
    }
    if constexpr (Oriented) {
        const double spread = direction * merged_one_minus_cos(a, b);
        size += spread * spread;
    }
    return (a.weight + b.weight) * size * (1 + growth_per_item * (a.count + b.count));
}

template <bool Oriented>
Rank rank(const BuildCluster<Oriented>& a, const BuildCluster<Oriented>& b, double direction) {
    const BuildCluster<Oriented>& first = a.id < b.id ? a : b;
    const BuildCluster<Oriented>& second = a.id < b.id ? b : a;
    return {union_size(first, second, direction), a.count + b.count, first.id, second.id};
}

/// Fills what is derived from the cone.
inline void set_cone(BuildCluster<true>& cluster, const Cone& cone) {
    cluster.cone = cone;
    cluster.half = half_of(cone);
    cluster.inverse_length = 1 / glm::length(glm::dvec3(cone.axis));
}

/// The axis, normalized, in float.
inline std::array<float, 3> unit_axis(const BuildCluster<true>& c) {
    const glm::vec3 axis(glm::dvec3(c.cone.axis) * c.inverse_length);
    return {axis.x, axis.y, axis.z};
}

/// The union. Does not depend on the order of arguments.
template <bool Oriented>
BuildCluster<Oriented> merge(const BuildCluster<Oriented>& a, const BuildCluster<Oriented>& b) {
    BuildCluster<Oriented> c = a;
    for (std::size_t i = 0; i < 3; ++i) {
        c.lo[i] = (std::min)(a.lo[i], b.lo[i]);
        c.hi[i] = (std::max)(a.hi[i], b.hi[i]);
    }
    c.weight = a.weight + b.weight;
    c.count = a.count + b.count;
    c.id = (std::min)(a.id, b.id);
    if constexpr (Oriented) {
        if (!(a.cone == b.cone)) {
            set_cone(c, a.id < b.id ? lightcuts::merge(a.cone, b.cone) : lightcuts::merge(b.cone, a.cone));
        }
    }
    return c;
}

/// pre: a checked item.
template <bool Oriented, class Item>
BuildCluster<Oriented> cluster_of(const Item& item, std::uint32_t index, const NormalizedSpace& space) {
    BuildCluster<Oriented> c;
    c.lo = c.hi = space.position(item.position);
    c.weight = space.weight(item.weight);
    c.count = 1;
    c.id = index;
    if constexpr (Oriented) set_cone(c, cone_of(item.axis + glm::vec3(0.0f)));  // no negative zeros
    return c;
}

}  // namespace detail
}  // namespace lightcuts
