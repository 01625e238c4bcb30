#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
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
/// - `Node`: a value with a default.
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
/// - `static constexpr std::size_t most_children`: 2 if not stated. Or, of a problem of fixed priorities,
///   `children(node)`, 2 or more: how many `split` appends. Room then is counted node by node, and a node of more
///   children than there is room for is passed over, that others may be refined.
/// - `static constexpr bool fixed_priorities = true`: `priority` of a node never changes, though the threshold may. The
///   frontier then is a heap, and a split costs O(log n) whatever the rounds.
/// - `is_final(node)`: true if the node can never be refined; the engine then looks at it no more.
/// - `tighten(frontier, span of candidates)`: lowers priorities where it pays, before any of the nodes is split:
///   both in `frontier[candidate.at]` and in the candidate. A node may come again.
/// - `observe(visit)`: called before each round, for problems that sum up again where they have lost count; `visit(f)`
///   calls f(node) for the whole frontier.
/// - `revise(visit)`: called when no priority is above the threshold; true if it made some larger, and the engine looks
///   again. Must become false.
/// - `checkpoint()`, `priority_scale()`, `priority_spread()`: for priorities that all change by about one factor, as
///   bounds relative to a total do. `priority` then gives them as they were at the last checkpoint; no priority has
///   grown since by more than the scale, nor by less than scale / spread. The engine refines by scale, and makes a new
///   checkpoint where the spread is above 1.02. Without these functions it asks for every priority in every round.
template <class P>
concept RefinementProblem = std::copyable<typename P::Node> && std::default_initializable<typename P::Node> &&
    requires(P p, const P c, typename P::Node& n, const typename P::Node& m, ReusableList<typename P::Node>& out) {
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
    limit,       ///< the maximum number of nodes is reached, or a split of any node would go beyond it
    unfinished,  ///< the caller stopped early, for instance on a time budget
};

/// When a refinement ends, and how many nodes its rounds split.
struct RefinementOptions {
    /// Largest number of nodes in the cut; the starting frontier is kept even if it is larger.
    std::size_t max_nodes = (std::numeric_limits<std::size_t>::max)();
    /// A round splits nodes down to this fraction of the largest finite priority. 1: one at a time, the order of
    /// the papers; 0.1: a tenth of the rounds for under one per cent more nodes.
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
        passed_over_.clear();
        absorbed_ = 0;
        stop_ = StopReason::unfinished;
        problem.roots(nodes_);
        if constexpr (tells_scale<P>) problem.checkpoint();
    }

    /// Goes on with the frontier as it is under other priorities: those of another problem over the same nodes, or of
    /// the same one after its criterion has changed. pre: the last `fresh` was absorbed. cost: O(size).
    template <RefinementProblem P>
    void reprioritize(P& problem) {
        stop_ = StopReason::unfinished;
        if constexpr (tells_scale<P>) problem.checkpoint();
        rekey(problem);
    }

    /// First half of a round: takes the nodes to be refined out of the frontier and puts their children into `fresh`.
    /// Returns false, leaving `fresh` empty, when the refinement has ended. pre: the last `fresh` was absorbed.
    template <RefinementProblem P>
    bool split(P& problem, const RefinementOptions& options) {
        const auto visit = [this](auto&& f) { this->for_each(f); };
        if constexpr (requires { problem.observe(visit); }) problem.observe(visit);
        const std::size_t room = options.max_nodes > size() ? options.max_nodes - size() : 0;
        // A node takes the place of its parent, the others take room.
        const std::size_t most_splits = room / (children_a_split<P> - 1);
        // At the limit all that is above the threshold is tightened once more, and then no more.
        const double fraction = most_splits == 0 ? 0.0 : (std::min)(options.round_fraction, 1.0);
        std::size_t children = 0;  // of the chosen nodes at most
        do {
            while (!choose(problem, fraction)) {
                if constexpr (requires { problem.revise(visit); }) {
                    if (problem.revise(visit)) continue;
                }
                stop_ = StopReason::converged;
                if constexpr (counts_children<P>) {
                    if (return_passed_over(problem)) stop_ = StopReason::limit;
                }
                return false;
            }
            if constexpr (counts_children<P>) {
                children = keep_what_fits(problem, room);
            } else {
                keep_largest(problem, most_splits);
                children = children_a_split<P> * chosen_.size();
            }
        } while (counts_children<P> && chosen_.empty() && room > 0);
        if (chosen_.empty()) {
            if constexpr (counts_children<P>) return_passed_over(problem);
            stop_ = StopReason::limit;
            return false;
        }
        nodes_.reserve(nodes_.size() + children);
        for (const RefinementCandidate& candidate : chosen_) {
            [[maybe_unused]] const std::size_t before = nodes_.size();
            problem.split(std::as_const(nodes_)[candidate.at], nodes_);
            LIGHTCUTS_ASSERT(nodes_.size() - before <= children);
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
    /// Gives a new node its key.
    template <class P>
    void join(const P& problem, std::uint32_t at) {
        keys_[at] = key_of(problem, nodes_[at]);
        if (in_heap_) push(problem, at);
    }

    /// Fills `chosen_` with what a round would split; false if no priority is above the threshold.
    template <class P>
    bool choose(P& problem, double fraction) {
        double threshold = problem.threshold();
        bool is_stale = !FixedPriorityProblem<P>;
        if constexpr (tells_scale<P>) {
            is_stale = !(problem.priority_spread() <= most_spread);
            if (is_stale) problem.checkpoint();
            threshold /= problem.priority_scale();
        }
        if (is_stale) rekey(problem);
        // A heap is cheapest where a round splits few nodes, a look at all where it splits many.
        const bool by_heap = FixedPriorityProblem<P> || (tells_scale<P> && fraction > 0.5);
        if (by_heap != in_heap_) {
            in_heap_ = by_heap;
            fill_heap(problem);
        }
        do {
            const bool any_left = by_heap ? take_from_heap(problem, fraction, threshold) : scan(fraction, threshold);
            tighten(problem);
            keep_top(problem, fraction, threshold);
            if (chosen_.empty() && !any_left) return false;
        } while (chosen_.empty());
        return true;
    }

    /// Finds the candidates: keys above the threshold that are infinite or not below a fraction of the largest finite
    /// one. True if others are above the threshold.
    bool scan(double fraction, double threshold) {
        const double* const keys = keys_.data();
        double largest = 0.0;
        for (std::size_t i = 0; i < absorbed_; ++i) {
            const double key = keys[i] < infinity ? keys[i] : 0.0;
            largest = key > largest ? key : largest;
        }
        const double cutoff = fraction * largest;
        const bool any_left = cutoff > threshold;
        chosen_.clear();
        for (std::size_t i = 0; i < absorbed_; ++i) {
            if (keys[i] > threshold && keys[i] >= cutoff) chosen_.push_back({static_cast<std::uint32_t>(i), keys[i]});
        }
        return any_left;
    }

    /// The same from the top of the heap; of a problem that tightens a handful at least.
    template <class P>
    bool take_from_heap(const P& problem, double fraction, double threshold) {
        const std::size_t handful = tightens<P> ? 8 : 0;
        chosen_.clear();
        double largest = 0.0;
        while (!heap_.empty()) {
            const std::uint32_t at = heap_.front();
            const double key = keys_[at];
            if (!(key > threshold) || (key < fraction * largest && chosen_.size() >= handful)) break;
            if (largest == 0.0 && key < infinity) largest = key;
            pop(problem);
            chosen_.push_back({at, key});
        }
        return !heap_.empty() && keys_[heap_.front()] > threshold;
    }

    /// Keeps the candidates above the threshold that are infinite or not below a fraction of the largest finite one.
    template <class P>
    void keep_top(const P& problem, double fraction, double threshold) {
        double largest = 0.0;
        for (const RefinementCandidate& c : chosen_) {
            if (c.priority < infinity && c.priority > largest) largest = c.priority;
        }
        if (in_heap_ && !heap_.empty() && keys_[heap_.front()] < infinity) {
            largest = (std::max)(largest, keys_[heap_.front()]);
        }
        const double cutoff = fraction * largest;
        std::size_t kept = 0;
        for (const RefinementCandidate& c : chosen_) {
            if (c.priority > threshold && c.priority >= cutoff) {
                chosen_[kept++] = c;
            } else if (in_heap_) {
                push(problem, c.at);
            }
        }
        chosen_.resize(kept);
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
            const auto middle = chosen_.begin() + static_cast<std::ptrdiff_t>(count);
            std::nth_element(chosen_.begin(), middle, chosen_.end(), is_larger(problem));
            if (in_heap_) {
                for (auto c = middle; c != chosen_.end(); ++c) push(problem, c->at);
            }
            chosen_.erase(middle, chosen_.end());
        }
        sort_by_place();
    }

    /// Keeps the candidates of largest priority whose children there is room for, in the order of the frontier, and
    /// passes over the others. Returns the number of children.
    template <class P>
    std::size_t keep_what_fits(const P& problem, std::size_t room) {
        const auto children_of = [&](const RefinementCandidate& c) {
            return static_cast<std::size_t>(problem.children(nodes_[c.at]));
        };
        std::size_t children = 0;
        for (const RefinementCandidate& c : chosen_) children += children_of(c);
        if (children - chosen_.size() > room) {
            std::sort(chosen_.begin(), chosen_.end(), is_larger(problem));
            std::size_t kept = 0;
            children = 0;
            for (const RefinementCandidate& c : chosen_) {
                const std::size_t own = children_of(c);
                if (own - 1 <= room) {
                    room -= own - 1;
                    children += own;
                    chosen_[kept++] = c;
                } else {
                    passed_over_.push_back(c.at);
                }
            }
            chosen_.resize(kept);
        }
        sort_by_place();
        return children;
    }

    /// Puts the nodes that were passed over back into the heap; true if any is above the threshold.
    template <class P>
    bool return_passed_over(const P& problem) {
        bool any_above = false;
        for (const std::uint32_t at : passed_over_) {
            any_above |= keys_[at] > static_cast<double>(problem.threshold());
            push(problem, at);
        }
        passed_over_.clear();
        return any_above;
    }

    template <class P>
    auto is_larger(const P& problem) const {
        return [this, &problem](const RefinementCandidate& a, const RefinementCandidate& b) {
            if (a.priority != b.priority) return a.priority > b.priority;
            return static_cast<bool>(problem.precedes(nodes_[a.at], nodes_[b.at]));
        };
    }
    void sort_by_place() {
        const auto at_less = [](const RefinementCandidate& a, const RefinementCandidate& b) { return a.at < b.at; };
        if (!std::is_sorted(chosen_.begin(), chosen_.end(), at_less)) {
            std::sort(chosen_.begin(), chosen_.end(), at_less);
        }
    }

    /// Asks for all priorities again.
    template <class P>
    void rekey(P& problem) {
        for (std::size_t i = 0; i < absorbed_; ++i) {
            if (keys_[i] != hole) keys_[i] = key_of(problem, nodes_[i]);
        }
        passed_over_.clear();
        fill_heap(problem);
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
        if (!in_heap_) return;
        for (std::size_t i = 0; i < absorbed_; ++i) {
            if (keys_[i] >= 0.0) heap_.push_back(static_cast<std::uint32_t>(i));
        }
        std::make_heap(heap_.begin(), heap_.end(), is_below(problem));
    }

    template <class P>
    static constexpr bool tells_scale = requires(P p) {
        p.checkpoint();
        { p.priority_scale() } -> std::convertible_to<double>;
        { p.priority_spread() } -> std::convertible_to<double>;
    };
    template <class P>
    static constexpr bool tightens = requires(P p, ReusableList<Node>& nodes,
                                              std::span<RefinementCandidate> candidates) {
        p.tighten(nodes, candidates);
    };
    template <class P>
    static constexpr bool counts_children = requires(const P p, const Node& n) {
        { p.children(n) } -> std::convertible_to<std::size_t>;
    };
    /// What a split has room for: in a problem that counts children the least that there can be, else the most.
    template <class P>
    static constexpr std::size_t children_a_split = [] {
        if constexpr (counts_children<P>) {
            static_assert(FixedPriorityProblem<P>, "children are counted where priorities are fixed");
            return std::size_t{2};
        } else if constexpr (requires { P::most_children; }) {
            static_assert(P::most_children >= 2, "a problem splits nodes into two or more");
            return std::size_t{P::most_children};
        } else {
            return std::size_t{2};
        }
    }();

    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr double final_node = -1.0;  ///< key of a node that can never be refined
    static constexpr double hole = -2.0;        ///< key of a place without a node
    static constexpr double most_spread = 1.02;

    ReusableList<Node> nodes_;                 ///< the frontier, with holes, and behind it fresh nodes
    std::vector<double> keys_;                 ///< of the frontier: priorities as they were when last asked for
    std::vector<std::uint32_t> heap_;          ///< places with keys above zero, ordered by keys, if `in_heap_`
    std::vector<std::uint32_t> holes_;         ///< places whose nodes were refined
    std::vector<RefinementCandidate> chosen_;  ///< to be refined in this round
    std::vector<std::uint32_t> passed_over_;   ///< places not in the heap, of nodes with too many children
    std::size_t absorbed_ = 0;                 ///< nodes behind are fresh
    bool in_heap_ = false;
    StopReason stop_ = StopReason::unfinished;
};

}  // namespace lightcuts
