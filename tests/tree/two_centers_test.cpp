#include <lightcuts/tree/build/two_centers.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/build/visibility_vectors.hpp>
#include <lightcuts/tree/statistics.hpp>
#include <lightcuts/tree/validate.hpp>
#include "support/random.hpp"

namespace lightcuts::test {
namespace {

static_assert(Splitter<TwoCenters, 3> && Splitter<TwoCenters, 6> && Splitter<DataDriven, 3> && Splitter<DataDriven, 6>);

std::vector<OrientedItem> directions(std::size_t n, std::uint64_t seed) {
    Random random(seed);
    std::vector<OrientedItem> items;
    for (std::size_t i = 0; i < n; ++i) {
        const glm::vec3 d(random.on_sphere());
        items.push_back({d, d, 1.0f});
    }
    return items;
}

std::set<std::uint32_t> items_below(const ClusterTree& tree, std::uint32_t n) {
    std::set<std::uint32_t> items;
    for (std::uint32_t d = tree.left_leaf(n); d <= n; ++d) {
        if (tree.is_leaf(d)) items.insert(tree.item(d));
    }
    return items;
}

TEST(TwoCenters, MakeACompleteTree) {
    for (const std::size_t n : {1u, 2u, 3u, 64u, 100u, 1000u}) {
        const auto items = directions(n, n);
        const ClusterTree tree = divide(items, TwoCenters{});
        ASSERT_NO_THROW(validate(tree));
        EXPECT_EQ(statistics(tree, std::span<const OrientedItem>(items)).depth_max, std::bit_width(n - 1));
    }
    // Also of items that coincide.
    const std::vector<PointItem> same(77, PointItem{{1, 2, 3}, 1});
    EXPECT_EQ(statistics(divide(same, TwoCenters{}), std::span<const PointItem>(same)).depth_max, 7u);
}

TEST(TwoCenters, PartWhatIsApart) {
    Random random(1);
    std::vector<PointItem> items;
    for (int i = 0; i < 60; ++i) {
        items.push_back(
            {glm::vec3(random.in_box({0, 0, 0}, {1, 1, 1})) + glm::vec3(i % 2 == 0 ? 0.0f : 9.0f, 0, 0), 1.0f});
    }
    const ClusterTree tree = divide(items, TwoCenters{});
    for (const std::uint32_t child : {tree.left(tree.root()), tree.right(tree.root())}) {
        const auto below = items_below(tree, child);
        for (const std::uint32_t i : below) EXPECT_EQ(i % 2, *below.begin() % 2);
    }
}

// Positions that coincide leave the normals.
TEST(TwoCenters, PartByNormalsToo) {
    std::vector<OrientedItem> items;
    for (int i = 0; i < 32; ++i) items.push_back({{0, 0, 0}, {0, 0, i % 2 == 0 ? 1.0f : -1.0f}, 1.0f});
    const ClusterTree tree = divide(items, TwoCenters{});
    const auto below = items_below(tree, tree.left(tree.root()));
    for (const std::uint32_t i : below) EXPECT_EQ(i % 2, *below.begin() % 2);
}

TEST(EvenClusters, AreACutOfEqualSizes) {
    const auto items = directions(1000, 3);
    const ClusterTree tree = divide(items, TwoCenters{});
    for (const std::size_t count : {1u, 7u, 64u, 5000u}) {
        const auto nodes = even_clusters(tree, count);
        EXPECT_EQ(nodes.size(), std::min<std::size_t>(count, 1000));
        std::size_t all = 0, most = 0, least = 1000;
        for (const std::uint32_t n : nodes) {
            all += tree.leaf_count(n);
            most = std::max(most, tree.leaf_count(n));
            least = std::min(least, tree.leaf_count(n));
        }
        EXPECT_EQ(all, 1000u);
        EXPECT_LE(most, 2 * least + 1);
    }
    EXPECT_TRUE(even_clusters(ClusterTree(), 5).empty());
}

/// Vertices on the floor, under a few balls; lights are directions.
struct Garden {
    std::vector<glm::dvec3> vertices;
    std::vector<std::pair<glm::dvec3, double>> balls;
    std::vector<OrientedItem> lights;

    explicit Garden(std::uint64_t seed) : lights(directions(4096, seed)) {
        Random random(seed + 1);
        for (int i = 0; i < 400; ++i) vertices.push_back(random.in_box({-3, -3, 0}, {3, 3, 0}));
        for (int i = 0; i < 12; ++i) {
            balls.push_back({random.in_box({-4, -4, 1}, {4, 4, 2.5}), random.between(0.2, 0.8)});
        }
    }
    float visibility(const glm::dvec3& from, std::uint32_t light) const {
        const glm::dvec3 d(lights[light].axis);
        if (d.z <= 0) return 0.0f;
        for (const auto& [center, radius] : balls) {
            const glm::dvec3 to = center - from;
            const double along = glm::dot(to, d);
            if (along > 0 && glm::dot(to, to) - along * along < radius * radius) return 0.0f;
        }
        return 1.0f;
    }
    /// The mean size of cuts from points that the tree was not made from.
    double cut_size(const ClusterTree& tree) const {
        Random random(77);
        double sum = 0;
        PiecewiseConstant<float> f;
        for (int i = 0; i < 60; ++i) {
            const glm::dvec3 from = random.in_box({-3, -3, 0}, {3, 3, 0});
            const auto of = moments(tree, [&](std::uint32_t light) { return visibility(from, light); });
            approximate(tree, of, 1.0, f);
            sum += static_cast<double>(f.size()) / 60;
        }
        return sum;
    }
};

TEST(DataDriven, MakesSmallerCutsOfWhatItHasNotSeen) {
    const Garden garden(5);
    std::vector<PointItem> vertices;
    for (const glm::dvec3& v : garden.vertices) vertices.push_back({glm::vec3(v), 1.0f});
    const ClusterTree vertex_tree = divide(vertices, TwoCenters{});
    const auto clusters = even_clusters(vertex_tree, 100);
    const auto vectors = visibility_vectors(vertex_tree, clusters, garden.lights.size(), [&](auto vertex, auto light) {
        return garden.visibility(garden.vertices[vertex], light);
    });
    const double geometric = garden.cut_size(divide(garden.lights, TwoCenters{}));
    const ClusterTree tree = divide(garden.lights, DataDriven(vectors, clusters.size()));
    ASSERT_NO_THROW(validate(tree));
    const double data_driven = garden.cut_size(tree);
    EXPECT_LT(data_driven, 0.9 * geometric) << data_driven << " " << geometric;
    // Beta 1 is geometry alone.
    EXPECT_EQ(divide(garden.lights, DataDriven(vectors, clusters.size(), 1.0)), divide(garden.lights, TwoCenters{}));
}

TEST(VisibilityVectors, AreMeansOverAllVerticesOfACluster) {
    const std::vector<PointItem> vertices{{{0, 0, 0}, 1}, {{0.1f, 0, 0}, 1}, {{5, 0, 0}, 1}, {{5.1f, 0, 0}, 1}};
    const ClusterTree tree = divide(vertices, TwoCenters{});
    const auto clusters = even_clusters(tree, 2);
    const auto vectors = visibility_vectors(
        tree, clusters, 3, [](std::uint32_t vertex, std::uint32_t light) { return vertex == light ? 1.0f : 0.0f; });
    ASSERT_EQ(vectors.size(), 6u);
    const bool left_is_first = items_below(tree, clusters[0]).contains(0);
    for (std::size_t light = 0; light < 3; ++light) {
        const bool in_first = (light < 2) == left_is_first;
        EXPECT_EQ(vectors[2 * light], in_first ? 0.5f : 0.0f);
        EXPECT_EQ(vectors[2 * light + 1], in_first ? 0.0f : 0.5f);
    }
}

TEST(DataDriven, RefusesVectorsThatAreNone) {
    const std::vector<float> vectors(10);
    EXPECT_THROW(DataDriven(vectors, 3), invalid_input);
    EXPECT_THROW(DataDriven(vectors, 0), invalid_input);
    EXPECT_THROW(DataDriven(vectors, 5, 1.5), invalid_input);
    EXPECT_THROW(DataDriven(vectors, 5, std::nan("")), invalid_input);
    EXPECT_THROW(DataDriven(vectors, 5, 0.5, {.position_factor = 30.0, .iterations = 0}), invalid_input);
    EXPECT_THROW(DataDriven(vectors, 5, 0.5, {.position_factor = INFINITY}), invalid_input);
    for (const float bad : {std::nanf(""), INFINITY, -INFINITY}) {
        std::vector<float> some = vectors;
        some[7] = bad;
        try {
            const DataDriven unused(some, 5);
            ADD_FAILURE() << bad;
        } catch (const invalid_input& error) {
            EXPECT_NE(std::string(error.what()).find("item 1, number 2 is not finite"), std::string::npos);
        }
    }
}
static_assert(!std::is_constructible_v<DataDriven, std::vector<float>, std::size_t>);

TEST(TwoCenters, RefuseOptionsOutOfRange) {
    const auto items = directions(20, 4);
    for (const TwoCenters bad : {TwoCenters{.iterations = 0}, TwoCenters{.iterations = -1},
                                 TwoCenters{.position_factor = std::nan("")}, TwoCenters{.position_factor = 1e200}}) {
        EXPECT_THROW(divide(items, bad), invalid_input);
    }
    EXPECT_NO_THROW(divide(items, TwoCenters{.position_factor = 1e100, .iterations = 1}));
}

}  // namespace
}  // namespace lightcuts::test
