#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "../core/invalid_input.hpp"
#include "../core/vector.hpp"
#include "../tree/build/divide.hpp"
#include "../tree/build/longest_axis.hpp"
#include "../tree/light_cluster.hpp"
#include "envelope.hpp"
#include "gather_point.hpp"
#include "time_vectors.hpp"

namespace lightcuts {

/// A lobe that says where it points: `main_direction()` is the direction in which it reflects most, of length 0 (even)
/// to 4 (sharp). Clusters of gather points are made of points whose directions are alike.
template <class M>
concept DirectedMaterial = requires(const M& m) {
    { m.main_direction() } -> Vector3;
};

/// How trees of gather points are built.
struct GatherTreeOptions {
    /// The diagonal of the scene in world units: an eighth of it is what a unit of direction counts for where positions
    /// and directions are compared [Multidimensional Lightcuts 2006, section 3.4]. 0: that of the gather points' box.
    double scene_diagonal = 0.0;
    /// Of the lights; 1 if these have none, whatever instants gather points have.
    std::uint32_t instants = 1;
};

namespace detail {
struct LobeTag {};

template <class M>
struct EnvelopeOfLobe {
    using type = Empty<LobeTag>;
};
template <class M>
    requires has_envelope<M>
struct EnvelopeOfLobe<M> {
    using type = decltype(envelope_of_lobe(std::declval<const M&>()));
};

/// Splits a set in the middle of the longest axis of its box, not at the median, which takes several passes; a handful
/// of points by their numbers, as cuts hardly ever get there.
struct GatherSplitter {
    template <std::size_t Dimensions>
    Split<Dimensions> split(const BuildRange<Dimensions>& range, const NormalizedSpace& space) const {
        using Item = BuildItem<Dimensions>;
        if (range.items.size() <= 8) {
            std::sort(range.items.begin(), range.items.end(),
                      [](const Item& a, const Item& b) { return a.item() < b.item(); });
            return split_at(range, range.items.size() / 2);
        }
        const auto bounds = BuildBounds<Dimensions>::of(range.items);
        const std::size_t axis = longest_axis(bounds, space.direction_share({}, 0.125f));
        const float middle = bounds.lo[axis] + 0.5f * (bounds.hi[axis] - bounds.lo[axis]);
        const std::size_t left = partition_items(range.items, [&](const Item& i) { return i.lane[axis] <= middle; });
        return left < range.items.size() ? split_at(range, left) : LongestAxis{}.split(range, space);
    }
};

}  // namespace detail

/// A binary tree over the gather points of one sum. Made to be rebuilt for each pixel: no allocation once warm.
/// Refers to the points, which must stay where they are.
template <AnyGatherPoint G>
class GatherTree {
public:
    using point_type = G;
    using material_type = typename G::material_type;
    using spectrum = typename G::spectrum;
    using node_index = ClusterTree::node_index;
    using envelope_type = typename detail::EnvelopeOfLobe<material_type>::type;

    static_assert(std::same_as<material_spectrum<material_type>, spectrum>,
                  "the lobe of a gather point needs to return the spectrum of the point's strength");

    /// What a node knows of the points below it.
    struct Cluster {
        Box box;
        spectrum strength = black<spectrum>();           ///< sum over the points
        [[no_unique_address]] envelope_type envelope{};  ///< dominates the points' lobes
    };

    /// Bounds the lobes of the points below a node: those of few one by one, which is tighter, those of many by the
    /// envelope, if there is one.
    class LobesBelow {
    public:
        LobesBelow() = default;
        LobesBelow(const GatherTree& tree, node_index node) : tree_(&tree), node_(node) {}

        /// cost: that of the envelope's bound, or of a bound for each point.
        spectrum upper_bound(const OffsetBox& box) const {
            if constexpr (EnvelopedMaterial<material_type>) {
                if (tree_->topology_.leaf_count(node_) > few_points) {
                    return detail::upper_bound_over<spectrum>(tree_->clusters_[node_].envelope, box);
                }
            }
            spectrum largest = black<spectrum>();
            for (node_index n = tree_->topology_.left_leaf(node_); n <= node_; ++n) {
                if (!tree_->topology_.is_leaf(n)) continue;
                const auto one = detail::upper_bound_over<spectrum>(tree_->point(n).receiver.material, box);
                largest = larger_channels(largest, one);
            }
            return largest;
        }

    private:
        static constexpr std::size_t few_points = 2;

        const GatherTree* tree_ = nullptr;
        node_index node_ = 0;
    };

    /// What bounds the points of a cluster: the envelope of cosine lobes, from which the bound policy forms joint
    /// bounds.
    static constexpr bool by_envelope = BoundsByCosineLobe<envelope_type, spectrum>;
    using bound_type = std::conditional_t<by_envelope, envelope_type, LobesBelow>;

    GatherTree() = default;
    GatherTree(const GatherTree&) = delete;
    GatherTree& operator=(const GatherTree&) = delete;
    GatherTree(GatherTree&&) noexcept = default;
    GatherTree& operator=(GatherTree&&) noexcept = default;

    /// Builds the tree of other points, in the storage of those before, by splits in the middle of the longest axis in
    /// six dimensions.
    /// throws: invalid_input naming the first point whose strength is negative or not finite, whose position is not
    /// finite, or whose instant is not below `options.instants`; the tree then is empty. cost: O(N log N).
    void build(std::span<const G> points, const GatherTreeOptions& options = {}) {
        clear();
        points_ = points;
        make_items(options);
        divide_into(std::span(items_), detail::GatherSplitter{}, space_, divide_, topology_);
        summarize_points();
        if constexpr (TimedGatherPoint<G>) {
            if (options.instants > 1) {
                times_.build(
                    topology_, options.instants, [&](std::uint32_t i) { return points_[i].instant; },
                    [&](std::uint32_t i) { return points_[i].strength; });
                is_timed_ = true;
            }
        }
    }

    /// Leaves a tree of no points, and keeps its storage.
    void clear() {
        points_ = {};
        std::vector<std::uint32_t> words = std::move(topology_).release();
        words.clear();
        topology_ = ClusterTree(std::move(words));
        is_timed_ = false;
    }

    /// True if no point has any strength.
    bool empty() const { return topology_.empty(); }
    const ClusterTree& topology() const { return topology_; }
    std::span<const Cluster> clusters() const { return clusters_; }
    /// The gather point of a leaf.
    const G& point(node_index leaf) const { return points_[topology_.item(leaf)]; }
    /// The sum over the channels of a node's strength.
    double weight(node_index n) const { return weights_[n]; }
    /// Strengths by instant, where there are several.
    const TimeVectors<spectrum>& times() const requires TimedGatherPoint<G> { return times_; }
    bool is_timed() const { return is_timed_; }

    /// Bounds the lobes of a cluster: a reference to its envelope, or what asks each of its points.
    decltype(auto) bound(node_index n) const {
        if constexpr (by_envelope) {
            return static_cast<const envelope_type&>(clusters_[n].envelope);
        } else {
            return LobesBelow(*this, n);
        }
    }

private:
    struct TimesTag {};
    using Times = std::conditional_t<TimedGatherPoint<G>, TimeVectors<spectrum>, detail::Empty<TimesTag>>;

    [[noreturn]] static void reject(std::size_t index, const char* what) {
        LIGHTCUTS_THROW(invalid_input("gather point " + std::to_string(index) + ": " + what));
    }

    static glm::vec3 direction_of(const material_type& m) {
        if constexpr (DirectedMaterial<material_type>) {
            return to_vec3(m.main_direction());
        } else if constexpr (CosineLobeMaterial<material_type>) {
            return merge(Cone{}, m.cosine_lobe().normal).axis;
        } else {
            return glm::vec3(0.0f);
        }
    }

    void make_items(const GatherTreeOptions& options) {
        Box box;
        double largest = 0.0;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double sum = channel_sum(points_[i].strength);
            for (int c = 0; c < channels_of<spectrum>; ++c) {
                const float s = channel(points_[i].strength, c);
                if (!(s >= 0.0f)) reject(i, "strength is negative or not a number");
                if (!(s - s == 0.0f)) reject(i, "strength is infinite");
            }
            if (!is_finite(points_[i].receiver.position)) reject(i, "position is not finite");
            if constexpr (TimedGatherPoint<G>) {
                if (options.instants > 1 && points_[i].instant >= options.instants) {
                    reject(i, "its instant is not below the number of instants");
                }
            }
            if (!(sum > 0.0)) continue;
            box = merge(box, box_of(points_[i].receiver.position));
            largest = sum > largest ? sum : largest;
        }
        items_.clear();
        if (is_empty(box)) return;
        const double diagonal = options.scene_diagonal > 0.0 ? options.scene_diagonal : std::sqrt(diagonal2(box));
        space_ = {};
        for (int a = 0; a < 3; ++a) space_.origin[static_cast<std::size_t>(a)] = static_cast<double>(box.lo[a]);
        if (diagonal > 0.0) space_.per_length = 1.0 / diagonal;
        space_.per_weight = 1.0 / largest;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double sum = channel_sum(points_[i].strength);
            if (!(sum > 0.0)) continue;
            constexpr double most = 3e38;
            const OrientedItem item{points_[i].receiver.position, direction_of(points_[i].receiver.material),
                                    static_cast<float>(sum < most ? sum : most)};
            items_.push_back(build_item(item, static_cast<std::uint32_t>(i), space_));
        }
    }

    void summarize_points() {
        clusters_.resize(topology_.size());
        weights_.resize(topology_.size());
        for (node_index n = 0; n < topology_.size(); ++n) {
            Cluster& cluster = clusters_[n];
            if (topology_.is_leaf(n)) {
                const G& p = point(n);
                cluster.box = box_of(p.receiver.position);
                cluster.strength = p.strength;
                if constexpr (detail::has_envelope<material_type>) {
                    cluster.envelope = detail::envelope_of_lobe(p.receiver.material);
                }
                weights_[n] = channel_sum(p.strength);
            } else {
                const node_index left = topology_.left(n), right = topology_.right(n);
                const Cluster &a = clusters_[left], &b = clusters_[right];
                cluster.box = merge(a.box, b.box);
                cluster.strength = finite(spectrum(a.strength + b.strength));
                if constexpr (detail::has_envelope<material_type>) cluster.envelope = merge(a.envelope, b.envelope);
                weights_[n] = weights_[left] + weights_[right];
            }
        }
    }

    std::span<const G> points_;
    ClusterTree topology_;
    std::vector<Cluster> clusters_;
    std::vector<double> weights_;
    [[no_unique_address]] Times times_{};
    bool is_timed_ = false;
    NormalizedSpace space_{};
    std::vector<BuildItem<6>> items_;
    DivideScratch<6> divide_;
};

}  // namespace lightcuts
