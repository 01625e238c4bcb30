#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "../core/random.hpp"
#include "cluster_bounder.hpp"
#include "cut_node.hpp"
#include "forest.hpp"
#include "options.hpp"
#include "prediction.hpp"
#include "refinement.hpp"
#include "representative_batch.hpp"
#include "running_total.hpp"
#include "total_criterion.hpp"

namespace lightcuts {

namespace detail {

/// What refining a cut has counted so far.
struct CutCounts {
    std::uint32_t queries = 0;
    std::uint32_t hidden = 0;  ///< clusters on the cut that the oracle has proved to be hidden
};

}  // namespace detail

/// Lightcuts as a refinement problem, for one receiver [Lightcuts 2005, section 3]. A view of the caller's data.
template <class Forest, class R, class Oracle, class Policy>
class LightcutProblem : public detail::TotalCriterion<detail::RunningTotal<typename Forest::spectrum, Forest::clamps>> {
public:
    using S = typename Forest::spectrum;
    static constexpr bool clamps = Forest::clamps;
    using Node = CutNode<S, clamps>;
    using Total = detail::RunningTotal<S, clamps>;
    using Surface = std::remove_cvref_t<decltype(R::material)>;

    static_assert(Material<Surface>, "a material needs evaluate(to_light) const, which returns a Spectrum");
    static_assert(
        detail::reflects<Surface, S>,
        "a material's evaluate(to_light) needs to return the spectrum in which the lights state their intensity");
    static_assert(
        detail::answers<Oracle, R, Forest>,
        "an oracle needs operator()(receiver, light) const, which returns a bool, a fraction or a spectrum of "
        "fractions, or many(queries, answers) const");

    LightcutProblem(const Forest& forest, const R& receiver, const Oracle& oracle, const Policy& policy,
                    const LightcutOptions& options, Total& total, detail::CutCounts& counts,
                    ReusableList<VisibilityQuery>& query_list)
        : Criterion(total, options), forest_(forest), options_(options), counts_(counts), receiver_id_(receiver.id),
          representatives_(forest, receiver, oracle, options.clamp, query_list),
          bounder_(forest, receiver, oracle, policy, counts.hidden), likely_(oracle, receiver) {}

    /// What a cluster is expected to be off by, as a share of the total: its bound where the oracle predicts nothing.
    double priority(const Node& n) const {
        if constexpr (PredictingOracle<Oracle, R>) {
            const double likely = likely_(n);
            return likely * total_.priority(n, threshold_ / likely);
        } else {
            return Criterion::priority(n);
        }
    }

    /// How likely clusters are to be visible, as the oracle predicts it.
    const detail::Prediction<Oracle, R>& prediction() const { return likely_; }

    void roots(ReusableList<Node>& out) {
        total_.start(options_.clamp, [this] { return detail::counts_per_radiance(forest_); });
        counts_ = {};
        const Start start = start_of();
        forest_.for_each([&](std::uint32_t kind, const auto& tree) {
            if (tree.empty()) return;
            const ClusterTree& topology = tree.topology();
            if (start == Start::lights) {
                out.reserve(out.size() + topology.item_count());
                for (ClusterTree::node_index n = 0; n < topology.size(); ++n) {
                    if (topology.is_leaf(n)) append(tree, kind, n, black<S>(), out);
                }
            } else if (start == Start::frontier) {
                for (const ClusterTree::node_index n : tree.start()) append(tree, kind, n, largest_transfer(tree), out);
            } else {
                append(tree, kind, topology.root(), largest_transfer(tree), out);
            }
        });
    }

    void split(const Node& parent, ReusableList<Node>& out) {
        total_.subtract(parent);
        forest_.visit(parent.kind, [&](const auto& tree) {
            const std::uint32_t right = tree.topology().right(parent.node);
            const std::uint32_t left = tree.topology().left(parent.node);
            // The child that holds the parent's representative keeps it, and its transfer with it.
            const bool in_left = parent.representative <= left;
            append_inheriting(tree, parent, in_left ? left : right, out);
            append(tree, parent.kind, in_left ? right : left, parent.unit_bound, out);
        });
    }

    void tighten(ReusableList<Node>& frontier, std::span<RefinementCandidate> candidates) const {
        const double threshold = threshold_ / total_.priority_scale();
        bounder_.tighten(
            frontier, candidates, [this](const Node& n) { return this->priority(n); }, threshold);
    }

    /// Finds the transfer of new representatives; a batched oracle's queries go to the caller's list.
    void request(std::span<Node> fresh) { counts_.queries += representatives_.request(fresh); }

    /// Traces the shadow rays of new nodes one by one.
    void evaluate(std::span<Node> fresh) {
        request(fresh);
        for (Node& n : fresh) {
            if (n.queried) representatives_.trace(n);
            total_.add(n);
        }
    }

    /// Takes the answers to the queries that `fresh` gave rise to, in their order; returns those left over.
    template <class A>
    std::span<const A> receive(std::span<Node> fresh, std::span<const A> answers) {
        for (Node& n : fresh) {
            if (n.queried) {
                representatives_.receive(n, answers.front());
                answers = answers.subspan(1);
            }
            total_.add(n);
        }
        return answers;
    }

    template <class Visit>
    bool revise(const Visit& visit) requires clamps {
        return total_.revise(visit, floor_);
    }

    /// Clusters around the receiver, whose bounds are infinite, go by intensity over squared diagonal. (The cosine that
    /// might go with it cannot be asked of the material.)
    bool precedes(const Node& a, const Node& b) const {
        const double density_a = density(a), density_b = density(b);
        if (density_a != density_b) return density_a > density_b;
        if (a.kind != b.kind) return a.kind < b.kind;
        return a.node < b.node;
    }

private:
    using Criterion = detail::TotalCriterion<Total>;
    using Criterion::floor_;
    using Criterion::threshold_;
    using Criterion::total_;

    /// What a cut starts from.
    enum class Start : std::uint8_t { lights, frontier, roots };

    Start start_of() const {
        // An oracle that bounds clusters may know of many lights at once that they are hidden.
        if constexpr (detail::bounds_clusters<Oracle, R, Forest>) return Start::roots;
        const std::size_t lights = forest_.light_count();
        if (lights <= options_.exhaustive_below && (options_.max_cut == 0 || lights <= options_.max_cut)) {
            return Start::lights;
        }
        // A cut that is limited to few clusters chooses each of them.
        return options_.max_cut == 0 || options_.max_cut >= 8 * forest_.start_count() ? Start::frontier : Start::roots;
    }

    /// What is known of a cluster's transfer without looking at it.
    template <class Tree>
    S largest_transfer(const Tree&) const {
        float largest = std::numeric_limits<float>::infinity();
        if constexpr (ClampableLight<typename Tree::light_type>) largest = options_.clamp.transfer;
        return make_spectrum<S>([&](int) { return largest; });
    }

    /// Appends a node with what its parent's bound says of it. In place: a node is too large to be passed around.
    /// What is known of its representative is left to be set.
    template <class Tree>
    static Node& append_bounded(const Tree& tree, std::uint32_t kind, std::uint32_t index, const S& unit_bound,
                                ReusableList<Node>& out) {
        Node& n = out.append();
        n.node = index;
        n.kind = static_cast<std::uint8_t>(kind);
        n.unit_bound = unit_bound;
        n.bounded = false;
        if constexpr (clamps) {
            n.lights = ClampableLight<typename Tree::light_type> ? static_cast<float>(tree.topology().leaf_count(index))
                                                                 : std::numeric_limits<float>::infinity();
        }
        // A single light is exact.
        n.bound = tree.topology().is_leaf(index)
                      ? black<S>()
                      : detail::multiply_bounds(unit_bound, tree.clusters()[index].intensity);
        return n;
    }

    /// Appends a node with a representative of its own, which has to be looked at.
    template <class Tree>
    void append(const Tree& tree, std::uint32_t kind, std::uint32_t index, const S& unit_bound,
                ReusableList<Node>& out) const {
        Node& n = append_bounded(tree, kind, index, unit_bound, out);
        n.queried = true;
        n.transfer = black<S>();
        n.estimate = black<S>();
        if constexpr (clamps) n.part = 0;
        if (tree.topology().is_leaf(index)) {
            n.representative = index;
        } else {
            const std::uint64_t choice = tree.representatives().single()
                                             ? 0
                                             : hash_keys(options_.seed, receiver_id_, kind, index);
            n.representative = tree.representatives().draw(index, choice);
        }
    }

    /// Appends the child that holds its parent's representative: its transfer is known.
    template <class Tree>
    static void append_inheriting(const Tree& tree, const Node& parent, std::uint32_t index, ReusableList<Node>& out) {
        Node& n = append_bounded(tree, parent.kind, index, parent.unit_bound, out);
        n.queried = false;
        n.representative = parent.representative;
        n.transfer = parent.transfer;
        if constexpr (clamps) n.part = parent.part;
        n.estimate = finite_product(n.transfer, tree.clusters()[index].intensity);
    }

    double density(const Node& n) const {
        return forest_.visit(n.kind, [&](const auto& tree) {
            const auto& cluster = tree.clusters()[n.node];
            const double size2 = diagonal2(cluster.box);
            return size2 > 0.0 ? channel_sum(cluster.intensity) / size2 : std::numeric_limits<double>::infinity();
        });
    }

    const Forest& forest_;
    const LightcutOptions& options_;
    detail::CutCounts& counts_;
    std::uint32_t receiver_id_;
    detail::RepresentativeBatch<Forest, R, Oracle> representatives_;
    detail::ClusterBounder<Forest, R, Oracle, Policy> bounder_;
    [[no_unique_address]] detail::Prediction<Oracle, R> likely_;
};

}  // namespace lightcuts
