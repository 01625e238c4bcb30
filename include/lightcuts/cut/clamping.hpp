#pragma once

#include <cstddef>
#include <limits>

#include "clamp.hpp"

namespace lightcuts::detail {

/// What a cut with clamped lights amounts to.
template <Spectrum S>
struct ClampedSums {
    ClampedTotal<S> clamped;
    ChannelSums<S> bound{};  ///< of the total's error
};

/// How the contributions to one cut are clamped at the moment. `N` is a node with an `estimate`, its error's `bound`,
/// both as they are without clamping, and how many `lights` it has, infinitely many if they are not clamped: a number,
/// or a spectrum where channels differ. `N::lights_rounding` is their relative rounding.
template <Spectrum S, class N>
class CutClamping {
public:
    using Sums = ChannelSums<S>;
    using Node = N;

    /// `counts()`: what `counts_per_radiance` finds; called under automatic clamping only.
    template <class Counts>
    void start(const ClampingOptions& options, const Counts& counts) {
        *this = {};
        options_ = options;
        if (options.is_automatic()) counts_ = counts();
        threshold_.fill(static_cast<double>(options.radiance));
        ratio_.fill(std::numeric_limits<double>::infinity());
    }

    /// What a node of this estimate adds to channel `c` of the total.
    double contribution(const Node& n, std::size_t c) const {
        const auto estimate = static_cast<double>(channel(n.estimate, static_cast<int>(c)));
        const double most = lights_in(n.lights, c) * threshold_[c];
        return estimate > most ? most : estimate;
    }

    /// True if the node's lights together may be off by more than `threshold` in channel `c`, as a share of the total.
    bool may_exceed(const Node& n, std::size_t c, double threshold) const {
        return !(lights_in(n.lights, c) * share_[c] <= threshold);  // NaN: not clamped, at a share of zero
    }

    /// Finds the largest share of one light from the weights of bounds. It is known also where the total is not, since
    /// that has been dark so far.
    void update_shares(const Sums& weight) {
        const auto limit = static_cast<double>(options_.radiance);
        for (std::size_t c = 0; c < weight.size(); ++c) {
            const double share = limit * weight[c];
            share_[c] = share < ratio_[c] ? share : ratio_[c];
        }
    }

    void checkpoint() { base_share_ = share_; }
    /// True if shares have changed since `checkpoint`.
    bool has_other_shares() const { return share_ != base_share_; }
    const Sums& shares() const { return share_; }
    const ClampingOptions& options() const { return options_; }
    bool is_automatic() const { return options_.is_automatic(); }

    /// True if the total has left the neighborhood of the one that the threshold was made of. Where few lights have
    /// arrived, each more of them changes the ratio: a small neighborhood, but not each total, or refining one node at
    /// a time would solve again for each. What is off is made good by `RunningTotal::revise`.
    bool has_moved(const Sums& total) const {
        if (!options_.is_automatic()) return false;
        bool moved = false;
        for (std::size_t c = 0; c < total.size(); ++c) {
            const double now = total[c], then = total_[c];
            const bool few = ratio_[c] > static_cast<double>(options_.ratio);
            const double most = few ? 1.01 : 1.25;
            moved = moved || now > most * then || now * most < then;
        }
        return moved;
    }

    /// Solves for total and threshold as if, of the lights in clusters that are dark so far, those were yet to arrive
    /// that may: about one of the clusters' mean size, and half of it if there is but one. An outlier found early would
    /// dominate the total, so the clusters that reveal it would never be refined. Returns the total.
    template <class Visit>
    Sums solve(const Visit& visit, const Sums& guess, double tolerance) {
        const Sums cautious = count_lights(visit);
        const auto solved = clamped_total<S>(options_, cautious, {}, guess, tolerance,
                                             [&](auto&& f) { visit([&](const Node& n) { f(n.estimate, n.lights); }); });
        is_final_ = cautious == ratio_;
        total_ = solved.total;
        threshold_ = solved.threshold;
        for (std::size_t c = 0; c < cautious.size(); ++c) {
            // Lights that arrive next show themselves.
            if (solved.total[c] == 0.0) threshold_[c] = static_cast<double>(options_.radiance);
        }
        return total_;
    }

    /// What a cut comes to as it is, under its own threshold. `visit(f)` calls f(node) for all of it. `total`: the
    /// running one; `converged`: the refinement has, and its nodes are as it left them. `bound_of(node)`
    /// bounds the error of each. `add_certain(node, count)` adds to a LightCount what is known for certain of the
    /// node's lights that arrive.
    template <class Visit, class BoundOf, class AddCertain>
    ClampedSums<S> sums(const Visit& visit, const Sums& total, bool converged, const BoundOf& bound_of,
                        const AddCertain& add_certain) const {
        ClampedSums<S> result;
        result.clamped = final_total(visit, total, converged);
        if (options_.is_automatic()) {
            result.bound = clamped_error<S>(
                options_, result.clamped, arriving_lights(visit, bound_of, add_certain), N::lights_rounding,
                [&](auto&& f) { visit([&](const Node& n) { f(n.estimate, bound_of(n), n.lights); }); });
            return result;
        }
        result.clamped.total = {};
        visit([&](const Node& n) {
            for (std::size_t c = 0; c < result.bound.size(); ++c) {
                const double most = lights_in(n.lights, c) * result.clamped.threshold[c];
                const auto e = static_cast<double>(channel(n.estimate, static_cast<int>(c)));
                const auto b = static_cast<double>(channel(bound_of(n), static_cast<int>(c)));
                result.clamped.total[c] += e > most ? most : e;
                result.bound[c] += b > most ? most : b;
            }
        });
        return result;
    }

private:
    /// The total of a cut as it is, under its own threshold.
    template <class Visit>
    ClampedTotal<S> final_total(const Visit& visit, const Sums& total, bool converged) const {
        // Converged refinements have found it, unless they had lights in mind which did not arrive.
        if (!options_.is_automatic() || (converged && is_final_)) return {total, threshold_, ratio_};
        const auto contributions = [&](auto&& f) { visit([&](const Node& n) { f(n.estimate, n.lights); }); };
        return clamped_total<S>(options_, effective_ratios<S>(options_, counts_, contributions), {}, total, 1e-6,
                                contributions);
    }

    /// Finds the ratio by the lights that have arrived; returns that with those which may yet.
    template <class Visit>
    Sums count_lights(const Visit& visit) {
        const auto contributions = [&](auto&& f) { visit([&](const Node& n) { f(n.estimate, n.lights); }); };
        ratio_ = effective_ratios<S>(options_, counts_, contributions);
        bool many = true;
        for (const double r : ratio_) many = many && r == static_cast<double>(options_.ratio);
        if (many) return ratio_;
        Sums lights{}, dark{}, dark_clusters{};
        visit([&](const Node& n) {
            if (!are_clamped(n.lights)) return;
            for (std::size_t c = 0; c < dark.size(); ++c) {
                const int i = static_cast<int>(c);
                const double count = lights_in(n.lights, c);
                const auto of = [&](float radiance) {
                    return counted_lights(static_cast<double>(radiance), count, counts_[c]);
                };
                const double arrived = of(channel(n.estimate, i)), most = of(channel(n.bound, i));
                lights[c] += arrived;
                if (most > arrived) {
                    dark[c] += most - arrived;
                    dark_clusters[c] += (most - arrived) / count;
                }
            }
        });
        Sums cautious{};
        for (std::size_t c = 0; c < cautious.size(); ++c) {
            cautious[c] = effective_ratio(options_, lights[c] + dark[c] / (dark_clusters[c] + 1.0));
        }
        return cautious;
    }

    /// How many clamped lights arrive: those that were looked at for certain, and others where there are bounds.
    template <class Visit, class BoundOf, class AddCertain>
    ArrivingLights<S> arriving_lights(const Visit& visit, const BoundOf& bound_of,
                                      const AddCertain& add_certain) const {
        const LightCount<S> none(options_, counts_);
        ArrivingLights<S> arriving{none, none};
        bool known = false, most_known = false;
        visit([&](const Node& n) {
            if (known || !are_clamped(n.lights)) return;
            if (!most_known) {
                arriving.most.add(is_black(n.bound) ? n.estimate : bound_of(n), n.lights);
                most_known = arriving.most.is_known();
            }
            add_certain(n, arriving.least);
            known = arriving.least.is_known();
        });
        return arriving;
    }

    ClampingOptions options_;
    Sums threshold_{};       ///< radiance: the most that a light adds
    Sums share_{};           ///< the most that a light's error adds to a priority
    Sums base_share_{};      ///< shares at the last checkpoint
    Sums total_{};           ///< of which the threshold was made
    Sums counts_{};          ///< of a light, per radiance: see `counts_per_radiance`
    Sums ratio_{};           ///< by the lights that have arrived; infinite while there are none
    bool is_final_ = false;  ///< the threshold was made by that ratio, not with others in mind
};

struct ClampingTag {};

}  // namespace lightcuts::detail
