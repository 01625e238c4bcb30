#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>

#include "cluster_size.hpp"

namespace lightcuts::detail {

/// Eight clusters, or eight nodes of the neighbor tree, side by side for vector instructions. Of a node's clusters it
/// has the smallest upper corner, the largest lower corner and the smallest weight. When clusters merge, the first and
/// the last only grow and the second only shrinks, so a node stays valid for the clusters that replace its own.
template <bool Oriented>
struct NeighborBlock {
    static constexpr std::size_t lanes = 8;
    using Lanes = std::array<float, lanes>;

    alignas(32) std::array<Lanes, 3> least_hi;
    std::array<Lanes, 3> most_lo;
    Lanes weight;

    void set(std::size_t j, const BuildCluster<false>& c, double per_weight) {
        for (std::size_t a = 0; a < 3; ++a) {
            least_hi[a][j] = c.hi[a];
            most_lo[a][j] = c.lo[a];
        }
        weight[j] = float_weight(c.weight, per_weight);
    }

    /// Nothing is there: any bound is infinite.
    void clear(std::size_t j) {
        constexpr float inf = std::numeric_limits<float>::infinity();
        for (std::size_t a = 0; a < 3; ++a) {
            least_hi[a][j] = inf;
            most_lo[a][j] = -inf;
        }
        weight[j] = inf;
    }

    bool is_empty(std::size_t j) const { return weight[j] == std::numeric_limits<float>::infinity(); }

    /// Limited, so that bounds of what is there are finite; they remain lower bounds.
    static float float_weight(double weight, double per_weight) {
        return static_cast<float>((std::min)(weight * per_weight, 1e30));
    }
};

template <>
struct NeighborBlock<true> : NeighborBlock<false> {
    std::array<Lanes, 3> axis;
    /// Sine and cosine of what to add to half the angle between axes: half a cluster's half-angle, or minus half the
    /// angle around a node's axis in which all its clusters' axes lie.
    Lanes sin, cos;

    void set(std::size_t j, const BuildCluster<true>& c, double per_weight) {
        NeighborBlock<false>::set(j, c, per_weight);
        const std::array<float, 3> unit = unit_axis(c);
        for (std::size_t a = 0; a < 3; ++a) axis[a][j] = unit[a];
        sin[j] = static_cast<float>(c.half.sin);
        cos[j] = static_cast<float>(c.half.cos);
    }

    void clear(std::size_t j) {
        NeighborBlock<false>::clear(j);
        for (Lanes& a : axis) a[j] = 0;
        sin[j] = 0;
        cos[j] = 1;
    }
};

/// Makes lane j of `parent` the node of all lanes of `child`.
inline void enclose(const NeighborBlock<false>& child, NeighborBlock<false>& parent, std::size_t j) {
    for (std::size_t a = 0; a < 3; ++a) {
        parent.least_hi[a][j] = *std::min_element(child.least_hi[a].begin(), child.least_hi[a].end());
        parent.most_lo[a][j] = *std::max_element(child.most_lo[a].begin(), child.most_lo[a].end());
    }
    parent.weight[j] = *std::min_element(child.weight.begin(), child.weight.end());
}

inline void enclose(const NeighborBlock<true>& child, NeighborBlock<true>& parent, std::size_t j) {
    enclose(static_cast<const NeighborBlock<false>&>(child), static_cast<NeighborBlock<false>&>(parent), j);
    std::array<float, 3> sum{};
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t k = 0; k < child.lanes; ++k) sum[a] += child.axis[a][k];
    }
    const float length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    constexpr float quarter_turn = 0.5f * std::numbers::pi_v<float>;  // half of any angle is less
    float around = length > 1e-3f ? 0.0f : quarter_turn;
    for (std::size_t a = 0; a < 3; ++a) parent.axis[a][j] = length > 1e-3f ? sum[a] / length : child.axis[a][0];
    for (std::size_t k = 0; k < child.lanes && around < quarter_turn; ++k) {
        if (child.is_empty(k)) continue;
        float distance2 = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            const float d = parent.axis[a][j] - child.axis[a][k];
            distance2 += d * d;
        }
        const float sine = 0.5f * std::sqrt(distance2);
        const float own = child.sin[k] < 0 ? std::atan2(-child.sin[k], child.cos[k]) : 0.0f;
        // Near a quarter turn the arc sine magnifies rounding errors.
        around = (std::max)(around, sine < 0.95f ? std::asin(sine) + own : quarter_turn);
    }
    around = (std::min)(around, quarter_turn);
    parent.sin[j] = -std::sin(around);
    parent.cos[j] = std::cos(around);
}

/// The cluster whose neighbors are sought, in float.
template <bool Oriented>
struct Probe {
    using Lanes = typename NeighborBlock<Oriented>::Lanes;

    std::array<float, 3> lo, hi;
    float weight;
    std::array<float, 3> axis{};
    float sin = 0, cos = 1;  ///< of its half-angle / 2
    float spread = 0;        ///< 1 - cos of its half-angle
    float direction2 = 0;    ///< the metric's c^2

    Probe(const BuildCluster<Oriented>& c, double direction, double per_weight)
        : lo(c.lo), hi(c.hi), weight(NeighborBlock<Oriented>::float_weight(c.weight, per_weight)) {
        if constexpr (Oriented) {
            axis = unit_axis(c);
            sin = static_cast<float>(c.half.sin);
            cos = static_cast<float>(c.half.cos);
            spread = (std::max)(static_cast<float>(one_minus_cos(c.cone)), spread_margin);
            direction2 = static_cast<float>(direction * direction);
        }
    }

    /// Above the absolute rounding errors of 1 - cos beta as computed below.
    static constexpr float spread_margin = 4e-6f;

    /// Lower bounds, up to a relative error below 4e-6, of the size of the union with any cluster of each lane.
    /// False if all are above `threshold`. Written without branches, and with memory that aliases nothing, so that
    /// compilers use vector instructions.
    bool bound(const NeighborBlock<Oriented>& b, float threshold, Lanes& bounds) const {
        constexpr std::size_t lanes = NeighborBlock<Oriented>::lanes;
        const auto larger = [](float s, float t) { return s > t ? s : t; };
        const auto smaller = [](float s, float t) { return s < t ? s : t; };
        float diagonal2[lanes], weights[lanes], result[lanes];

        // Step 1: boxes and weights alone.
        const float lo_x = lo[0], lo_y = lo[1], lo_z = lo[2], hi_x = hi[0], hi_y = hi[1], hi_z = hi[2], own = weight;
        for (std::size_t j = 0; j < lanes; ++j) {
            const float x = larger(hi_x, b.least_hi[0][j]) - smaller(lo_x, b.most_lo[0][j]);
            const float y = larger(hi_y, b.least_hi[1][j]) - smaller(lo_y, b.most_lo[1][j]);
            const float z = larger(hi_z, b.least_hi[2][j]) - smaller(lo_z, b.most_lo[2][j]);
            diagonal2[j] = x * x + y * y + z * z;
            weights[j] = own + b.weight[j];
            result[j] = weights[j] * diagonal2[j];
        }
        float least = result[0];
        for (std::size_t j = 1; j < lanes; ++j) least = smaller(least, result[j]);
        if (least > threshold) return false;

        // Step 2: directions.
        if constexpr (Oriented) {
            const float axis_x = axis[0], axis_y = axis[1], axis_z = axis[2];
            const float sine = sin, cosine = cos, own_spread = spread, c2 = direction2;
            for (std::size_t j = 0; j < lanes; ++j) {
                // Half the angle between the axes: its sine from below, its cosine from both sides.
                const float x = axis_x - b.axis[0][j], y = axis_y - b.axis[1][j], z = axis_z - b.axis[2][j];
                const float s2 = 0.25f * (x * x + y * y + z * z);
                const float s = root_below(s2);
                const float c_low = 1 - s2, c_high = 1 - s2 * (0.5f + s2 * (0.125f + s2 * 0.0625f));
                // The cosine of its sum with the probe's and the lane's angle, from above.
                const float add_cos = cosine * b.cos[j] - sine * b.sin[j];
                const float add_sin = sine * b.cos[j] + cosine * b.sin[j];
                const float sum_cos = larger(c_low * add_cos, c_high * add_cos) -
                                      smaller(s * add_sin, root_error * s * add_sin);
                // A node's axes may reach the probe's: the sine of the sum with the lane's angle, from below, made
                // steep enough to act as a switch.
                const float apart = b.cos[j] * s + smaller(c_low * b.sin[j], c_high * b.sin[j]);
                const float merged = smaller(1 - sum_cos, 1e6f * apart);
                const float total = larger(merged, own_spread) - spread_margin;
                result[j] = weights[j] * (diagonal2[j] + c2 * total * total);
            }
        }
        std::copy(std::begin(result), std::end(result), bounds.begin());
        return true;
    }

private:
    static constexpr float root_error = 1.002f;

    /// The square root from below, at most root_error too small: std::sqrt sets errno, so compilers do not
    /// vectorize it.
    static float root_below(float x) {
        const float r = std::bit_cast<float>(0x5f3759dfu - (std::bit_cast<std::uint32_t>(x) >> 1));
        return x * r * (1.5f - 0.5f * x * r * r);  // one step of Newton's method, which never exceeds the root
    }
};

}  // namespace lightcuts::detail
