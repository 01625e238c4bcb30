#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/tree/cluster_tree.hpp>

namespace relight {

/// What is known of a node of a tree over directions.
struct DirectionCluster {
    glm::vec3 direction{0.0f};  ///< unit: the mean of those below
    float radius = 0.0f;        ///< largest angle between it and them, plus half of the distance between neighbors

    bool operator==(const DirectionCluster&) const = default;
};

/// Directions spread evenly over the sphere and a tree over them. Item i is the i-th leaf from the left, so that items
/// of one node are neighbors.
struct Directions {
    lightcuts::ClusterTree tree;
    std::vector<DirectionCluster> clusters;  ///< by node
    std::vector<glm::vec3> leaves;           ///< unit, by item

    std::size_t size() const { return leaves.size(); }
};

/// The tree's items are renumbered: see Directions. `directions`: by item of `tree`.
Directions make_directions(const lightcuts::ClusterTree& tree, std::span<const glm::vec3> directions);

/// Splits evenly by the geometric metric [Cut merging 2008, Eq. 10]. pre: at least one direction.
Directions geometric_directions(std::span<const glm::vec3> directions);

/// The bytes of a file of them, and what is in one. throws: invalid_input, one line, if it is damaged.
std::vector<std::byte> to_bytes(const Directions& directions);
Directions read_directions(std::span<const std::byte> bytes);

}  // namespace relight
