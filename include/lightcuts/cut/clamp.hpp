#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "../core/spectrum.hpp"

namespace lightcuts {

/// The most that one light of a ClampedLight kind may add at a receiver. The limits hold together, in every channel;
/// an infinite one is off. A cluster of n lights may add n times as much, so that error bounds stay bounds.
struct ClampOptions {
    /// Radiance. pre: >= 0.
    float radiance = std::numeric_limits<float>::infinity();
    /// Share of the receiver's total, itself clamped [Lightcuts 2005, section 5]; 1 and above is off. Where fewer than
    /// 1 / ratio clamped lights arrive and nothing else, all are clamped to nothing. pre: >= 0.
    float ratio = std::numeric_limits<float>::infinity();
    /// Material x geometric term, per unit intensity [Multidimensional Lightcuts 2006, Eq. 14]. pre: >= 0.
    float terms = std::numeric_limits<float>::infinity();

    /// True if the threshold follows from the total.
    bool is_automatic() const { return ratio < 1.0f; }
    /// True if there is a threshold of radiance.
    bool has_threshold() const { return is_automatic() || radiance < std::numeric_limits<float>::infinity(); }
};

/// No clamped light adds more than a hundredth of the total.
inline constexpr ClampOptions automatic_clamping{.ratio = 0.01f};

namespace detail {

template <Spectrum S>
using ChannelSums = std::array<double, static_cast<std::size_t>(channels_of<S>)>;

/// `s` with no channel above `limit`.
template <Spectrum S>
S at_most(const S& s, float limit) {
    if (limit == std::numeric_limits<float>::infinity()) return s;
    return make_spectrum<S>([&](int c) { return channel(s, c) < limit ? channel(s, c) : limit; });
}

/// What a total of contributions comes to under a threshold that depends on it.
template <Spectrum S>
struct ClampedTotal {
    ChannelSums<S> total{};
    ChannelSums<S> threshold{};  ///< the most that a clamped light adds
};

/// The threshold under a total that may be infinite.
inline double clamp_threshold(const ClampOptions& clamp, double total) {
    const double limit = static_cast<double>(clamp.radiance);
    const double share = clamp.is_automatic() ? static_cast<double>(clamp.ratio) * total : limit;
    return share < limit ? share : limit;
}

/// Solves `total = fixed + sum over contributions of min(raw, lights x threshold(total))` for the largest total, from
/// above or from a guess, in every channel. The sum is concave and piecewise linear in the total, and not negative at
/// zero: Newton's method descends to the root in finitely many steps, of which there are rarely more than three.
/// `visit(f)` calls f(raw, lights) for every contribution, of infinitely many lights if it is not clamped. The
/// threshold is that of a total within `tolerance` of the root, and the total is the sum under this very threshold.
template <Spectrum S, class Visit>
ClampedTotal<S> clamped_total(const ClampOptions& clamp, const ChannelSums<S>& fixed, ChannelSums<S> guess,
                              double tolerance, const Visit& visit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr int most_steps = 100;
    for (double& g : guess) g = g > 0.0 ? g : infinity;  // zero may be a root below the largest
    ClampedTotal<S> result;
    for (int step = 0; step < most_steps; ++step) {
        // Step 1: the sum under this guess, and how many lights are clamped.
        for (std::size_t c = 0; c < guess.size(); ++c) result.threshold[c] = clamp_threshold(clamp, guess[c]);
        result.total = fixed;
        ChannelSums<S> clamped{};
        visit([&](const S& raw, double lights) {
            for (std::size_t c = 0; c < guess.size(); ++c) {
                const double value = static_cast<double>(channel(raw, static_cast<int>(c)));
                const double limit = lights * result.threshold[c];  // NaN: not clamped, at a threshold of zero
                result.total[c] += value > limit ? limit : value;
                clamped[c] += value > limit ? lights : 0.0;
            }
        });
        // Step 2: the root of the tangent.
        bool found = true;
        for (std::size_t c = 0; c < guess.size(); ++c) {
            const bool moves = result.threshold[c] < static_cast<double>(clamp.radiance);
            const double slope = moves ? static_cast<double>(clamp.ratio) * clamped[c] : 0.0;
            const double excess = result.total[c] - guess[c];
            double next = infinity;  // left of the root: once more from above
            if (!(guess[c] < infinity)) {
                next = result.total[c];
            } else if (slope < 1.0) {
                next = guess[c] + excess / (1.0 - slope);
            } else if (excess <= tolerance * guess[c]) {
                next = guess[c];
            }
            const double moved = next - guess[c];
            found = found && guess[c] < infinity && moved <= tolerance * guess[c] && -moved <= tolerance * guess[c];
            guess[c] = next > 0.0 ? next : 0.0;
        }
        if (found) break;
    }
    return result;
}

/// Bounds the difference between a cut's clamped total and the true one, whose threshold is another: both are roots
/// of concave functions of the total between that of the exact nodes alone and that of bounds in place of estimates.
/// `visit(f)` calls f(raw estimate, raw bound, lights) for every node of the cut; zero bounds are exact nodes.
template <Spectrum S, class Visit>
ChannelSums<S> clamped_error(const ClampOptions& clamp, const ClampedTotal<S>& cut, const Visit& visit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    struct Sums {
        double bound = 0, raw_bound = 0;        ///< of the nodes that are not exact
        double loose = 0;                       ///< their estimates
        double exact_at_half = 0;               ///< the others' estimates under half the total
        double clamped = 0, clamped_exact = 0;  ///< lights in nodes that are clamped if bounds are true
        double half_threshold = 0, ratio = 0;
    };
    std::array<Sums, ChannelSums<S>{}.size()> sums;
    for (std::size_t c = 0; c < sums.size(); ++c) {
        sums[c].half_threshold = clamp_threshold(clamp, 0.5 * cut.total[c]);
        sums[c].ratio = cut.threshold[c] < static_cast<double>(clamp.radiance) ? static_cast<double>(clamp.ratio) : 0.0;
    }
    visit([&](const S& estimate, const S& bound, double lights) {
        for (std::size_t c = 0; c < sums.size(); ++c) {
            Sums& s = sums[c];
            const double e = static_cast<double>(channel(estimate, static_cast<int>(c)));
            const double b = static_cast<double>(channel(bound, static_cast<int>(c)));
            const double limit = lights * cut.threshold[c];
            if (b == 0.0) {
                const double half_limit = lights * s.half_threshold;
                s.exact_at_half += e > half_limit ? half_limit : e;
                s.clamped_exact += e > limit ? lights : 0.0;
            } else {
                s.loose += e > limit ? limit : e;
                s.bound += b > limit ? limit : b;
                s.raw_bound += b;
                s.clamped += b > limit ? lights : 0.0;
            }
        }
    });
    ChannelSums<S> error{};
    for (std::size_t c = 0; c < sums.size(); ++c) {
        const Sums& s = sums[c];
        if (s.raw_bound == 0.0) continue;
        // Above: the root of the tangent of the upper function, with bounds clamped or not.
        const double exact_slope = s.ratio * s.clamped_exact, slope = exact_slope + s.ratio * s.clamped;
        const double clamped_above = slope < 1.0 ? s.bound / (1.0 - slope) : infinity;
        const double raw_above = exact_slope < 1.0 ? s.raw_bound / (1.0 - exact_slope) : infinity;
        const double above = clamped_above < raw_above ? clamped_above : raw_above;
        // Below: the root of the chord of the lower function between half the total and all of it.
        const double half = 0.5 * cut.total[c], excess = s.exact_at_half - half;
        const double below = excess > 0.0 ? half * s.loose / (excess + s.loose) : cut.total[c];
        error[c] = below > above ? below : above;
    }
    return error;
}

}  // namespace detail

}  // namespace lightcuts
