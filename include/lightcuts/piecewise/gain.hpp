#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../tree/cluster_tree.hpp"
#include "moments.hpp"

namespace lightcuts {

namespace detail {

/// The steps by which the error below a node can best be lowered, as mergeable heaps (leftist ones) in one array.
class GainHeaps {
public:
    static constexpr std::uint32_t none = 0xffff'ffffu;

    explicit GainHeaps(std::size_t steps) { steps_.reserve(steps); }

    double slope(std::uint32_t heap) const { return steps_[heap].reduction / steps_[heap].pieces; }
    double reduction(std::uint32_t heap) const { return steps_[heap].reduction; }
    double pieces(std::uint32_t heap) const { return steps_[heap].pieces; }

    std::uint32_t add(double reduction, double pieces) {
        steps_.push_back({reduction, pieces, none, none, 1});
        return static_cast<std::uint32_t>(steps_.size() - 1);
    }
    /// Without the first step.
    std::uint32_t rest(std::uint32_t heap) { return meld(steps_[heap].left, steps_[heap].right); }
    /// cost: O(log N), also of the stack.
    std::uint32_t meld(std::uint32_t a, std::uint32_t b) {
        if (a == none) return b;
        if (b == none) return a;
        if (slope(a) < slope(b)) std::swap(a, b);
        const std::uint32_t right = meld(steps_[a].right, b);
        Step& top = steps_[a];
        top.right = right;
        if (rank(top.left) < rank(top.right)) std::swap(top.left, top.right);
        top.rank = rank(top.right) + 1;
        return a;
    }

private:
    struct Step {
        double reduction;  ///< of the sum of squared deviations
        double pieces;     ///< that it takes more
        std::uint32_t left, right;
        std::uint32_t rank;
    };
    std::uint32_t rank(std::uint32_t heap) const { return heap == none ? 0 : steps_[heap].rank; }

    std::vector<Step> steps_;
};

}  // namespace detail

/// Of every node, by how much each more piece lowers the squared L2 error if the subtree is refined as is best: the
/// largest (|C| var - the same after) / (pieces - 1) over all cuts of the subtree; 0 for leaves. A node whose own split
/// helps little, but those below it much, has a large gain.
/// Refined by gain instead of error, a cut has the fewest pieces for its L2 error, whenever no node below has a larger
/// gain than the one refined last: the lower convex hull of error over size.
/// pre: `moments` are of this tree. cost: O(N log N).
template <int Channels>
std::vector<double> gains(const ClusterTree& tree, const std::vector<Moments<Channels>>& moments) {
    using Heaps = detail::GainHeaps;
    std::vector<double> result(tree.size(), 0.0);
    std::vector<std::uint32_t> heap(tree.size(), Heaps::none);
    Heaps heaps(tree.size());
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        if (tree.is_leaf(n)) continue;
        double reduction = moments[n].total_squared_deviation(), pieces = -1.0;
        std::uint32_t below = Heaps::none;
        tree.for_each_child(n, [&](std::uint32_t child) {
            reduction -= moments[child].total_squared_deviation();
            pieces += 1.0;
            below = heaps.meld(below, heap[child]);
        });
        if (!(reduction > 0.0)) reduction = 0.0;  // it cannot be less, but for rounding
        // A step below that pays more than this node's split is taken along with it.
        while (below != Heaps::none && heaps.slope(below) * pieces >= reduction) {
            reduction += heaps.reduction(below);
            pieces += heaps.pieces(below);
            below = heaps.rest(below);
        }
        result[n] = reduction / pieces;
        heap[n] = heaps.meld(heaps.add(reduction, pieces), below);
    }
    return result;
}

}  // namespace lightcuts
