#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/tree/cluster_tree.hpp>

namespace daylighting {

/// Directions spread evenly over the sphere and a tree over them. Directions stand in the order of the tree's leaves:
/// that at place i is leaf number i from the left, and the leaf's item.
struct DirectionTree {
    lightcuts::ClusterTree tree;
    std::vector<glm::vec3> directions;  ///< unit, in the scene's axes

    std::size_t size() const { return directions.size(); }
    /// What each direction stands for, sr.
    double solid_angle() const;
    /// The place of the direction nearest to `direction`. cost: O(size)
    std::uint32_t nearest(const glm::vec3& direction) const;
};

/// The same on every run and machine. pre: 2 <= count. cost: a second for 32,768.
DirectionTree make_direction_tree(std::size_t count);

}  // namespace daylighting
