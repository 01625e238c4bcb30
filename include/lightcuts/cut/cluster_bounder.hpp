#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "../bound/policy.hpp"
#include "../core/assertion.hpp"
#include "../core/reusable_list.hpp"
#include "../material/material.hpp"
#include "../shading/shadow_origin.hpp"
#include "../visibility/oracle.hpp"
#include "cut_node.hpp"
#include "forest.hpp"
#include "refinement.hpp"

namespace lightcuts::detail {

/// Replaces bounds that nodes have inherited from their parents by the clusters' own, where a node is about to be
/// split. Most clusters on a final cut never need one.
template <class Forest, class R, class Oracle, class Policy>
class ClusterBounder {
public:
    using S = typename Forest::spectrum;
    using Node = CutNode<S, Forest::clamps>;

    /// `hidden`: counts clusters that the oracle proves to be hidden.
    ClusterBounder(const Forest& forest, const R& receiver, const Oracle& oracle, const Policy& policy,
                   std::uint32_t& hidden)
        : forest_(forest), receiver_(receiver), oracle_(oracle), policy_(policy), hidden_(hidden) {}

    /// `priority(node)`: after the bound has changed. `threshold`: of such priorities; nodes below are not split.
    template <class Priority>
    void tighten(ReusableList<Node>& frontier, std::span<RefinementCandidate> candidates, const Priority& priority,
                 double threshold) const {
        forest_.for_each([&](std::uint32_t kind, const auto& tree) {
            if (tree.empty()) return;
            std::array<RefinementCandidate*, lane_count> members;
            std::size_t count = 0;
            for (RefinementCandidate& candidate : candidates) {
                const Node& n = frontier[candidate.at];
                if (n.bounded || n.kind != kind) continue;
                members[count++] = &candidate;
                if (count < members.size()) continue;
                bound(tree, frontier, std::span(members), priority, threshold);
                count = 0;
            }
            if (count > 0) bound(tree, frontier, std::span(members).first(count), priority, threshold);
        });
    }

private:
    template <class Tree, class Priority>
    void bound(const Tree& tree, ReusableList<Node>& frontier, std::span<RefinementCandidate* const> candidates,
               const Priority& priority, double threshold) const {
        using Cluster = typename Tree::cluster;
        using Surface = std::remove_cvref_t<decltype(R::material)>;
        static_assert(
            BoundPolicy<Policy, Surface, Cluster>,
            "a bound policy needs quick(bound, cluster, receivers) const, which returns the lights' spectrum");
        std::array<const Cluster*, lane_count> clusters;
        std::array<S, lane_count> units;
        const std::size_t count = candidates.size();
        for (std::size_t i = 0; i < count; ++i) clusters[i] = &tree.clusters()[frontier[candidates[i]->at].node];
        const Box place = box_of(receiver_.position);
        quick_bounds(policy_, receiver_.material, clusters.data(), count, place, units.data());
        for (std::size_t i = 0; i < count; ++i) {
            Node& n = frontier[candidates[i]->at];
            LIGHTCUTS_ASSERT(dominates(units[i], n.transfer) &&
                             "a bound is below what evaluate() returns: do both include the cosine?");
            lower_bound(n, units[i], *clusters[i]);
            n.bounded = true;
            candidates[i]->priority = priority(n);
        }
        static_assert(!Policy::two_stages || TwoStagePolicy<Policy, Surface, Cluster>,
                      "a bound policy of two stages needs tight_band, a number, and tight(bound, cluster, receivers) "
                      "const, which returns the lights' spectrum");
        if constexpr (Policy::two_stages) {
            // The tight bound is computed only where it can change the decision.
            for (std::size_t i = 0; policy_.tight_band > 1.0 && i < count; ++i) {
                Node& n = frontier[candidates[i]->at];
                double& p = candidates[i]->priority;
                if (p > threshold && p < policy_.tight_band * threshold) {
                    lower_bound(n, policy_.tight(receiver_.material, *clusters[i], place), *clusters[i]);
                    p = priority(n);
                }
            }
        }
        if constexpr (BoundedOracle<Oracle, R, typename Tree::light_type>) {
            for (std::size_t i = 0; i < count; ++i) {
                if (!(candidates[i]->priority > threshold)) continue;
                apply_visibility_bound(frontier[candidates[i]->at], *clusters[i]);
                candidates[i]->priority = priority(frontier[candidates[i]->at]);
            }
        }
        if constexpr (HidingOracle<Oracle, R, typename Tree::light_type>) {
            for (std::size_t i = 0; i < count; ++i) {
                Node& n = frontier[candidates[i]->at];
                // What has a visible light is not hidden.
                if (!(candidates[i]->priority > threshold) || !is_black(n.transfer)) continue;
                if (!is_hidden(*clusters[i])) continue;
                lower_bound(n, black<S>(), *clusters[i]);
                candidates[i]->priority = priority(n);
                ++hidden_;
            }
        }
    }

    /// True if the oracle proves that no light of a cluster is visible.
    template <class Cluster>
    bool is_hidden(const Cluster& cluster) const {
        const place_box<typename Cluster::light_type> box{cluster.box};
        if constexpr (R::two_sided) {
            if (is_lit_from_behind() && !oracle_.hides(from_behind(receiver_), box)) return false;
        }
        return oracle_.hides(receiver_, box);
    }

    /// False of a two-sided material that says of this receiver that nothing comes through.
    bool is_lit_from_behind() const {
        if constexpr (MaterialWithHorizon<std::remove_cvref_t<decltype(R::material)>>) {
            return !receiver_.material.horizon();
        }
        return true;
    }

    template <class Cluster>
    static void lower_bound(Node& n, const S& unit, const Cluster& cluster) {
        n.unit_bound = smaller_channels(n.unit_bound, unit);
        n.bound = multiply_bounds(n.unit_bound, cluster.intensity);
    }

    /// Scales a cluster's bound by what the oracle knows to be the most that is visible of it.
    template <class Cluster>
    void apply_visibility_bound(Node& n, const Cluster& cluster) const {
        const place_box<typename Cluster::light_type> box{cluster.box};
        auto visible = static_cast<float>(oracle_.upper_bound(receiver_, box));
        if constexpr (R::two_sided) {
            const auto behind = static_cast<float>(oracle_.upper_bound(from_behind(receiver_), box));
            visible = behind > visible ? behind : visible;
        }
        if (visible >= 1.0f) return;
        const S fraction = make_spectrum<S>([&](int) { return visible; });
        lower_bound(n, multiply_bounds(n.unit_bound, fraction), cluster);
    }

    const Forest& forest_;
    const R& receiver_;
    const Oracle& oracle_;
    const Policy& policy_;
    std::uint32_t& hidden_;
};

}  // namespace lightcuts::detail
