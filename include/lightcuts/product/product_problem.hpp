#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "../core/random.hpp"
#include "../core/reusable_list.hpp"
#include "../cut/options.hpp"
#include "../cut/refinement.hpp"
#include "../cut/running_total.hpp"
#include "../cut/total_criterion.hpp"
#include "../shading/shadow_origin.hpp"
#include "../shading/transfer.hpp"
#include "../visibility/oracle.hpp"
#include "gather_forest.hpp"
#include "pair_bounder.hpp"
#include "pair_lights.hpp"
#include "product_node.hpp"
#include "timed_forest.hpp"

namespace lightcuts {

namespace detail {

/// True if `Oracle` can be asked about every pair of a gather point and a light.
template <class Oracle, class Points, class Forest>
inline constexpr bool answers_points = false;
template <class Oracle, AnyGatherPoint... Gs, class Forest>
inline constexpr bool answers_points<Oracle, GatherForest<Gs...>, Forest> =
    (answers<Oracle, decltype(Gs::receiver), Forest> && ...);

template <Spectrum S, bool Clamps>
using ProductTotal = RunningTotal<S, Clamps, ProductNode<S, Clamps>>;

/// What a problem counts lights by, in the caller's storage.
template <Spectrum S, bool Clamps>
using PairLightsIf = std::conditional_t<Clamps, PairLights<S>, Empty<PairLightsTag>>;

}  // namespace detail

/// How the sum over pairs of gather points and lights is refined.
struct ProductOptions {
    /// As of lightcuts, with pairs in place of clusters and lights: error ratio, largest cut, `exhaustive_below`,
    /// adaptation, seed, and how ClampableLights are clamped: by transfer and by share of the total, see `gather`, but
    /// not by radiance. Cuts are larger than those of one receiver: at most 2000 pairs, as in the paper, unless that is
    /// less than what they start from, a pair for each two trees.
    LightcutOptions cut{.max_cut = 2000};
    /// Of this sum: a pixel, a texel. Choices of different ids do not depend on one another.
    std::uint32_t id = 0;
    /// Starts with each gather point by itself, whatever the largest cut, so that only lights are clustered: a
    /// reference to compare with, the 'unified cut' of the paper.
    bool separate_points = false;
    /// Draws the representatives of every pair of the final cut anew, but of single ones, so that the estimate does not
    /// depend on what the refinement has seen: unbiased for that cut where strengths and intensities are each of one
    /// hue, for one more shadow ray a pair. (Of several channels that vary, a pair is drawn by their sum.)
    bool redraw = false;
    SideRule side_rule = SideRule::bounds;  ///< which side of a pair is split
};

/// The sum over pairs of gather points and lights as a refinement problem: a cut through their product graph, which is
/// never made [Multidimensional Lightcuts 2006, section 3]. A view of the caller's data.
template <class Lights, class Points, class Oracle, class Policy>
class ProductProblem
    : public detail::TotalCriterion<detail::ProductTotal<typename Lights::spectrum, Lights::forest_type::clamps>> {
public:
    using S = typename Lights::spectrum;
    static constexpr bool clamps = Lights::forest_type::clamps;
    static_assert(std::same_as<S, typename Points::spectrum>, "gather points and lights need the same spectrum");
    static_assert(!Lights::timed || Points::timed, "lights with instants need gather points with instants");
    static_assert(
        detail::answers_points<Oracle, Points, typename Lights::forest_type>,
        "an oracle needs operator()(receiver, light) const, which returns a bool, a fraction or a spectrum of "
        "fractions, or many(queries, answers) const");

    using Node = ProductNode<S, clamps>;
    using Total = detail::ProductTotal<S, clamps>;
    using PairLights = detail::PairLightsIf<S, clamps>;

    ProductProblem(const Lights& lights, const Points& points, const Oracle& oracle, const Policy& policy,
                   const ProductOptions& options, Total& total, PairLights& pair_lights, std::uint32_t& queries,
                   ReusableList<VisibilityQuery>& query_list)
        : Criterion(total, options.cut), lights_(lights), points_(points), oracle_(oracle), options_(options),
          pair_lights_(pair_lights), queries_(queries), query_list_(query_list),
          bounder_(lights, points, policy, options.side_rule) {}

    void roots(ReusableList<Node>& out) {
        if constexpr (clamps) {
            pair_lights_.stop();
            if (options_.cut.clamp.is_automatic()) pair_lights_.start(points_);
        }
        total_.start(options_.cut.clamp, [this] { return counts_per_radiance(); });
        queries_ = 0;
        const std::size_t most = options_.cut.max_cut == 0 ? (std::numeric_limits<std::size_t>::max)()
                                                           : options_.cut.max_cut;
        std::size_t starts = 0;  // of gather points
        points_.for_each([&](std::uint32_t, const auto& tree) {
            starts += options_.separate_points ? tree.topology().item_count() : tree.empty() ? 0u : 1u;
        });
        const std::size_t pairs = points_.point_count() * lights_.forest().light_count();
        const bool exhaustive = pairs <= options_.cut.exhaustive_below && pairs <= most;
        const bool frontier = 8 * starts * lights_.forest().start_count() <= most;
        for_each_pair([&](auto kinds, const auto& points, const auto& lights, const auto& times) {
            if (points.empty() || lights.empty()) return;
            const auto add = [&](ClusterTree::node_index gather, ClusterTree::node_index light) {
                append(kinds, points, lights, times, gather, light, largest_transfer(lights), out);
            };
            const auto with_lights = [&](ClusterTree::node_index gather) {
                if (exhaustive) {
                    for (ClusterTree::node_index n = 0; n < lights.topology().size(); ++n) {
                        if (lights.topology().is_leaf(n)) add(gather, n);
                    }
                } else if (frontier) {
                    for (const ClusterTree::node_index n : lights.start()) add(gather, n);
                } else {
                    add(gather, lights.topology().root());
                }
            };
            if (exhaustive || options_.separate_points) {
                for (ClusterTree::node_index n = 0; n < points.topology().size(); ++n) {
                    if (points.topology().is_leaf(n)) with_lights(n);
                }
            } else {
                with_lights(points.topology().root());
            }
        });
    }

    void split(const Node& parent, ReusableList<Node>& out) {
        total_.subtract(parent);
        visit(parent, [&](auto kinds, const auto& points, const auto& lights, const auto& times) {
            const bool of_points = parent.side == PairSide::gather;
            const ClusterTree& tree = of_points ? points.topology() : lights.topology();
            const ClusterTree::node_index from = of_points ? parent.gather : parent.light;
            const ClusterTree::node_index holder = of_points ? parent.gather_representative
                                                             : parent.light_representative;
            const ClusterTree::node_index left = tree.left(from), right = tree.right(from);
            // The child that holds the parent's representatives keeps them, and their transfer with them.
            const bool in_left = holder <= left;
            const auto add = [&](ClusterTree::node_index child, bool inherits) {
                const std::size_t before = out.size();
                append(kinds, points, lights, times, of_points ? child : parent.gather,
                       of_points ? parent.light : child, parent.unit_bound, out, inherits ? &parent : nullptr);
                if (out.size() == before) return;
                Node& n = out[before];
                n.gather_splits = of_points ? next(parent.gather_splits) : std::uint8_t{0};
                n.light_splits = of_points ? std::uint8_t{0} : next(parent.light_splits);
            };
            add(left, in_left);
            add(right, !in_left);
        });
    }

    void tighten(ReusableList<Node>& frontier, std::span<RefinementCandidate> candidates) const {
        const double threshold = threshold_ / total_.priority_scale();
        bounder_.tighten(
            frontier, candidates, [this](const Node& n) { return this->priority(n); }, threshold);
    }

    /// Finds the transfer of new representatives; a batched oracle's queries go to the caller's list.
    void request(std::span<Node> fresh) {
        for (Node& n : fresh) {
            if (n.queried) request(n);
        }
    }

    /// Traces the shadow rays of new nodes one by one.
    void evaluate(std::span<Node> fresh) {
        request(fresh);
        for (Node& n : fresh) {
            if (n.queried) trace(n);
            total_.add(n);
        }
    }

    /// Takes the answers to the queries that `fresh` gave rise to, in their order; returns those left over.
    template <class A>
    std::span<const A> receive(std::span<Node> fresh, std::span<const A> answers) {
        for (Node& n : fresh) {
            if (n.queried) {
                receive(n, answers.front());
                answers = answers.subspan(1);
            }
            total_.add(n);
        }
        return answers;
    }

    /// Draws other representatives for a node of the cut, which then wait to be looked at. Those of a single pair stay.
    void redraw(Node& n) const {
        visit(n, [&](auto, const auto& points, const auto& lights, const auto& times) {
            // A single pair's transfer is known.
            n.queried = !(points.topology().is_leaf(n.gather) && lights.topology().is_leaf(n.light));
            if (!n.queried) return;
            n.transfer = black<S>();
            n.estimate = black<S>();
            draw(points, lights, times, n, Purpose::redraw);
        });
    }

    template <class Visit>
    bool revise(const Visit& visit) requires clamps {
        return total_.revise(visit, floor_);
    }

    /// Adds to a LightCount that a node's representatives arrive, if they do.
    template <class LightCount>
    void add_certain(const Node& n, LightCount& count) const requires clamps {
        visit(n, [&](auto, const auto& points, const auto& lights, const auto& times) {
            const auto g = n.gather_representative, l = n.light_representative;
            count.add(finite_product(n.transfer, weight_of(points, lights, times, g, l)),
                      pair_lights_.of(points, lights, times, g, l));
        });
    }

    /// Pairs whose boxes touch, whose bounds are infinite, go by weight over squared diagonals.
    bool precedes(const Node& a, const Node& b) const {
        const double density_a = density(a), density_b = density(b);
        if (density_a != density_b) return density_a > density_b;
        if (a.gather_kind != b.gather_kind) return a.gather_kind < b.gather_kind;
        if (a.light_kind != b.light_kind) return a.light_kind < b.light_kind;
        return a.gather != b.gather ? a.gather < b.gather : a.light < b.light;
    }

private:
    using Criterion = detail::TotalCriterion<Total>;
    using Criterion::floor_;
    using Criterion::threshold_;
    using Criterion::total_;

    /// As of a receiver, per radiance of the sum.
    detail::ChannelSums<S> counts_per_radiance() const {
        auto counts = detail::counts_per_radiance(lights_.forest());
        if constexpr (clamps) {
            for (std::size_t c = 0; c < counts.size(); ++c) counts[c] /= pair_lights_.strength()[c];
        }
        return counts;
    }

    /// Of gather points and of lights.
    struct Kinds {
        std::uint8_t gather;
        std::uint8_t light;
    };

    static std::uint8_t next(std::uint8_t splits) {
        return splits < 64 ? static_cast<std::uint8_t>(splits + 1) : splits;
    }

    template <class F>
    decltype(auto) visit(const Node& n, const F& f) const {
        return points_.visit(n.gather_kind, [&](const auto& points) -> decltype(auto) {
            return lights_.visit(n.light_kind, [&](const auto& lights, const auto& times) -> decltype(auto) {
                return f(Kinds{n.gather_kind, n.light_kind}, points, lights, times);
            });
        });
    }
    template <class F>
    void for_each_pair(const F& f) const {
        points_.for_each([&](std::uint32_t gather_kind, const auto& points) {
            lights_.for_each([&](std::uint32_t light_kind, const auto& lights, const auto& times) {
                f(Kinds{static_cast<std::uint8_t>(gather_kind), static_cast<std::uint8_t>(light_kind)}, points, lights,
                  times);
            });
        });
    }

    template <class LightTree>
    static constexpr bool at_instants = TimedLight<typename LightTree::light_type>;

    /// What is known of a pair's transfer without looking at it.
    template <class LightTree>
    S largest_transfer(const LightTree&) const {
        float largest = std::numeric_limits<float>::infinity();
        if constexpr (ClampableLight<typename LightTree::light_type>) largest = options_.cut.clamp.transfer;
        return make_spectrum<S>([&](int) { return largest; });
    }

    /// Strength x intensity summed over the pairs below that exist at one instant.
    template <class GatherTree, class LightTree, class Times>
    static S weight_of(const GatherTree& points, const LightTree& lights, [[maybe_unused]] const Times& times,
                       ClusterTree::node_index gather, ClusterTree::node_index light) {
        if constexpr (at_instants<LightTree>) {
            if (points.is_timed()) {
                detail::ChannelSums<S> sum{};
                detail::for_each_common(points.times(), gather, times, light,
                                        [&](std::uint32_t, const S& strength, const S& intensity) {
                                            const S product = finite_product(strength, intensity);
                                            for (std::size_t c = 0; c < sum.size(); ++c) {
                                                sum[c] += static_cast<double>(channel(product, static_cast<int>(c)));
                                            }
                                        });
                return finite(make_spectrum<S>([&](int c) { return sum[static_cast<std::size_t>(c)]; }));
            }
        }
        return finite_product(points.clusters()[gather].strength, lights.clusters()[light].intensity);
    }

    /// Appends a pair, unless nothing of it exists at one instant or no channel has both strength and intensity. With
    /// the representatives of its parent, `heir_of`, or with its own, which have to be looked at.
    template <class GatherTree, class LightTree, class Times>
    void append(Kinds kinds, const GatherTree& points, const LightTree& lights, const Times& times,
                ClusterTree::node_index gather, ClusterTree::node_index light, const S& unit_bound,
                ReusableList<Node>& out, const Node* heir_of = nullptr) const {
        const S weight = weight_of(points, lights, times, gather, light);
        if (is_black(weight)) return;
        Node& n = out.append();
        n.gather = gather;
        n.light = light;
        n.gather_kind = kinds.gather;
        n.light_kind = kinds.light;
        n.weight = weight;
        n.unit_bound = unit_bound;
        n.bounded = false;
        n.side = PairSide::undecided;
        n.gather_splits = n.light_splits = 0;
        if constexpr (clamps) n.lights = pair_lights_.of(points, lights, times, gather, light);
        // A single pair is exact.
        const bool is_single = points.topology().is_leaf(gather) && lights.topology().is_leaf(light);
        n.bound = is_single ? black<S>() : detail::multiply_bounds(unit_bound, weight);
        if (heir_of != nullptr) {
            n.queried = false;
            n.gather_representative = heir_of->gather_representative;
            n.light_representative = heir_of->light_representative;
            n.transfer = heir_of->transfer;
            n.estimate = finite_product(n.transfer, n.weight);
        } else {
            n.queried = true;
            n.transfer = black<S>();
            n.estimate = black<S>();
            draw(points, lights, times, n, Purpose::refine);
        }
    }

    /// What representatives are drawn for: while the cut is refined, or anew when it is final.
    enum class Purpose : std::uint8_t { refine, redraw };

    /// Draws a node's representatives: the instant by what the pair weighs then, a gather point and a light by what
    /// each has of its side then [Multidimensional Lightcuts 2006, Eq. 8-12]. cost: O(depth)
    template <class GatherTree, class LightTree, class Times>
    void draw(const GatherTree& points, const LightTree& lights, [[maybe_unused]] const Times& times, Node& n,
              Purpose purpose) const {
        const std::uint64_t seed = hash_keys(options_.cut.seed, options_.id, static_cast<std::uint32_t>(purpose),
                                             n.gather_kind, n.light_kind, n.gather, n.light);
        const std::uint64_t of_point = hash_keys(seed, 0), of_light = hash_keys(seed, 1);
        if constexpr (at_instants<LightTree>) {
            if (points.is_timed()) {
                const std::uint32_t instant = draw_common_instant(points.times(), n.gather, times, n.light, seed);
                n.gather_representative = draw_leaf(points.topology(), n.gather, of_point, [&](auto node_index) {
                    return channel_sum(points.times().at(node_index, instant));
                });
                n.light_representative = draw_leaf(lights.topology(), n.light, of_light, [&](auto node_index) {
                    return channel_sum(times.at(node_index, instant));
                });
                return;
            }
        }
        n.gather_representative = draw_gather_point(points, n.gather, of_point);
        if (lights.topology().is_leaf(n.light)) {
            n.light_representative = n.light;
        } else if (purpose == Purpose::refine) {
            n.light_representative = lights.representatives().draw(n.light, of_light);
        } else {
            n.light_representative = draw_leaf(lights.topology(), n.light, of_light, [&](auto node_index) {
                return channel_sum(lights.clusters()[node_index].intensity);
            });
        }
    }

    /// One of the gather points below a node, by strength. A pair draws one of its own among all: those of one cluster
    /// would all be wrong together where one point stood for all of them and it alone were in shadow.
    template <class GatherTree>
    static ClusterTree::node_index draw_gather_point(const GatherTree& points, ClusterTree::node_index n,
                                                     std::uint64_t seed) {
        return draw_leaf(points.topology(), n, seed, [&](auto node_index) { return points.weight(node_index); });
    }

    /// A leaf below `n`, each with a probability proportional to its weight.
    template <class Weight>
    static ClusterTree::node_index draw_leaf(const ClusterTree& tree, ClusterTree::node_index n, std::uint64_t seed,
                                             const Weight& weight) {
        while (!tree.is_leaf(n)) {
            const ClusterTree::node_index left = tree.left(n), right = tree.right(n);
            const double of_left = weight(left), of_right = weight(right);
            n = uniform01(hash_keys(seed, n)) * (of_left + of_right) < of_left ? left : right;
        }
        return n;
    }

    static std::uint32_t draw_common_instant(const TimeVectors<S>& strengths, ClusterTree::node_index gather,
                                             const TimeVectors<S>& intensities, ClusterTree::node_index light,
                                             std::uint64_t seed) {
        double sum = 0.0;
        const auto weigh = [](const S& strength, const S& intensity) {
            return channel_sum(finite_product(strength, intensity));
        };
        detail::for_each_common(strengths, gather, intensities, light,
                                [&](std::uint32_t, const S& s, const S& i) { sum += weigh(s, i); });
        const double wanted = uniform01(seed) * sum;
        double before = 0.0;
        std::uint32_t drawn = 0;
        bool found = false;
        detail::for_each_common(strengths, gather, intensities, light,
                                [&](std::uint32_t instant, const S& s, const S& i) {
                                    const double w = weigh(s, i);
                                    if (w > 0.0 && !found) drawn = instant;
                                    before += w;
                                    found = found || before > wanted;
                                });
        return drawn;
    }

    /// The transfer of a node's representatives, shadows apart.
    void request(Node& n) {
        visit(n, [&](auto, const auto& points, const auto& lights, const auto&) {
            using L = typename std::remove_cvref_t<decltype(lights)>::light_type;
            const auto& receiver = points.point(n.gather_representative).receiver;
            const std::uint32_t index = lights.topology().item(n.light_representative);
            const L& light = lights.lights()[index];
            n.transfer = unshadowed_transfer(receiver, light);
            if constexpr (ClampableLight<L>) n.transfer = detail::at_most(n.transfer, options_.cut.clamp.transfer);
            n.queried = !is_black(n.transfer);
            if (!n.queried) return;
            n.estimate = finite_product(n.transfer, n.weight);
            if constexpr (std::same_as<Oracle, AlwaysVisible>) {
                n.queried = false;
                return;
            }
            ++queries_;
            if constexpr (detail::AnswersMany<Oracle, S>) {
                VisibilityQuery& query = query_list_.append();
                query.to = position_or_direction(light);
                query.from = receiver.shadow_origin_towards(detail::towards<L>(receiver.position, query.to));
                query.receiver = receiver.id;
                query.light = index;
                query.kind = n.light_kind;
                query.distant = DirectionalLight<L>;
            }
        });
    }

    void trace(Node& n) const {
        visit(n, [&](auto, const auto& points, const auto& lights, const auto&) {
            const auto& light = lights.lights()[lights.topology().item(n.light_representative)];
            detail::with_shadow_origin(points.point(n.gather_representative).receiver, light,
                                       [&](const auto& lit) { receive(n, detail::as_factor<S>(oracle_(lit, light))); });
        });
    }

    template <class A>
    static void receive(Node& n, const A& visibility) {
        n.transfer = n.transfer * visibility;
        n.estimate = finite_product(n.transfer, n.weight);
    }

    double density(const Node& n) const {
        return visit(n, [&](auto, const auto& points, const auto& lights, const auto&) {
            const double size2 = diagonal2(points.clusters()[n.gather].box) + diagonal2(lights.clusters()[n.light].box);
            return size2 > 0.0 ? channel_sum(n.weight) / size2 : std::numeric_limits<double>::infinity();
        });
    }

    const Lights& lights_;
    const Points& points_;
    const Oracle& oracle_;
    const ProductOptions& options_;
    PairLights& pair_lights_;
    std::uint32_t& queries_;
    ReusableList<VisibilityQuery>& query_list_;
    detail::PairBounder<Lights, Points, Policy> bounder_;
};

}  // namespace lightcuts
