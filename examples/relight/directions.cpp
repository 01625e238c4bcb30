#include "directions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/piecewise/tree_file.hpp>
#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/build/two_centers.hpp>
#include <lightcuts/tree/leaf_order.hpp>
#include <render/tbb_executor.hpp>

namespace relight {

namespace {

constexpr std::uint64_t summaries_tag = 0x6469'7265'6374'696fu;

/// Half of the distance between neighbors, were they a hexagonal lattice.
float half_spacing(std::size_t count) {
    return static_cast<float>(0.5 * std::sqrt(8.0 * std::numbers::pi / std::sqrt(3.0) / static_cast<double>(count)));
}

std::vector<DirectionCluster> clusters_of(const lightcuts::ClusterTree& tree, std::span<const glm::vec3> leaves) {
    std::vector<DirectionCluster> clusters(tree.size());
    std::vector<glm::dvec3> sums(tree.size());
    const float own = half_spacing(leaves.size());
    std::size_t left_of = 0;  // leaves before the subtree's end
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        if (tree.is_leaf(n)) {
            sums[n] = glm::dvec3(leaves[tree.item(n)]);
            ++left_of;
        } else {
            sums[n] = sums[tree.left(n)] + sums[tree.right(n)];
        }
        const std::size_t count = tree.leaf_count(n);
        const double length = glm::length(sums[n]);
        DirectionCluster& cluster = clusters[n];
        cluster.direction = length > 1e-6 ? glm::vec3(sums[n] / length) : leaves[left_of - count];
        double least = 1.0;
        for (std::size_t i = left_of - count; i < left_of; ++i) {
            least = std::min(least, glm::dot(glm::dvec3(cluster.direction), glm::dvec3(leaves[i])));
        }
        cluster.radius = static_cast<float>(std::acos(std::clamp(least, -1.0, 1.0))) + own;
    }
    return clusters;
}

std::vector<glm::vec3> leaves_of(const lightcuts::ClusterTree& tree, std::span<const DirectionCluster> clusters) {
    std::vector<glm::vec3> leaves;
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        if (tree.is_leaf(n)) leaves.push_back(clusters[n].direction);
    }
    return leaves;
}

[[noreturn]] void refuse(const std::string& what) {
    throw lightcuts::invalid_input("tree of directions: " + what + "; prepare it anew");
}

}  // namespace

Directions make_directions(const lightcuts::ClusterTree& tree, std::span<const glm::vec3> directions) {
    lightcuts::LeafOrder ordered = lightcuts::in_leaf_order(tree);
    Directions result;
    result.tree = std::move(ordered.tree);
    for (const std::uint32_t item : ordered.items) result.leaves.push_back(glm::normalize(directions[item]));
    result.clusters = clusters_of(result.tree, result.leaves);
    // As a file has them, where a leaf's direction is that of its cluster.
    result.leaves = leaves_of(result.tree, result.clusters);
    return result;
}

Directions geometric_directions(std::span<const glm::vec3> directions) {
    std::vector<lightcuts::OrientedItem> items;
    for (const glm::vec3& d : directions) items.push_back({d, d, 1.0f});
    return make_directions(lightcuts::divide(items, lightcuts::TwoCenters{}, render::TbbExecutor{}), directions);
}

std::vector<std::byte> to_bytes(const Directions& directions) {
    return lightcuts::tree_file(directions.tree, std::span<const DirectionCluster>(directions.clusters), summaries_tag);
}

Directions read_directions(std::span<const std::byte> bytes) {
    auto saved = lightcuts::read_tree<DirectionCluster>(bytes, summaries_tag);
    if (saved.tree.empty() || !saved.tree.is_binary()) refuse("has no directions, or more than two parts a node");
    std::uint32_t next = 0;
    for (std::uint32_t n = 0; n < saved.tree.size(); ++n) {
        const DirectionCluster& cluster = saved.summaries[n];
        const float length = glm::length(cluster.direction);
        if (!(std::abs(length - 1.0f) < 1e-3f && cluster.radius >= 0.0f && cluster.radius < 10.0f)) {
            refuse("node " + std::to_string(n) + " has no unit direction, or no radius");
        }
        if (saved.tree.is_leaf(n) && saved.tree.item(n) != next++) refuse("its leaves are not in order");
    }
    Directions result{std::move(saved.tree), std::move(saved.summaries), {}};
    result.leaves = leaves_of(result.tree, result.clusters);
    return result;
}

}  // namespace relight
