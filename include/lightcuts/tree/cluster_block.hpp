#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "cluster_size.hpp"

namespace lightcuts::detail {

/// Eight clusters, or eight nodes of the neighbour tree, side by side for vector instructions. Of a node's clusters it
/// has the smallest hi, the largest lo and the smallest weight: whatever grows when clusters merge, so that a node
/// stays valid while its clusters do.
template <bool Oriented>
struct Block {
    static constexpr std::size_t lanes = 8;
    using Lanes = std::array<float, lanes>;

    alignas(32) std::array<Lanes, 3> least_hi;
    std::array<Lanes, 3> most_lo;
    Lanes weight;

    void clear_box(std::size_t j) {
        constexpr float inf = std::numeric_limits<float>::infinity();
        for (std::size_t a = 0; a < 3; ++a) {
            least_hi[a][j] = inf;
            most_lo[a][j] = -inf;
        }
        weight[j] = inf;
    }
    void clear(std::size_t j) { clear_box(j); }
};

template <>
struct Block<true> : Block<false> {
    std::array<Lanes, 3> axis;
    /// Sine and cosine of half an angle to add to half the angle between axes: a cluster's half-angle, or minus the
    /// angle around a node's axis in which all its clusters' axes lie.
    Lanes sin, cos;

    void clear(std::size_t j) {
        clear_box(j);
        for (Lanes& a : axis) a[j] = 0;
        sin[j] = 0;
        cos[j] = 1;
    }
};

/// The cluster whose neighbours are sought, in float.
template <bool Oriented>
struct Probe {
    using Lanes = typename Block<Oriented>::Lanes;

    std::array<float, 3> lo, hi;
    float weight;
    std::array<float, 3> axis{};
    float sin = 0, cos = 1;  ///< of its half-angle / 2
    float spread = 0;        ///< 1 - cos of its half-angle
    float direction2 = 0;    ///< the metric's c^2

    Probe(const Cluster<Oriented>& c, double per_weight, double direction)
        : lo(c.lo), hi(c.hi), weight(float_weight(c.weight * per_weight)) {
        if constexpr (Oriented) {
            axis = unit_axis(c);
            sin = static_cast<float>(c.half.sin);
            cos = static_cast<float>(c.half.cos);
            spread = std::max(static_cast<float>(one_minus_cos(c.cone)), spread_margin);
            direction2 = static_cast<float>(std::min(direction * direction, 1e6));
        }
    }

    /// Limited, as is direction2, so that bounds stay finite: they remain lower bounds.
    static float float_weight(double weight) { return static_cast<float>(std::min(weight, 1e30)); }

    static constexpr float spread_margin = 2e-6f;  ///< far above the rounding errors below

    /// Lower bounds, up to a relative rounding error below 4e-6, of the size of the union with any cluster of each
    /// lane. False if all are above `threshold`. Written without branches and memory that might alias, so that
    /// compilers use vector instructions.
    bool bound(const Block<Oriented>& block, float threshold, Lanes& bounds) const {
        const Block<Oriented>& b = block;
        float diagonal2[Block<Oriented>::lanes], weights[Block<Oriented>::lanes], result[Block<Oriented>::lanes];
        const float lo_x = lo[0], lo_y = lo[1], lo_z = lo[2], hi_x = hi[0], hi_y = hi[1], hi_z = hi[2], own = weight;
        const auto larger = [](float s, float t) { return s > t ? s : t; };
        const auto smaller = [](float s, float t) { return s < t ? s : t; };
        for (std::size_t j = 0; j < Block<Oriented>::lanes; ++j) {
            const float x = larger(hi_x, b.least_hi[0][j]) - smaller(lo_x, b.most_lo[0][j]);
            const float y = larger(hi_y, b.least_hi[1][j]) - smaller(lo_y, b.most_lo[1][j]);
            const float z = larger(hi_z, b.least_hi[2][j]) - smaller(lo_z, b.most_lo[2][j]);
            diagonal2[j] = x * x + y * y + z * z;
            weights[j] = own + b.weight[j];
            result[j] = weights[j] * diagonal2[j];
        }
        float least = result[0];
        for (std::size_t j = 1; j < Block<Oriented>::lanes; ++j) least = smaller(least, result[j]);
        if (least > threshold) return false;
        if constexpr (Oriented) {
        const float axis_x = axis[0], axis_y = axis[1], axis_z = axis[2], sine = sin, cosine = cos,
                    own_spread = spread, c2 = direction2;
        for (std::size_t j = 0; j < Block<Oriented>::lanes; ++j) {
            // Half the angle D between the axes: its sine from below, s, and from both sides of its cosine, c and C.
            const float x = axis_x - b.axis[0][j], y = axis_y - b.axis[1][j], z = axis_z - b.axis[2][j];
            const float s2 = 0.25f * (x * x + y * y + z * z);
            const float s = root_below(s2);
            const float c_low = 1 - s2, c_high = 1 - s2 * (0.5f + s2 * (0.125f + s2 * 0.0625f));
            // The half-angle A to add: the probe's and the lane's; cos(D + A) from above.
            const float add_cos = cosine * b.cos[j] - sine * b.sin[j];
            const float add_sin = sine * b.cos[j] + cosine * b.sin[j];
            const float sum_cos = larger(c_low * add_cos, c_high * add_cos) - smaller(s * add_sin, root_error * s * add_sin);
            // A node's axes may reach the probe's: sin(D + lane's half-angle) from below, steepened to a switch.
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

    /// The square root from below, at most root_error too small: std::sqrt minds errno, so it is not vectorised.
    static float root_below(float x) {
        const float r = std::bit_cast<float>(0x5f3759dfu - (std::bit_cast<std::uint32_t>(x) >> 1));
        return x * r * (1.5f - 0.5f * x * r * r);  // one step of Newton's method, which never exceeds the root
    }
};

}  // namespace lightcuts::detail
