#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "../core/executor.hpp"
#include "../core/invalid_input.hpp"
#include "../shading/transfer.hpp"
#include "../visibility/hidden_lights.hpp"
#include "lightcut.hpp"
#include "pilot_places.hpp"

namespace lightcuts {

/// How visibility is learned, and how much is made of it.
struct LearningOptions {
    /// Of the pilots' lightcuts, whose shadow rays are what is learned from: best those of the cuts that will use it.
    LightcutOptions cut{};
    /// The rays of so many pilots are put together, those nearest to one. More are smoother and see more of what is
    /// rarely visible; fewer know better what is hidden from where.
    std::size_t neighbors = 8;
    /// So many rays, of which as many arrive as of all pilots together, are added to those of a cluster: what is
    /// believed where few rays were traced. Less is bolder.
    float prior_rays = 1.0f;
    /// From this share of visible lights on a cluster is refined as if nothing were learned: what matters is whether
    /// anything is visible.
    float full_share = 1.0f / 16.0f;
    /// The least factor of a cluster's priority. Above 1/64 most of the gain is lost.
    float least_factor = 0x1p-10f;
    /// What one unit of a normal's coordinates counts for among distances, in diagonals of the box of the pilots.
    float normal_length = 0.25f;
    /// About so many clusters are told apart: those which most rays went to. memory: a byte each for every pilot.
    std::size_t clusters = 4096;
};

/// Which clusters are likely to be visible from where, learned from the shadow rays of pilots: what a PredictingOracle
/// answers from. Nothing is proved by it, and stated error bounds do not depend on it. See LearnedOracle.
///
/// A pilot's lightcut asks for a light in each of its clusters. Every ray counts for the cluster, and for all above it.
/// From the share of the rays that arrive, those of the pilots nearby, follows a factor of the cluster's priority; a
/// receiver takes the larger one of its two nearest pilots.
class LearnedVisibility {
public:
    /// Nothing is learned: all is likely.
    LearnedVisibility() = default;

    /// Learns what is visible from `pilots`, of which a few hundred spread over what will be shaded are enough.
    /// The same for any executor. `oracle` is asked from its threads.
    /// throws: invalid_input for options out of range: neighbors at least 1, prior_rays and full_share above 0,
    /// full_share at most 1, least_factor from 2^-30 to 1, normal_length not negative, clusters from 1 to 32768.
    /// cost: a lightcut for each pilot. memory: 2 bytes for each node of the trees, and `LearningOptions::clusters`
    /// bytes for each pilot.
    template <TreeOrForest Lights, class M, class Oracle, Executor E = Sequential>
    LearnedVisibility(const Lights& lights, std::span<const Receiver<M>> pilots, const Oracle& oracle,
                      const LearningOptions& options = {}, const E& execute = {}) {
        check(options);
        const auto& forest = as_forest(lights);
        std::vector<detail::PilotPlace> places;
        for (const Receiver<M>& p : pilots) places.push_back(place_of(p));
        pilots_ = detail::PilotPlaces(std::move(places), static_cast<double>(options.normal_length));
        if (pilots.empty()) return;
        std::vector<std::vector<Trial>> trials(pilots.size());
        std::vector<std::uint32_t> rays(pilots.size());
        execute(pilots.size(), [&](std::size_t p) {
            Lightcut cut(forest, pilots[p], oracle, options.cut);
            while (cut.step()) {}
            rays[p] = cut.result().queries;
            cut.for_each([&](const auto& n) {
                if (is_lit(forest, pilots[p], n)) trials[p].push_back({n.node, n.kind, !is_black(n.transfer)});
            });
        });
        for (const std::uint32_t r : rays) rays_ += r;
        Groups groups = choose_clusters(forest, trials, options.clusters);
        execute(pilots.size(), [&](std::size_t p) {
            for (Trial& t : trials[p]) t.node = group_of_[t.kind][t.node];
        });
        factors_.resize(pilots.size() * groups.size());
        group_count_ = groups.size();
        execute(pilots.size(), [&](std::size_t p) { learn(p, trials, groups, options); });
    }

    /// A factor of priorities for the clusters of one receiver. A view of what was learned.
    class Likelihood {
    public:
        /// The `node` of the tree `kind`, in (0, 1].
        float operator()(std::uint32_t kind, std::uint32_t node) const {
            if (group_of_ == nullptr) return 1.0f;
            const std::uint16_t group = (*group_of_)[kind][node];
            const std::uint8_t a = rows_[0][group], b = rows_[1][group];
            return factor_of(a < b ? a : b);  // the lower code, the larger factor
        }

    private:
        friend class LearnedVisibility;
        const std::vector<std::vector<std::uint16_t>>* group_of_ = nullptr;
        std::array<const std::uint8_t*, 2> rows_{};
    };

    /// What the two pilots nearest to a receiver know. pre: cuts are over the trees that it was learned for, neither
    /// built anew nor refitted to lights elsewhere. cost: that of a search among the pilots.
    template <class M>
    Likelihood likely_visible(const Receiver<M>& receiver) const {
        Likelihood likely;
        std::array<detail::PilotPlaces::Neighbor, 2> nearest;
        const std::size_t count = pilots_.nearest(place_of(receiver), nearest);
        if (count == 0) return likely;
        likely.group_of_ = &group_of_;
        for (std::size_t i = 0; i < likely.rows_.size(); ++i) {
            likely.rows_[i] = factors_.data() + nearest[i < count ? i : 0].place * group_count_;
        }
        return likely;
    }

    /// Shadow rays that were traced to learn.
    std::uint64_t rays() const { return rays_; }
    std::size_t pilot_count() const { return pilots_.size(); }

private:
    /// A ray for a cluster; later for a group of them.
    struct Trial {
        std::uint32_t node;
        std::uint8_t kind;
        bool arrived;
    };
    struct Count {
        std::uint64_t rays = 0, arrived = 0;

        void add(const Count& c) {
            rays += c.rays;
            arrived += c.arrived;
        }
    };
    /// A node that is told apart, and what lies below it and is not.
    struct Group {
        std::uint16_t above = none;  ///< the group of the parent, which precedes this one
        double share = 0.0;          ///< of all pilots' rays that arrived
    };
    using Groups = std::vector<Group>;
    static constexpr std::uint16_t none = 0xffff;
    static constexpr std::uint64_t fewest_rays = 8;  ///< of all pilots, for a cluster that is told apart

    static void check(const LearningOptions& o) {
        const auto require = [](bool holds, const char* what) {
            if (!holds) LIGHTCUTS_THROW(invalid_input(std::string("learned visibility: ") + what));
        };
        require(o.neighbors >= 1, "neighbors is not at least 1");
        require(o.prior_rays > 0.0f && o.prior_rays < 1e30f, "prior_rays is not above 0 and below 1e30");
        require(o.full_share > 0.0f && o.full_share <= 1.0f, "full_share is not above 0 and at most 1");
        require(o.least_factor >= 0x1p-30f && o.least_factor <= 1.0f, "least_factor is not from 2^-30 to 1");
        require(o.normal_length >= 0.0f && o.normal_length < 1e30f, "normal_length is not from 0 to 1e30");
        require(o.clusters >= 1 && o.clusters <= 32768, "clusters is not from 1 to 32768");
    }

    template <class M>
    static detail::PilotPlace place_of(const Receiver<M>& receiver) {
        const ReceiverBox box = lightcuts::box_of(receiver);
        return {receiver.position, box.horizon ? box.horizon->normal : glm::vec3(0.0f)};
    }

    /// Whether a cluster's representative would contribute if nothing shadowed it: then its shadow ray was traced.
    template <class Forest, class M, class Node>
    static bool is_lit(const Forest& forest, const Receiver<M>& receiver, const Node& n) {
        if (!is_black(n.transfer)) return true;
        return forest.visit(n.kind, [&](const auto& tree) {
            return !is_black(unshadowed_transfer(receiver, tree.lights()[tree.topology().item(n.representative)]));
        });
    }

    /// Tells those clusters apart which most rays went to; they and all above them are groups of their own.
    template <class Forest>
    Groups choose_clusters(const Forest& forest, const std::vector<std::vector<Trial>>& trials, std::size_t most) {
        std::vector<std::vector<Count>> counts(Forest::kinds);
        forest.for_each([&](std::uint32_t kind, const auto& tree) { counts[kind].resize(tree.topology().size()); });
        for (const std::vector<Trial>& pilot : trials) {
            for (const Trial& t : pilot) counts[t.kind][t.node].add({1, t.arrived ? 1u : 0u});
        }
        std::vector<std::uint64_t> rays;
        forest.for_each([&](std::uint32_t kind, const auto& tree) {
            const ClusterTree& topology = tree.topology();
            for (std::uint32_t n = 0; n < topology.size(); ++n) {
                Count& count = counts[kind][n];
                if (!topology.is_leaf(n)) {
                    count.add(counts[kind][topology.left(n)]);
                    count.add(counts[kind][topology.right(n)]);
                }
                if (count.rays >= fewest_rays) rays.push_back(count.rays);
            }
        });
        std::uint64_t least = fewest_rays;
        if (rays.size() > most) {
            const auto first_left_out = rays.begin() + static_cast<std::ptrdiff_t>(most);
            std::nth_element(rays.begin(), first_left_out, rays.end(), std::greater<>());
            least = *first_left_out + 1;
        }
        Groups groups;
        group_of_.resize(Forest::kinds);
        forest.for_each([&](std::uint32_t kind, const auto& tree) {
            const ClusterTree& topology = tree.topology();
            std::vector<std::uint16_t>& group_of = group_of_[kind];
            group_of.assign(topology.size(), none);
            // Parents come after their children in the array, so they are met first.
            for (std::size_t n = topology.size(); n-- > 0;) {
                const auto node = static_cast<std::uint32_t>(n);
                if (group_of[n] == none || counts[kind][n].rays >= least) {
                    const std::uint16_t above = group_of[n];
                    group_of[n] = static_cast<std::uint16_t>(groups.size());
                    const double prior = above == none ? 1.0 : groups[above].share;
                    groups.push_back({above, share_of(counts[kind][n], 1.0, prior)});
                }
                if (topology.is_leaf(node)) continue;
                group_of[topology.left(node)] = group_of[topology.right(node)] = group_of[n];
            }
        });
        return groups;
    }

    /// The share of rays that arrive, with `prior_rays` of which `prior` arrive added to them.
    static double share_of(const Count& count, double prior_rays, double prior) {
        return (static_cast<double>(count.arrived) + prior_rays * prior) /
               (static_cast<double>(count.rays) + prior_rays);
    }

    /// Fills the factors of pilot `p`. Trials are those of groups.
    void learn(std::size_t p, const std::vector<std::vector<Trial>>& trials, const Groups& groups,
               const LearningOptions& options) {
        std::vector<detail::PilotPlaces::Neighbor> neighbors((std::min)(options.neighbors, pilots_.size()));
        pilots_.nearest(pilots_.places()[p], neighbors);
        std::vector<Count> counts(groups.size());
        for (const auto& neighbor : neighbors) {
            for (const Trial& t : trials[neighbor.place]) counts[t.node].add({1, t.arrived ? 1u : 0u});
        }
        for (std::size_t g = groups.size(); g-- > 0;) {
            if (groups[g].above != none) counts[groups[g].above].add(counts[g]);
            const double share = share_of(counts[g], static_cast<double>(options.prior_rays), groups[g].share);
            const auto factor = static_cast<float>(share / static_cast<double>(options.full_share));
            factors_[p * groups.size() + g] = code_of((std::min)((std::max)(factor, options.least_factor), 1.0f));
        }
    }

    /// A factor from 2^-31 to 1 in a byte, rounded up: the exponent and three bits of the fraction, counted down
    /// from 1.
    static constexpr std::uint8_t code_of(float factor) {
        const std::uint32_t bits = (std::bit_cast<std::uint32_t>(factor) + 0xfffffu) >> 20;
        return static_cast<std::uint8_t>(code_of_one - bits);
    }
    static constexpr float factor_of(std::uint8_t code) { return std::bit_cast<float>((code_of_one - code) << 20); }
    static constexpr std::uint32_t code_of_one = std::bit_cast<std::uint32_t>(1.0f) >> 20;

    detail::PilotPlaces pilots_;
    std::vector<std::vector<std::uint16_t>> group_of_;  ///< of each node of each kind's tree
    std::size_t group_count_ = 0;
    std::vector<std::uint8_t> factors_;  ///< codes: of each pilot, of each group
    std::uint64_t rays_ = 0;
};

/// An oracle that answers as `Oracle` does, and predicts what was learned: a PredictingOracle. Refers to what was
/// learned.
template <class Oracle>
class LearnedOracle : public Oracle {
public:
    LearnedOracle(const Oracle& oracle, const LearnedVisibility& learned) : Oracle(oracle), learned_(learned) {}

    template <class M>
    LearnedVisibility::Likelihood likely_visible(const Receiver<M>& receiver) const {
        return learned_.likely_visible(receiver);
    }

private:
    const LearnedVisibility& learned_;
};

}  // namespace lightcuts
