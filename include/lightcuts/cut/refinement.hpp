#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../core/assertion.hpp"
#include "../core/reusable_list.hpp"

namespace lightcuts {

/// A node above the threshold.
struct RefinementCandidate {
    std::uint32_t at;  ///< its index in the frontier
    double priority;
};

/// What the refinement engine asks of a problem. It knows neither trees nor light.
///
/// - `node`: a value with a default.
/// - `roots(out)`: appends the starting frontier to a ReusableList.
/// - `evaluate(span of new nodes)`: one batch, possibly nothing. Every node passes through it once.
/// - `priority(node)`: not negative, possibly infinite, never NaN. Use bounds, never what an estimate happened to
///   show: that biases sums.
/// - `threshold()`: nodes of a priority above it are refined. May change between rounds.
/// - `split(node, out)`: appends the nodes that replace `node` to a ReusableList, at most `most_children` of them; none
///   drops the node. References to nodes stay valid. Refinement must come to an end: a chain of splits into one child
///   has to be finite.
/// - `precedes(a, b)`: a total order that breaks ties of priority, infinite ones above all.
///
/// Optional:
/// - `static constexpr std::size_t most_children`: 2 if not stated.
/// - `static constexpr bool fixed_priorities = true`: `priority` of a node never changes, though the threshold may. The
///   frontier then is a heap, and a split costs O(log n) whatever the rounds.
/// - `is_final(node)`: true if the node can never be refined; the engine then looks at it no more.
/// - `tighten(frontier, span of candidates)`: lowers priorities where it pays, before any of the nodes is split:
///   both in `frontier[candidate.at]` and in the candidate. A node may come again.
/// - `observe(visit)`: called before each round, for problems that sum up again where they have lost count; `visit(f)`
///   calls f(node) for the whole frontier.
/// - `revise(visit)`: called when no priority is above the threshold; true if it made some larger, and the engine looks
///   again. Must become false.
/// - `checkpoint()` and `priority_growth()`: the second bounds the factor by which any priority has grown since the
///   first was called, at least 1. Without them every priority is asked for in every round.
template <class P>
concept RefinementProblem = std::copyable<typename P::node> && std::default_initializable<typename P::node> &&
    requires(P p, const P c, typename P::node& n, const typename P::node& m, ReusableList<typename P::node>& out) {
    p.roots(out);
    { c.priority(m) } -> std::convertible_to<double>;
    { c.threshold() } -> std::convertible_to<double>;
    p.split(m, out);
    { c.precedes(m, m) } -> std::convertible_to<bool>;
    p.evaluate(std::span(&n, 1));
};

/// A problem whose priorities stay as they are once a node was evaluated.
template <class P>
concept FixedPriorityProblem = RefinementProblem<P> && bool(P::fixed_priorities);

/// Why a refinement ended.
enum class StopReason : std::uint8_t {
    converged,   ///< no node is above the threshold
    limit,       ///< the maximum number of nodes is reached
    unfinished,  ///< the caller stopped early, for instance on a time budget
};

struct RefinementOptions {
    /// Largest number of nodes in the cut; the starting frontier is kept even if it is larger.
    std::size_t max_nodes = std::numeric_limits<std::size_t>::max();
    /// A round splits nodes down to this fraction of the largest finite priority. 1: one at a time, the order of
    /// the papers, exactly so for fixed priorities and within a tenth of the priority for others; 0.1: a tenth of the
    /// rounds for under one per cent more nodes.
    double round_fraction = 0.1;
};

/// The one refinement engine: a frontier of nodes, refined in rounds until no priority is above the threshold or
/// the limit is reached, which is never overshot. Resumable: `step` performs one round. Its two halves, `split` and
/// `absorb`, are for callers that evaluate the new nodes of many refinements in one batch.
/// Reusable: no allocation once warm. memory: at most twice the nodes of the largest frontier, and the children of one
/// round.
template <class Node>
class Refinement {
public:
    /// Starts afresh; the roots then wait in `fresh` for evaluation.
    template <RefinementProblem P>
    void start(P& problem) {
        nodes_.clear();
        keys_.clear();
        heap_.clear();
        chosen_.clear();
        holes_.clear();
        absorbed_ = 0;
        stop_ = StopReason::unfinished;
        problem.roots(nodes_);
        if constexpr (tells_growth<P>) problem.checkpoint();
    }

    /// Goes on with the frontier as it is under other priorities: those of another problem over the same nodes, or of
    /// the same one after its criterion has changed. pre: the last `fresh` was absorbed. cost: O(size).
    template <RefinementProblem P>
    void reprioritize(P& problem) {
        stop_ = StopReason::unfinished;
        rekey(problem);
    }

    /// First half of a round: takes the nodes to be refined out of the frontier and puts their children into `fresh`.
    /// Returns false, leaving `fresh` empty, when the refinement has ended. pre: the last `fresh` was absorbed.
    template <RefinementProblem P>
    bool split(P& problem, const RefinementOptions& options) {
        const auto visit = [this](auto&& f) { this->for_each(f); };
        if constexpr (requires { problem.observe(visit); }) problem.observe(visit);
        while (!choose(problem, options)) {
            if constexpr (requires { problem.revise(visit); }) {
                if (problem.revise(visit)) continue;
            }
            stop_ = StopReason::converged;
            return false;
        }
        const std::size_t room = options.max_nodes > size() ? options.max_nodes - size() : 0;
        keep_largest(problem, room / (most_children<P> - 1));
        if (chosen_.empty()) {
            stop_ = StopReason::limit;
            return false;
        }
        nodes_.reserve(nodes_.size() + most_children<P> * chosen_.size());
        for (const RefinementCandidate& candidate : chosen_) {
            [[maybe_unused]] const std::size_t before = nodes_.size();
            problem.split(std::as_const(nodes_)[candidate.at], nodes_);
            LIGHTCUTS_ASSERT(nodes_.size() - before <= most_children<P>);
            keys_[candidate.at] = hole;
            holes_.push_back(candidate.at);
        }
        return true;
    }

    /// Second half of a round: evaluated `fresh` nodes join the frontier.
    template <RefinementProblem P>
    void absorb(const P& problem) {
        // From the end, into the places of those that were refined.
        while (!holes_.empty() && nodes_.size() > absorbed_) {
            const std::uint32_t at = holes_.back();
            holes_.pop_back();
            nodes_[at] = nodes_[nodes_.size() - 1];
            nodes_.pop_back();
            join(problem, at);
        }
        keys_.resize(nodes_.size());
        for (; absorbed_ < nodes_.size(); ++absorbed_) join(problem, static_cast<std::uint32_t>(absorbed_));
    }

    /// One round. Returns false, having done nothing, when the refinement has ended.
    template <RefinementProblem P>
    bool step(P& problem, const RefinementOptions& options) {
        if (fresh().empty() && !split(problem, options)) return false;  // not empty: the roots
        problem.evaluate(fresh());
        absorb(problem);
        return true;
    }

    /// Refines to the end.
    template <RefinementProblem P>
    void run(P& problem, const RefinementOptions& options) {
        start(problem);
        while (step(problem, options)) {}
    }

    /// Nodes that wait for evaluation.
    std::span<Node> fresh() { return {nodes_.data() + absorbed_, nodes_.size() - absorbed_}; }
    /// Calls `f(node)` for each node of the cut, in no particular order.
    template <class F>
    void for_each(F&& f) const {
        for (std::size_t i = 0; i < absorbed_; ++i) {
            if (keys_[i] != hole) f(nodes_[i]);
        }
    }
    /// Number of nodes in the cut.
    std::size_t size() const { return absorbed_ - holes_.size(); }
    /// Number of nodes that there is storage for.
    std::size_t capacity() const { return nodes_.capacity(); }
    StopReason stop_reason() const { return stop_; }

private:
    /// Finds the key of a new node: any that is large enough if all keys will be asked for anyway.
    template <class P>
    void join(const P& problem, std::uint32_t at) {
        if (in_heap_) {
            keys_[at] = key_of(problem, nodes_[at]);
            push(problem, at);
        } else {
            keys_[at] = is_final(problem, nodes_[at]) ? final_node : infinity;
        }
    }

    /// Fills `chosen_` with what a round would split; false if no priority is above the threshold.
    template <class P>
    bool choose(P& problem, const RefinementOptions& options) {
        const double fraction = options.round_fraction < 1.0 ? options.round_fraction : 1.0;
        const bool by_heap = FixedPriorityProblem<P> || (tells_growth<P> && fraction > 0.5);
        if (by_heap != in_heap_) {
            in_heap_ = by_heap;
            heap_.clear();
            if (by_heap) fill_heap(problem);
        }
        if constexpr (tells_growth<P>) {
            if (problem.priority_growth() > most_growth) rekey(problem);
        }
        return by_heap ? choose_by_heap(problem, fraction) : choose_by_scan(problem, fraction);
    }

    /// Looks at all nodes: cheapest where a round splits many of them.
    template <class P>
    bool choose_by_scan(P& problem, double fraction) {
        const double threshold = problem.threshold();
        double least = 0.0;  // all that are not final
        if constexpr (tells_growth<P>) least = threshold / problem.priority_growth() * (1.0 - 1e-12);
        chosen_.clear();
        double* const keys = keys_.data();
        const Node* const nodes = nodes_.data();
        for (std::size_t i = 0; i < absorbed_; ++i) {
            if (tells_growth<P> ? !(keys[i] > least) : keys[i] < least) continue;
            keys[i] = problem.priority(nodes[i]);
            if (keys[i] > threshold) chosen_.push_back({static_cast<std::uint32_t>(i), keys[i]});
        }
        tighten(problem);
        double largest = 0.0;
        for (const RefinementCandidate& c : chosen_) {
            if (c.priority < infinity && c.priority > largest) largest = c.priority;
        }
        const double cutoff = fraction * largest;
        std::erase_if(chosen_, [&](const RefinementCandidate& c) {
            return !(c.priority > threshold) || c.priority < cutoff;
        });
        return !chosen_.empty();
    }

    /// Takes nodes from the top of the heap: cheapest where a round splits few of them. Keys may be stale by the growth
    /// of priorities, which `choose` has limited.
    template <class P>
    bool choose_by_heap(P& problem, double fraction) {
        const double threshold = problem.threshold();
        for (;;) {
            chosen_.clear();
            // Step 1: what may be large enough, and a handful more, which are bounded together as cheaply.
            constexpr std::size_t handful = 8;
            double largest = 0.0;
            while (!heap_.empty()) {
                const std::uint32_t at = heap_.front();
                const double key = keys_[at];
                if (!(key > threshold) || (key < fraction * largest && (!tightens<P> || chosen_.size() >= handful))) {
                    break;
                }
                pop(problem);
                if constexpr (!FixedPriorityProblem<P>) keys_[at] = problem.priority(nodes_[at]);
                chosen_.push_back({at, keys_[at]});
                if (keys_[at] < infinity && keys_[at] > largest) largest = keys_[at];
            }
            if (chosen_.empty()) {
                if constexpr (tells_growth<P>) {
                    if (problem.priority_growth() > 1.0) {
                        rekey(problem);
                        if (!heap_.empty() && keys_[heap_.front()] > threshold) continue;
                    }
                }
                return false;
            }
            // Step 2: the rest goes back.
            tighten(problem);
            largest = 0.0;
            for (const RefinementCandidate& c : chosen_) {
                if (c.priority < infinity && c.priority > largest) largest = c.priority;
            }
            if (!heap_.empty() && keys_[heap_.front()] < infinity) largest = std::max(largest, keys_[heap_.front()]);
            const double cutoff = fraction * largest;
            std::size_t kept = 0;
            for (const RefinementCandidate c : chosen_) {
                if (c.priority > threshold && (c.priority >= cutoff)) {
                    chosen_[kept++] = c;
                } else {
                    push(problem, c.at);
                }
            }
            chosen_.resize(kept);
            if (kept > 0) return true;
        }
    }

    template <class P>
    void tighten(P& problem) {
        if constexpr (tightens<P>) {
            problem.tighten(nodes_, std::span(chosen_));
            for (const RefinementCandidate& c : chosen_) keys_[c.at] = c.priority;
        }
    }

    /// Keeps the `count` candidates of largest priority, in the order of the frontier.
    template <class P>
    void keep_largest(const P& problem, std::size_t count) {
        if (chosen_.size() > count) {
            const auto larger = [&](const RefinementCandidate& a, const RefinementCandidate& b) {
                if (a.priority != b.priority) return a.priority > b.priority;
                return static_cast<bool>(problem.precedes(nodes_[a.at], nodes_[b.at]));
            };
            const auto middle = chosen_.begin() + static_cast<std::ptrdiff_t>(count);
            std::nth_element(chosen_.begin(), middle, chosen_.end(), larger);
            if (in_heap_) {
                for (auto c = middle; c != chosen_.end(); ++c) push(problem, c->at);
            }
            chosen_.erase(middle, chosen_.end());
        }
        const auto at_less = [](const RefinementCandidate& a, const RefinementCandidate& b) { return a.at < b.at; };
        if (!std::is_sorted(chosen_.begin(), chosen_.end(), at_less)) {
            std::sort(chosen_.begin(), chosen_.end(), at_less);
        }
    }

    /// Asks for all priorities again.
    template <class P>
    void rekey(P& problem) {
        if constexpr (tells_growth<P>) problem.checkpoint();
        for (std::size_t i = 0; i < absorbed_; ++i) {
            if (keys_[i] != hole) keys_[i] = key_of(problem, nodes_[i]);
        }
        if (in_heap_) fill_heap(problem);
    }

    template <class P>
    static double key_of(const P& problem, const Node& node) {
        return is_final(problem, node) ? final_node : static_cast<double>(problem.priority(node));
    }
    template <class P>
    static bool is_final(const P& problem, const Node& node) {
        if constexpr (requires { problem.is_final(node); }) return problem.is_final(node);
        return false;
    }

    template <class P>
    auto is_below(const P& problem) const {
        return [this, &problem](std::uint32_t a, std::uint32_t b) {
            if (keys_[a] != keys_[b]) return keys_[a] < keys_[b];
            return static_cast<bool>(problem.precedes(nodes_[b], nodes_[a]));
        };
    }
    template <class P>
    void push(const P& problem, std::uint32_t at) {
        if (keys_[at] < 0.0) return;
        heap_.push_back(at);
        std::push_heap(heap_.begin(), heap_.end(), is_below(problem));
    }
    template <class P>
    void pop(const P& problem) {
        std::pop_heap(heap_.begin(), heap_.end(), is_below(problem));
        heap_.pop_back();
    }
    template <class P>
    void fill_heap(const P& problem) {
        heap_.clear();
        for (std::size_t i = 0; i < absorbed_; ++i) {
            if (keys_[i] >= 0.0) heap_.push_back(static_cast<std::uint32_t>(i));
        }
        std::make_heap(heap_.begin(), heap_.end(), is_below(problem));
    }

    template <class P>
    static constexpr bool tells_growth = requires(P p) {
        p.checkpoint();
        { p.priority_growth() } -> std::convertible_to<double>;
    };
    template <class P>
    static constexpr bool tightens = requires(P p, ReusableList<Node>& nodes, std::span<RefinementCandidate> candidates) {
        p.tighten(nodes, candidates);
    };
    template <class P>
    static constexpr std::size_t children_of() {
        if constexpr (requires { P::most_children; }) {
            static_assert(P::most_children >= 2, "a problem splits nodes into two or more");
            return P::most_children;
        }
        return 2;
    }
    template <class P>
    static constexpr std::size_t most_children = children_of<P>();

    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr double final_node = -1.0;  ///< key of a node that can never be refined
    static constexpr double hole = -2.0;        ///< key of a place without a node
    /// Keys are asked for again once priorities may have grown by this factor.
    static constexpr double most_growth = 1.1;

    ReusableList<Node> nodes_;                     ///< the frontier, with holes, and behind it fresh nodes
    std::vector<double> keys_;                 ///< of the frontier: priorities as they were when last asked for
    std::vector<std::uint32_t> heap_;          ///< places with keys above zero, ordered by keys, if `in_heap_`
    std::vector<std::uint32_t> holes_;         ///< places whose nodes were refined
    std::vector<RefinementCandidate> chosen_;  ///< to be refined in this round
    std::size_t absorbed_ = 0;                 ///< nodes behind are fresh
    bool in_heap_ = false;
    StopReason stop_ = StopReason::unfinished;
};

}  // namespace lightcuts
