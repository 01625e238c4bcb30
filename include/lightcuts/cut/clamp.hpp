#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "../core/box.hpp"
#include "../core/rounding.hpp"
#include "../core/spectrum.hpp"
#include "../light/clampable.hpp"

namespace lightcuts {

/// The most that one light of a ClampableLight kind may add at a receiver. The limits hold together, in every channel;
/// an infinite one is off. A cluster of n lights may add n times as much, so that error bounds stay bounds.
struct ClampingOptions {
    /// Radiance. pre: >= 0.
    float radiance = std::numeric_limits<float>::infinity();
    /// Share of the receiver's total, itself clamped [Lightcuts 2005, section 5]; 1 and above is off. Where fewer than
    /// 2 / ratio clamped lights arrive, n of them, it is 2 / n, so that lights which are alike are never clamped. In
    /// every channel by itself. A light counts as a part of one if it adds less than 1e-9 of all lights' intensity over
    /// the squared diagonal of their box: so the total is continuous in what each adds. pre: >= 0.
    float ratio = std::numeric_limits<float>::infinity();
    /// Material x geometric term, per unit intensity [Multidimensional Lightcuts 2006, Eq. 14]. pre: >= 0.
    float transfer = std::numeric_limits<float>::infinity();

    /// True if the threshold follows from the total.
    bool is_automatic() const { return ratio < 1.0f; }
    /// True if there is a threshold of radiance.
    bool has_threshold() const { return is_automatic() || radiance < std::numeric_limits<float>::infinity(); }
};

/// No clamped light adds more than a hundredth of the total where 200 arrive, or twice the mean where fewer do.
inline constexpr ClampingOptions automatic_clamping{.ratio = 0.01f};

namespace detail {

template <Spectrum S>
using ChannelSums = std::array<double, static_cast<std::size_t>(channels_of<S>)>;

/// How many lights count in channel `c`: one number for all channels, or a spectrum.
inline double lights_in(double lights, std::size_t) { return lights; }
template <Spectrum S>
    requires(channels_of<S> > 1)
double lights_in(const S& lights, std::size_t c) { return static_cast<double>(channel(lights, static_cast<int>(c))); }

/// True of lights that are clamped: others are infinitely many, in every channel.
template <class Count>
bool are_clamped(const Count& lights) {
    return lights_in(lights, 0) < std::numeric_limits<double>::infinity();
}

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
    ChannelSums<S> ratio{};      ///< that share of the total; infinite if none arrives

    /// What a single receiver reports: no limit where it is the total or more.
    S threshold_at_receiver(const ClampingOptions& clamp) const {
        return make_spectrum<S>([&](int channel) {
            const auto c = static_cast<std::size_t>(channel);
            return ratio[c] < 1.0 ? threshold[c] : static_cast<double>(clamp.radiance);
        });
    }
};

/// The share of the total that one of `lights` may add, which are the clamped ones that arrive; infinite of none. At
/// least twice the share of each if they are alike: n lights of more than 1 / n each have no total but 0. A share of 1
/// or more limits no light at a single receiver; in a sum over several, of which each has a part of it, it may.
/// Continuous.
inline double effective_ratio(const ClampingOptions& clamp, double lights) {
    const auto stated = static_cast<double>(clamp.ratio);
    // A little more than 2 / n, so that it is all the same whether to a whole number of lights next to nothing is
    // added.
    constexpr double two = 2.0 * (1.0 + 0x1p-30);
    if (!(lights > 0.0)) return std::numeric_limits<double>::infinity();
    // Nearly 2 / ratio lights: a little less than 2 / n, since the ratio was rounded to float, and 2 / 200 is not above
    // 0.01.
    const double least = two / lights, nearby = 0x1p-22 * stated - 0x1p-12 * (least - stated);
    const double lowered = nearby > 0.0 ? least - nearby : least;
    return lowered > stated ? lowered : stated;
}

/// The threshold under a total that may be infinite; `ratio` as it is effective.
inline double clamp_threshold(const ClampingOptions& clamp, double ratio, double total) {
    const double limit = static_cast<double>(clamp.radiance);
    const double share = ratio < std::numeric_limits<double>::infinity() ? ratio * total : limit;
    return share < limit ? share : limit;
}

/// How much of one light a light is that adds a unit of radiance, in every channel: it is a whole one from where it
/// adds next to nothing of what one adds somewhere between the lights. Follows from what is known before any of them is
/// looked at, so that no light makes others count for less. Zero if they are all at one place: none is a spike for
/// being near.
template <class Forest>
ChannelSums<typename Forest::spectrum> counts_per_radiance(const Forest& forest) {
    constexpr double next_to_nothing = 1e-9;
    constexpr double in_range = 0x1p-100;  // what is a little less would be rounded as denormals are
    ChannelSums<typename Forest::spectrum> distant{}, local{};
    Box box;
    forest.for_each([&](std::uint32_t, const auto& tree) {
        using L = typename std::remove_cvref_t<decltype(tree)>::light_type;
        if constexpr (ClampableLight<L>) {
            if (tree.empty()) return;
            const auto& all = tree.clusters()[tree.topology().root()];
            if constexpr (!DirectionalLight<L>) box = merge(box, all.box);
            auto& sum = DirectionalLight<L> ? distant : local;
            for (std::size_t c = 0; c < sum.size(); ++c) {
                sum[c] += next_to_nothing * static_cast<double>(channel(all.intensity, static_cast<int>(c)));
            }
        }
    });
    const double size2 = diagonal2(box);
    ChannelSums<typename Forest::spectrum> counts{};
    for (std::size_t c = 0; c < local.size(); ++c) {
        const double whole = distant[c] + (local[c] > 0.0 ? local[c] / size2 : 0.0);
        counts[c] = 1.0 / (whole < in_range ? in_range : whole);
    }
    return counts;
}

/// How many of `lights` count that add `contribution` together: each by what it adds, but as no more than one.
constexpr double counted_lights(double contribution, double lights, double per_radiance) {
    const double counts = contribution * per_radiance;
    return contribution > 0.0 ? counts < lights ? counts : lights : 0.0;
}

/// Counts lights in every channel until there are so many that the ratio is the stated one.
template <Spectrum S>
struct LightCount {
    ChannelSums<S> lights{};
    ChannelSums<S> per_radiance;  ///< see `counts_per_radiance`
    double many;                  ///< 2 / ratio, and some for rounding

    LightCount(const ClampingOptions& clamp, const ChannelSums<S>& counts)
        : per_radiance(counts), many(2.000001 / static_cast<double>(clamp.ratio)) {}

    bool is_known() const {
        bool known = true;
        for (const double n : lights) known = known && n >= many;
        return known;
    }
    /// `count` lights that add `contribution` together, or `part` of it.
    template <class Count>
    void add(const S& contribution, const Count& count, double part = 1.0) {
        for (std::size_t c = 0; c < lights.size(); ++c) {
            lights[c] += counted_lights(part * static_cast<double>(channel(contribution, static_cast<int>(c))),
                                        lights_in(count, c), per_radiance[c]);
        }
    }
};

/// The effective ratio in every channel; infinite if clamping is not automatic. `counts`: see `counts_per_radiance`.
/// `visit(f)` as for `clamped_total`.
template <Spectrum S, class Visit>
ChannelSums<S> effective_ratios(const ClampingOptions& clamp, const ChannelSums<S>& counts, const Visit& visit) {
    LightCount<S> arriving(clamp, counts);
    bool known = !clamp.is_automatic();
    visit([&](const S& raw, const auto& lights) {
        if (known || !are_clamped(lights)) return;
        arriving.add(raw, lights);
        known = arriving.is_known();
    });
    ChannelSums<S> ratios{};
    for (std::size_t c = 0; c < ratios.size(); ++c) ratios[c] = effective_ratio(clamp, arriving.lights[c]);
    return ratios;
}

/// Solves `total = fixed + sum over contributions of min(raw, lights x threshold(total))` for the largest total, from
/// above or from a guess, in every channel. The sum is concave and piecewise linear in the total, and not negative at
/// zero: Newton's method descends to the root in finitely many steps, of which there are rarely more than three.
/// `visit(f)` calls f(raw, lights) for every contribution, of infinitely many lights if it is not clamped; `lights` is
/// a number or, where channels have different ones, a spectrum. The threshold is that of a total within `tolerance` of
/// the root, and the total is the sum under this very threshold. `ratio`: effective.
template <Spectrum S, class Visit>
ClampedTotal<S> clamped_total(const ClampingOptions& clamp, const ChannelSums<S>& ratio, const ChannelSums<S>& fixed,
                              ChannelSums<S> guess, double tolerance, const Visit& visit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr int most_steps = 100;
    for (double& g : guess) g = g > 0.0 ? g : infinity;  // zero may be a root below the largest
    ClampedTotal<S> result;
    result.ratio = ratio;
    for (int step = 0; step < most_steps; ++step) {
        // Step 1: what is not clamped under this guess, and how many lights are.
        for (std::size_t c = 0; c < guess.size(); ++c) {
            result.threshold[c] = clamp_threshold(clamp, result.ratio[c], guess[c]);
        }
        ChannelSums<S> rest = fixed, clamped{};
        visit([&](const S& raw, const auto& lights) {
            for (std::size_t c = 0; c < guess.size(); ++c) {
                const double value = static_cast<double>(channel(raw, static_cast<int>(c)));
                const double count = lights_in(lights, c);
                const double limit = count * result.threshold[c];  // NaN: not clamped, at a threshold of zero
                rest[c] += value > limit ? 0.0 : value;
                clamped[c] += value > limit ? count : 0.0;
            }
        });
        // Step 2: the root of the tangent, without a difference of sums, of which a spike may be nearly all.
        bool found = true;
        for (std::size_t c = 0; c < guess.size(); ++c) {
            const bool moves = result.threshold[c] < static_cast<double>(clamp.radiance);
            const double slope = moves ? result.ratio[c] * clamped[c] : 0.0;
            result.total[c] = clamped[c] > 0.0 ? rest[c] + result.threshold[c] * clamped[c] : rest[c];
            double next = infinity;  // left of the root: once more from above
            if (!(guess[c] < infinity)) {
                next = result.total[c];
            } else if (slope < 1.0) {
                next = (moves ? rest[c] : result.total[c]) / (1.0 - slope);
            } else if (step > 0 && result.total[c] - guess[c] <= tolerance * guess[c]) {
                // Rounding. Only the first guess can be far left, also where the sum grows just as the total does.
                next = guess[c];
            }
            const double moved = next - guess[c];
            found = found && guess[c] < infinity && moved <= tolerance * guess[c] && -moved <= tolerance * guess[c];
            guess[c] = next;
        }
        if (found) break;
    }
    return result;
}

/// Between how many clamped lights arrive, in every channel.
template <Spectrum S>
struct ArrivingLights {
    LightCount<S> least, most;
};

/// Bounds the difference between a cut's clamped total and the true one, whose ratio and threshold are others.
/// `visit(f)` calls f(raw estimate, raw bound, lights) for every node of the cut; zero bounds are exact nodes.
/// `count_rounding`: relative, of `lights`.
///
/// For a given ratio the total is the largest root of a concave function of the total. The larger the function, the
/// larger the root; and for a given ratio the function increases with every contribution, and with the ratio. So both
/// totals lie between the root with exact nodes alone and the ratio of most lights, and that with bounds in place of
/// estimates and the ratio of fewest lights, though a larger contribution may count for more lights. Tangents of the
/// latter function are above it, chords of the former below.
template <Spectrum S, class Visit>
ChannelSums<S> clamped_error(const ClampingOptions& clamp, const ClampedTotal<S>& cut,
                             const ArrivingLights<S>& arriving, double count_rounding, const Visit& visit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    struct Sums {
        double upper_threshold = 0, lower_threshold = 0;  ///< under the cut's total, by the extreme ratios
        double half_threshold = 0;                        ///< the lower one, under half the total
        double bound = 0, raw_bound = 0;                  ///< of the nodes that are not exact
        double loose = 0;                                 ///< their estimates
        double exact_gain = 0, exact_loss = 0;            ///< of the others' estimates by the extreme thresholds
        double exact_raw_gain = 0;                        ///< and by none
        double exact_at_half = 0;                         ///< they under half the total
        double clamped = 0, clamped_exact = 0;            ///< lights in nodes that are clamped if bounds are true
        double upper_ratio = 0;                           ///< slope of the upper threshold
        double unclamped = 0;                             ///< estimates below the threshold
    };
    std::array<Sums, ChannelSums<S>{}.size()> sums;
    for (std::size_t c = 0; c < sums.size(); ++c) {
        Sums& s = sums[c];
        const double upper = effective_ratio(clamp, arriving.least.lights[c]),
                     lower = effective_ratio(clamp, arriving.most.lights[c]);
        // The cut's own threshold is that of its total but for a tolerance.
        const auto threshold_by = [&](double ratio) {
            return ratio == cut.ratio[c] ? cut.threshold[c] : clamp_threshold(clamp, ratio, cut.total[c]);
        };
        s.upper_threshold = threshold_by(upper);
        s.lower_threshold = threshold_by(lower);
        s.half_threshold = clamp_threshold(clamp, lower, 0.5 * cut.total[c]);
        s.upper_ratio = s.upper_threshold < static_cast<double>(clamp.radiance) ? upper : 0.0;
    }
    double nodes = 0.0;
    visit([&](const S& estimate, const S& bound, const auto& count) {
        nodes += 1.0;
        for (std::size_t c = 0; c < sums.size(); ++c) {
            Sums& s = sums[c];
            const double lights = lights_in(count, c);
            const auto at_most = [lights](double value, double threshold) {
                const double limit = lights * threshold;
                return value > limit ? limit : value;
            };
            const double e = static_cast<double>(channel(estimate, static_cast<int>(c)));
            const double b = static_cast<double>(channel(bound, static_cast<int>(c)));
            const double here = at_most(e, cut.threshold[c]);
            s.unclamped += here < e ? 0.0 : e;
            if (b == 0.0) {
                s.exact_at_half += at_most(e, s.half_threshold);
                if (!(e > lights * s.half_threshold)) continue;  // the least of thresholds
                s.exact_gain += at_most(e, s.upper_threshold) - here;
                s.exact_loss += here - at_most(e, s.lower_threshold);
                s.exact_raw_gain += e - here;
                s.clamped_exact += e > lights * s.upper_threshold ? lights : 0.0;
            } else {
                s.loose += here;
                s.bound += at_most(b, s.upper_threshold);
                s.raw_bound += b;
                s.clamped += b > lights * s.upper_threshold ? lights : 0.0;
            }
        }
    });
    constexpr double float_rounding = 0x1p-24;
    const double rounding = unit_roundoff * (16.0 + nodes) + count_rounding;
    ChannelSums<S> error{};
    for (std::size_t c = 0; c < sums.size(); ++c) {
        const Sums& s = sums[c];
        // The total is what is not clamped over 1 - slope: where that difference is lost in rounding, so is the total.
        const bool moves = cut.threshold[c] < static_cast<double>(clamp.radiance);
        const double rounded = moves ? rounding * (cut.total[c] / s.unclamped) : 0.0;
        if (rounded > float_rounding + 16.0 * count_rounding) {
            const double raw = s.exact_raw_gain + s.raw_bound, most = raw > cut.total[c] ? raw : cut.total[c];
            error[c] = rounded < 1.0 ? rounded * most : most;
        }
        if (s.raw_bound == 0.0) continue;
        // Above: the least root of three tangents of the upper function.
        const double exact_slope = s.upper_ratio * s.clamped_exact;
        double above = s.exact_raw_gain + s.raw_bound;  // far out, where nothing is clamped
        const auto lower_above = [&](double excess, double slope) {
            const double root = slope < 1.0 ? excess / (1.0 - slope) : infinity;
            above = root < above ? root : above;
        };
        lower_above(s.exact_gain + s.bound, exact_slope + s.upper_ratio * s.clamped);
        lower_above(s.exact_gain + s.raw_bound, exact_slope);
        // Below: the root of the chord of the lower function between half the total and all of it.
        const double half = 0.5 * cut.total[c], excess = s.exact_at_half - half, lost = s.loose + s.exact_loss;
        const double below = excess > 0.0 ? half * lost / (excess + lost) : cut.total[c];
        error[c] += below > above ? below : above;
    }
    return error;
}

}  // namespace detail

}  // namespace lightcuts
