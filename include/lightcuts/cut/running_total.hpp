#pragma once

#include <cstddef>
#include <limits>
#include <type_traits>

#include "clamping.hpp"
#include "cut_node.hpp"

namespace lightcuts::detail {

/// The estimated total of one cut while it is refined, radiance in double, and the priorities that follow
/// from it: what a cluster may be off by, as a share of the total. `N` has an `estimate` and a `bound`, and
/// what CutClamping asks for if the cut `Clamps`.
template <Spectrum S, bool Clamps = false, class N = CutNode<S, Clamps>>
class RunningTotal {
public:
    using Sums = ChannelSums<S>;
    using Node = N;

    /// The arguments are looked at only if `Clamps`; see CutClamping.
    template <class Counts>
    void start([[maybe_unused]] const ClampingOptions& clamp, [[maybe_unused]] const Counts& counts) {
        *this = {};
        weight_.fill(darkest);
        if constexpr (Clamps) {
            clamping_.start(clamp, counts);
            clamping_.update_shares(weight_);
        }
    }

    void add(const Node& n) {
        for (std::size_t c = 0; c < total_.size(); ++c) total_[c] += contribution(n, c);
    }
    void subtract(const Node& n) {
        for (std::size_t c = 0; c < total_.size(); ++c) total_[c] -= contribution(n, c);
    }

    /// Sums up again where the running sum has lost its digits, and makes priorities of the total as it is.
    /// `adaptation`: radiance added to the total. `visit(f)` calls f(node) for the whole cut.
    template <class Visit>
    void update(const Visit& visit, double adaptation) {
        if constexpr (Clamps) {
            if (clamping_.has_moved(total_)) solve_clamping(visit, 1e-2);
        }
        // Differences of a sum that was once much larger are noise. Within a round it is largest at the end.
        constexpr double cancellation = 1e6;
        bool is_noise = false;
        for (std::size_t c = 0; c < total_.size(); ++c) {
            const double total = total_[c];
            largest_[c] = total > largest_[c] ? total : largest_[c];
            is_noise = is_noise || !(largest_[c] <= cancellation * total);
        }
        if (is_noise) {
            total_ = {};
            visit([this](const Node& n) { add(n); });
            largest_ = total_;
        }
        update_weights(adaptation);
    }

    /// Finds the final total under its own threshold; true if the running total was so much larger, or lights thought
    /// to arrive so many more, that clusters may have been left too coarse.
    template <class Visit>
    bool revise(const Visit& visit, double adaptation) requires Clamps {
        if (!clamping_.is_automatic()) return false;
        const Sums weight = weight_, share = clamping_.shares();
        solve_clamping(visit, 1e-6);
        update_weights(adaptation);
        bool grown = false;
        for (std::size_t c = 0; c < weight.size(); ++c) {
            grown = grown || weight_[c] > 1.01 * weight[c] || clamping_.shares()[c] > 1.01 * share[c];
        }
        return grown;
    }

    /// Priorities are those of now until the next time.
    void checkpoint() {
        base_ = weight_;
        if constexpr (Clamps) clamping_.checkpoint();
    }
    /// The largest factor by which a priority has changed since `checkpoint`.
    double priority_scale() const {
        return extreme_ratio([](double a, double b) { return a > b; });
    }
    /// The largest factor over the least one; infinite if priorities follow from another rule now.
    double priority_spread() const {
        if constexpr (Clamps) {
            if (clamping_.has_other_shares()) return std::numeric_limits<double>::infinity();
        }
        return priority_scale() / extreme_ratio([](double a, double b) { return a < b; });
    }

    /// What a cluster may be off by, as a share of the total at the last checkpoint. A channel in which clamping alone
    /// keeps the cluster's error below `threshold` does not count.
    double priority(const Node& n, [[maybe_unused]] double threshold) const {
        double largest = 0.0;
        for (std::size_t c = 0; c < base_.size(); ++c) {
            if constexpr (Clamps) {
                if (!clamping_.may_exceed(n, c, threshold)) continue;
            }
            const double p = static_cast<double>(channel(n.bound, static_cast<int>(c))) * base_[c];
            largest = p > largest ? p : largest;
        }
        return largest;
    }

    const Sums& total() const { return total_; }
    const CutClamping<S, N>& clamping() const requires Clamps { return clamping_; }

private:
    static constexpr double darkest = 1e150;  ///< weight of bounds where no light has arrived

    double contribution(const Node& n, std::size_t c) const {
        if constexpr (Clamps) return clamping_.contribution(n, c);
        return static_cast<double>(channel(n.estimate, static_cast<int>(c)));
    }

    template <class Precedes>
    double extreme_ratio(const Precedes& precedes) const {
        double extreme = weight_[0] / base_[0];
        for (std::size_t c = 1; c < weight_.size(); ++c) {
            const double ratio = weight_[c] / base_[c];
            extreme = precedes(ratio, extreme) ? ratio : extreme;
        }
        return extreme;
    }

    template <class Visit>
    void solve_clamping(const Visit& visit, double tolerance) requires Clamps {
        total_ = clamping_.solve(visit, total_, tolerance);
        largest_ = total_;
    }

    void update_weights(double adaptation) {
        for (std::size_t c = 0; c < total_.size(); ++c) {
            const double reference = total_[c] + adaptation;
            // Against darkness every bound is too large, and larger bounds are refined first.
            weight_[c] = reference * darkest > 1.0 ? 1.0 / reference : darkest;
        }
        if constexpr (Clamps) clamping_.update_shares(weight_);
    }

    Sums total_{};    ///< running sum of the estimates, clamped
    Sums largest_{};  ///< largest running sum since it was last computed afresh
    Sums weight_{};   ///< 1 / (total + adaptation): what turns a bound into a priority
    Sums base_{};     ///< weights at the last checkpoint
    [[no_unique_address]] std::conditional_t<Clamps, CutClamping<S, N>, Empty<ClampingTag>> clamping_{};
};

}  // namespace lightcuts::detail
