#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "../core/invalid_input.hpp"
#include "../core/reusable_list.hpp"
#include "../cut/refinement.hpp"
#include "../tree/cluster_tree.hpp"
#include "moments.hpp"
#include "piecewise_constant.hpp"

namespace lightcuts {

namespace detail {

/// Appends the deviations of all pieces of `out` from the function of these moments.
template <PiecewiseValue V>
void append_deviations(std::span<const MomentsOf<V>> moments, PiecewiseConstant<V>& out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        for (int c = 0; c < channels_of<V>; ++c) {
            const double value = value_channel(out.values()[i], c);
            out.append_deviation(moments[out.pieces()[i].node()].deviation_from(value, c));
        }
    }
}

/// The mean of a piece.
/// throws: invalid_input naming the node if V is of floats and the mean beyond them. cost: O(1).
template <PiecewiseValue V>
V mean_of_piece(const MomentsOf<V>& moments, std::uint32_t node) {
    const V value = moments.template value<V>();
    for (int c = 0; c < channels_of<V>; ++c) {
        if (!std::isfinite(value_channel(value, c))) {
            LIGHTCUTS_THROW(invalid_input("approximation, node " + std::to_string(node) + ": the mean " +
                                          std::to_string(moments.mean[static_cast<std::size_t>(c)]) +
                                          " is beyond the largest float; scale the function, or take doubles"));
        }
    }
    return value;
}

inline void check_deviation(double deviation, const char* name) {
    if (!(deviation >= 0.0)) {
        LIGHTCUTS_THROW(invalid_input(std::string(name) + ": " + std::to_string(deviation) + " is not 0 or more"));
    }
}

inline void check_moments(const ClusterTree& tree, std::size_t moments) {
    if (moments != tree.size()) {
        LIGHTCUTS_THROW(invalid_input("cluster tree: " + std::to_string(tree.size()) + " nodes, but " +
                                      std::to_string(moments) + " moments; they are of another tree"));
    }
}

}  // namespace detail

/// Makes `out` the mean of a function below the highest nodes whose L2 error, sqrt(|C| var), is at most
/// `node_deviation` [Cut merging 2008, Eq. 5, where it is called sigma]. Whether a node is on the cut depends on
/// nothing outside its subtree. `moments`: of the function at each node of `tree`. The paper takes 1.5 to 3 for
/// visibility over 32,000 directions. Deviations are kept with the pieces where `with_deviations` says so, for bounds
/// of errors. throws: invalid_input if `moments` are not of this tree, `node_deviation` is negative or no number, or
/// naming a node whose mean is beyond the values' type.
/// cost: O(nodes visited), at most twice the size of the cut in a binary tree; nothing is allocated if `out` has room.
template <PiecewiseValue V>
void approximate(const ClusterTree& tree, const std::vector<MomentsOf<V>>& moments, double node_deviation,
                 PiecewiseConstant<V>& out, bool with_deviations = false) {
    detail::check_moments(tree, moments.size());
    detail::check_deviation(node_deviation, "node_deviation");
    const double most = node_deviation * node_deviation;
    detail::Filling filling(out);
    // From right to left the node before n in the array is its last child, and that before its first leaf the next
    // node which is not below it: a descent without a stack.
    auto leaf_end = static_cast<std::uint32_t>(tree.item_count());
    for (auto n = static_cast<std::int64_t>(tree.size()) - 1; n >= 0;) {
        const auto node = static_cast<std::uint32_t>(n);
        const MomentsOf<V>& m = moments[node];
        if (tree.is_leaf(node) || m.total_squared_deviation() <= most) {
            out.append({node, leaf_end}, detail::mean_of_piece<V>(m, node));
            leaf_end -= static_cast<std::uint32_t>(m.leaves);
            n = std::int64_t{tree.left_leaf(node)} - 1;
        } else {
            --n;
        }
    }
    out.reverse();
    if (with_deviations) detail::append_deviations<V>(moments, out);
    filling.finish();
}

/// Approximates a function step by step, largest first, from the root down: to a largest error of a node, to an L2
/// error of the whole, by values, by a rule of your own, up to a size. Steps may follow each other, as in an
/// illumination cut, which is refined by error first and then by value up to a size [Cut merging 2008, section 3.2];
/// after any of them `store` gives the function. The cuts of a sequence of growing sizes are refinements of each other.
/// Reusable: no allocation once warm. cost: O(log n) a split.
template <PiecewiseValue V>
class OrderedApproximation {
public:
    static constexpr std::size_t unlimited = (std::numeric_limits<std::size_t>::max)();

    /// Starts with the root alone. `moments`: of the function at each node of `tree`; both are referred to.
    /// throws: invalid_input if `moments` are not of this tree.
    void start(const ClusterTree& tree, const std::vector<MomentsOf<V>>& moments) {
        detail::check_moments(tree, moments.size());
        tree_ = &tree;
        moments_ = &moments;
        // One round of nothing but the roots.
        auto nothing = [](std::uint32_t) { return 0.0; };
        Problem<decltype(nothing)> problem{*this, nothing, 0.0};
        refinement_.start(problem);
        refinement_.step(problem, {});
    }
    void start(const ClusterTree&, std::vector<MomentsOf<V>>&&) = delete;
    void start(ClusterTree&&, const std::vector<MomentsOf<V>>&) = delete;

    /// Refines nodes, that of the largest error first, until sqrt(|C| var) is at most `node_deviation` everywhere or
    /// there are `max_size` pieces. Nodes of more children than there is room for are passed over.
    /// throws: invalid_input if `node_deviation` is negative or no number.
    StopReason refine_by_error(double node_deviation, std::size_t max_size = unlimited) {
        detail::check_deviation(node_deviation, "node_deviation");
        return refine([this](std::uint32_t n) { return error(n); }, node_deviation * node_deviation, max_size);
    }

    /// Refines nodes, that of the largest error first, until the L2 error of the whole, sqrt(sum |C| var), is at most
    /// `deviation` or there are `max_size` pieces. Nodes of equal error are refined together. Fewer pieces than by
    /// error of nodes, less evenly spread. throws: invalid_input if `deviation` is negative or no number.
    StopReason refine_to_total_error(double deviation, std::size_t max_size = unlimited) {
        return refine_to_total_error(
            deviation, [this](std::uint32_t n) { return error(n); }, max_size);
    }

    /// The same in an order of your own, as by `gains`, which takes the fewest pieces.
    /// pre: `priority(node)` is as in `refine`, and is positive for a node with an error.
    template <std::invocable<std::uint32_t> Priority>
    StopReason refine_to_total_error(double deviation, Priority priority, std::size_t max_size = unlimited) {
        detail::check_deviation(deviation, "deviation");
        TotalProblem<Priority> problem{{*this, priority, 0.0}, deviation * deviation};
        return run(problem, max_size);
    }

    /// Refines nodes, that of the largest |mean| first, summed over the channels, until it is at most `magnitude`
    /// everywhere above the leaves or there are `max_size` pieces.
    StopReason refine_by_value(std::size_t max_size, double magnitude = 0.0) {
        return refine(
            [this](std::uint32_t n) {
                double sum = 0.0;
                for (const double mean : (*moments_)[n].mean) sum += std::abs(mean);
                return sum;
            },
            magnitude, max_size);
    }

    /// Refines nodes by a rule of your own, `priority(node)`, that of the largest first, until it is at most
    /// `threshold` everywhere above the leaves or there are `max_size` pieces. pre: priorities are >= 0, never NaN.
    template <std::invocable<std::uint32_t> Priority>
    StopReason refine(Priority priority, double threshold, std::size_t max_size = unlimited) {
        Problem<Priority> problem{*this, priority, threshold};
        return run(problem, max_size);
    }

    /// Number of pieces.
    std::size_t size() const { return refinement_.size(); }

    /// An upper bound of the L2 error of the whole, sqrt(sum |C| var). cost: O(size).
    double total_error() const { return std::sqrt(sum_of_errors()) * (1.0 + 4.0 * unit_roundoff); }

    /// Makes `out` the mean of the function below each node of the cut. Deviations are kept with the pieces where
    /// `with_deviations` says so, for bounds of errors.
    /// throws: invalid_input naming a node whose mean is beyond the values' type. cost: O(n log n).
    void store(PiecewiseConstant<V>& out, bool with_deviations = false) {
        nodes_.clear();
        refinement_.for_each([this](std::uint32_t n) { nodes_.push_back(n); });
        std::sort(nodes_.begin(), nodes_.end());
        detail::Filling filling(out);
        std::uint32_t leaf_end = 0;
        for (const std::uint32_t n : nodes_) {
            leaf_end += static_cast<std::uint32_t>((*moments_)[n].leaves);
            out.append({n, leaf_end}, detail::mean_of_piece<V>((*moments_)[n], n));
        }
        if (with_deviations) detail::append_deviations<V>(*moments_, out);
        filling.finish();
    }

private:
    /// What the refinement engine asks.
    template <class Priority>
    struct Problem {
        using Node = std::uint32_t;
        static constexpr bool fixed_priorities = true;

        OrderedApproximation& owner;
        Priority& rule;
        double least;

        void roots(ReusableList<Node>& out) const {
            if (!owner.tree_->empty()) out.append(owner.tree_->root());
        }
        void evaluate(std::span<Node>) const {}
        bool is_final(Node n) const { return owner.tree_->is_leaf(n); }
        double priority(Node n) const { return static_cast<double>(rule(n)); }
        double threshold() const { return least; }
        std::size_t children(Node n) const {
            if (owner.tree_->is_binary()) return 2;
            std::size_t count = 0;
            owner.tree_->for_each_child(n, [&](Node) { ++count; });
            return count;
        }
        void split(Node n, ReusableList<Node>& out) {
            owner.tree_->for_each_child(n, [&](Node child) { out.append(child); });
        }
        bool precedes(Node a, Node b) const { return a < b; }
    };

    /// Ends when the sum of all errors is small enough.
    template <class Priority>
    struct TotalProblem : Problem<Priority> {
        using Node = std::uint32_t;

        double budget;
        double total = 0.0;
        double largest_total = 0.0;  ///< since it was last summed up

        template <class Visit>
        void observe(const Visit&) {
            // Differences of what was large say little of what is left; nor does rounding decide when to stop.
            if (total <= budget || total < 1e-3 * largest_total) {
                total = this->owner.sum_of_errors();
                largest_total = total;
            }
            this->least = total <= budget ? std::numeric_limits<double>::infinity() : 0.0;
        }
        void split(Node n, ReusableList<Node>& out) {
            total -= this->owner.error(n);
            this->owner.tree_->for_each_child(n, [&](Node child) {
                total += this->owner.error(child);
                out.append(child);
            });
        }
    };

    template <class P>
    StopReason run(P& problem, std::size_t max_size) {
        refinement_.reprioritize(problem);
        const RefinementOptions options{.max_nodes = max_size, .round_fraction = 1.0};
        while (refinement_.step(problem, options)) {}
        return refinement_.stop_reason();
    }

    double error(std::uint32_t n) const { return (*moments_)[n].total_squared_deviation(); }
    double sum_of_errors() const {
        double sum = 0.0;
        refinement_.for_each([&](std::uint32_t n) { sum += error(n); });
        return sum * detail::sum_inflation(static_cast<double>(refinement_.size()));
    }

    const ClusterTree* tree_ = nullptr;
    const std::vector<MomentsOf<V>>* moments_ = nullptr;
    Refinement<std::uint32_t> refinement_;
    std::vector<std::uint32_t> nodes_;  ///< storage of `store`
};

}  // namespace lightcuts
