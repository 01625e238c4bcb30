#include <lightcuts/tree/build/agglomerate.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/core/box.hpp>
#include <lightcuts/core/cone.hpp>
#include <lightcuts/tree/statistics.hpp>
#include <lightcuts/tree/validate.hpp>

#include "tree/build/item_sets.hpp"

namespace {

using namespace lightcuts;
using namespace lightcuts::test;
using detail::BuildCluster;
using detail::Rank;

template <bool Oriented, class Item>
std::vector<BuildCluster<Oriented>> clusters_of(const std::vector<Item>& items, const NormalizedSpace& space) {
    std::vector<BuildCluster<Oriented>> clusters;
    clusters.reserve(items.size());
    for (const Item& item : items) {
        clusters.push_back(detail::cluster_of<Oriented>(item, static_cast<std::uint32_t>(clusters.size()), space));
    }
    return clusters;
}

/// The greedy method as the papers state it: in each step look at all pairs and merge the best.
template <bool Oriented, class Item>
ClusterTree brute_force(const std::vector<Item>& items, const ClusterSize& size) {
    const auto [space, direction] = detail::GreedySpace::of(std::span<const Item>(items), size);
    std::vector<BuildCluster<Oriented>> clusters = clusters_of<Oriented>(items, space);
    const std::size_t count = clusters.size();
    std::vector<std::uint32_t> nodes(count);
    for (std::size_t i = 0; i < count; ++i) nodes[i] = static_cast<std::uint32_t>(i);
    std::vector<Rank> ranks(count * count);
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b < a; ++b) ranks[a * count + b] = detail::rank(clusters[a], clusters[b], direction);
    }
    detail::Linkage linkage(count);
    std::vector<bool> alive(count, true);
    for (std::size_t step = 1; step < count; ++step) {
        std::pair<std::size_t, std::size_t> best{count, count};
        for (std::size_t a = 0; a < count; ++a) {
            if (!alive[a]) continue;
            for (std::size_t b = 0; b < a; ++b) {
                if (!alive[b]) continue;
                if (best.first == count || ranks[a * count + b] < ranks[best.first * count + best.second])
                    best = {a, b};
            }
        }
        // Of a pair, the slot with the smaller index holds the smaller id.
        const auto [gone, kept] = best;
        nodes[kept] = linkage.join(nodes[kept], nodes[gone]);
        clusters[kept] = merge(clusters[kept], clusters[gone]);
        alive[gone] = false;
        for (std::size_t c = 0; c < count; ++c) {
            if (!alive[c] || c == kept) continue;
            ranks[std::max(c, kept) * count + std::min(c, kept)] = detail::rank(clusters[kept], clusters[c], direction);
        }
    }
    return linkage.tree();
}

TEST(Agglomerate, NoItemsMakeAnEmptyTree) {
    EXPECT_TRUE(agglomerate(std::vector<PointItem>{}).empty());
    EXPECT_TRUE(agglomerate(std::vector<OrientedItem>{}).empty());
}

TEST(Agglomerate, IsTheGreedyMethod) {
    Random random(1);
    for (int round = 0; round < 600; ++round) {
        const ItemSet set = random_items(random, 1 + random.below(round % 20 == 0 ? 200 : 70));
        const double unit = 1 / NormalizedSpace::of(std::span<const OrientedItem>(set.items)).per_length;
        const ClusterSize size = random.chance(0.3) ? ClusterSize{unit * random.decades(-2, 2)} : ClusterSize{};
        SCOPED_TRACE(set.name + "; c in diagonals " + std::to_string(size.direction_length.value_or(unit) / unit));
        const ClusterTree tree = agglomerate(set.items, size);
        ASSERT_NO_THROW(validate(tree));
        ASSERT_EQ(tree, (brute_force<true>(set.items, size)));
        const std::vector<PointItem> points = without_axes(set.items);
        const ClusterTree point_tree = agglomerate(points);
        ASSERT_EQ(point_tree, (brute_force<false>(points, {})));
        ASSERT_EQ(point_tree, agglomerate(set.items, ClusterSize{0}));
    }
}

TEST(Agglomerate, IsTheGreedyMethodForLargerSets) {
    Random random(2);
    for (const double jitter : {0.0, 0.1, 1.0}) {
        const std::vector<OrientedItem> items = room_items(random, 500, jitter);
        EXPECT_EQ(agglomerate(items), (brute_force<true>(items, {})));
    }
}

/// Equally spaced items whose weight falls along the line: the nearest neighbor of each is the next one, so that the
/// chain from the first leads to the last.
std::vector<PointItem> strip(std::size_t count) {
    std::vector<PointItem> items;
    for (std::size_t i = 0; i < count; ++i) {
        const float x = static_cast<float>(i) / static_cast<float>(count - 1);
        items.push_back({{x, 0, 0}, 1.0f + static_cast<float>(count - i) / static_cast<float>(count)});
    }
    return items;
}

TEST(Agglomerate, StepsOfChainsAreLinearInTheNumberOfItems) {
    Random random(8);
    std::vector<std::vector<PointItem>> sets{strip(257), strip(4097), strip(20000)};
    for (int round = 0; round < 20; ++round) sets.push_back(without_axes(random_items(random, 2000).items));
    for (const std::vector<PointItem>& items : sets) {
        const std::span<const PointItem> span(items);
        detail::Agglomerator<false> agglomerator(span, NormalizedSpace::of(span), 0);
        NoProgress progress;
        const ClusterTree tree = agglomerator.build(Sequential{}, progress);
        EXPECT_NO_THROW(validate(tree));
        EXPECT_LE(agglomerator.steps(), 11 * (items.size() - 1));
    }
}

TEST(Agglomerate, IsTheGreedyMethodWhereChainsAreLong) {
    for (const std::size_t count : {2u, 3u, 65u, 300u}) {
        EXPECT_EQ(agglomerate(strip(count)), brute_force<false>(strip(count), {})) << count;
    }
}

/// The greedy method in world units, by the paper's formula: I (alpha^2 + c^2 (1 - cos beta)^2).
ClusterTree in_world_units(const std::vector<OrientedItem>& items, double c) {
    struct Group {
        Box box;
        Cone cone;
        double weight;
        std::uint32_t id, node;
    };
    std::vector<Group> groups;
    for (const OrientedItem& i : items) {
        const auto id = static_cast<std::uint32_t>(groups.size());
        groups.push_back({box_of(i.position), cone_of(i.axis), static_cast<double>(i.weight), id, id});
    }
    const auto joined = [](const Group& a, const Group& b) {
        return Group{merge(a.box, b.box), merge(a.cone, b.cone), a.weight + b.weight, std::min(a.id, b.id), 0};
    };
    detail::Linkage linkage(items.size());
    while (groups.size() > 1) {
        std::pair<std::size_t, std::size_t> best;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t a = 0; a < groups.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                const Group group = joined(groups[a], groups[b]);
                const double spread = c * one_minus_cos(group.cone);
                const double size = group.weight * (diagonal2(group.box) + spread * spread);
                if (size < least) {
                    least = size;
                    best = {a, b};
                }
            }
        }
        const Group a = groups[best.first], b = groups[best.second];
        Group group = joined(a, b);
        group.node = a.id < b.id ? linkage.join(a.node, b.node) : linkage.join(b.node, a.node);
        groups[best.second] = group;
        groups[best.first] = groups.back();
        groups.pop_back();
    }
    return linkage.tree();
}

TEST(Agglomerate, TakesTheSizeOfDirectionsInWorldUnits) {
    Random random(9);
    int others = 0;
    for (int round = 0; round < 20; ++round) {
        const std::vector<OrientedItem> lights = room_items(random, 60, 0.3);
        const double diagonal = 1 / NormalizedSpace::of(std::span<const OrientedItem>(lights)).per_length;
        const double scene = diagonal * random.between(3, 30);
        const ClusterTree alone = agglomerate(lights), in_scene = agglomerate(lights, ClusterSize{scene});
        EXPECT_EQ(alone, in_world_units(lights, diagonal));
        EXPECT_EQ(in_scene, in_world_units(lights, scene));
        EXPECT_EQ(agglomerate(lights, ClusterSize{diagonal / 20}), in_world_units(lights, diagonal / 20));
        EXPECT_EQ(alone, agglomerate(lights, ClusterSize{diagonal}));
        others += alone == in_scene ? 0 : 1;
    }
    EXPECT_EQ(others, 20);
}

TEST(Agglomerate, TakesAnySizeOfDirections) {
    Random random(10);
    for (const double length : {1e-30, 1e-3, 1e9, 3e38}) {
        const std::vector<OrientedItem> items = room_items(random, 100, 0.3);
        EXPECT_NO_THROW(validate(agglomerate(items, ClusterSize{length}))) << length;
    }
    // Lamps at one place: only directions tell them apart.
    std::vector<OrientedItem> lamp = room_items(random, 100, 0.3);
    for (OrientedItem& item : lamp) item.position = {1, 2, 3};
    EXPECT_EQ(agglomerate(lamp, ClusterSize{1e7}), agglomerate(lamp));
}

TEST(Agglomerate, DoesNotDependOnTheExecutor) {
    Random random(3);
    const std::vector<OrientedItem> items = room_items(random, 3000, 0.1);
    const std::vector<PointItem> points = without_axes(items);
    EXPECT_EQ(agglomerate(items), agglomerate(items, ClusterSize{}, TwoThreads{}));
    EXPECT_EQ(agglomerate(items), agglomerate(items, ClusterSize{}, Backwards{}));
    EXPECT_EQ(agglomerate(points), agglomerate(points, ClusterSize{}, TwoThreads{}));
    for (int round = 0; round < 30; ++round) {
        const ItemSet set = random_items(random, 300);
        EXPECT_EQ(agglomerate(set.items), agglomerate(set.items, ClusterSize{}, TwoThreads{})) << set.name;
    }
}

TEST(Agglomerate, CoincidentItemsMakeABalancedTree) {
    for (const std::size_t count : {2u, 3u, 1000u, 20000u}) {
        const std::vector<OrientedItem> items(count, {{1, 2, 3}, {0, 1, 0}, 2});
        EXPECT_EQ(statistics(agglomerate(items), items).depth_max, static_cast<std::size_t>(std::bit_width(count - 1)));
    }
}

TEST(Agglomerate, RefusesAnImpossibleDirection) {
    const std::vector<OrientedItem> items{{{0, 0, 0}, {0, 0, 1}, 1}};
    for (const double direction : {-1.0, std::nan(""), 1e300}) {
        EXPECT_NE(refusal([&] { agglomerate(items, ClusterSize{direction}); }), "");
    }
}

TEST(ClusterSize, IsThePapersMetric) {
    Random random(4);
    for (int round = 0; round < 200; ++round) {
        const std::vector<OrientedItem> items = room_items(random, 8, 0.5);
        const auto space = NormalizedSpace::of(std::span<const OrientedItem>(items));
        const auto clusters = clusters_of<true>(items, space);
        const auto a = merge(clusters[0], merge(clusters[1], clusters[2])), b = merge(clusters[3], clusters[4]);
        Box box;
        double weight = 0;
        for (std::size_t i = 0; i < 5; ++i) {
            box = lightcuts::merge(box, box_of(items[i].position));
            weight += static_cast<double>(items[i].weight) * space.per_weight;
        }
        const double alpha2 = diagonal2(box) * space.per_length * space.per_length;
        const double spread = one_minus_cos(lightcuts::merge(a.cone, b.cone));
        const double c = random.between(0, 3);
        const double expected = weight * (alpha2 + c * c * spread * spread);
        EXPECT_NEAR(detail::union_size(a, b, c), expected, 3e-6 * expected);
    }
}

/// What lets mutual nearest neighbors be merged at once.
TEST(ClusterSize, IsStrictlyMonotone) {
    Random random(5);
    for (int round = 0; round < 3000; ++round) {
        const ItemSet set = random_items(random, 12);
        auto clusters = clusters_of<true>(set.items, NormalizedSpace::of(std::span<const OrientedItem>(set.items)));
        // Merge at random down to three clusters.
        while (clusters.size() > 3) {
            const std::size_t a = random.below(clusters.size() - 1);
            clusters[a] = merge(clusters[a], clusters.back());
            clusters.pop_back();
        }
        const auto& [a, b, c] = std::tie(clusters[0], clusters[1], clusters[2]);
        const Rank together = detail::rank(a, merge(b, c), 1.0);
        ASSERT_LT(detail::rank(a, b, 1.0), together) << set.name;
        ASSERT_LT(detail::rank(a, c, 1.0), together) << set.name;
        if (together.size > 0) { ASSERT_LT(detail::rank(a, b, 1.0).size, together.size) << set.name; }
    }
}

TEST(ClusterSize, IsSymmetric) {
    Random random(6);
    for (int round = 0; round < 1000; ++round) {
        const ItemSet set = random_items(random, 2);
        const auto clusters = clusters_of<true>(set.items,
                                                NormalizedSpace::of(std::span<const OrientedItem>(set.items)));
        EXPECT_EQ(detail::rank(clusters[0], clusters[1], 1.0).size, detail::rank(clusters[1], clusters[0], 1.0).size);
    }
}

/// The bounds of the neighbor tree, through whatever they exclude: also while clusters merge under stale nodes.
TEST(NeighborTree, FindsWhatALinearSearchFinds) {
    Random random(7);
    for (int round = 0; round < 150; ++round) {
        const ItemSet set = random_items(random, 2 + random.below(300));
        SCOPED_TRACE(set.name);
        auto unsorted = clusters_of<true>(set.items, NormalizedSpace::of(std::span<const OrientedItem>(set.items)));
        std::vector<BuildCluster<true>> clusters;
        for (const std::uint32_t s : detail::KdOrder<true>::of(unsorted, 1.0)) clusters.push_back(unsorted[s]);
        detail::NeighborTree<true> tree(clusters, 1.0, 1.0);
        std::vector<std::uint32_t> alive(clusters.size());
        for (std::size_t s = 0; s < alive.size(); ++s) alive[s] = static_cast<std::uint32_t>(s);
        while (alive.size() > 1) {
            const std::uint32_t slot = alive[random.below(alive.size())];
            detail::Neighbor expected;
            std::size_t index = 0;
            for (std::size_t i = 0; i < alive.size(); ++i) {
                if (alive[i] == slot) continue;
                const Rank r = detail::rank(clusters[slot], clusters[alive[i]], 1.0);
                if (r < expected.rank) {
                    expected = {alive[i], r};
                    index = i;
                }
            }
            ASSERT_EQ(tree.nearest(slot, {}).slot, expected.slot);
            // Merge it with its neighbor, or with any other cluster.
            if (random.chance(0.3)) index = random.below(alive.size());
            const std::uint32_t other = alive[index];
            if (other == slot) continue;
            clusters[slot] = merge(clusters[slot], clusters[other]);
            tree.replace(slot);
            tree.erase(other);
            alive[index] = alive.back();
            alive.pop_back();
        }
    }
}

}  // namespace
