#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "../core/invalid_input.hpp"
#include "../core/rounding.hpp"
#include "../tree/cluster_tree.hpp"
#include "../tree/summary.hpp"
#include "deviation.hpp"
#include "value.hpp"

namespace lightcuts {

/// Mean and variance of a function over the leaves below a node [Cut merging 2008, section 3.1], channel by channel.
template <int Channels>
struct Moments {
    static constexpr int channels = Channels;

    std::array<double, static_cast<std::size_t>(Channels)> mean{};
    /// Upper bound of the rounding errors of `mean`.
    std::array<double, static_cast<std::size_t>(Channels)> mean_error{};
    /// Sum over the leaves of (f - mean)^2, rounded up: |C| var.
    std::array<double, static_cast<std::size_t>(Channels)> squared_deviation{};
    double leaves = 1.0;

    /// |C| var, all channels together.
    double total_squared_deviation() const {
        double sum = 0.0;
        for (const double s : squared_deviation) sum += s;
        return sum;
    }
    /// How far the function is from `value`, in one channel.
    Deviation deviation_from(double value, int channel) const {
        const auto c = static_cast<std::size_t>(channel);
        return detail::deviation_from(value, mean[c], mean_error[c], squared_deviation[c], leaves);
    }
    /// The means, rounded.
    template <PiecewiseValue V>
    V value() const {
        static_assert(channels_of<V> == Channels);
        return make_value<V>([this](int c) { return mean[static_cast<std::size_t>(c)]; });
    }
};

/// The moments of a function with values of type V.
template <PiecewiseValue V>
using MomentsOf = Moments<channels_of<V>>;

/// The moments of two sets of leaves together. Stable: deviations are never differences of large sums.
template <int Channels>
Moments<Channels> merge(const Moments<Channels>& a, const Moments<Channels>& b) {
    constexpr double u = unit_roundoff;
    Moments<Channels> m;
    m.leaves = a.leaves + b.leaves;
    for (std::size_t c = 0; c < static_cast<std::size_t>(Channels); ++c) {
        const double apart = b.mean[c] - a.mean[c];
        m.mean[c] = a.mean[c] + apart * (b.leaves / m.leaves);
        double error = a.mean_error[c] < b.mean_error[c] ? b.mean_error[c] : a.mean_error[c];
        double spread = 0.0;
        if (apart != 0.0 || error > 0.0) {
            // The difference, the share, their product and the sum are rounded; the least number is for underflow.
            const double rounding = 4.0 * u * std::abs(apart) + 2.0 * u * std::abs(m.mean[c]);
            spread = std::abs(apart) + a.mean_error[c] + b.mean_error[c];
            if (apart != 0.0) error += rounding + 0x1p-1000;
        }
        m.mean_error[c] = error * (1.0 + 4.0 * u);
        const double between = spread * spread * (a.leaves / m.leaves * b.leaves);
        m.squared_deviation[c] = (a.squared_deviation[c] + b.squared_deviation[c] + between) * (1.0 + 16.0 * u);
        if (spread > 0.0 && m.squared_deviation[c] < 0x1p-1000) m.squared_deviation[c] = 0x1p-1000;
    }
    return m;
}

/// Computes anew the moments of a function at every node of `tree`, bottom-up. `leaf(item)`: its value.
/// shapes: `moments` has tree.size() entries, in node order.
/// throws: invalid_input naming the item whose value is not finite or above 1e150. cost: one pass, O(N); nothing is
/// allocated if `moments` has room.
template <std::invocable<std::uint32_t> Leaf, int Channels>
void refit_moments(const ClusterTree& tree, std::vector<Moments<Channels>>& moments, Leaf&& leaf) {
    using V = std::remove_cvref_t<std::invoke_result_t<Leaf&, std::uint32_t>>;
    static_assert(channels_of<V> == Channels);
    refit(
        tree, moments,
        [&](std::uint32_t item) {
            const V value = leaf(item);
            Moments<Channels> m;
            for (int c = 0; c < Channels; ++c) {
                const double v = value_channel(value, c);
                // Squares of larger ones could be infinite.
                if (!(std::abs(v) <= 1e150)) {
                    LIGHTCUTS_THROW(invalid_input("item " + std::to_string(item) + ": the value " + std::to_string(v) +
                                                  " is not finite, or above 1e150"));
                }
                m.mean[static_cast<std::size_t>(c)] = v;
            }
            return m;
        },
        [](const Moments<Channels>& a, const Moments<Channels>& b) { return merge(a, b); });
}

/// The moments of a function at every node of `tree`, in node order. See `refit_moments`.
template <std::invocable<std::uint32_t> Leaf>
auto moments(const ClusterTree& tree, Leaf&& leaf) {
    using V = std::remove_cvref_t<std::invoke_result_t<Leaf&, std::uint32_t>>;
    static_assert(PiecewiseValue<V>,
                  "a function's values need to be float, double or a Spectrum: +, *, channels and a way to set them");
    std::vector<MomentsOf<V>> result;
    refit_moments(tree, result, leaf);
    return result;
}

}  // namespace lightcuts
