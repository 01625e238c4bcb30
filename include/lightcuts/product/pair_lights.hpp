#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "../core/spectrum.hpp"
#include "../cut/clamp.hpp"
#include "../light/clampable.hpp"
#include "../tree/cluster_tree.hpp"
#include "product_node.hpp"
#include "time_vectors.hpp"
#include "timed_light.hpp"

namespace lightcuts::detail {

/// How many lights a pair of clusters counts for under clamping: each light by the share that the pair's gather points
/// have of the strength which it reaches. That is the strength of all gather points, or, of a light that exists at one
/// instant, of those of that instant. So a light counts as one over all of the gather points, and as one at a single
/// gather point. One for each sum; `start` reuses its storage.
template <Spectrum S>
class PairLights {
public:
    using Count = ProductLightCount<S>;

    /// Forgets the last sum: no lights are counted, each pair has infinitely many, which are not clamped.
    void stop() { counts_ = false; }

    /// Finds the strength of all gather points, at each instant too where there are several. cost: O(instants).
    template <class Points>
    void start(const Points& points) {
        counts_ = true;
        strength_ = {};
        at_instants_.assign(points.instants() > 1 ? points.instants() : 0, {});
        points.for_each([&](std::uint32_t, const auto& tree) {
            if (tree.empty()) return;
            const ClusterTree::node_index root = tree.topology().root();
            add(tree.clusters()[root].strength, strength_);
            if constexpr (requires { tree.times(); }) {
                if (!tree.is_timed()) return;
                tree.times().for_each(root, [&](std::uint32_t t, const S& s) { add(s, at_instants_[t]); });
            }
        });
    }

    /// Of all gather points, in every channel.
    const ChannelSums<S>& strength() const { return strength_; }

    /// The lights of a pair of nodes. `times`: of the tree of lights, as a TimedForest has them.
    template <class GatherTree, class LightTree, class Times>
    Count of(const GatherTree& points, const LightTree& lights, [[maybe_unused]] const Times& times,
             ClusterTree::node_index gather, ClusterTree::node_index light) const {
        using L = typename LightTree::light_type;
        if constexpr (ClampableLight<L>) {
            if (!counts_) return infinitely_many();
            if constexpr (TimedLight<L>) {
                if (points.is_timed()) {
                    ChannelSums<S> sum{};
                    for_each_common(points.times(), gather, times.counts, light,
                                    [&](std::uint32_t t, const S& strength, float count) {
                                        for (std::size_t c = 0; c < sum.size(); ++c) {
                                            sum[c] += share(strength, at_instants_[t], c) * static_cast<double>(count);
                                        }
                                    });
                    return make_spectrum<Count>([&](int c) { return sum[static_cast<std::size_t>(c)]; });
                }
            }
            const auto count = static_cast<double>(lights.topology().leaf_count(light));
            return make_spectrum<Count>([&](int c) {
                return count * share(points.clusters()[gather].strength, strength_, static_cast<std::size_t>(c));
            });
        } else {
            return infinitely_many();
        }
    }

private:
    static Count infinitely_many() {
        return make_spectrum<Count>([](int) { return std::numeric_limits<float>::infinity(); });
    }
    static void add(const S& s, ChannelSums<S>& sum) {
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += static_cast<double>(channel(s, static_cast<int>(c)));
    }
    static double share(const S& part, const ChannelSums<S>& whole, std::size_t c) {
        return whole[c] > 0.0 ? static_cast<double>(channel(part, static_cast<int>(c))) / whole[c] : 0.0;
    }

    bool counts_ = false;
    ChannelSums<S> strength_{};
    std::vector<ChannelSums<S>> at_instants_;
};

struct PairLightsTag {};

}  // namespace lightcuts::detail
