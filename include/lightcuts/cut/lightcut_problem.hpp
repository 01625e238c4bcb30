#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../bound/policy.hpp"
#include "../core/random.hpp"
#include "../material/terms.hpp"
#include "../visibility/oracle.hpp"
#include "../visibility/shadow_origin.hpp"
#include "forest.hpp"
#include "options.hpp"
#include "refinement.hpp"

namespace lightcuts {

namespace detail {
struct LightCountTag {};
struct AllChannelsTag {};
struct ClampTag {};
}  // namespace detail

/// A cluster on a lightcut. `Clamps`: the cut may hold lights that are clamped; estimates and bounds here are as they
/// were without.
template <Spectrum S, bool Clamps = false>
struct CutNode {
    using light_count = std::conditional_t<Clamps, float, detail::Empty<detail::LightCountTag>>;
    using channel_mark = std::conditional_t<Clamps, bool, detail::Empty<detail::AllChannelsTag>>;

    std::uint32_t node = 0;            ///< in its tree
    std::uint32_t representative = 0;  ///< leaf of the tree that stands for the cluster
    S terms{};                         ///< the representative's material x geometric x visibility terms
    S estimate{};                      ///< terms x cluster intensity [Lightcuts 2005, Eq. 2]
    S unit_bound{};                    ///< upper bound of material x geometric terms, the cluster's or its parent's
    S bound{};                         ///< upper bound of the cluster's error; 0 for a single light
    std::uint8_t kind = 0;             ///< tree of the forest
    bool bounded = false;              ///< `unit_bound` is the cluster's own
    bool queried = false;              ///< `terms` waits for the representative, or for its shadow ray
    /// The representative shines in every channel; the cluster may shine in others than it.
    [[no_unique_address]] channel_mark all_channels{};
    /// Of the cluster; infinite if its kind is not clamped.
    [[no_unique_address]] light_count lights{};
};

/// How the contributions to a cut are clamped at the moment.
template <Spectrum S>
struct CutClamp {
    ClampOptions options;
    detail::ChannelSums<S> threshold{};  ///< radiance: the most that a light adds
    detail::ChannelSums<S> share{};      ///< the most that a light's error adds to a priority
    detail::ChannelSums<S> least{};      ///< least shares since the last mark
    detail::ChannelSums<S> total{};      ///< of which the threshold was made
    detail::ChannelSums<S> ratio{};      ///< by the lights that have arrived; infinite while there are none
    bool is_final = false;               ///< the threshold was made by that ratio, not with others in mind
};

/// Radiance sums of one receiver's cut, in double.
template <Spectrum S, bool Clamps = false>
struct CutTotals {
    using Sums = detail::ChannelSums<S>;
    using clamp_type = std::conditional_t<Clamps, CutClamp<S>, detail::Empty<detail::ClampTag>>;

    Sums total{};    ///< running sum of the estimates, clamped
    Sums largest{};  ///< largest running sum since it was last computed afresh
    Sums weight{};   ///< 1 / (total + adaptation): what turns a bound into a priority
    Sums least{};    ///< least weights since the last mark
    std::uint32_t queries = 0;
    [[no_unique_address]] clamp_type clamp{};
};

/// Lightcuts as a refinement problem, for one receiver [Lightcuts 2005, section 3]. A view of the caller's data.
template <class Forest, class R, class Oracle, class Policy>
class LightcutProblem {
public:
    using S = typename Forest::spectrum;
    static constexpr bool clamps = Forest::clamps;
    using node = CutNode<S, clamps>;
    using totals = CutTotals<S, clamps>;
    using material = std::remove_cvref_t<decltype(R::material)>;

    static_assert(Material<material>, "a material needs evaluate(to_light) const, which returns a Spectrum");
    static_assert(
        detail::reflects<material, S>,
        "a material's evaluate(to_light) needs to return the spectrum in which the lights state their intensity");
    static_assert(
        detail::answers<Oracle, R, Forest>,
        "an oracle needs operator()(receiver, light) const, which returns a bool, a fraction or a spectrum of "
        "fractions, or many(queries, answers) const");

    LightcutProblem(const Forest& forest, const R& receiver, const Oracle& oracle, const Policy& policy,
                    const LightcutOptions& options, totals& sums, std::vector<VisibilityQuery>& queries)
        : forest_(forest), receiver_(receiver), oracle_(oracle), policy_(policy), options_(options), totals_(sums),
          queries_(queries), threshold_(static_cast<double>(options.error_ratio)) {}

    void roots(std::vector<node>& out) {
        totals_ = {};
        totals_.weight.fill(darkest);
        if constexpr (clamps) {
            totals_.clamp.options = options_.clamp;
            totals_.clamp.threshold.fill(static_cast<double>(options_.clamp.radiance));
            totals_.clamp.ratio.fill(std::numeric_limits<double>::infinity());
            set_shares();
        }
        const bool few = has_few_lights();
        forest_.for_each([&](std::uint32_t kind, const auto& tree) {
            if (tree.empty()) return;
            const ClusterTree& topology = tree.topology();
            if (few) {
                for (ClusterTree::node_index n = 0; n < topology.size(); ++n) {
                    if (topology.is_leaf(n)) make_node(tree, kind, n, S{}, out);
                }
            } else {
                make_node(tree, kind, topology.root(), largest_terms(tree), out);
            }
        });
    }

    void split(const node& parent, std::vector<node>& out) {
        add(parent, -1.0);
        forest_.visit(parent.kind, [&](const auto& tree) {
            const std::uint32_t right = tree.topology().right(parent.node);
            const std::uint32_t left = tree.topology().left(parent.node);
            // The child that holds the parent's representative keeps it, and its terms with it.
            const bool in_left = parent.representative <= left;
            inherit_node(tree, parent, in_left ? left : right, out);
            make_node(tree, parent.kind, in_left ? right : left, parent.unit_bound, out);
        });
    }

    /// Replaces bounds inherited from parents by the clusters' own. Most clusters on a final cut never need one.
    void tighten(std::span<RefinementCandidate<node>> candidates) {
        for (std::size_t begin = 0; begin < candidates.size();) {
            if (candidates[begin].node->bounded) {
                ++begin;
                continue;
            }
            // Step 1: collect clusters of one kind, also from behind others: a round has few of each.
            std::array<RefinementCandidate<node>*, lane_count> members;
            std::size_t count = 0;
            const std::uint8_t kind = candidates[begin].node->kind;
            for (std::size_t i = begin; i < candidates.size() && count < members.size(); ++i) {
                const node& n = *candidates[i].node;
                if (!n.bounded && n.kind == kind) members[count++] = &candidates[i];
            }
            // Step 2: bound them side by side.
            forest_.visit(kind, [&](const auto& tree) { bound_nodes(tree, std::span(members).first(count)); });
        }
    }

    /// Finds the terms of the representatives that are not shared with a parent, shadows apart; a batched oracle's
    /// queries go to the caller's list.
    void request(std::span<node> fresh) {
        for (std::size_t begin = 0; begin < fresh.size();) {
            if (!fresh[begin].queried) {
                ++begin;
                continue;
            }
            std::array<node*, lane_count> members;
            std::size_t count = 0;
            const std::uint8_t kind = fresh[begin].kind;
            for (; begin < fresh.size() && count < members.size() && fresh[begin].kind == kind; ++begin) {
                if (fresh[begin].queried) members[count++] = &fresh[begin];
            }
            forest_.visit(kind, [&](const auto& tree) { request_nodes(tree, std::span(members).first(count)); });
        }
    }

    /// Traces the shadow rays of new nodes one by one.
    void evaluate(std::span<node> fresh) {
        request(fresh);
        for (node& n : fresh) {
            if (n.queried) {
                forest_.visit(n.kind, [&](const auto& tree) {
                    const auto& light = tree.lights()[tree.topology().item(n.representative)];
                    detail::with_shadow_origin(receiver_, light, [&](const auto& lit) {
                        receive(n, detail::as_factor<S>(oracle_(lit, light)));
                    });
                });
            }
            add(n, 1.0);
        }
    }

    /// Takes the answers to the queries that `fresh` gave rise to, in their order; returns those left over.
    template <class A>
    std::span<const A> receive(std::span<node> fresh, std::span<const A> answers) {
        for (node& n : fresh) {
            if (n.queried) {
                receive(n, answers.front());
                answers = answers.subspan(1);
            }
            add(n, 1.0);
        }
        return answers;
    }

    bool settled(const node& n) const { return is_black(n.bound); }

    template <class Visit>
    void observe(const Visit& visit) {
        if constexpr (clamps) {
            if (has_moved()) clamp_anew(visit, 1e-2);
        }
        // Differences of a sum that was once much larger are noise. Within a round it is largest at the end.
        constexpr double cancellation = 1e6;
        bool is_noise = false;
        for (std::size_t c = 0; c < totals_.total.size(); ++c) {
            const double total = totals_.total[c];
            totals_.largest[c] = total > totals_.largest[c] ? total : totals_.largest[c];
            is_noise = is_noise || !(totals_.largest[c] <= cancellation * total);
        }
        if (is_noise) {
            totals_.total = {};
            visit([this](const node& n) { add(n, 1.0); });
            totals_.largest = totals_.total;
        }
        weigh();
    }

    /// Finds the final total under its own threshold; true if the running total was so much larger, or lights thought
    /// to arrive so many more, that clusters may have been left too coarse.
    template <class Visit>
    bool revise(const Visit& visit) requires clamps {
        if (!options_.clamp.is_automatic()) return false;
        const auto weight = totals_.weight, share = totals_.clamp.share;
        clamp_anew(visit, 1e-6);
        weigh();
        bool grown = false;
        for (std::size_t c = 0; c < weight.size(); ++c) {
            grown = grown || totals_.weight[c] > 1.01 * weight[c] || totals_.clamp.share[c] > 1.01 * share[c];
        }
        return grown;
    }

    void mark() {
        totals_.least = totals_.weight;
        if constexpr (clamps) totals_.clamp.least = totals_.clamp.share;
    }

    double growth() const {
        double largest = 0.0;
        const auto grows = [&largest](double now, double least) {
            const double factor = now / least;  // NaN: zero or infinite as before
            largest = factor > largest ? factor : largest;
        };
        for (std::size_t c = 0; c < totals_.weight.size(); ++c) {
            grows(totals_.weight[c], totals_.least[c]);
            if constexpr (clamps) grows(totals_.clamp.share[c], totals_.clamp.least[c]);
        }
        return largest;
    }

    /// What a cluster may be off by, as a share of the total. Clamping decides whether it is refined. In which order is
    /// decided without: by shares, clusters of most lights would come first, and a limited cut might miss the nearest.
    double priority(const node& n) const {
        double largest = 0.0;
        for (int c = 0; c < channels_of<S>; ++c) {
            const double p = static_cast<double>(channel(n.bound, c)) * totals_.weight[static_cast<std::size_t>(c)];
            largest = p > largest ? p : largest;
        }
        if constexpr (clamps) {
            if (largest > threshold_) {
                const double clamped = clamped_priority(n);
                return clamped > threshold_ ? largest : clamped;
            }
        }
        return largest;
    }

    double threshold() const { return threshold_; }

    /// Clusters around the receiver, whose bounds are infinite, go by intensity over squared diagonal. (The cosine that
    /// might go with it is the material's secret.)
    bool before(const node& a, const node& b) const {
        const double density_a = density(a), density_b = density(b);
        if (density_a != density_b) return density_a > density_b;
        if (a.kind != b.kind) return a.kind < b.kind;
        return a.node < b.node;
    }

private:
    static constexpr double darkest = 1e150;  ///< weight of bounds where no light has arrived

    double clamped_priority(const node& n) const requires clamps {
        double largest = 0.0;
        for (int c = 0; c < channels_of<S>; ++c) {
            const double p = static_cast<double>(channel(n.bound, c)) * totals_.weight[static_cast<std::size_t>(c)];
            const double most = static_cast<double>(n.lights) * totals_.clamp.share[static_cast<std::size_t>(c)];
            const double clamped = p > most ? most : p;
            largest = clamped > largest ? clamped : largest;
        }
        return largest;
    }

    /// True if the cut starts with all lights. Not if the oracle bounds clusters: it may know of many at once that they
    /// are hidden.
    bool has_few_lights() const {
        if constexpr (detail::bounds_clusters<Oracle, R, Forest>) return false;
        const std::size_t lights = forest_.light_count();
        return lights <= options_.few_lights && (options_.max_cut == 0 || lights <= options_.max_cut);
    }

    /// What is known of a cluster's terms without looking at it.
    template <class Tree>
    S largest_terms(const Tree&) const {
        float largest = std::numeric_limits<float>::infinity();
        if constexpr (ClampableLight<typename Tree::light_type>) largest = options_.clamp.terms;
        return make_spectrum<S>([&](int) { return largest; });
    }

    /// Appends a node with what its parent's bound says of it. In place: a node is too large to be passed around.
    template <class Tree>
    static node& add_node(const Tree& tree, std::uint32_t kind, std::uint32_t index, const S& unit_bound,
                          std::vector<node>& out) {
        node& n = out.emplace_back();
        n.node = index;
        n.kind = static_cast<std::uint8_t>(kind);
        n.unit_bound = unit_bound;
        if constexpr (clamps) {
            n.lights = ClampableLight<typename Tree::light_type> ? static_cast<float>(tree.topology().leaf_count(index))
                                                                 : std::numeric_limits<float>::infinity();
        }
        // A single light is exact.
        if (!tree.topology().is_leaf(index)) {
            n.bound = detail::multiply_bounds(unit_bound, tree.clusters()[index].intensity);
        }
        return n;
    }

    /// Appends a node with a representative of its own.
    template <class Tree>
    void make_node(const Tree& tree, std::uint32_t kind, std::uint32_t index, const S& unit_bound,
                   std::vector<node>& out) {
        node& n = add_node(tree, kind, index, unit_bound, out);
        n.queried = true;
        if (tree.topology().is_leaf(index)) {
            n.representative = index;
        } else {
            const std::uint64_t choice = tree.representatives().single()
                                             ? 0
                                             : hash_keys(options_.seed, receiver_.id, kind, index);
            n.representative = tree.representatives().draw(index, choice);
        }
    }

    template <class Tree>
    void request_nodes(const Tree& tree, std::span<node* const> nodes) {
        using L = typename Tree::light_type;
        LightBlock lights;
        LaneSpectra<S> terms;
        const auto light_of = [&](int i) -> const L& {
            return tree.lights()[tree.topology().item(nodes[static_cast<std::size_t>(i)]->representative)];
        };
        const int count = static_cast<int>(nodes.size());
        for (int i = 0; i < count; ++i) {
            const auto& leaf = tree.clusters()[nodes[static_cast<std::size_t>(i)]->representative];
            lights.place.set(i, leaf.box.lo);
            if constexpr (OrientedLight<L>) lights.axis.set(i, leaf.cone.axis);
        }
        lights.template finish<L>(count);
        unshadowed_terms<L>(receiver_, lights, count, light_of, terms);
        for (int i = 0; i < count; ++i) {
            node& n = *nodes[static_cast<std::size_t>(i)];
            n.terms = terms[static_cast<std::size_t>(i)];
            if constexpr (ClampableLight<L>) {
                n.terms = detail::at_most(n.terms, options_.clamp.terms);
                n.all_channels = channel_min(tree.clusters()[n.representative].intensity) > 0.0f;
            }
            n.queried = !is_black(n.terms);
            if (!n.queried) continue;
            n.estimate = finite_product(n.terms, tree.clusters()[n.node].intensity);
            if constexpr (std::same_as<Oracle, AlwaysVisible>) {
                n.queried = false;
                continue;
            }
            ++totals_.queries;
            if constexpr (detail::AnswersMany<Oracle, S>) {
                // In place: what is written in pieces is slow to copy at once.
                VisibilityQuery& query = queries_.emplace_back();
                query.to = lights.place.at(i);
                query.from = receiver_.shadow_origin_towards(detail::towards<L>(receiver_.position, query.to));
                query.receiver = receiver_.id;
                query.light = tree.topology().item(n.representative);
                query.kind = n.kind;
                query.distant = DirectionalLight<L>;
            }
        }
    }

    /// Appends the child that holds its parent's representative: its terms are known.
    template <class Tree>
    static void inherit_node(const Tree& tree, const node& parent, std::uint32_t index, std::vector<node>& out) {
        node& n = add_node(tree, parent.kind, index, parent.unit_bound, out);
        n.representative = parent.representative;
        n.terms = parent.terms;
        if constexpr (clamps) n.all_channels = parent.all_channels;
        n.estimate = finite_product(n.terms, tree.clusters()[index].intensity);
    }

    template <class Tree>
    void bound_nodes(const Tree& tree, std::span<RefinementCandidate<node>* const> candidates) const {
        using Cluster = typename Tree::cluster;
        static_assert(BoundPolicy<Policy, material, Cluster>,
                      "a bound policy needs quick(material, cluster, point) const, which returns the material's "
                      "spectrum");
        std::array<const Cluster*, lane_count> clusters;
        std::array<S, lane_count> units;
        const std::size_t count = candidates.size();
        for (std::size_t i = 0; i < count; ++i) clusters[i] = &tree.clusters()[candidates[i]->node->node];
        detail::quick_bounds(policy_, receiver_.material, receiver_.position, clusters.data(), count, units.data());
        for (std::size_t i = 0; i < count; ++i) {
            node& n = *candidates[i]->node;
            lower_bound(n, units[i], *clusters[i]);
            n.bounded = true;
            candidates[i]->priority = priority(n);
        }
        if constexpr (TwoStagePolicy<Policy>) {
            // The dear bound is worth it only where it may change the decision.
            for (std::size_t i = 0; policy_.doubt > 1.0 && i < count; ++i) {
                node& n = *candidates[i]->node;
                double& p = candidates[i]->priority;
                if (p > threshold() && p < policy_.doubt * threshold()) {
                    lower_bound(n, policy_.tight(receiver_.material, *clusters[i], receiver_.position), *clusters[i]);
                    p = priority(n);
                }
            }
        }
        if constexpr (BoundedOracle<Oracle, R, typename Tree::light_type>) {
            for (std::size_t i = 0; i < count; ++i) {
                if (!(candidates[i]->priority > threshold())) continue;
                hide(*candidates[i]->node, *clusters[i]);
                candidates[i]->priority = priority(*candidates[i]->node);
            }
        }
    }

    template <class Cluster>
    static void lower_bound(node& n, const S& unit, const Cluster& cluster) {
        n.unit_bound = make_spectrum<S>([&](int c) {
            const float a = channel(n.unit_bound, c), b = channel(unit, c);
            return b < a ? b : a;
        });
        n.bound = detail::multiply_bounds(n.unit_bound, cluster.intensity);
    }

    /// Scales a cluster's bound by what the oracle knows to be the most that is visible of it.
    template <class Cluster>
    void hide(node& n, const Cluster& cluster) const {
        const place_box<typename Cluster::light_type> box{cluster.box};
        auto visible = static_cast<float>(oracle_.upper_bound(receiver_, box));
        if constexpr (R::two_sided) {
            const auto behind = static_cast<float>(oracle_.upper_bound(detail::from_behind(receiver_), box));
            visible = behind > visible ? behind : visible;
        }
        if (visible >= 1.0f) return;
        const S fraction = make_spectrum<S>([&](int) { return visible; });
        lower_bound(n, detail::multiply_bounds(n.unit_bound, fraction), cluster);
    }

    /// `visibility`: a float or a spectrum
    template <class A>
    void receive(node& n, const A& visibility) const {
        if constexpr (std::same_as<A, float>) {
            if (visibility == 1.0f) return;
        }
        n.terms = n.terms * visibility;
        n.estimate = n.estimate * visibility;
    }

    void add(const node& n, double sign) {
        for (int c = 0; c < channels_of<S>; ++c) {
            double& total = totals_.total[static_cast<std::size_t>(c)];
            double estimate = static_cast<double>(channel(n.estimate, c));
            if constexpr (clamps) {
                const double most = static_cast<double>(n.lights) *
                                    totals_.clamp.threshold[static_cast<std::size_t>(c)];
                estimate = estimate > most ? most : estimate;
            }
            total += sign * estimate;
        }
    }

    /// Makes priorities of the total as it is.
    void weigh() {
        for (std::size_t c = 0; c < totals_.total.size(); ++c) {
            const double reference = totals_.total[c] + 0.1 * static_cast<double>(options_.adaptation);
            // Against darkness every bound is too large, and larger bounds are refined first.
            totals_.weight[c] = reference * darkest > 1.0 ? 1.0 / reference : darkest;
            totals_.least[c] = totals_.weight[c] < totals_.least[c] ? totals_.weight[c] : totals_.least[c];
        }
        if constexpr (clamps) set_shares();
    }

    /// A light's share in the total is known also where the total is not, since it has been dark so far.
    void set_shares() requires clamps {
        CutClamp<S>& clamp = totals_.clamp;
        const double limit = static_cast<double>(options_.clamp.radiance);
        for (std::size_t c = 0; c < totals_.weight.size(); ++c) {
            const double share = limit * totals_.weight[c];
            clamp.share[c] = share < clamp.ratio[c] ? share : clamp.ratio[c];
            clamp.least[c] = clamp.share[c] < clamp.least[c] ? clamp.share[c] : clamp.least[c];
        }
    }

    /// True if the total has left the neighbourhood of the one that the threshold was made of. Where few lights have
    /// arrived, each more of them changes the ratio: a small neighbourhood.
    bool has_moved() const requires clamps {
        if (!options_.clamp.is_automatic()) return false;
        bool moved = false;
        for (std::size_t c = 0; c < totals_.total.size(); ++c) {
            const double now = totals_.total[c], then = totals_.clamp.total[c];
            const bool few = totals_.clamp.ratio[c] > static_cast<double>(options_.clamp.ratio);
            moved = moved || now > 1.25 * then || now < 0.8 * then || (few && now != then);
        }
        return moved;
    }

    /// Solves for total and threshold as if, of the lights in clusters that are dark so far, those were yet to arrive
    /// that may: about one of the clusters' mean size, and half of it if there is but one. A spike that is found early
    /// would else be most of the total, by which all that shows it to be a spike is too little to be looked for.
    template <class Visit>
    void clamp_anew(const Visit& visit, double tolerance) requires clamps {
        CutClamp<S>& clamp = totals_.clamp;
        const detail::ChannelSums<S> cautious = count_anew(visit);
        const auto solved = detail::clamped_total<S>(
            options_.clamp, cautious, {}, totals_.total, tolerance,
            [&](auto&& f) { visit([&](const node& n) { f(n.estimate, static_cast<double>(n.lights)); }); });
        clamp.is_final = cautious == clamp.ratio;
        totals_.total = clamp.total = solved.total;
        clamp.threshold = solved.threshold;
        for (std::size_t c = 0; c < cautious.size(); ++c) {
            // Lights that arrive next show themselves.
            if (solved.total[c] == 0.0) clamp.threshold[c] = static_cast<double>(options_.clamp.radiance);
        }
        totals_.largest = totals_.total;
    }

    /// Finds the ratio by the lights that have arrived; returns that with those which may yet.
    template <class Visit>
    detail::ChannelSums<S> count_anew(const Visit& visit) requires clamps {
        auto& ratio = totals_.clamp.ratio;
        ratio = detail::effective_ratios<S>(options_.clamp, [&](auto&& f) {
            visit([&](const node& n) { f(n.estimate, static_cast<double>(n.lights)); });
        });
        bool many = true;
        for (const double r : ratio) many = many && r == static_cast<double>(options_.clamp.ratio);
        if (many) return ratio;
        detail::ChannelSums<S> lights{}, dark{}, dark_clusters{};
        visit([&](const node& n) {
            if (!(n.lights < std::numeric_limits<float>::infinity())) return;
            for (std::size_t c = 0; c < dark.size(); ++c) {
                const int i = static_cast<int>(c);
                const auto count = static_cast<double>(n.lights);
                if (channel(n.estimate, i) > 0.0f) {
                    lights[c] += count;
                } else if (channel(n.bound, i) > 0.0f) {
                    dark[c] += count;
                    dark_clusters[c] += 1.0;
                }
            }
        });
        detail::ChannelSums<S> cautious{};
        for (std::size_t c = 0; c < cautious.size(); ++c) {
            cautious[c] = detail::effective_ratio(options_.clamp, lights[c] + dark[c] / (dark_clusters[c] + 1.0));
        }
        return cautious;
    }

    double density(const node& n) const {
        return forest_.visit(n.kind, [&](const auto& tree) {
            const auto& cluster = tree.clusters()[n.node];
            const double size2 = diagonal2(cluster.box);
            return size2 > 0.0 ? channel_sum(cluster.intensity) / size2 : std::numeric_limits<double>::infinity();
        });
    }

    Forest forest_;
    const R& receiver_;
    const Oracle& oracle_;
    const Policy& policy_;
    const LightcutOptions& options_;
    totals& totals_;
    std::vector<VisibilityQuery>& queries_;
    double threshold_;
};

}  // namespace lightcuts
