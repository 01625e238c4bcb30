#pragma once

#include <cstddef>
#include <limits>

#include "clamp.hpp"
#include "cut_node.hpp"
#include "refinement.hpp"

namespace lightcuts::detail {

/// How the contributions to one receiver's cut are clamped at the moment.
template <Spectrum S>
class CutClamping {
public:
    using Sums = ChannelSums<S>;
    using Node = CutNode<S, true>;

    template <class Forest>
    void start(const ClampingOptions& options, const Forest& forest) {
        *this = {};
        options_ = options;
        if (options.is_automatic()) counts_ = counts_per_radiance(forest);
        threshold_.fill(static_cast<double>(options.radiance));
        ratio_.fill(std::numeric_limits<double>::infinity());
    }

    /// What a node of this estimate adds to channel `c` of the total.
    double contribution(const Node& n, std::size_t c) const {
        const auto estimate = static_cast<double>(channel(n.estimate, static_cast<int>(c)));
        const double most = static_cast<double>(n.lights) * threshold_[c];
        return estimate > most ? most : estimate;
    }

    /// True if the node's lights together may be off by more than `threshold` in channel `c`, as a share of the total.
    bool may_exceed(const Node& n, std::size_t c, double threshold) const {
        return !(static_cast<double>(n.lights) * share_[c] <= threshold);  // NaN: not clamped, at a share of zero
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
        const auto solved = clamped_total<S>(options_, cautious, {}, guess, tolerance, [&](auto&& f) {
            visit([&](const Node& n) { f(n.estimate, static_cast<double>(n.lights)); });
        });
        is_final_ = cautious == ratio_;
        total_ = solved.total;
        threshold_ = solved.threshold;
        for (std::size_t c = 0; c < cautious.size(); ++c) {
            // Lights that arrive next show themselves.
            if (solved.total[c] == 0.0) threshold_[c] = static_cast<double>(options_.radiance);
        }
        return total_;
    }

    /// The total of a cut as it is, under its own threshold. `total`: the running one.
    ClampedTotal<S> final_total(const Refinement<Node>& refinement, const Sums& total) const {
        // Converged refinements have found it, unless they had lights in mind which did not arrive.
        const bool is_found = refinement.stop_reason() == StopReason::converged && is_final_;
        if (!options_.is_automatic() || is_found) return {total, threshold_, ratio_};
        const auto visit = [&](auto&& f) {
            refinement.for_each([&](const Node& n) { f(n.estimate, static_cast<double>(n.lights)); });
        };
        return clamped_total<S>(options_, effective_ratios<S>(options_, counts_, visit), {}, total, 1e-6, visit);
    }

    /// Bounds the error of `cut`.
    Sums error(const Refinement<Node>& refinement, const ClampedTotal<S>& cut) const {
        return clamped_error<S>(options_, cut, arriving_lights(refinement), [&](auto&& f) {
            refinement.for_each([&](const Node& n) { f(n.estimate, n.bound, static_cast<double>(n.lights)); });
        });
    }

private:
    /// Finds the ratio by the lights that have arrived; returns that with those which may yet.
    template <class Visit>
    Sums count_lights(const Visit& visit) {
        const auto contributions = [&](auto&& f) {
            visit([&](const Node& n) { f(n.estimate, static_cast<double>(n.lights)); });
        };
        ratio_ = effective_ratios<S>(options_, counts_, contributions);
        bool many = true;
        for (const double r : ratio_) many = many && r == static_cast<double>(options_.ratio);
        if (many) return ratio_;
        Sums lights{}, dark{}, dark_clusters{};
        visit([&](const Node& n) {
            if (!(n.lights < std::numeric_limits<float>::infinity())) return;
            for (std::size_t c = 0; c < dark.size(); ++c) {
                const int i = static_cast<int>(c);
                const auto count = static_cast<double>(n.lights);
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
    ArrivingLights<S> arriving_lights(const Refinement<Node>& refinement) const {
        const LightCount<S> none(options_, counts_);
        ArrivingLights<S> arriving{none, none};
        bool known = false, most_known = false;
        refinement.for_each([&](const Node& n) {
            if (known || !(n.lights < std::numeric_limits<float>::infinity())) return;
            const bool single = n.lights == 1.0f;
            if (!most_known) {
                arriving.most.add(single ? n.estimate : n.bound, static_cast<double>(n.lights));
                most_known = arriving.most.is_known();
            }
            arriving.least.add(n.estimate, 1.0, single ? 1.0 : representative_part(n));
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
