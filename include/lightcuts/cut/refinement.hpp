#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace lightcuts {

/// What the refinement engine asks of a problem. It knows neither trees nor light.
///
/// - `node`: a value; nothing else is stored.
/// - `roots(out)`: appends the starting frontier.
/// - `evaluate(span of new nodes)`: one batch, possibly nothing. Every node passes through it once.
/// - `priority(node)`: not negative, possibly infinite, never NaN. Use bounds, never what an estimate happened to
///   show: that biases sums.
/// - `threshold()`: nodes of a priority above it are refined. May change between rounds.
/// - `split(node, out)`: appends the nodes that replace it, two or fewer: some need not be in the cut. `node` lies in
///   `out`, which has room.
/// - `before(a, b)`: a total order that breaks ties of priority, infinite ones above all.
///
/// Optional:
/// - `settled(node)`: true if the node can never be refined; the engine then looks at it no more.
/// - `tighten(span of candidates)`: lowers priorities where it pays, before any of the nodes is split, in the nodes and
///   in the candidates. These are all nodes above the threshold; a node may come again.
/// - `observe(visit)`: called before each round, for problems that sum up again where they have lost count; `visit(f)`
///   calls f(node) for the whole frontier.
/// - `revise(visit)`: called when no priority is above the threshold; true if it made some larger, and the engine looks
///   again. Must become false.
/// - `mark()` and `growth()`: the second bounds the factor by which any priority has grown since the first was called.
///   Spares the engine from looking at nodes far below the threshold in every round.
template <class P>
concept RefinementProblem = requires(P p, const P c, typename P::node& n, const typename P::node& m,
                                     std::vector<typename P::node>& out) {
    p.roots(out);
    { c.priority(m) } -> std::convertible_to<double>;
    { c.threshold() } -> std::convertible_to<double>;
    p.split(m, out);
    { c.before(m, m) } -> std::convertible_to<bool>;
    p.evaluate(std::span(&n, 1));
};

/// Why a refinement ended.
enum class StopReason : std::uint8_t {
    converged,   ///< no node is above the threshold
    limit,       ///< the maximum number of nodes is reached
    unfinished,  ///< the caller stopped early, for instance on a time budget
};

struct RefinementOptions {
    /// Largest number of nodes in the cut; the starting frontier is kept even if it is larger.
    std::size_t max_nodes = (std::numeric_limits<std::size_t>::max)();
    /// A round splits nodes down to this fraction of the largest finite priority. 1: one at a time, the order of
    /// the papers; 0.1: a tenth of the rounds for under one per cent more nodes.
    double round_fraction = 0.1;
};

/// A node above the threshold.
template <class Node>
struct RefinementCandidate {
    Node* node;
    std::uint32_t at;  ///< its place among the active nodes
    double priority;
};

/// The one refinement engine: a frontier of nodes, refined in rounds until no priority is above the threshold or
/// the limit is reached, which is never overshot. Resumable: `step` performs one round. Its two halves, `split` and
/// `absorb`, are for callers that evaluate the new nodes of many refinements in one batch.
/// Reusable: no allocation once warm.
template <class Node>
class Refinement {
public:
    using Candidate = RefinementCandidate<Node>;

    /// Starts afresh; the roots then wait in `fresh` for evaluation.
    template <RefinementProblem P>
    void start(P& problem) {
        nodes_.clear();
        active_.clear();
        resting_.clear();
        absorbed_ = 0;
        stop_ = StopReason::unfinished;
        problem.roots(nodes_);
        if constexpr (tells_growth<P>) problem.mark();
    }

    /// First half of a round: takes the nodes to be refined out of the frontier and puts their children into `fresh`.
    /// Returns false, leaving `fresh` empty, when the refinement has ended. pre: the last `fresh` was absorbed.
    template <RefinementProblem P>
    bool split(P& problem, const RefinementOptions& options) {
        const auto visit = [this](auto&& f) { this->for_each(f); };
        if constexpr (requires { problem.observe(visit); }) problem.observe(visit);
        while (!find(problem, options)) {
            if constexpr (requires { problem.revise(visit); }) {
                if (problem.revise(visit)) continue;
            }
            stop_ = StopReason::converged;
            return false;
        }
        const std::size_t room = options.max_nodes > size() ? options.max_nodes - size() : 0;
        if (chosen_.size() > room) keep_largest(problem, room);
        if (chosen_.empty()) {
            stop_ = StopReason::limit;
            return false;
        }
        replace_chosen(problem);
        return true;
    }

    /// Second half of a round: evaluated `fresh` nodes join the frontier.
    template <RefinementProblem P>
    void absorb(const P& problem) {
        const double rest = rest_below * problem.threshold();
        const std::size_t begin = absorbed_;
        absorbed_ = nodes_.size();
        for (std::size_t i = begin; i < absorbed_; ++i) {
            const Node& node = nodes_[i];
            const bool rests = is_settled(problem, node) || (tells_growth<P> && problem.priority(node) <= rest);
            (rests ? resting_ : active_).push_back(static_cast<std::uint32_t>(i));
        }
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
    std::span<Node> fresh() { return std::span(nodes_).subspan(absorbed_); }
    /// Calls `f(node)` for each node of the cut, in no particular order.
    template <class F>
    void for_each(F&& f) const {
        for (const std::uint32_t i : resting_) f(nodes_[i]);
        for (const std::uint32_t i : active_) f(nodes_[i]);
    }
    /// Number of nodes in the cut.
    std::size_t size() const { return active_.size() + resting_.size(); }
    StopReason stop_reason() const { return stop_; }

private:
    /// `select` from all nodes whose priorities may be above the threshold.
    template <class P>
    bool find(P& problem, const RefinementOptions& options) {
        if constexpr (tells_growth<P>) {
            if (problem.growth() * rest_below > 1.0) {
                wake(problem);
                problem.mark();
            }
        }
        make_room();
        return select(problem, options);
    }

    /// Fills `chosen_` with what a round would split, in frontier order; false if nothing is above the threshold.
    template <class P>
    bool select(P& problem, const RefinementOptions& options) {
        const double threshold = problem.threshold();
        const double rest = tells_growth<P> ? rest_below * threshold : -1.0;
        chosen_.clear();
        std::size_t kept = 0;
        for (const std::uint32_t i : active_) {
            const double priority = problem.priority(nodes_[i]);
            if (priority <= rest) {
                resting_.push_back(i);
                continue;
            }
            if (priority > threshold) chosen_.push_back({&nodes_[i], static_cast<std::uint32_t>(kept), priority});
            active_[kept++] = i;
        }
        active_.resize(kept);
        if constexpr (requires { problem.tighten(std::span<Candidate>()); }) problem.tighten(std::span(chosen_));
        keep_top(options.round_fraction, threshold);
        return !chosen_.empty();
    }

    /// Keeps the candidates above the threshold that are infinite or not below a fraction of the largest finite one.
    void keep_top(double fraction, double threshold) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        double largest = 0.0;
        for (const Candidate& candidate : chosen_) {
            if (candidate.priority < infinity && candidate.priority > largest) largest = candidate.priority;
        }
        const double cutoff = (fraction < 1.0 ? fraction : 1.0) * largest;
        std::erase_if(chosen_, [&](const Candidate& candidate) {
            return !(candidate.priority > threshold) || candidate.priority < cutoff;
        });
    }

    /// Keeps the `count` candidates of largest priority, in frontier order.
    template <class P>
    void keep_largest(const P& problem, std::size_t count) {
        const auto larger = [&](const Candidate& a, const Candidate& b) {
            if (a.priority != b.priority) return a.priority > b.priority;
            return problem.before(*a.node, *b.node);
        };
        const auto middle = chosen_.begin() + static_cast<std::ptrdiff_t>(count);
        std::nth_element(chosen_.begin(), middle, chosen_.end(), larger);
        chosen_.erase(middle, chosen_.end());
        std::sort(chosen_.begin(), chosen_.end(), [](const Candidate& a, const Candidate& b) { return a.at < b.at; });
    }

    /// Children must not move the nodes that candidates point to.
    void make_room() {
        const std::size_t most = nodes_.size() + 2 * active_.size();
        if (most > nodes_.capacity()) nodes_.reserve(2 * most);
    }

    template <class P>
    void replace_chosen(P& problem) {
        for (const Candidate& candidate : chosen_) problem.split(*candidate.node, nodes_);
        for (std::size_t c = chosen_.size(); c-- > 0;) {
            active_[chosen_[c].at] = active_.back();
            active_.pop_back();
        }
    }

    /// Nodes at rest that can be refined become active again.
    template <class P>
    void wake(const P& problem) {
        std::size_t kept = 0;
        for (const std::uint32_t i : resting_) {
            if (is_settled(problem, nodes_[i])) {
                resting_[kept++] = i;
            } else {
                active_.push_back(i);
            }
        }
        resting_.resize(kept);
    }

    template <class P>
    static bool is_settled(const P& problem, const Node& node) {
        if constexpr (requires { problem.settled(node); }) return problem.settled(node);
        return false;
    }

    template <class P>
    static constexpr bool tells_growth = requires(P p) {
        p.mark();
        { p.growth() } -> std::convertible_to<double>;
    };

    /// Nodes below this fraction of the threshold rest until priorities have grown by its inverse.
    static constexpr double rest_below = 0.9;

    std::vector<Node> nodes_;             ///< all since the start, refined ones too: nodes are never moved
    std::vector<std::uint32_t> active_;   ///< indices of the frontier
    std::vector<std::uint32_t> resting_;  ///< of the rest of it: settled, or far below the threshold
    std::size_t absorbed_ = 0;            ///< nodes behind are fresh
    std::vector<Candidate> chosen_;
    StopReason stop_ = StopReason::unfinished;
};

}  // namespace lightcuts
