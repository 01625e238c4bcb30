#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "../bound/policy.hpp"
#include "../core/assertion.hpp"
#include "../core/reusable_list.hpp"
#include "../cut/refinement.hpp"
#include "../tree/cluster_tree.hpp"
#include "product_node.hpp"

namespace lightcuts::detail {

/// Pairs of clusters of one kind each, side by side, to be bounded at once.
template <class GatherTree, class LightTree>
class PairBlock {
public:
    using B = std::remove_cvref_t<decltype(std::declval<const GatherTree&>().bound(0))>;
    using L = typename LightTree::light_type;
    using S = typename LightTree::spectrum;

    PairBlock(const GatherTree& gather_tree, const LightTree& light_tree)
        : gather_tree_(gather_tree), light_tree_(light_tree) {}

    std::size_t size() const { return count_; }
    bool is_full() const { return count_ == lanes; }
    void clear() { count_ = 0; }
    void add(std::uint32_t gather, std::uint32_t light) {
        if constexpr (by_value) {
            made_[count_] = gather_tree_.bound(gather);
            bounds_[count_] = &made_[count_];
        } else {
            bounds_[count_] = &gather_tree_.bound(gather);
        }
        boxes_[count_] = &gather_tree_.clusters()[gather].box;
        clusters_[count_] = &light_tree_.clusters()[light];
        ++count_;
    }
    template <class Policy>
    const std::array<S, static_cast<std::size_t>(lane_count)>& bound(const Policy& policy) {
        if (count_ > 0)
            quick_pair_bounds(policy, bounds_.data(), clusters_.data(), count_, boxes_.data(), units_.data());
        return units_;
    }

private:
    static constexpr std::size_t lanes = static_cast<std::size_t>(lane_count);
    struct NoBounds {};
    static constexpr bool by_value = !std::is_reference_v<decltype(std::declval<const GatherTree&>().bound(0))>;

    const GatherTree& gather_tree_;
    const LightTree& light_tree_;
    std::size_t count_ = 0;
    std::array<const B*, lanes> bounds_;
    std::array<const Box*, lanes> boxes_;
    std::array<const LightCluster<L>*, lanes> clusters_;
    [[no_unique_address]] std::conditional_t<by_value, std::array<B, lanes>, NoBounds> made_;
    std::array<S, lanes> units_;
};

/// Bounds pairs of clusters that are about to be split, and says which side of each to split.
template <class Lights, class Points, class Policy>
class PairBounder {
public:
    using S = typename Lights::spectrum;
    using Node = ProductNode<S, Lights::forest_type::clamps>;

    PairBounder(const Lights& lights, const Points& points, const Policy& policy, SideRule rule)
        : lights_(lights), points_(points), policy_(policy), rule_(rule) {}

    /// `priority(node)`: after the bound has changed. `threshold`: of such priorities; nodes below are not split.
    template <class Priority>
    void tighten(ReusableList<Node>& frontier, std::span<RefinementCandidate> candidates, const Priority& priority,
                 double threshold) const {
        points_.for_each([&](std::uint32_t gather_kind, const auto& gather_tree) {
            if (gather_tree.empty()) return;
            lights_.for_each([&](std::uint32_t light_kind, const auto& light_tree, const auto&) {
                if (light_tree.empty()) return;
                const auto is_of_kinds = [&](const Node& n) {
                    return n.gather_kind == gather_kind && n.light_kind == light_kind;
                };
                bound_pairs(gather_tree, light_tree, frontier, candidates, is_of_kinds, priority, threshold);
                choose_sides(gather_tree, light_tree, frontier, candidates, is_of_kinds, threshold);
            });
        });
    }

private:
    template <class GatherTree, class LightTree, class IsOfKinds, class Priority>
    void bound_pairs(const GatherTree& gather_tree, const LightTree& light_tree, ReusableList<Node>& frontier,
                     std::span<RefinementCandidate> candidates, const IsOfKinds& is_of_kinds, const Priority& priority,
                     [[maybe_unused]] double threshold) const {
        PairBlock block(gather_tree, light_tree);
        std::array<RefinementCandidate*, static_cast<std::size_t>(lane_count)> members;
        const auto flush = [&] {
            const auto& units = block.bound(policy_);
            for (std::size_t i = 0; i < block.size(); ++i) {
                Node& n = frontier[members[i]->at];
                double& p = members[i]->priority;
                LIGHTCUTS_ASSERT(dominates(units[i], n.transfer) &&
                                 "a bound is below what evaluate() returns: do both include the cosine?");
                lower_bound(n, units[i]);
                n.bounded = true;
                p = priority(n);
                if constexpr (Policy::two_stages) {
                    // The tight bound is computed only where it can change the decision.
                    if (policy_.tight_band > 1.0 && p > threshold && p < policy_.tight_band * threshold) {
                        lower_bound(n, policy_.tight(gather_tree.bound(n.gather), light_tree.clusters()[n.light],
                                                     gather_tree.clusters()[n.gather].box));
                        p = priority(n);
                    }
                }
            }
            block.clear();
        };
        for (RefinementCandidate& candidate : candidates) {
            const Node& n = frontier[candidate.at];
            if (n.bounded || !is_of_kinds(n)) continue;
            members[block.size()] = &candidate;
            block.add(n.gather, n.light);
            if (block.is_full()) flush();
        }
        flush();
    }

    /// The side whose collapse to one of its leaves lowers the bound more: what is left then is the other side's. Each
    /// split of one side in a row lets the other one appear a tenth better. Not to its representative: representatives
    /// that contribute much would be kept and others split away, which biases the sum.
    template <class GatherTree, class LightTree, class IsOfKinds>
    void choose_sides(const GatherTree& gather_tree, const LightTree& light_tree, ReusableList<Node>& frontier,
                      std::span<RefinementCandidate> candidates, const IsOfKinds& is_of_kinds, double threshold) const {
        PairBlock block(gather_tree, light_tree);
        std::array<Node*, static_cast<std::size_t>(lane_count)> members;
        const auto flush = [&] {
            const auto& units = block.bound(policy_);
            for (std::size_t i = 0; i < block.size(); i += 2) {
                Node& n = *members[i];
                const double gather_left = residue(units[i], n.gather_splits);
                const double light_left = residue(units[i + 1], n.light_splits);
                if (gather_left != light_left) {
                    n.side = gather_left < light_left ? PairSide::gather : PairSide::light;
                } else {
                    const double of_points = diagonal2(gather_tree.clusters()[n.gather].box);
                    const double of_lights = diagonal2(light_tree.clusters()[n.light].box);
                    n.side = of_points > of_lights ? PairSide::gather : PairSide::light;
                }
            }
            block.clear();
        };
        for (const RefinementCandidate& candidate : candidates) {
            Node& n = frontier[candidate.at];
            if (n.side != PairSide::undecided || !is_of_kinds(n) || !(candidate.priority > threshold)) continue;
            if (gather_tree.topology().is_leaf(n.gather)) {
                n.side = PairSide::light;
            } else if (light_tree.topology().is_leaf(n.light)) {
                n.side = PairSide::gather;
            } else if (rule_ == SideRule::sizes) {
                n.side = larger_side(gather_tree, light_tree, n);
            } else {
                members[block.size()] = &n;
                block.add(some_leaf(gather_tree.topology(), n.gather), n.light);
                block.add(n.gather, some_leaf(light_tree.topology(), n.light));
                if (block.is_full()) flush();
            }
        }
        flush();
    }

    /// By SideRule::sizes, with the same tenth for each split in a row.
    template <class GatherTree, class LightTree>
    static PairSide larger_side(const GatherTree& gather_tree, const LightTree& light_tree, const Node& n) {
        const auto& points = gather_tree.clusters()[n.gather];
        const auto& lights = light_tree.clusters()[n.light];
        double of_points = std::sqrt(diagonal2(points.box));
        const bool apart = !touch(points.box, lights.box);
        if constexpr (requires { points.envelope.cosine_lobe().normal.sin2_half; }) {
            if (apart) of_points *= std::fmax(0.0, cos_half_angle(points.envelope.cosine_lobe().normal));
        }
        const double of_lights = std::sqrt(diagonal2(lights.box));
        return of_points * rise(n.light_splits) > of_lights * rise(n.gather_splits) ? PairSide::gather
                                                                                    : PairSide::light;
    }
    template <class Box1>
    static bool touch(const Box1& a, const Box1& b) {
        for (int c = 0; c < 3; ++c) {
            if (a.hi[c] < b.lo[c] || b.hi[c] < a.lo[c]) return false;
        }
        return true;
    }

    /// A leaf below `n` at about its middle, whatever the representatives.
    static std::uint32_t some_leaf(const ClusterTree& tree, std::uint32_t n) { return tree.left_leaf(tree.right(n)); }

    static double residue(const S& unit, int splits) { return static_cast<double>(channel_max(unit)) * rise(splits); }
    static double rise(int splits) {
        double factor = 1.0;
        for (int i = 0; i < splits; ++i) factor *= 1.1;
        return factor;
    }

    static void lower_bound(Node& n, const S& unit) {
        n.unit_bound = smaller_channels(n.unit_bound, unit);
        n.bound = multiply_bounds(n.unit_bound, n.weight);
    }

    const Lights& lights_;
    const Points& points_;
    const Policy& policy_;
    SideRule rule_;
};

}  // namespace lightcuts::detail
