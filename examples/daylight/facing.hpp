#pragma once

#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/piecewise/moments.hpp>

#include "direction_tree.hpp"

namespace daylighting {

/// What all sensors of one normal have in common: by which cosine light counts that comes from each direction. Node
/// sums of light that are weighted so make illuminance exact in the cosine, and visibility behind the sensor's plane,
/// of weight 0, takes no pieces of any cut.
class Facing {
public:
    Facing(const DirectionTree& directions, const glm::vec3& normal);

    const glm::vec3& normal() const { return normal_; }
    /// max(0, normal . direction) of each direction.
    const std::vector<float>& cosines() const { return cosines_; }

    /// Weighted mean and sum of squared deviations of `visibility`, a value each direction, at every node, as
    /// approximations need them. What weighs nothing has mean 0 and no deviation.
    void moments(const lightcuts::ClusterTree& tree, const std::vector<float>& visibility,
                 std::vector<lightcuts::Moments<1>>& result) const;
    /// sqrt(sum of weight x visibility^2): what errors are relative to.
    double norm(const lightcuts::Moments<1>& root) const;

private:
    glm::vec3 normal_;
    std::vector<float> cosines_;
    std::vector<double> weights_;  ///< of each node, the sum of its cosines
};

}  // namespace daylighting
