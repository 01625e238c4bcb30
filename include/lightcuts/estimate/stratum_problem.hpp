#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "../cut/refinement.hpp"
#include "strata.hpp"

namespace lightcuts::detail {

/// The choice of a cut by `priority_of(tree, node, importance)` alone, which is asked for clusters of more than one
/// light, as a refinement problem: nothing is estimated and no shadow ray is asked for. Clusters that cannot contribute
/// are left out.
template <class Forest, class M, class Policy, class PriorityOf>
class StratumProblem {
public:
    using Node = typename EstimateScratch<typename Forest::spectrum>::Stratum;
    static constexpr bool fixed_priorities = true;

    StratumProblem(const Forest& forest, const Receiver<M>& receiver, const Policy& policy,
                   const PriorityOf& priority_of)
        : forest_(forest), receiver_(receiver), policy_(policy), priority_of_(priority_of) {}

    void roots(ReusableList<Node>& out) {
        const auto importances = root_importances(policy_, receiver_, forest_);
        forest_.for_each([&](std::uint32_t kind, const auto& tree) {
            if (!tree.empty()) append(tree, kind, tree.topology().root(), importances[kind], out);
        });
    }

    void split(const Node& parent, ReusableList<Node>& out) {
        forest_.visit(parent.kind, [&](const auto& tree) {
            append(tree, parent.kind, tree.topology().left(parent.node), parent.children[0], out);
            append(tree, parent.kind, tree.topology().right(parent.node), parent.children[1], out);
        });
    }

    /// Finds the importances of the new nodes' children: for splits, or for the first step of a descent.
    void evaluate(std::span<Node> fresh) {
        forest_.for_each([&](std::uint32_t kind, const auto& tree) {
            const auto is_parent = [kind](const Node& n) { return n.kind == kind && !n.leaf; };
            for (const Node& n : fresh) {
                if (is_parent(n)) prefetch_children(tree, n.node);
            }
            std::array<Node*, parents_at_once> parents;
            std::array<std::uint32_t, parents_at_once> nodes;
            std::array<std::array<Importance, 2>, parents_at_once> importances;
            std::size_t count = 0;
            const auto find = [&] {
                find_child_importances(policy_, receiver_, tree, std::span(nodes).first(count), importances.data());
                for (std::size_t i = 0; i < count; ++i) parents[i]->children = importances[i];
                count = 0;
            };
            for (Node& n : fresh) {
                if (!is_parent(n)) continue;
                parents[count] = &n;
                nodes[count++] = n.node;
                if (count == parents_at_once) find();
            }
            if (count > 0) find();
        });
    }
    double priority(const Node& n) const { return n.priority; }
    double threshold() const { return 0.0; }
    bool is_final(const Node& n) const { return n.leaf; }

    bool precedes(const Node& a, const Node& b) const {
        if (a.importance.irradiance != b.importance.irradiance) {
            return a.importance.irradiance > b.importance.irradiance;
        }
        return a.kind != b.kind ? a.kind < b.kind : a.node < b.node;
    }

private:
    template <class Tree>
    void append(const Tree& tree, std::uint32_t kind, std::uint32_t index, const Importance& importance,
                ReusableList<Node>& out) const {
        if (importance.is_zero()) return;
        const bool leaf = tree.topology().is_leaf(index);
        out.append({index, kind, leaf, importance, {}, leaf ? 0.0 : priority_of_(tree, index, importance)});
    }

    const Forest& forest_;
    const Receiver<M>& receiver_;
    const Policy& policy_;
    const PriorityOf& priority_of_;
};

/// Fills the scratch's strata with the cut that `priority_of` chooses.
template <class Forest, class M, class Policy, class PriorityOf>
void choose_strata(const Forest& forest, const Receiver<M>& receiver, const Policy& policy,
                   const PriorityOf& priority_of, const RefinementOptions& options,
                   EstimateScratch<typename Forest::spectrum>& scratch) {
    StratumProblem<Forest, M, Policy, PriorityOf> problem(forest, receiver, policy, priority_of);
    scratch.refinement.run(problem, options);
    scratch.strata.clear();
    scratch.refinement.for_each([&](const auto& cluster) { scratch.strata.push_back(cluster); });
}

}  // namespace lightcuts::detail
