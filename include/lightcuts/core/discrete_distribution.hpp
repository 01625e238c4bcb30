#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lightcuts::detail {

/// Draws one of many with probabilities in proportion to their weights.
class DiscreteDistribution {
public:
    void add(double weight) { cumulative_.push_back(total() + weight); }
    /// To be called after the last `add`. pre: total() > 0
    void prepare() {
        starts_.resize(cumulative_.size());
        std::size_t at = 0;
        for (std::size_t cell = 0; cell < starts_.size(); ++cell) {
            const double start = total() * (static_cast<double>(cell) / static_cast<double>(starts_.size()));
            starts_[cell] = at = first_beyond(start, at);
        }
    }

    std::size_t size() const { return cumulative_.size(); }
    double total() const { return cumulative_.empty() ? 0.0 : cumulative_.back(); }

    /// The share of choice `at` in the total.
    double probability(std::size_t at) const {
        return (cumulative_[at] - (at > 0 ? cumulative_[at - 1] : 0.0)) / total();
    }

    /// The choice for `u` in [0, 1): the first whose weight and those before it exceed that share of the total. It is
    /// looked for from where the cell of u begins, as cells are many [Chen and Asau 1974]. cost: O(1), on average
    std::size_t operator()(double u) const {
        const double wanted = u * total();
        const auto cell = static_cast<std::size_t>(u * static_cast<double>(starts_.size()));
        std::size_t at = starts_[(std::min)(cell, starts_.size() - 1)];
        while (at > 0 && cumulative_[at - 1] > wanted) --at;  // rounding
        return first_beyond(wanted, at);
    }

private:
    /// The first from `at` on with which the sum exceeds `wanted`, or is complete.
    std::size_t first_beyond(double wanted, std::size_t at) const {
        while (cumulative_[at] <= wanted && cumulative_[at] < total()) ++at;
        return at;
    }

    std::vector<double> cumulative_;
    std::vector<std::size_t> starts_;  ///< choice for the first u of each cell
};

}  // namespace lightcuts::detail
