#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "../core/executor.hpp"
#include "../core/invalid_input.hpp"
#include "build/binned.hpp"
#include "build/divide.hpp"
#include "build/item.hpp"
#include "light_cluster.hpp"
#include "representatives.hpp"

namespace lightcuts {

/// What the nodes of a LightTree are given besides the tree's topology.
struct LightTreeOptions {
    /// Most representatives of a node, 1 to 32. With 1, which takes the least memory, all receivers see a cluster by
    /// the same light, and penumbrae may show bands; with 8 the bands are noise.
    unsigned representatives = 1;
    /// Seed of the random choice of representatives. Trees that differ only in it choose independently.
    std::uint64_t seed = 1;
};

/// The default builder of light trees: `divide` by the splitter `Binned`, from the top down. cost: O(N log N)
struct BinnedBuilder {
    template <class Item, Executor E>
    ClusterTree operator()(std::span<const Item> items, const E& execute) const {
        return divide(items, Binned{}, execute);
    }
};

namespace detail {

/// Stands for the lights of a range from which no tree can be made.
template <class R>
struct ScatteredLights {};
template <class L>
inline constexpr bool are_scattered = false;
template <class R>
inline constexpr bool are_scattered<ScatteredLights<R>> = true;

/// Ranges of `L` whose elements stand side by side.
template <class R, class L>
concept LightsOf = std::ranges::contiguous_range<R> && std::ranges::sized_range<R> &&
    std::same_as<std::ranges::range_value_t<R>, L>;

}  // namespace detail

/// The light tree of a type that is not a Light: it does not compile, and the message says what the type lacks.
template <class L>
class LightTree {
    static_assert(!detail::are_scattered<L>,
                  "the lights of a tree stand side by side: std::vector, std::array, std::span or an array, not "
                  "std::deque or std::list");
    static_assert(detail::are_scattered<L> || detail::HasIntensity<L>,
                  "a light needs intensity(): a float, a glm::vec3 or another Spectrum; a member, or a function of "
                  "light_traits");
    static_assert(!detail::HasIntensity<L> || Light<L>,
                  "a light needs position(), or direction() if it is infinitely far: three coordinates; a member, or a "
                  "function of light_traits");

public:
    template <class... Arguments>
    explicit LightTree(const Arguments&...) {}
};

/// A binary tree over lights of one kind [Lightcuts 2005, section 3]: a topology, and for each node the cluster of the
/// lights below it and the lights that may represent it. Refers to the lights, which must outlive it and stay where
/// they are; copies none. Lights of zero intensity are left out.
/// memory: for float RGB and one representative 88 bytes an omni light, 120 an oriented one.
/// threads: safe to read from several.
template <Light L>
class LightTree<L> {
    static_assert(
        !PointLight<L> || OrientedLight<L> || !requires(const L& l) { detail::direction_of(l); },
        "a light with position() and direction() is ambiguous: name the direction of maximum emission axis(), or leave "
        "out the position of a light at infinity");
    static_assert(
        OrientedLight<L> || !requires(const L& l) { detail::emission_of(l, 0.0f); },
        "a light with emission(cos) needs axis(), from which the angle is measured");
    static_assert(
        !LightCluster<L>::enveloped || requires(const typename LightCluster<L>::envelope_type& e) { merge(e, e); },
        "what a light's envelope() returns needs merge(a, b), which is nowhere below either");

public:
    using light_type = L;
    using spectrum = spectrum_of<L>;
    using cluster = LightCluster<L>;
    using node_index = ClusterTree::node_index;

    /// A tree of no lights.
    LightTree() = default;

    /// Deleted: a copy would refer to the original's lights, even where an object that holds lights and tree is copied
    /// with both. Move the tree, share it by reference, or build another over the copied lights.
    LightTree(const LightTree&) = delete;
    LightTree& operator=(const LightTree&) = delete;
    /// Takes over the tree of `other`, which becomes a tree of no lights. The lights must stay where they are; those of
    /// a std::vector do when the vector is moved. A LightForest that refers to `other` goes on referring to it.
    LightTree(LightTree&& other) noexcept { *this = std::move(other); }
    LightTree& operator=(LightTree&& other) noexcept {
        lights_ = std::exchange(other.lights_, {});
        options_ = other.options_;
        tree_ = std::exchange(other.tree_, {});
        clusters_ = std::exchange(other.clusters_, {});
        representatives_ = std::exchange(other.representatives_, {});
        start_ = std::exchange(other.start_, {});
        return *this;
    }

    /// Builds a tree over `lights`: its topology is what `builder(items, execute)` returns, a binary ClusterTree over
    /// the lights of positive intensity; then clusters and representatives of all nodes are computed.
    /// throws: invalid_input naming the first light whose intensity is negative or not finite, whose position or
    /// direction is not finite, or whose axis or direction is not of unit length; or if `options.representatives` is
    /// not in 1 to 32, if there are more than 2^30 lights, or if the builder's tree is not binary.
    /// cost: that of the builder, by default O(N log N), and O(N).
    template <class Builder = BinnedBuilder, Executor E = Sequential>
    explicit LightTree(std::span<const L> lights, const LightTreeOptions& options = {}, const Builder& builder = {},
                       const E& execute = {})
        : lights_(lights), options_(options) {
        if (options.representatives < 1 || options.representatives > 32) {
            LIGHTCUTS_THROW(
                invalid_input("representatives: " + std::to_string(options.representatives) + " is not in 1 to 32"));
        }
        build_topology(builder, execute);
        update();
    }

    /// Builds a tree over the lights of a std::vector, a std::array, an array or another contiguous range, which must
    /// outlive the tree. throws: invalid_input where the constructor from a span does.
    /// cost: that of the builder, by default O(N log N), and O(N).
    template <detail::LightsOf<L> R, class Builder = BinnedBuilder, Executor E = Sequential>
        requires(!std::same_as<R, std::span<const L>>)
    explicit LightTree(const R& lights, const LightTreeOptions& options = {}, const Builder& builder = {},
                       const E& execute = {})
        : LightTree(std::span<const L>(std::ranges::data(lights), std::ranges::size(lights)), options, builder,
                    execute) {}

    /// Deleted: a tree refers to its lights, and those of a temporary would be gone. Keep them in a variable.
    template <detail::LightsOf<L> R, class... Rest>
        requires(!std::ranges::borrowed_range<R>)
    explicit LightTree(const R&&, const Rest&...) = delete;

    /// Computes the clusters and representatives of all nodes anew after lights were moved, turned or dimmed in place.
    /// The topology stays: build another tree where lights of one cluster have moved far apart. cost: O(N)
    /// throws: invalid_input naming the first light whose intensity is negative or not finite, whose position or
    /// direction is not finite, or whose axis or direction is not of unit length; the tree then is as it was.
    /// pre: the lights of positive intensity are the same as when the tree was built.
    void refit() {
        for (node_index n = 0; n < tree_.size(); ++n) {
            if (tree_.is_leaf(n)) checked_item(lights_[tree_.item(n)], tree_.item(n));
        }
        update();
    }

    /// True if no light has a positive intensity: the tree has no nodes.
    bool empty() const { return tree_.empty(); }
    /// The caller's lights, including those of zero intensity.
    std::span<const L> lights() const { return lights_; }
    /// The nodes and how they are linked; the item of a leaf is an index into `lights()`.
    const ClusterTree& topology() const { return tree_; }
    /// For each node of the topology, in post-order, the box, axes, envelope and summed intensity of the lights below
    /// it.
    std::span<const cluster> clusters() const { return clusters_; }
    /// For each node the leaves whose lights may represent it.
    const Representatives& representatives() const { return representatives_; }
    /// A cut of the whole tree into at most 32 clusters of about equal power, in post-order: where refinement starts,
    /// since nearly every lightcut lies below it.
    std::span<const node_index> start() const { return start_; }

    /// Bytes of heap memory that topology, clusters and representatives hold. The lights are the caller's.
    std::size_t memory_bytes() const {
        return tree_.words().capacity() * sizeof(std::uint32_t) + clusters_.capacity() * sizeof(cluster) +
               representatives_.memory_bytes();
    }

private:
    static constexpr std::size_t start_size = 32;

    using Item = std::conditional_t<cluster::oriented, OrientedItem, PointItem>;

    [[noreturn]] static void reject(std::size_t index, const char* what) {
        LIGHTCUTS_THROW(invalid_input("light " + std::to_string(index) + ": " + what));
    }

    /// Computes the clusters and representatives from the lights as they are now. One pass over all: `summarize` once
    /// for extents and once for sums takes a seventh longer.
    void update() {
        constexpr int channels = channels_of<spectrum>;
        using Sums = std::array<double, static_cast<std::size_t>(channels)>;
        std::vector<Sums> sums(tree_.size());
        std::vector<double> weights(tree_.size());
        clusters_.resize(tree_.size());
        for (node_index n = 0; n < tree_.size(); ++n) {
            Sums& sum = sums[n];
            if (tree_.is_leaf(n)) {
                clusters_[n] = cluster_of(lights_[tree_.item(n)]);
                for (int c = 0; c < channels; ++c) {
                    sum[static_cast<std::size_t>(c)] = static_cast<double>(channel(clusters_[n].intensity, c));
                }
            } else {
                const node_index a = tree_.left(n), b = tree_.right(n);
                clusters_[n] = merge_extents(clusters_[a], clusters_[b]);
                for (std::size_t c = 0; c < sum.size(); ++c) sum[c] = sums[a][c] + sums[b][c];
                clusters_[n].intensity = make_spectrum<spectrum>(
                    [&](int c) { return sum[static_cast<std::size_t>(c)]; });
            }
            for (const double s : sum) weights[n] += s;
        }
        representatives_ = Representatives(tree_, weights, options_.representatives, options_.seed);
        start_ = equal_power_cut(weights);
    }

    /// Splits the strongest cluster as long as there are few.
    std::vector<node_index> equal_power_cut(std::span<const double> powers) const {
        std::vector<node_index> cut;
        if (tree_.empty()) return cut;
        cut.push_back(tree_.root());
        const auto is_weaker = [&](node_index a, node_index b) {
            if (tree_.is_leaf(a) != tree_.is_leaf(b)) return tree_.is_leaf(a);
            return powers[a] != powers[b] ? powers[a] < powers[b] : a > b;
        };
        while (cut.size() < start_size) {
            const auto strongest = std::max_element(cut.begin(), cut.end(), is_weaker);
            const node_index n = *strongest;
            if (tree_.is_leaf(n)) break;
            *strongest = tree_.right(n);
            cut.push_back(tree_.left(n));
        }
        std::sort(cut.begin(), cut.end());
        return cut;
    }

    static Item checked_item(const L& light, std::size_t index) {
        const spectrum intensity = detail::intensity_of(light);
        for (int c = 0; c < channels_of<spectrum>; ++c) {
            const float value = channel(intensity, c);
            if (!(value >= 0.0f)) reject(index, "intensity is negative or not a number");
            if (!(value - value == 0.0f)) reject(index, "intensity is infinite");
        }
        Item item;
        if constexpr (DirectionalLight<L>) {
            check_unit(to_vec3(detail::direction_of(light)), index, "direction is not of unit length");
        }
        item.position = position_or_direction(light);
        if (!is_finite(item.position)) reject(index, "position is not finite");
        if constexpr (cluster::oriented) {
            item.axis = to_vec3(detail::axis_of(light));
            check_unit(item.axis, index, "axis is not of unit length");
        }
        const double weight = channel_sum(intensity);
        item.weight = weight > 3e38 ? 3e38f : static_cast<float>(weight);
        if (weight > 0 && item.weight == 0.0f) item.weight = 1e-45f;
        return item;
    }

    static void check_unit(const glm::vec3& v, std::size_t index, const char* what) {
        const float length2 = glm::dot(v, v);
        if (!(length2 > 0.99999f && length2 < 1.00001f)) reject(index, what);
    }

    template <class Builder, class E>
    void build_topology(const Builder& builder, const E& execute) {
        std::vector<Item> items;
        std::vector<std::uint32_t> light_of;
        if (lights_.size() > ClusterTree::max_items) {
            LIGHTCUTS_THROW(invalid_input("more than 2^30 lights in one tree"));
        }
        items.reserve(lights_.size());
        for (std::size_t i = 0; i < lights_.size(); ++i) {
            const Item item = checked_item(lights_[i], i);
            if (item.weight > 0.0f) {
                if (items.size() < i && light_of.empty()) {  // the first light after a dark one
                    for (std::uint32_t k = 0; k < items.size(); ++k) light_of.push_back(k);
                }
                if (items.size() < i) light_of.push_back(static_cast<std::uint32_t>(i));
                items.push_back(item);
            }
        }
        tree_ = builder(std::span<const Item>(items), execute);
        if (!tree_.is_binary())
            LIGHTCUTS_THROW(invalid_input("light tree: its builder made a tree that is not binary"));
        if (!light_of.empty()) tree_ = relabeled(tree_, light_of, lights_.size());
    }

    /// The same tree with item i called `names[i]`, all of which are below `bound`.
    static ClusterTree relabeled(const ClusterTree& tree, const std::vector<std::uint32_t>& names, std::size_t bound) {
        std::vector<std::uint32_t> words = tree.words();
        for (node_index n = 0; n < tree.size(); ++n) {
            if (tree.is_leaf(n)) words[n] = ClusterTree::leaf_word(names[tree.item(n)]);
        }
        return ClusterTree(std::move(words), bound);
    }

    std::span<const L> lights_;
    LightTreeOptions options_;
    ClusterTree tree_;
    std::vector<cluster> clusters_;
    Representatives representatives_;
    std::vector<node_index> start_;
};

template <std::ranges::contiguous_range R>
LightTree(R&&, const LightTreeOptions& = {}) -> LightTree<std::ranges::range_value_t<R>>;
template <std::ranges::contiguous_range R, class Builder, class... Rest>
LightTree(R&&, const LightTreeOptions&, const Builder&, const Rest&...) -> LightTree<std::ranges::range_value_t<R>>;
template <class R, class... Rest>
    requires(std::ranges::input_range<R> && !std::ranges::contiguous_range<R>)
LightTree(R&&, const Rest&...)
->LightTree<detail::ScatteredLights<std::remove_cvref_t<R>>>;

}  // namespace lightcuts
